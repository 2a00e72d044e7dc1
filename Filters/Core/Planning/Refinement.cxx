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

namespace
{

/// A piece between its neighbours.
struct Place
{
  const Piece& Before;
  const Piece& Own;
  const Piece& After;

  double CostOf(const SegmentLibrary& library, const Piece& piece) const
  {
    return ConnectionCost(library, this->Before, piece) +
           ConnectionCost(library, piece, this->After);
  }
};

/// Another segment in a piece's stead.
struct Trial
{
  int Segment = -1;
  Mat3 Rotation = Mat3::Identity();
  double Cost = 1e300;
  double Shift = 1e300; // change of displacement [m]
};

double TotalCost(const SegmentLibrary& library, const PieceChain& chain)
{
  double sum = 0.0;
  for (std::size_t i = 1; i < chain.Pieces.size(); ++i)
  {
    sum += ConnectionCost(library, chain.Pieces[i - 1], chain.Pieces[i]);
  }
  return sum;
}

/// As the neighbours fly in the windows that the piece shares with them.
Steps WantedSteps(const SegmentLibrary& library, const Place& place)
{
  const int steps = library.Window() - 1;
  Steps wanted;
  AppendWindow(library.Samples(place.Before.Segment), place.Before.Last - steps, steps, wanted);
  for (Vec3& step : wanted)
  {
    step = place.Before.Transform.Rotation * step;
  }
  AppendWindow(library.Samples(place.After.Segment), place.After.First, steps, wanted);
  for (int k = steps; k < 2 * steps; ++k)
  {
    wanted[k] = place.After.Transform.Rotation * wanted[k];
  }
  return wanted;
}

Trial TryThere(const SegmentLibrary& library, const Place& place, const Steps& wanted, int segment)
{
  Trial trial;
  const std::vector<Vec3>& old = library.Samples(place.Own.Segment);
  const std::vector<Vec3>& samples = library.Samples(segment);
  if (samples.size() != old.size())
  {
    return trial;
  }
  const int steps = library.Window() - 1;
  Steps own;
  AppendWindow(samples, 0, steps, own);
  AppendWindow(samples, static_cast<int>(samples.size()) - 1 - steps, steps, own);
  trial.Segment = segment;
  trial.Rotation = FitRotation(library, own, wanted);
  Piece candidate = place.Own;
  candidate.Segment = segment;
  candidate.Transform.Rotation = trial.Rotation;
  trial.Cost = place.CostOf(library, candidate);
  const Vec3 displacement = place.Own.Transform.Rotation * (old.back() - old.front());
  trial.Shift = (trial.Rotation * (samples.back() - samples.front()) - displacement).norm();
  return trial;
}

/// Down the clusters of the piece's top node, the cheapest child at each: the cheapest of all that
/// are seen, or the piece as it is.
Trial FindBetter(const SegmentLibrary& library, const Place& place, double maximumShift)
{
  const MotionDatabase& database = library.Database();
  const Steps wanted = WantedSteps(library, place);
  Trial best;
  best.Segment = place.Own.Segment;
  best.Rotation = place.Own.Transform.Rotation;
  best.Cost = place.CostOf(library, place.Own);
  int node = database.TopNodes[place.Own.Top];
  while (node >= 0 && database.Nodes[node].FirstChild >= 0)
  {
    const ClusterNode& cluster = database.Nodes[node];
    int next = -1;
    double nextCost = 1e300;
    for (int c = cluster.FirstChild; c < cluster.FirstChild + cluster.NumberOfChildren; ++c)
    {
      const Trial trial = TryThere(library, place, wanted, database.Nodes[c].Medoid);
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
  return best;
}

/// What follows is moved along with the piece's end.
void Replace(const SegmentLibrary& library, const Trial& better, std::size_t i, PieceChain& chain)
{
  Piece& piece = chain.Pieces[i];
  const std::vector<Vec3>& old = library.Samples(piece.Segment);
  const Vec3 head = piece.Transform * old.front();
  const Vec3 tail = piece.Transform * old.back();
  piece.Segment = better.Segment;
  piece.Transform.Rotation = better.Rotation;
  const std::vector<Vec3>& samples = library.Samples(piece.Segment);
  piece.Transform.Translation = head - better.Rotation * samples.front();
  const Vec3 shift = piece.Transform * samples.back() - tail;
  for (std::size_t j = i + 1; j < chain.Pieces.size(); ++j)
  {
    chain.Pieces[j].Transform.Translation += shift;
  }
}

} // namespace

RefinementResult RefineChain(const SegmentLibrary& library, double maximumShift, PieceChain& chain)
{
  RefinementResult result;
  result.CostBefore = TotalCost(library, chain);
  for (std::size_t i = 1; i + 1 < chain.Pieces.size(); ++i)
  {
    const Place place{ chain.Pieces[i - 1], chain.Pieces[i], chain.Pieces[i + 1] };
    const std::size_t count = library.Samples(place.Own.Segment).size();
    if (place.Own.First != 0 || place.Own.Last + 1 != static_cast<int>(count))
    {
      continue;
    }
    const Trial better = FindBetter(library, place, maximumShift);
    if (better.Cost < place.CostOf(library, place.Own))
    {
      Replace(library, better, i, chain);
      ++result.NumberOfReplaced;
    }
  }
  result.CostAfter = TotalCost(library, chain);
  return result;
}

} // namespace waft
