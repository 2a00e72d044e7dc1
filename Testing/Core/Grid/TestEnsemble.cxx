// SPDX-License-Identifier: BSD-3-Clause
#include "Grid/SmokeEnsemble.h"
#include "Grid/SmokeSolver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace waft;

TEST(Ensemble, IsDescribedByItsSeed)
{
  EnsembleOptions options;
  options.Seed = 7;
  Ensemble a, b, c;
  ASSERT_TRUE(MakeEnsemble(options, a));
  ASSERT_TRUE(MakeEnsemble(options, b));
  options.NumberOfWinds = 0; // must not move anything else
  options.NumberOfObstacles = 5;
  ASSERT_TRUE(MakeEnsemble(options, c));
  ASSERT_EQ(a.Forces.Vortices.size(), 10u);
  ASSERT_EQ(a.Obstacles.size(), 2u);
  EXPECT_EQ(c.Obstacles.size(), 5u);
  EXPECT_TRUE(c.Forces.Winds.empty());
  for (std::size_t v = 0; v < 10; ++v)
  {
    EXPECT_EQ(a.Forces.Vortices[v].P1, b.Forces.Vortices[v].P1);
    EXPECT_EQ(a.Forces.Vortices[v].Strength, c.Forces.Vortices[v].Strength);
    EXPECT_TRUE(options.Bounds.Contains(a.Forces.Vortices[v].P1));
    EXPECT_TRUE(options.Bounds.Contains(a.Forces.Vortices[v].P2));
  }
  EXPECT_EQ(a.Obstacles[1].Mesh.Points, c.Obstacles[1].Mesh.Points);
  options.Seed = 8;
  ASSERT_TRUE(MakeEnsemble(options, b));
  EXPECT_NE(a.Forces.Vortices[0].P1, b.Forces.Vortices[0].P1);
}

TEST(Ensemble, VorticesHaveTheDiameterAndAccelerationAskedFor)
{
  EnsembleOptions options;
  options.NumberOfVortices = 40;
  Ensemble ensemble;
  ASSERT_TRUE(MakeEnsemble(options, ensemble));
  for (const Vortex& vortex : ensemble.Forces.Vortices)
  {
    // Along a line from mid-segment, by the closed form itself.
    const Vec3 middle = 0.5 * (vortex.P1 + vortex.P2);
    const Vec3 across = (vortex.P2 - vortex.P1).unitOrthogonal();
    double largest = 0.0;
    double half = 0.0;
    for (double r = 0.0; r < 4.0; r += 0.001)
    {
      const double size = vortex.SpatialAcceleration(middle + r * across).norm();
      largest = std::max(largest, size);
      half = size >= 0.5 * largest ? r : half;
    }
    EXPECT_GE(largest, options.VortexAcceleration.front() * 0.999);
    EXPECT_LE(largest, options.VortexAcceleration.back() * 1.001);
    EXPECT_GE(2.0 * half, 4.0 * options.VortexDiameter.front() - 0.01);
    EXPECT_LE(2.0 * half, 4.0 * options.VortexDiameter.back() + 0.01);
  }
}

TEST(Ensemble, AirOfTheDefaultVolumeHasTheSpeedsOfTheDatabase)
{
  // Speeds of the air at voxel centres, a coarse stand-in for tracers: wide bounds about the
  // figures in Documentation/GridSmokeSource.md.
  std::vector<double> speeds;
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
  {
    EnsembleOptions options;
    options.Seed = seed;
    options.NumberOfFrames = 150;
    Ensemble ensemble;
    ASSERT_TRUE(MakeEnsemble(options, ensemble));
    ensemble.Forces.Emitters.clear();
    SmokeOptions smoke;
    smoke.Resolution = { 20, 20, 20 };
    SmokeSolver solver;
    ASSERT_TRUE(solver.Begin(smoke, ensemble.Forces));
    SilentMonitor monitor;
    SmokeFrame frame;
    while (solver.Frame() < 149)
    {
      ASSERT_TRUE(solver.Step(SerialFor(), monitor));
      if (solver.Frame() % 15 == 0)
      {
        solver.Read(frame);
        for (const auto& v : frame.Velocity)
        {
          speeds.push_back(std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
        }
      }
    }
  }
  std::sort(speeds.begin(), speeds.end());
  const double median = speeds[speeds.size() / 2];
  const double fast = speeds[speeds.size() * 95 / 100];
  EXPECT_GT(median, 0.3);
  EXPECT_LT(median, 0.8);
  EXPECT_GT(fast, 1.0);
  EXPECT_LT(fast, 2.5);
}

TEST(Ensemble, NamesABadRange)
{
  EnsembleOptions options;
  options.WindRadius = { 0.5, 0.2 };
  Ensemble ensemble;
  const Result result = MakeEnsemble(options, ensemble);
  EXPECT_FALSE(result);
  EXPECT_NE(result.Message().find("WindRadius"), std::string::npos);
  options = EnsembleOptions();
  options.NumberOfVortices = -1;
  EXPECT_FALSE(MakeEnsemble(options, ensemble));
}
