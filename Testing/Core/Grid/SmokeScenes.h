// SPDX-License-Identifier: BSD-3-Clause
// Small scenes that the tests of the smoke solver share.
#pragma once

#include "Grid/SmokeSolver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace waft
{
namespace test
{

inline SmokeOptions Options(int n, BoundaryKind kind)
{
  SmokeOptions options;
  options.Resolution = { n, n, n };
  options.Boundary.fill(kind);
  options.WarmUpSeconds = 0.0;
  return options;
}

inline SmokeForces Stirring()
{
  SmokeForces forces;
  Vortex vortex;
  vortex.P1 = Vec3(0.5, 0.3, 0.6);
  vortex.P2 = Vec3(0.2, 0.6, 3.2);
  vortex.Strength = 6.0;
  vortex.CoreRadius = 0.3;
  vortex.CenterTime = 0.1;
  forces.Vortices = { vortex };
  AnalyticWind wind;
  wind.Direction = Vec3(0.6, 0.0, 0.8);
  wind.Center = Vec3(-0.5, 0.2, 1.5);
  wind.Strength = 2.0;
  wind.CenterTime = 0.2;
  forces.Winds = { wind };
  return forces;
}

inline std::vector<float> SphereDistances(const SmokeOptions& options, const Vec3& center,
                                          double radius)
{
  std::vector<float> distances;
  const Vec3 h = options.Spacing();
  for (int k = 0; k <= options.Resolution[2]; ++k)
  {
    for (int j = 0; j <= options.Resolution[1]; ++j)
    {
      for (int i = 0; i <= options.Resolution[0]; ++i)
      {
        const Vec3 x = options.Bounds.Min + Vec3(i, j, k).cwiseProduct(h);
        distances.push_back(static_cast<float>((x - center).norm() - radius));
      }
    }
  }
  return distances;
}

inline void RunFrames(SmokeSolver& solver, int frames, const ParallelFor& parallelFor = SerialFor())
{
  SilentMonitor monitor;
  for (int frame = 0; frame < frames; ++frame)
  {
    ASSERT_TRUE(solver.Step(parallelFor, monitor));
  }
}

inline const Vec3 BallCenter(-0.3, 0.1, 2.0);
constexpr double BallRadius = 0.7;

// Smooth, free of divergence, no flow through the walls of the default volume.
inline Vec3 Eddies(const Vec3& x)
{
  const double a = M_PI / 2.0;
  return Vec3(std::sin(a * (x.x() + 2)) * std::cos(a * (x.y() + 2)),
              -std::cos(a * (x.x() + 2)) * std::sin(a * (x.y() + 2)), 0.0) +
         0.5 * Vec3(0.0, std::sin(a * (x.y() + 2)) * std::cos(a * x.z()),
                    -std::cos(a * (x.y() + 2)) * std::sin(a * x.z()));
}

} // namespace test
} // namespace waft
