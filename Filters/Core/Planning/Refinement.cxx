// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/Refinement.h"

#include "Planning/PlannerNumbers.h"

#include <cmath>

namespace waft
{

namespace
{

using Steps = std::vector<Vec3>;

/// Steps of the head or tail window of a segment, in its own frame.
void AppendWindow(const std::vector<Vec3>& samples, int first, int count, Steps& steps)
{
  for (int k = 0; k < count; ++k)
  {
    steps.push_back(samples[first + k + 1] - samples[first + k]);
  }
}

/// The yaw, then the small tilt, that carries `own` onto `wanted` best in the least-squares sense.
Mat3 FitRotation(const SegmentLibrary& library, const Steps& own, const Steps& wanted)
{
  double sine = 0.0;
  double cosine = 0.0;
  for (std::size_t k = 0; k < own.size(); ++k)
  {
    sine += own[k].x() * wanted[k].y() - own[k].y() * wanted[k].x();
    cosine += own[k].x() * wanted[k].x() + own[k].y() * wanted[k].y();
  }
  Mat3 rotation = Eigen::AngleAxisd(std::atan2(sine, cosine), Vec3::UnitZ()).toRotationMatrix();
  if (library.Options().Freedom == RotationFreedom::Yaw)
  {
    return rotation;
  }
  for (int iteration = 0; iteration < PlannerNumbers::RotationSteps; ++iteration)
  {
    // Gauss-Newton on the rotation vector; the ridge keeps straight windows from spinning.
    Mat3 normal = Mat3::Zero();
    Vec3 right = Vec3::Zero();
    for (std::size_t k = 0; k < own.size(); ++k)
    {
      const Vec3 b = rotation * own[k];
      normal += b.squaredNorm() * Mat3::Identity() - b * b.transpose();
      right += b.cross(wanted[k]);
    }
    normal += PlannerNumbers::RotationRidge * normal.trace() * Mat3::Identity();
    const Vec3 turn = normal.ldlt().solve(right);
    const double angle = turn.norm();
    if (!(angle > 1e-12))
    {
      break;
    }
    rotation = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() * rotation;
    library.LimitTilt(rotation);
  }
  return rotation;
}

struct Trial
{
  int Segment = -1;
  Mat3 Rotation = Mat3::Identity();
  double Cost = 1e300;
  double Shift = 1e300; // change of displacement [m]
};

} // namespace

double ConnectionCost(const SegmentLibrary& library, const Piece& before, const Piece& after)
{
  const int steps = library.Window() - 1;
  const std::vector<Vec3>& first = library.Samples(before.Segment);
  const std::vector<Vec3>& second = library.Samples(after.Segment);
  double difference = 0.0;
  double scale = 0.0;
  for (int k = 0; k < steps; ++k)
  {
    const int i = before.Last - steps + k;
    const Vec3 a = before.Transform.Rotation * (first[i + 1] - first[i]);
    const int j = after.First + k;
    const Vec3 b = after.Transform.Rotation * (second[j + 1] - second[j]);
    difference += (a - b).squaredNorm();
    scale += 0.5 * (a.squaredNorm() + b.squaredNorm());
  }
  return scale > 0.0 ? difference / scale : 0.0;
}

RefinementResult RefineChain(const SegmentLibrary& library, double maximumShift, PieceChain& chain)
{
  RefinementResult result;
  const MotionDatabase& database = library.Database();
  const auto total = [&]()
  {
    double sum = 0.0;
    for (std::size_t i = 1; i < chain.Pieces.size(); ++i)
    {
      sum += ConnectionCost(library, chain.Pieces[i - 1], chain.Pieces[i]);
    }
    return sum;
  };
  result.CostBefore = total();
  const int steps = library.Window() - 1;
  for (std::size_t i = 1; i + 1 < chain.Pieces.size(); ++i)
  {
    Piece& piece = chain.Pieces[i];
    const Piece& before = chain.Pieces[i - 1];
    const Piece& after = chain.Pieces[i + 1];
    const std::size_t count = library.Samples(piece.Segment).size();
    if (piece.First != 0 || piece.Last + 1 != static_cast<int>(count))
    {
      continue;
    }
    Steps wanted;
    AppendWindow(library.Samples(before.Segment), before.Last - steps, steps, wanted);
    for (Vec3& step : wanted)
    {
      step = before.Transform.Rotation * step;
    }
    AppendWindow(library.Samples(after.Segment), after.First, steps, wanted);
    for (int k = steps; k < 2 * steps; ++k)
    {
      wanted[k] = after.Transform.Rotation * wanted[k];
    }
    const Vec3 displacement = piece.Transform.Rotation * (library.Samples(piece.Segment).back() -
                                                          library.Samples(piece.Segment).front());
    const auto evaluate = [&](int segment)
    {
      Trial trial;
      const std::vector<Vec3>& samples = library.Samples(segment);
      if (samples.size() != count)
      {
        return trial;
      }
      Steps own;
      AppendWindow(samples, 0, steps, own);
      AppendWindow(samples, static_cast<int>(count) - 1 - steps, steps, own);
      trial.Segment = segment;
      trial.Rotation = FitRotation(library, own, wanted);
      Piece candidate = piece;
      candidate.Segment = segment;
      candidate.Transform.Rotation = trial.Rotation;
      trial.Cost =
        ConnectionCost(library, before, candidate) + ConnectionCost(library, candidate, after);
      trial.Shift = (trial.Rotation * (samples.back() - samples.front()) - displacement).norm();
      return trial;
    };
    Trial best;
    best.Segment = piece.Segment;
    best.Rotation = piece.Transform.Rotation;
    best.Cost = ConnectionCost(library, before, piece) + ConnectionCost(library, piece, after);
    const double original = best.Cost;
    int node = database.TopNodes[piece.Top];
    while (node >= 0 && database.Nodes[node].FirstChild >= 0)
    {
      const ClusterNode& cluster = database.Nodes[node];
      int next = -1;
      double nextCost = 1e300;
      for (int c = cluster.FirstChild; c < cluster.FirstChild + cluster.NumberOfChildren; ++c)
      {
        const Trial trial = evaluate(database.Nodes[c].Medoid);
        if (trial.Cost < nextCost)
        {
          nextCost = trial.Cost;
          next = c;
        }
        if (trial.Cost < best.Cost && trial.Shift <= maximumShift)
        {
          best = trial;
        }
      }
      node = next;
    }
    if (best.Cost < original)
    {
      const std::vector<Vec3>& old = library.Samples(piece.Segment);
      const Vec3 head = piece.Transform * old.front();
      const Vec3 tail = piece.Transform * old.back();
      piece.Segment = best.Segment;
      piece.Transform.Rotation = best.Rotation;
      const std::vector<Vec3>& samples = library.Samples(piece.Segment);
      piece.Transform.Translation = head - best.Rotation * samples.front();
      const Vec3 shift = piece.Transform * samples.back() - tail;
      for (std::size_t j = i + 1; j < chain.Pieces.size(); ++j)
      {
        chain.Pieces[j].Transform.Translation += shift;
      }
      ++result.NumberOfReplaced;
    }
  }
  result.CostAfter = total();
  return result;
}

} // namespace waft
