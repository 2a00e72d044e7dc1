// SPDX-License-Identifier: BSD-3-Clause
// A smooth, divergence-free field in space and time by least squares: how the wind is estimated
// from accelerations and the moving air from velocities.
#pragma once

#include "Base/Parallel.h"
#include "Base/Types.h"
#include "Spacetime/Model/SplineWind.h"

#include <vector>

namespace waft
{

struct SplineFitOptions
{
  double Ridge = 0.05;        // of the mean weight at a node
  double Curvature = 0.3;     // of the mean weight at a node, on second differences in space
  double TimeSmoothing = 0.3; // of the mean weight at a node, on first differences in time
  int Iterations = 30;        // of conjugate gradients
};

/// What is known of the field at one frame.
struct SplineSamples
{
  struct Sample
  {
    Vec3 Position = Vec3::Zero(); // [dx]
    Vec3 Value = Vec3::Zero();
    double Weight = 1.0;
  };
  int Frame = 0;
  std::vector<Sample> Samples;
};

/// The field's coefficients are those of a CurlPotential, so that its discrete divergence vanishes.
/// shape: the lattice, its FramesPerKnot and as many knots as wanted (their values are not read).
SplineWind FitSplineField(const SplineWind& shape, int numberOfKnots,
                          const std::vector<SplineSamples>& samples,
                          const SplineFitOptions& options, const ParallelFor& parallel);

} // namespace waft
