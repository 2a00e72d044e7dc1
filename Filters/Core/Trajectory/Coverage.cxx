// SPDX-License-Identifier: BSD-3-Clause
#include "Trajectory/Coverage.h"

#include <algorithm>
#include <cmath>

namespace waft
{

namespace
{

/// Rms distance between the ends of the segments of each group [m].
std::vector<double> Chords(const MotionDatabase& database)
{
  std::vector<double> squares(database.Groups.size(), 0.0);
  std::vector<int> counts(database.Groups.size(), 0);
  for (std::size_t s = 0; s < database.Segments.size(); ++s)
  {
    const std::vector<Vec3> path = database.Reconstruct(static_cast<int>(s));
    squares[database.Segments[s].Group] += (path.back() - path.front()).squaredNorm();
    ++counts[database.Segments[s].Group];
  }
  for (std::size_t g = 0; g < squares.size(); ++g)
  {
    squares[g] = std::sqrt(squares[g] / std::max(counts[g], 1));
  }
  return squares;
}

} // namespace

std::vector<CoveragePoint> CoverageCurve(const MotionDatabase& database, double tolerance)
{
  int simulations = 0;
  for (const Segment& segment : database.Segments)
  {
    simulations = std::max(simulations, segment.Simulation + 1);
  }
  const std::vector<double> chords = Chords(database);
  std::vector<CoveragePoint> curve;
  for (int next = 1; next < simulations; ++next)
  {
    CoveragePoint point;
    point.Simulations = next;
    int isNew = 0;
    for (const Segment& segment : database.Segments)
    {
      if (segment.Simulation != next)
      {
        continue;
      }
      ++point.NewSegments;
      const double limit = tolerance * chords[segment.Group];
      const int samples = database.Groups[segment.Group].NumberOfSamples;
      const double squared = limit * limit * samples;
      const bool isKnown =
        std::any_of(database.Segments.begin(), database.Segments.end(),
                    [&](const Segment& other)
                    {
                      return other.Simulation < next && other.Group == segment.Group &&
                             (other.Coefficients - segment.Coefficients).squaredNorm() <= squared;
                    });
      isNew += isKnown ? 0 : 1;
    }
    point.NewShare = point.NewSegments > 0 ? double(isNew) / point.NewSegments : 0.0;
    curve.push_back(point);
  }
  return curve;
}

} // namespace waft
