// SPDX-License-Identifier: BSD-3-Clause
#include "Trajectory/Coverage.h"

#include "Trajectory/Compression.h"
#include "Trajectory/SegmentFrame.h"
#include "Trajectory/TrackPieces.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace waft
{

namespace
{

Eigen::MatrixXd PrincipalDirections(const Eigen::MatrixXd& samples)
{
  const Eigen::VectorXd mean = samples.rowwise().mean();
  const Eigen::MatrixXd centered = samples.colwise() - mean;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(SecondMoments(centered));
  return axes.eigenvectors().rowwise().reverse();
}

Eigen::MatrixXf SortedByFirstRow(const Eigen::MatrixXf& columns)
{
  std::vector<Eigen::Index> order(static_cast<std::size_t>(columns.cols()));
  std::iota(order.begin(), order.end(), Eigen::Index(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return columns(0, a) < columns(0, b); });
  Eigen::MatrixXf sorted(columns.rows(), columns.cols());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    sorted.col(static_cast<Eigen::Index>(i)) = columns.col(order[i]);
  }
  return sorted;
}

/// Whether the squared distance is at most the limit; it gives up where a part of it is more.
bool IsNear(const float* a, const float* b, Eigen::Index size, float limit)
{
  constexpr Eigen::Index part = 4;
  float sum = 0.0f;
  Eigen::Index i = 0;
  for (; i + part <= size && sum <= limit; i += part)
  {
    for (Eigen::Index j = i; j < i + part; ++j)
    {
      sum += (a[j] - b[j]) * (a[j] - b[j]);
    }
  }
  for (; i < size && sum <= limit; ++i)
  {
    sum += (a[i] - b[i]) * (a[i] - b[i]);
  }
  return sum <= limit;
}

/// Whether one of the columns, sorted by the first row, is within reach of the sample.
bool HasNear(const Eigen::MatrixXf& columns, const float* sample, float reach)
{
  const Eigen::Index size = columns.rows();
  const Eigen::Index count = columns.cols();
  const auto before = [&](Eigen::Index column) { return columns(0, column) < sample[0] - reach; };
  Eigen::Index low = 0;
  for (Eigen::Index high = count; low < high;)
  {
    const Eigen::Index middle = (low + high) / 2;
    before(middle) ? low = middle + 1 : high = middle;
  }
  for (Eigen::Index c = low; c < count && columns(0, c) <= sample[0] + reach; ++c)
  {
    if (IsNear(columns.col(c).data(), sample, size, reach * reach))
    {
      return true;
    }
  }
  return false;
}

} // namespace

Coverage::Coverage(const SegmentationOptions& options, double framesPerSecond, double width,
                   double tolerance) :
  Options(options),
  FramesPerSecond(framesPerSecond), Width(width), Tolerance(tolerance)
{
  for (const int length : GroupLengths(options))
  {
    this->Groups.emplace_back();
    this->Groups.back().NumberOfSamples = length;
  }
}

int Coverage::CountNew(const Group& group, const Block& block, const ParallelFor& parallelFor) const
{
  const double chord = std::sqrt(group.SquaredChords / group.NumberOfSegments);
  const float reach =
    static_cast<float>(this->Tolerance * chord * std::sqrt(group.NumberOfSamples));
  std::vector<unsigned char> isNew(static_cast<std::size_t>(block.cols()), 0);
  parallelFor(isNew.size(),
              [&](std::size_t begin, std::size_t end)
              {
                for (std::size_t s = begin; s < end; ++s)
                {
                  const float* sample = block.col(static_cast<Eigen::Index>(s)).data();
                  isNew[s] = std::none_of(group.Blocks.begin(), group.Blocks.end(),
                                          [&](const Block& earlier)
                                          { return HasNear(earlier, sample, reach); });
                }
              });
  return std::accumulate(isNew.begin(), isNew.end(), 0);
}

void Coverage::Add(const std::vector<Track>& tracks, const ParallelFor& parallelFor)
{
  std::vector<int> lengths;
  for (const Group& group : this->Groups)
  {
    lengths.push_back(group.NumberOfSamples);
  }
  std::vector<std::vector<Eigen::VectorXd>> samples(this->Groups.size());
  for (const TrackPiece& piece :
       CutTracks(tracks, this->FramesPerSecond, this->Width, this->Options, lengths))
  {
    const std::vector<Vec3> part = PositionsOf(tracks, piece);
    Group& group = this->Groups[piece.Length];
    group.SquaredChords += (part.back() - part.front()).squaredNorm();
    ++group.NumberOfSegments;
    samples[piece.Length].push_back(LocalSamples(part, FrameOf(part)));
  }
  CoveragePoint point;
  point.Simulations = this->Simulations++;
  int isNew = 0;
  for (std::size_t g = 0; g < this->Groups.size(); ++g)
  {
    if (samples[g].empty())
    {
      continue;
    }
    Group& group = this->Groups[g];
    Eigen::MatrixXd columns(3 * group.NumberOfSamples,
                            static_cast<Eigen::Index>(samples[g].size()));
    for (std::size_t s = 0; s < samples[g].size(); ++s)
    {
      columns.col(static_cast<Eigen::Index>(s)) = samples[g][s];
    }
    if (group.Directions.size() == 0)
    {
      group.Directions = PrincipalDirections(columns);
    }
    const Block block =
      SortedByFirstRow((group.Directions.transpose() * columns).template cast<float>());
    point.NewSegments += static_cast<int>(block.cols());
    isNew += CountNew(group, block, parallelFor);
    group.Blocks.push_back(block);
  }
  if (point.Simulations == 0)
  {
    return; // everything in it is new
  }
  point.NewShare = point.NewSegments > 0 ? double(isNew) / point.NewSegments : 0.0;
  this->Points.push_back(point);
}

} // namespace waft
