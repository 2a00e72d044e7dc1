// SPDX-License-Identifier: BSD-3-Clause
// Figures by which the style of a motion is judged: curvature, acceleration and speed of its
// samples, and the distance between two such populations.
#pragma once

#include "Base/Types.h"
#include "Trajectory/MotionDatabase.h"

#include <vector>

namespace waft
{

/// Pooled over any number of paths; the three lists need not be equally long.
struct StyleSamples
{
  std::vector<double> LogCurvature; // natural logarithm of the curvature [1/m]
  std::vector<double> Acceleration; // |a| [m/s^2]
  std::vector<double> Speed;        // m/s
};

/// Speeds below this have no direction worth speaking of: their curvature is left out [m/s].
constexpr double LeastStyleSpeed = 1e-3;

/// Adds the inner samples [first, last) of a path sampled every `step` seconds: velocity and
/// acceleration by central differences, curvature |v x a| / |v|^3 (at least 1e-6 1/m). The two ends
/// of the path have no central difference and are left out.
void AppendStyle(const std::vector<Vec3>& positions, double step, std::size_t first,
                 std::size_t last, StyleSamples& samples);
void AppendStyle(const std::vector<Vec3>& positions, double step, StyleSamples& samples);

/// Every segment of a database, as reconstructed.
StyleSamples StyleOf(const MotionDatabase& database);

/// The largest distance between the two empirical distribution functions: 0 alike, 1 disjoint; 1
/// when either is empty.
double KolmogorovSmirnov(std::vector<double> a, std::vector<double> b);

/// Value below which a fraction (0..1) of the samples lies, linear between ranks; 0 when empty.
double Quantile(std::vector<double> values, double fraction);

} // namespace waft
