// SPDX-License-Identifier: BSD-3-Clause
#include "SmokeScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

using namespace waft;
using namespace waft::test;

namespace
{

// Largest |div u| [1/s] from the faces, by its definition, in double.
double LargestDivergence(const SmokeSolver& solver)
{
  const std::array<int, 3>& n = solver.Options().Resolution;
  const Vec3 h = solver.Options().Spacing();
  std::vector<double> divergence(solver.Options().NumberOfCells(), 0.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::vector<float> velocity = solver.FaceVelocities(axis);
    const std::vector<float> open = solver.FaceFractions(axis);
    std::array<int, 3> count = n;
    ++count[axis];
    std::size_t stride = 1;
    for (int lower = 0; lower < axis; ++lower)
    {
      stride *= static_cast<std::size_t>(count[lower]);
    }
    std::size_t cell = 0;
    for (int k = 0; k < n[2]; ++k)
    {
      for (int j = 0; j < n[1]; ++j)
      {
        for (int i = 0; i < n[0]; ++i, ++cell)
        {
          const std::size_t p =
            i + static_cast<std::size_t>(count[0]) * (j + static_cast<std::size_t>(count[1]) * k);
          divergence[cell] += (static_cast<double>(open[p + stride]) * velocity[p + stride] -
                               static_cast<double>(open[p]) * velocity[p]) /
                              h[axis];
        }
      }
    }
  }
  double largest = 0.0;
  for (const double value : divergence)
  {
    largest = std::max(largest, std::abs(value));
  }
  return largest;
}

} // namespace

class ProjectionTest : public testing::TestWithParam<std::tuple<int, BoundaryKind>>
{
};

TEST_P(ProjectionTest, LeavesNoDivergenceAndNoFlowThroughSolids)
{
  const auto [n, kind] = GetParam();
  const SmokeOptions options = Options(n, kind);
  SmokeSolver solver;
  ASSERT_TRUE(solver.Begin(options, Stirring()));
  ASSERT_TRUE(solver.SetSolids(SphereDistances(options, BallCenter, BallRadius)));
  RunFrames(solver, 7);
  EXPECT_LE(LargestDivergence(solver) / options.FramesPerSecond, 1e-4);
  EXPECT_NEAR(solver.MaximumDivergence(), LargestDivergence(solver), 1e-4);
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

TEST(SmokeFlow, EachAxisHasEndsOfItsOwnAndVoxelsNeedNotBeCubes)
{
  // Walls across x, still air outside y and above z, an endless z or x; every scheme of advection.
  const std::array<BoundaryKind, 3> mixtures[] = {
    { BoundaryKind::Closed, BoundaryKind::Open, BoundaryKind::Periodic },
    { BoundaryKind::Periodic, BoundaryKind::Closed, BoundaryKind::Open },
    { BoundaryKind::Open, BoundaryKind::Periodic, BoundaryKind::Closed },
  };
  for (int m = 0; m < 3; ++m)
  {
    SmokeOptions options = Options(32, BoundaryKind::Closed);
    options.Resolution = { 40, 24, 16 };
    options.Boundary = mixtures[m];
    options.Advection = static_cast<AdvectionScheme>(m);
    SmokeSolver solver;
    ASSERT_TRUE(solver.Begin(options, Stirring()));
    ASSERT_TRUE(solver.SetSolids(SphereDistances(options, BallCenter, BallRadius)));
    RunFrames(solver, 7);
    EXPECT_LE(LargestDivergence(solver) / options.FramesPerSecond, 1e-4) << "mixture " << m;
    EXPECT_GT(solver.KineticEnergy(), 1e-3);
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::vector<float> velocity = solver.FaceVelocities(axis);
      std::array<int, 3> count = options.Resolution;
      ++count[axis];
      double lower = 0.0; // largest speed through the two ends
      double upper = 0.0;
      double difference = 0.0;
      const int u = (axis + 1) % 3;
      const int v = (axis + 2) % 3;
      for (int b = 0; b < count[v]; ++b)
      {
        for (int a = 0; a < count[u]; ++a)
        {
          std::array<int, 3> at{ 0, 0, 0 };
          at[u] = a;
          at[v] = b;
          const auto value = [&](int end)
          {
            at[axis] = end;
            return double(velocity[at[0] + static_cast<std::size_t>(count[0]) *
                                             (at[1] + static_cast<std::size_t>(count[1]) * at[2])]);
          };
          const double first = value(0);
          const double last = value(options.Resolution[axis]);
          lower = std::max(lower, std::abs(first));
          upper = std::max(upper, std::abs(last));
          difference = std::max(difference, std::abs(first - last));
        }
      }
      const BoundaryKind kind = options.Boundary[axis];
      EXPECT_EQ(upper == 0.0, kind == BoundaryKind::Closed) << "mixture " << m << " axis " << axis;
      EXPECT_EQ(lower == 0.0,
                kind == BoundaryKind::Closed || (kind == BoundaryKind::Open && axis == 2));
      EXPECT_EQ(difference == 0.0, kind != BoundaryKind::Open);
    }
  }
}

TEST(SmokeFlow, StepsAreDividedByTheCourantNumber)
{
  // A uniform flow of 8/3 voxels a frame, which stays what it is.
  SmokeOptions options = Options(16, BoundaryKind::Periodic);
  options.CourantNumber = 1.0;
  for (const int most : { 16, 2 })
  {
    options.MaximumSubsteps = most;
    SmokeSolver solver;
    ASSERT_TRUE(solver.Begin(options, {}));
    ASSERT_TRUE(solver.SetVelocity([](const Vec3&) { return Vec3(20.0, 0.0, 0.0); }, false));
    RunFrames(solver, 1);
    EXPECT_EQ(solver.Statistics().Substeps, std::min(most, 3));
    EXPECT_NEAR(solver.FaceVelocities(0)[100], 20.0, 1e-4);
  }
}

TEST(SmokeFlow, EnergyNeverGrowsWithoutForces)
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

TEST(SmokeFlow, TaylorGreenStaysAndItsErrorConverges)
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

TEST(SmokeFlow, ConfinementRaisesEnstrophy)
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

TEST(SmokeFlow, SymmetricSceneStaysSymmetric)
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

TEST(SmokeFlow, ABreezeComesInAndGoesOutAndStaysTheMean)
{
  SmokeOptions options = Options(24, BoundaryKind::Closed);
  options.Boundary[0] = BoundaryKind::Open;
  options.Breeze = Vec3(0.7, 0.0, 0.0);
  const auto meanOf = [](const SmokeSolver& solver)
  {
    SmokeFrame frame;
    solver.Read(frame);
    double sum = 0.0;
    for (const auto& u : frame.Velocity)
    {
      sum += u[0];
    }
    return sum / static_cast<double>(frame.Velocity.size());
  };
  SmokeSolver still;
  ASSERT_TRUE(still.Begin(options, {}));
  RunFrames(still, 40);
  const std::vector<float> faces = still.FaceVelocities(0);
  for (const float u : faces) // nothing is in its way
  {
    ASSERT_NEAR(u, 0.7f, 1e-4f);
  }
  // Round a ball, stirred and pushed back by a wind for four crossings of the volume.
  SmokeForces forces = Stirring();
  forces.Winds[0].Direction = Vec3(-1.0, 0.0, 0.0);
  SmokeSolver solver;
  ASSERT_TRUE(solver.Begin(options, forces));
  ASSERT_TRUE(solver.SetSolids(SphereDistances(options, Vec3(0.3, 0.1, 2.0), 0.5)));
  RunFrames(solver, 10);
  EXPECT_LT(meanOf(solver), 0.65);
  RunFrames(solver, 600);
  EXPECT_NEAR(meanOf(solver), 0.7, 0.07);
  EXPECT_LT(solver.MaximumDivergence(), 0.1);
}
