// SPDX-License-Identifier: BSD-3-Clause
// How far a path is from the style of the database, cheap enough to compare candidates by it.
#pragma once

#include "Base/Types.h"
#include "Trajectory/MotionDatabase.h"

#include <cstdint>
#include <vector>

namespace waft
{

/// How many of some values lie between which quantiles of the database: all that the distance of
/// two distributions needs, and no longer for a longer flight.
struct ValuesByQuantile
{
  std::vector<std::int64_t> Counts; // one more than quantiles; none: no value yet
  double Largest = 0.0;

  void Add(const ValuesByQuantile& others);
};

/// Curvatures [ln(1/m)] and accelerations [m/s^2] along what an object has flown so far.
struct StyleHistory
{
  ValuesByQuantile LogCurvature;
  ValuesByQuantile Acceleration;
};

class StyleGauge
{
public:
  StyleGauge() = default;
  explicit StyleGauge(const MotionDatabase& database);

  /// Adds the inner samples first..last-1 of a path [s between samples].
  void Append(const std::vector<Vec3>& positions, double step, int first, int last,
              StyleHistory& history) const;
  /// Kolmogorov-Smirnov distances of the curvatures and of the accelerations, weighted 1.25 and
  /// 0.75 and added; 0 without samples.
  double Distance(const StyleHistory& history) const;
  /// By how much the largest acceleration of a flight exceeds what one in a hundred samples of the
  /// database does, relative to that; at least 0.
  double AccelerationExcess(const StyleHistory& flight) const;

private:
  std::vector<double> LogCurvature; // quantiles, evenly spaced in probability
  std::vector<double> Acceleration;
  double HighAcceleration = 0.0; // m/s^2
};

} // namespace waft
