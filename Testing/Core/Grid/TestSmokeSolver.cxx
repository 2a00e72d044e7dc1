// SPDX-License-Identifier: BSD-3-Clause
#include "Grid/SmokeSolver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace waft;

namespace
{

SmokeOptions Options(int n, BoundaryKind kind)
{
  SmokeOptions options;
  options.Resolution = { n, n, n };
  options.Boundary.fill(kind);
  options.WarmUpSeconds = 0.0;
  return options;
}

SmokeForces Stirring()
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

std::vector<float> SphereDistances(const SmokeOptions& options, const Vec3& center, double radius)
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

void RunFrames(SmokeSolver& solver, int frames, const ParallelFor& parallelFor = SerialFor())
{
  SilentMonitor monitor;
  for (int frame = 0; frame < frames; ++frame)
  {
    ASSERT_TRUE(solver.Step(parallelFor, monitor));
  }
}

const Vec3 BallCenter(-0.3, 0.1, 2.0);
constexpr double BallRadius = 0.7;

class ProjectionTest : public testing::TestWithParam<std::tuple<int, BoundaryKind>>
{
};

// Smooth, free of divergence, no flow through the walls of the default volume.
Vec3 Eddies(const Vec3& x)
{
  const double a = M_PI / 2.0;
  return Vec3(std::sin(a * (x.x() + 2)) * std::cos(a * (x.y() + 2)),
              -std::cos(a * (x.x() + 2)) * std::sin(a * (x.y() + 2)), 0.0) +
         0.5 * Vec3(0.0, std::sin(a * (x.y() + 2)) * std::cos(a * x.z()),
                    -std::cos(a * (x.y() + 2)) * std::sin(a * x.z()));
}

} // namespace

TEST_P(ProjectionTest, LeavesNoDivergenceAndNoFlowThroughSolids)
{
  const auto [n, kind] = GetParam();
  const SmokeOptions options = Options(n, kind);
  SmokeSolver solver;
  ASSERT_TRUE(solver.Begin(options, Stirring()));
  ASSERT_TRUE(solver.SetSolids(SphereDistances(options, BallCenter, BallRadius)));
  RunFrames(solver, 7);
  EXPECT_LE(solver.MaximumDivergence() / options.FramesPerSecond, 1e-4);
  EXPECT_GT(solver.KineticEnergy(), 1e-3);
  const Vec3 h = options.Spacing();
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::vector<float> velocity = solver.FaceVelocities(axis);
    const std::vector<float> open = solver.FaceFractions(axis);
    std::size_t p = 0;
    int closed = 0;
    std::array<int, 3> count = options.Resolution;
    ++count[axis];
    for (int k = 0; k < count[2]; ++k)
    {
      for (int j = 0; j < count[1]; ++j)
      {
        for (int i = 0; i < count[0]; ++i, ++p)
        {
          Vec3 at(i + 0.5, j + 0.5, k + 0.5);
          at[axis] -= 0.5;
          const Vec3 x = options.Bounds.Min + at.cwiseProduct(h);
          const int index = axis == 0 ? i : axis == 1 ? j : k;
          const bool wall =
            kind == BoundaryKind::Closed && (index == 0 || index == options.Resolution[axis]);
          if ((x - BallCenter).norm() < BallRadius - h.x() || wall)
          {
            EXPECT_EQ(open[p], 0.0f);
            EXPECT_EQ(velocity[p], 0.0f);
            ++closed;
          }
          else if ((x - BallCenter).norm() > BallRadius + h.x() &&
                   !(axis == 2 && k == 0 && kind == BoundaryKind::Open))
          {
            EXPECT_EQ(open[p], 1.0f);
          }
        }
      }
    }
    EXPECT_GT(closed, 100);
  }
  SmokeFrame frame;
  solver.Read(frame);
  int solid = 0;
  for (std::size_t c = 0; c < frame.Obstacle.size(); ++c)
  {
    solid += frame.Obstacle[c];
    EXPECT_TRUE(frame.Obstacle[c] == 0 ||
                (frame.Velocity[c] == std::array<float, 3>{ 0.0f, 0.0f, 0.0f }));
  }
  EXPECT_NEAR(solid * h.prod(), 4.0 / 3.0 * M_PI * std::pow(BallRadius, 3), 0.05);
}

INSTANTIATE_TEST_SUITE_P(Boundaries, ProjectionTest,
                         testing::Combine(testing::Values(32, 64),
                                          testing::Values(BoundaryKind::Closed, BoundaryKind::Open,
                                                          BoundaryKind::Periodic)));

TEST(SmokeSolver, EnergyNeverGrowsWithoutForces)
{
  for (const BoundaryKind kind :
       { BoundaryKind::Closed, BoundaryKind::Periodic, BoundaryKind::Open })
  {
    for (const AdvectionScheme scheme :
         { AdvectionScheme::Linear, AdvectionScheme::MonotoneCubic, AdvectionScheme::MacCormack })
    {
      SmokeOptions options = Options(20, kind);
      options.Advection = scheme;
      options.Confinement = 0.0;
      SmokeSolver solver;
      ASSERT_TRUE(solver.Begin(options, {}));
      ASSERT_TRUE(solver.SetSolids(SphereDistances(options, BallCenter, BallRadius)));
      ASSERT_TRUE(solver.SetVelocity(Eddies, true));
      double energy = solver.KineticEnergy();
      ASSERT_GT(energy, 1.0);
      for (int step = 0; step < 30; ++step)
      {
        RunFrames(solver, 1);
        const double next = solver.KineticEnergy();
        EXPECT_LE(next, energy * (1.0 + 1e-6))
          << "boundary " << int(kind) << " scheme " << int(scheme) << " step " << step;
        energy = next;
      }
    }
  }
}

TEST(SmokeSolver, TaylorGreenStaysAndItsErrorConverges)
{
  // A steady flow of air without friction: what changes is the scheme's error.
  const double a = M_PI / 2.0;
  const auto flow = [a](const Vec3& x)
  {
    return Vec3(std::sin(a * x.x()) * std::cos(a * x.y()),
                -std::cos(a * x.x()) * std::sin(a * x.y()), 0.0);
  };
  double errors[2];
  for (int level = 0; level < 2; ++level)
  {
    const int n = level == 0 ? 16 : 32;
    SmokeOptions options = Options(n, BoundaryKind::Periodic);
    options.Resolution[2] = 4;
    options.Bounds.Max.z() = 4.0 * 4 / n;
    options.Confinement = 0.0;
    options.FramesPerSecond = 7.5 * n / 16;
    SmokeSolver solver;
    ASSERT_TRUE(solver.Begin(options, {}));
    ASSERT_TRUE(solver.SetVelocity(flow, false));
    EXPECT_LT(solver.MaximumDivergence(), 1e-5);
    RunFrames(solver, 8 * n / 16);
    const std::vector<float> u = solver.FaceVelocities(0);
    double sum = 0.0;
    std::size_t p = 0;
    for (int k = 0; k < 4; ++k)
    {
      for (int j = 0; j < n; ++j)
      {
        for (int i = 0; i <= n; ++i, ++p)
        {
          const Vec3 x(-2.0 + 4.0 * i / n, -2.0 + 4.0 * (j + 0.5) / n, 0.0);
          sum += std::pow(u[p] - flow(x).x(), 2);
        }
      }
    }
    errors[level] = std::sqrt(sum / p);
  }
  EXPECT_LT(errors[1], 0.05);
  EXPECT_GT(std::log2(errors[0] / errors[1]), 0.9); // first order in time
}

TEST(SmokeSolver, ConfinementRaisesEnstrophy)
{
  double enstrophy[2];
  for (int on = 0; on < 2; ++on)
  {
    SmokeOptions options = Options(24, BoundaryKind::Closed);
    options.Confinement = on;
    SmokeSolver solver;
    ASSERT_TRUE(solver.Begin(options, {}));
    ASSERT_TRUE(solver.SetVelocity(Eddies, true));
    RunFrames(solver, 20);
    enstrophy[on] = solver.Enstrophy();
  }
  EXPECT_GT(enstrophy[1], 1.02 * enstrophy[0]);
}

TEST(SmokeSolver, SymmetricSceneStaysSymmetric)
{
  // Mirrored in the plane x = 0: a rising wind over a ball in the middle. Voxels of 1/8 m, so that
  // the scene itself is symmetric to the last bit.
  SmokeOptions options = Options(32, BoundaryKind::Open);
  SmokeForces forces;
  AnalyticWind wind;
  wind.Direction = Vec3::UnitZ();
  wind.Center = Vec3(0.0, 0.3, 1.0);
  wind.Strength = 1.0;
  wind.Duration = 10.0;
  forces.Winds = { wind };
  SmokeSolver solver;
  ASSERT_TRUE(solver.Begin(options, forces));
  ASSERT_TRUE(solver.SetSolids(SphereDistances(options, Vec3(0.0, 0.0, 2.3), 0.6)));
  RunFrames(solver, 100);
  SmokeFrame frame;
  solver.Read(frame);
  double worst = 0.0;
  double fastest = 0.0;
  const int n = 32;
  for (int row = 0; row < n * n; ++row)
  {
    for (int i = 0; i < n; ++i)
    {
      const auto& a = frame.Velocity[row * n + i];
      const auto& b = frame.Velocity[row * n + n - 1 - i];
      worst = std::max({ worst, std::abs(double(a[0]) + b[0]), std::abs(double(a[1]) - b[1]),
                         std::abs(double(a[2]) - b[2]) });
      fastest = std::max<double>(fastest, a[2]);
    }
  }
  EXPECT_GT(fastest, 0.5);
  EXPECT_EQ(worst, 0.0); // to the last bit
}

TEST(SmokeSolver, EvenWindInAClosedBoxOnlyMakesPressure)
{
  SmokeOptions options = Options(16, BoundaryKind::Closed);
  SmokeForces forces;
  forces.Wind.Dimensions = { 2, 2, 2 };
  forces.Wind.Origin = options.Bounds.Min;
  forces.Wind.Spacing = options.Bounds.Size();
  forces.Wind.Times = { 0.0 };
  forces.Wind.Values = { std::vector<std::array<float, 3>>(8, { 1.0f, 0.0f, 0.0f }) };
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

TEST(SmokeSolver, WindThatIsAVelocityDrawsTheAirToIt)
{
  SmokeOptions options = Options(16, BoundaryKind::Periodic);
  options.WindDrag = 2.0;
  SmokeForces forces;
  forces.Wind.Meaning = FieldMeaning::Velocity;
  forces.Wind.Dimensions = { 2, 2, 2 };
  forces.Wind.Origin = options.Bounds.Min;
  forces.Wind.Spacing = options.Bounds.Size();
  forces.Wind.Times = { 0.0 };
  forces.Wind.Values = { std::vector<std::array<float, 3>>(8, { 0.0f, 1.0f, 0.0f }) };
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
