// SPDX-License-Identifier: BSD-3-Clause
#include "Trajectory/Segmentation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace waft
{

namespace
{

constexpr double SpeedFloor = 0.02; // m/s

/// Least curvature in [begin, end]; of equals the one nearest to the middle.
int LeastCurved(const std::vector<double>& curvature, int begin, int end)
{
  int best = begin;
  for (int i = begin; i <= end; ++i)
  {
    const bool isEqual = curvature[i] == curvature[best];
    const bool isNearer = std::abs(2 * i - begin - end) < std::abs(2 * best - begin - end);
    if (curvature[i] < curvature[best] || (isEqual && isNearer))
    {
      best = i;
    }
  }
  return best;
}

void JoinShort(const std::vector<double>& curvature, int shortest, std::vector<int>& cuts)
{
  while (cuts.size() > 2)
  {
    std::size_t found = 0;
    int least = shortest;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
    {
      const int count = cuts[i + 1] - cuts[i] + 1;
      if (count < least)
      {
        least = count;
        found = i;
      }
    }
    if (least == shortest)
    {
      return;
    }
    const bool hasLeft = found > 0;
    const bool hasRight = found + 2 < cuts.size();
    const bool dropsRight =
      !hasLeft || (hasRight && curvature[cuts[found + 1]] >= curvature[cuts[found]]);
    cuts.erase(cuts.begin() + static_cast<std::ptrdiff_t>(dropsRight ? found + 1 : found));
  }
}

void SplitLong(const std::vector<double>& curvature, const SegmentationOptions& options,
               std::vector<int>& cuts)
{
  for (std::size_t i = 0; i + 1 < cuts.size();)
  {
    const int count = cuts[i + 1] - cuts[i] + 1;
    // Near the middle: the least curvature of all often lies beside an end, and would leave a part
    // of the shortest length.
    const int margin = std::max(options.ShortestSegment - 1, count / 3);
    const int begin = cuts[i] + margin;
    const int end = cuts[i + 1] - margin;
    if (count > options.LongestSegment && begin <= end)
    {
      cuts.insert(cuts.begin() + static_cast<std::ptrdiff_t>(i + 1),
                  LeastCurved(curvature, begin, end));
    }
    else
    {
      ++i;
    }
  }
}

} // namespace

Result SegmentationOptions::Validate() const
{
  WAFT_RETURN_IF_FAILED(ValidateFields<SegmentationOptions>(*this));
  if (this->LongestSegment < 2 * this->ShortestSegment)
  {
    return Result::Error("LongestSegment: expected at least twice ShortestSegment, " +
                         std::to_string(this->ShortestSegment) + ", found " +
                         std::to_string(this->LongestSegment));
  }
  return Result::Ok();
}

std::vector<double> CurvatureAlong(const std::vector<Vec3>& positions, double step)
{
  const int count = static_cast<int>(positions.size());
  std::vector<double> raw(positions.size(), 0.0);
  if (count < 3)
  {
    return raw;
  }
  for (int i = 1; i + 1 < count; ++i)
  {
    const Vec3 velocity = (positions[i + 1] - positions[i - 1]) / (2.0 * step);
    const Vec3 acceleration =
      (positions[i + 1] - 2.0 * positions[i] + positions[i - 1]) / (step * step);
    const double squared = velocity.squaredNorm() + SpeedFloor * SpeedFloor;
    raw[i] = velocity.cross(acceleration).norm() / (squared * std::sqrt(squared));
  }
  raw.front() = raw[1];
  raw.back() = raw[count - 2];

  constexpr std::array<double, 5> weights{ 1.0, 2.0, 3.0, 2.0, 1.0 };
  std::vector<double> smooth(positions.size());
  for (int i = 0; i < count; ++i)
  {
    double sum = 0.0;
    double total = 0.0;
    for (int o = -2; o <= 2; ++o)
    {
      if (i + o >= 0 && i + o < count)
      {
        sum += weights[o + 2] * raw[i + o];
        total += weights[o + 2];
      }
    }
    smooth[i] = sum / total;
  }
  return smooth;
}

std::vector<int> CutsBetweenFeatures(const std::vector<double>& curvature, double featureCurvature,
                                     double featureContrast)
{
  // One pass with hysteresis: a feature is closed once the curvature has fallen from its peak by
  // the contrast, and the next one is opened once it has risen again by the contrast from the least
  // value since.
  std::vector<int> cuts;
  const int count = static_cast<int>(curvature.size());
  double peak = 0.0;    // of the open feature
  bool isClosed = true; // nothing is open yet
  bool hasFeature = false;
  int valley = 0; // begin of the stretch in which the next cut lies
  double least = count > 0 ? curvature[0] : 0.0;
  for (int i = 0; i < count; ++i)
  {
    const double value = curvature[i];
    if (!isClosed)
    {
      peak = std::max(peak, value);
      if (value * featureContrast <= peak)
      {
        isClosed = true;
        valley = i;
        least = value;
      }
      continue;
    }
    least = std::min(least, value);
    if (value >= featureCurvature && (!hasFeature || value >= featureContrast * least))
    {
      if (hasFeature)
      {
        cuts.push_back(LeastCurved(curvature, valley, i));
      }
      hasFeature = true;
      isClosed = false;
      peak = value;
    }
  }
  return cuts;
}

std::vector<SampleRange> CutPath(const std::vector<double>& curvature,
                                 const SegmentationOptions& options, double featureCurvature)
{
  std::vector<SampleRange> ranges;
  const int count = static_cast<int>(curvature.size());
  if (count < options.ShortestSegment)
  {
    return ranges;
  }
  std::vector<int> cuts = CutsBetweenFeatures(curvature, featureCurvature, options.FeatureContrast);
  cuts.insert(cuts.begin(), 0);
  cuts.push_back(count - 1);
  JoinShort(curvature, options.ShortestSegment, cuts);
  SplitLong(curvature, options, cuts);
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
  {
    ranges.push_back({ cuts[i], cuts[i + 1] - cuts[i] + 1 });
  }
  return ranges;
}

std::vector<int> GroupLengths(const SegmentationOptions& options)
{
  // As many steps as come nearest to the ratio, so that the last group is the longest segment.
  const double span = double(options.LongestSegment) / options.ShortestSegment;
  const int steps =
    std::max(1, static_cast<int>(std::lround(std::log(span) / std::log(options.LengthRatio))));
  std::vector<int> lengths;
  for (int i = 0; i <= steps; ++i)
  {
    const int length =
      static_cast<int>(std::lround(options.ShortestSegment * std::pow(span, double(i) / steps)));
    if (lengths.empty() || length > lengths.back())
    {
      lengths.push_back(length);
    }
  }
  return lengths;
}

SampleRange Truncate(const SampleRange& range, int count, const std::vector<double>& curvature)
{
  double sum = 0.0;
  for (int i = 0; i < count; ++i)
  {
    sum += curvature[range.First + i];
  }
  double most = sum;
  int best = range.First;
  for (int first = range.First + 1; first + count <= range.First + range.Count; ++first)
  {
    sum += curvature[first + count - 1] - curvature[first - 1];
    if (sum > most)
    {
      most = sum;
      best = first;
    }
  }
  return { best, count };
}

} // namespace waft
