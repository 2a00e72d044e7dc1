// SPDX-License-Identifier: BSD-3-Clause
// Redistribution of what is left over: a path with given accelerations through given marks.
#pragma once

#include "Base/Types.h"

#include <vector>

namespace waft
{

/// sum of Weights[i] * x[Frames[i]] = Value, per axis: a velocity or acceleration row in terms of
/// the positions.
struct LinearRow
{
  std::vector<int> Frames;
  std::vector<double> Weights;
  Vec3 Value = Vec3::Zero();
};

/// A soft constraint: x[Frame] is to lie at Value.
struct SoftMark
{
  int Frame = 0;
  Vec3 Value = Vec3::Zero();
  double Weight = 1.0;
};

/// Minimises sum_k |x[k-1] - 2 x[k] + x[k+1] - a[k]|^2 + sum soft, over the samples that are not
/// fixed, subject to the linear rows. The difference to a path whose second differences are a is a
/// natural cubic spline between the marks: smooth, of second order continuous, and spread over the
/// whole span, so that curvature and acceleration hardly change. Seams (marks at which two spans
/// meet with different velocities) are healed in the same solution.
struct WarpProblem
{
  std::vector<Vec3> SecondDifferences; // a[k], one a sample; first and last unused [m]
  std::vector<unsigned char> IsFixed;  // one a sample
  std::vector<Vec3> Fixed;             // its value where fixed [m]
  std::vector<LinearRow> Rows;
  std::vector<SoftMark> Soft;
  std::vector<double> StiffnessWeights; // one a sample, or empty: all 1
};

/// One position a sample; fixed samples come back bit-identical. Rows that contradict each other or
/// act on fixed samples only are met in the least-squares sense.
std::vector<Vec3> SolveWarp(const WarpProblem& problem);

/// Second differences of positions; zero at both ends.
std::vector<Vec3> SecondDifferences(const std::vector<Vec3>& positions);

} // namespace waft
