// SPDX-License-Identifier: BSD-3-Clause
#include "Grid/SmokeEnsemble.h"
#include "Grid/SmokeSolver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

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

TEST(Stirring, GoesOnByARateOverAnAbsoluteTimeLine)
{
  const Box volume{ Vec3(-2, -2, 0), Vec3(2, 2, 4) };
  const SmokeForces some = StirringForces(volume, 7, 0.0, 10.0);
  const SmokeForces more = StirringForces(volume, 7, 0.0, 40.0);
  const SmokeForces later = StirringForces(volume, 7, 30.0, 40.0);
  const SmokeForces other = StirringForces(volume, 8, 0.0, 10.0);
  EXPECT_NE(some.Vortices.front().P1, other.Vortices.front().P1);
  // At each time both have the same forces.
  const auto felt = [](const SmokeForces& forces, double time)
  {
    std::vector<Vortex> all;
    std::copy_if(forces.Vortices.begin(), forces.Vortices.end(), std::back_inserter(all),
                 [time](const Vortex& vortex) { return vortex.TimeFactor(time) > StirringLeast; });
    return all;
  };
  const auto expectSame = [&](const SmokeForces& one, const SmokeForces& two, double time)
  {
    const std::vector<Vortex> a = felt(one, time);
    const std::vector<Vortex> b = felt(two, time);
    ASSERT_EQ(a.size(), b.size()) << time;
    EXPECT_FALSE(a.empty());
    for (std::size_t v = 0; v < a.size(); ++v)
    {
      EXPECT_EQ(a[v].VortexId, b[v].VortexId);
      EXPECT_EQ(a[v].P1, b[v].P1);
      EXPECT_EQ(a[v].CenterTime, b[v].CenterTime);
    }
  };
  for (const double time : { 0.0, 3.0, 10.0 })
  {
    expectSame(some, more, time);
  }
  for (const double time : { 30.0, 40.0 })
  {
    expectSame(later, more, time);
  }
  // By the rate of the defaults, from long before the beginning on.
  const auto between = [&](double from, double to)
  {
    return std::count_if(more.Vortices.begin(), more.Vortices.end(),
                         [&](const Vortex& vortex)
                         { return vortex.CenterTime >= from && vortex.CenterTime < to; });
  };
  EXPECT_NEAR(static_cast<double>(between(0.0, 39.0)), 30.0, 5.0);
  EXPECT_GT(between(-12.0, 0.0), 0);
}

TEST(Stirring, TimesGoAsTheSquareRootOfTheWidth)
{
  const SmokeForces usual = StirringForces({ Vec3(-2, -2, 0), Vec3(2, 2, 4) }, 3, 0.0, 10.0);
  const SmokeForces small = StirringForces({ Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1) }, 3, 0.0, 5.0);
  EXPECT_EQ(TimeScaleOf(1.0), 0.5);
  ASSERT_EQ(usual.Vortices.size(), small.Vortices.size());
  for (std::size_t v = 0; v < usual.Vortices.size(); ++v)
  {
    EXPECT_NEAR(small.Vortices[v].CenterTime, 0.5 * usual.Vortices[v].CenterTime, 1e-12);
    EXPECT_NEAR(small.Vortices[v].Duration, 0.5 * usual.Vortices[v].Duration, 1e-12);
    EXPECT_NEAR((small.Vortices[v].P1 - 0.25 * usual.Vortices[v].P1).norm(), 0.0, 1e-12);
    EXPECT_NEAR(small.Vortices[v].Acceleration(0.25 * Vec3(0.3, 0.2, 1.0), 2.0).norm(),
                usual.Vortices[v].Acceleration(Vec3(0.3, 0.2, 1.0), 4.0).norm(), 1e-9);
  }
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
