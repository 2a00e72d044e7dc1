// SPDX-License-Identifier: BSD-3-Clause
#include "Base/EvenWind.h"
#include "SmokeScenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace waft;
using namespace waft::test;

TEST(SmokeSolver, EvenWindInAClosedBoxOnlyMakesPressure)
{
  SmokeOptions options = Options(16, BoundaryKind::Closed);
  SmokeForces forces;
  forces.Wind = EvenWind(options.Bounds, FieldMeaning::Acceleration, { 1.0f, 0.0f, 0.0f });
  SmokeSolver solver;
  ASSERT_TRUE(solver.Begin(options, forces));
  RunFrames(solver, 5);
  SmokeFrame frame;
  solver.Read(frame);
  EXPECT_LT(solver.KineticEnergy(), 1e-6);
  // dp/dx = rho a: 1.2 Pa/m over 15 voxels of 0.25 m.
  EXPECT_NEAR(frame.Pressure[15] - frame.Pressure[0], 1.2 * 3.75, 0.01);
  EXPECT_NEAR(frame.WindForce[77][0], 1.0, 1e-6);
}

TEST(SmokeSolver, WindMayVaryInSpaceAndTime)
{
  // An acceleration of y t along x, which is free of divergence: speed y t^2 / 2.
  SmokeOptions options = Options(16, BoundaryKind::Closed);
  options.Boundary[0] = BoundaryKind::Periodic;
  options.Confinement = 0.0;
  SmokeForces forces;
  forces.Wind.Dimensions = { 2, 2, 2 };
  forces.Wind.Origin = options.Bounds.Min;
  forces.Wind.Spacing = options.Bounds.Size();
  forces.Wind.Times = { 0.0, 0.5, 2.0 };
  for (const double time : forces.Wind.Times)
  {
    const float low = static_cast<float>(-2.0 * time);
    const float high = static_cast<float>(2.0 * time);
    std::vector<std::array<float, 3>> step;
    for (const float value : { low, low, high, high, low, low, high, high })
    {
      step.push_back({ value, 0.0f, 0.0f });
    }
    forces.Wind.Values.push_back(step);
  }
  SmokeSolver solver;
  ASSERT_TRUE(solver.Begin(options, forces));
  RunFrames(solver, 31); // 1 s
  SmokeFrame frame;
  solver.Read(frame);
  for (int j = 0; j < 16; ++j)
  {
    const double y = -2.0 + (j + 0.5) * 0.25;
    const std::size_t cell = 5 + 16 * (static_cast<std::size_t>(j) + 16 * 7);
    EXPECT_NEAR(frame.Velocity[cell][0], 0.5 * y, 2e-3) << j;
    EXPECT_NEAR(frame.WindForce[cell][0], y, 1e-5);
  }
}

TEST(SmokeSolver, WindThatIsAVelocityDrawsTheAirToIt)
{
  SmokeOptions options = Options(16, BoundaryKind::Periodic);
  options.WindDrag = 2.0;
  SmokeForces forces;
  forces.Wind = EvenWind(options.Bounds, FieldMeaning::Velocity, { 0.0f, 1.0f, 0.0f });
  SmokeSolver solver;
  ASSERT_TRUE(solver.Begin(options, forces));
  RunFrames(solver, 31); // 1 s
  SmokeFrame frame;
  solver.Read(frame);
  EXPECT_NEAR(frame.Velocity[100][1], 1.0 - std::exp(-2.0), 0.01);
}

TEST(SmokeSolver, ForcesAreThoseOfTheClosedForms)
{
  SmokeOptions options = Options(12, BoundaryKind::Open);
  SmokeForces forces = Stirring();
  SmokeSolver solver;
  ASSERT_TRUE(solver.Begin(options, forces));
  RunFrames(solver, 4);
  EXPECT_DOUBLE_EQ(solver.Time(), 0.1);
  SmokeFrame frame;
  solver.Read(frame);
  std::size_t c = 0;
  for (int k = 0; k < 12; ++k)
  {
    for (int j = 0; j < 12; ++j)
    {
      for (int i = 0; i < 12; ++i, ++c)
      {
        const Vec3 x = frame.Origin + Vec3(i, j, k).cwiseProduct(frame.Spacing);
        const Vec3 vortex = forces.Vortices[0].Acceleration(x, 0.1);
        const Vec3 wind = forces.Winds[0].Acceleration(x, 0.1);
        for (int axis = 0; axis < 3; ++axis)
        {
          EXPECT_NEAR(frame.VortexForce[c][axis], vortex[axis], 2e-6);
          EXPECT_NEAR(frame.WindForce[c][axis], wind[axis], 2e-6);
        }
      }
    }
  }
}

TEST(SmokeSolver, WarmSmokeRisesAndCoolSmokeSinks)
{
  for (const double sign : { 1.0, -1.0 })
  {
    SmokeOptions options = Options(20, BoundaryKind::Closed);
    options.BuoyancyTemperature = sign > 0.0 ? 0.1 : 0.0;
    options.BuoyancyDensity = sign > 0.0 ? 0.0 : 1.0;
    SmokeForces forces;
    SmokeEmitter emitter;
    emitter.Center = Vec3(0.0, 0.0, 2.0);
    emitter.Radius = 0.5;
    emitter.Temperature = sign > 0.0 ? 20.0 : 0.0;
    forces.Emitters = { emitter };
    SmokeSolver solver;
    ASSERT_TRUE(solver.Begin(options, forces));
    RunFrames(solver, 30);
    SmokeFrame frame;
    solver.Read(frame);
    double height = 0.0;
    double smoke = 0.0;
    for (std::size_t c = 0; c < frame.Density.size(); ++c)
    {
      EXPECT_GE(frame.Density[c], 0.0f);
      EXPECT_LE(frame.Density[c], 1.0f + 1e-5f);
      height += frame.Density[c] * (frame.Origin.z() + frame.Spacing.z() * (c / 400));
      smoke += frame.Density[c];
    }
    ASSERT_GT(smoke, 10.0);
    EXPECT_GT(sign * (height / smoke - 2.0), 0.05);
  }
}

TEST(SmokeSolver, MovingSolidPushesTheAir)
{
  const SmokeOptions options = Options(24, BoundaryKind::Open);
  SmokeSolver solver;
  ASSERT_TRUE(solver.Begin(options, {}));
  SilentMonitor monitor;
  ASSERT_TRUE(solver.Step(SerialFor(), monitor));
  const std::vector<std::array<float, 3>> velocity(options.NumberOfNodes(), { 0.6f, 0.0f, 0.0f });
  for (int frame = 0; frame < 15; ++frame)
  {
    const Vec3 center = BallCenter + Vec3(0.02 * frame, 0.0, 0.0);
    ASSERT_TRUE(solver.SetSolids(SphereDistances(options, center, BallRadius), velocity));
    ASSERT_TRUE(solver.Step(SerialFor(), monitor));
    EXPECT_LE(solver.MaximumDivergence() / 30.0, 1e-4);
  }
  SmokeFrame frame;
  solver.Read(frame);
  // Ahead of the ball on its path: pushed, though less than the ball moves.
  const Vec3 ahead = BallCenter + Vec3(0.28 + BallRadius + 0.25, 0.0, 0.0);
  const Vec3 at = (ahead - frame.Origin).cwiseQuotient(frame.Spacing);
  const float pushed =
    frame.Velocity[std::lround(at.x()) + 24 * (std::lround(at.y()) + 24 * std::lround(at.z()))][0];
  EXPECT_GT(pushed, 0.15f);
  EXPECT_LT(pushed, 0.6f);
}

TEST(SmokeSolver, IsTheSameWithTwoThreadsAndFromASavedState)
{
  SmokeOptions options = Options(20, BoundaryKind::Open);
  options.Resolution = { 48, 52, 44 }; // large enough for threads to be used
  options.WarmUpSeconds = 0.2;
  SmokeForces forces = Stirring();
  SmokeEmitter emitter;
  emitter.Center = Vec3(0.0, 0.0, 1.0);
  forces.Emitters = { emitter };
  SmokeFrame frames[3];
  for (int run = 0; run < 3; ++run)
  {
    SmokeSolver solver;
    ASSERT_TRUE(solver.Begin(options, forces));
    ASSERT_TRUE(solver.SetSolids(SphereDistances(options, BallCenter, BallRadius)));
    RunFrames(solver, 6, ThreadedFor(run == 1 ? 2 : 1));
    if (run == 2)
    {
      const SmokeState state = solver.Save();
      RunFrames(solver, 3);
      ASSERT_TRUE(solver.Restore(state));
      EXPECT_EQ(solver.Frame(), 5);
    }
    RunFrames(solver, 6, ThreadedFor(run == 1 ? 2 : 1));
    solver.Read(frames[run]);
  }
  EXPECT_EQ(frames[0].Frame, 11);
  for (int run = 1; run < 3; ++run)
  {
    EXPECT_EQ(frames[0].Velocity, frames[run].Velocity);
    EXPECT_EQ(frames[0].Density, frames[run].Density);
    EXPECT_EQ(frames[0].Pressure, frames[run].Pressure);
  }
}

TEST(SmokeSolver, StopsWithTheLastWholeFrame)
{
  struct StopAt : Monitor
  {
    int Ticks = 0;
    bool Tick(double, const std::string&) override { return ++this->Ticks < 2; }
  };
  SmokeSolver solver;
  ASSERT_TRUE(solver.Begin(Options(16, BoundaryKind::Open), Stirring()));
  RunFrames(solver, 3);
  SmokeFrame before, after;
  solver.Read(before);
  StopAt monitor;
  EXPECT_TRUE(solver.Step(SerialFor(), monitor).IsStopped());
  solver.Read(after);
  EXPECT_EQ(after.Frame, 2);
  EXPECT_EQ(before.Velocity, after.Velocity);
}

TEST(SmokeSolver, SaysThatTheAirIsNotFinite)
{
  for (const double odd : { std::numeric_limits<double>::quiet_NaN(), 1e300 })
  {
    SmokeSolver solver;
    ASSERT_TRUE(solver.Begin(Options(8, BoundaryKind::Closed), {}));
    const auto velocity = [odd](const Vec3& x) { return Vec3(x.x() > 0.5 ? odd : 0.0, 0.0, 0.0); };
    ASSERT_TRUE(static_cast<bool>(solver.SetVelocity(velocity, false)));
    SilentMonitor monitor;
    const Result stepped = solver.Step(SerialFor(), monitor);
    EXPECT_NE(stepped.Message().find("velocity is not finite at frame 1"), std::string::npos)
      << stepped.Message();
  }
}

TEST(SmokeSolver, NamesWhatIsWrong)
{
  SmokeSolver solver;
  SilentMonitor monitor;
  EXPECT_FALSE(solver.Step(SerialFor(), monitor));
  SmokeOptions options = Options(3, BoundaryKind::Open);
  Result result = solver.Begin(options, {});
  EXPECT_FALSE(result);
  EXPECT_NE(result.Message().find("Resolution"), std::string::npos);
  options = Options(8, BoundaryKind::Open);
  SmokeForces forces = Stirring();
  forces.Vortices[0].Duration = 0.0;
  result = solver.Begin(options, forces);
  EXPECT_FALSE(result);
  EXPECT_NE(result.Message().find("Vortices: row 0"), std::string::npos);
  ASSERT_TRUE(solver.Begin(options, {}));
  EXPECT_FALSE(solver.SetSolids(std::vector<float>(5, 1.0f)));
  std::vector<float> distances(options.NumberOfNodes(), 1.0f);
  distances[7] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(solver.SetSolids(distances));
  EXPECT_FALSE(solver.Restore(SmokeState()));
}
