// SPDX-License-Identifier: BSD-3-Clause
// Databases of paths in an analytic flow.
#pragma once

#include "AnalyticFlow.h"
#include "Trajectory/TrajectoryClusters.h"

#include <gtest/gtest.h>

#include <vector>

namespace waft
{
namespace test
{

inline Vortex Upright(int id)
{
  Vortex vortex;
  vortex.VortexId = id;
  vortex.P1 = Vec3(0.3, 0.2, 0);
  vortex.P2 = Vec3(0.1, -0.3, 4);
  vortex.Strength = 6.0;
  vortex.CenterTime = 1.5;
  vortex.CoreRadius = 0.3;
  return vortex;
}

inline ClusterInput Traced(int simulations, int stride)
{
  ClusterInput input;
  for (int s = 0; s < simulations; ++s)
  {
    TraceOptions options;
    options.SeedStride = stride;
    const PointLattice lattice = CubeLattice(options.Volume, 24);
    TrajectoryTracer tracer;
    const std::vector<Vortex> vortices{ Upright(4 + s) };
    EXPECT_TRUE(tracer.Begin(lattice, options, vortices));
    for (int frame = 0; frame < 100; ++frame)
    {
      EXPECT_TRUE(
        tracer.Feed(FrameOfFlow(
                      lattice, [s](const Vec3& x, double t) { return SwirlingFlow(x, t, 0.6 * s); },
                      frame / 30.0),
                    SerialFor()));
    }
    input.Simulations.push_back({ tracer.Finish(), vortices });
  }
  return input;
}

inline MotionDatabase Build(const ClusterInput& input, const ClusterOptions& options,
                            int threads = 1)
{
  MotionDatabase database;
  SilentMonitor monitor;
  const Result result =
    ClusterTrajectories(input, options, ThreadedFor(threads), monitor, database);
  EXPECT_TRUE(result) << result.Message();
  return database;
}

inline const MotionDatabase& Large()
{
  static const MotionDatabase database = []
  {
    ClusterOptions options;
    options.MaximumSegments = 0;
    return Build(Traced(4, 2), options);
  }();
  return database;
}

} // namespace test
} // namespace waft
