// SPDX-License-Identifier: BSD-3-Clause
// How far a path is from the style of the database, cheap enough to compare candidates by it.
#pragma once

#include "Base/Types.h"
#include "Trajectory/MotionDatabase.h"

#include <vector>

namespace waft
{

/// Curvatures and accelerations along what an object has flown so far.
struct StyleHistory
{
  std::vector<double> LogCurvature; // ln(1/m)
  std::vector<double> Acceleration; // m/s^2
};

class StyleGauge
{
public:
  StyleGauge() = default;
  explicit StyleGauge(const MotionDatabase& database);

  /// Adds the inner samples first..last-1 of a path [s between samples].
  static void Append(const std::vector<Vec3>& positions, double step, int first, int last,
                     StyleHistory& history);
  /// Kolmogorov-Smirnov distance of the curvatures plus that of the accelerations; 0 without
  /// samples.
  double Distance(StyleHistory history) const;

private:
  std::vector<double> LogCurvature; // quantiles, evenly spaced in probability
  std::vector<double> Acceleration;
};

} // namespace waft
