// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Primitives.h"
#include "Particles/GasLattice.h"
#include "Particles/SphReference.h"
#include "RandomGas.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace waft;

TEST(SphFluid, KernelIntegratesToOne)
{
  for (const double h : { 0.8, 1.2, 2.0 })
  {
    SphFluid fluid;
    fluid.SmoothingLength = h;
    double sum = 0.0;
    const int n = 4000;
    for (int k = 0; k < n; ++k)
    {
      const double r = (k + 0.5) * fluid.Support() / n;
      sum += 4.0 * M_PI * r * r * fluid.Kernel(r) * fluid.Support() / n;
    }
    EXPECT_NEAR(sum, 1.0, 1e-6);
    EXPECT_EQ(fluid.Kernel(fluid.Support() * 1.001), 0.0);
  }
}

TEST(SphFluid, PressureVanishesAtRestAndHasItsSlope)
{
  for (const double gamma : { 1.0, 7.0 })
  {
    SphFluid fluid;
    fluid.Gamma = gamma;
    EXPECT_NEAR(fluid.Pressure(1.0), 0.0, 1e-15);
    // The sound speed: dP/drho = d(rho^2 p)/drho at rest.
    EXPECT_NEAR(fluid.PressureSlope(1.0), fluid.SoundSpeed * fluid.SoundSpeed, 1e-12);
    for (const double rho : { 0.2, 0.4999, 0.5001, 0.9, 1.3 })
    {
      const double h = 1e-6;
      EXPECT_NEAR(fluid.PressureSlope(rho),
                  (fluid.Pressure(rho + h) - fluid.Pressure(rho - h)) / (2.0 * h),
                  1e-4 * std::abs(fluid.PressureSlope(rho)));
    }
  }
}

TEST(SphFluid, RefusesNonsense)
{
  SphFluid fluid;
  EXPECT_TRUE(fluid.Validate());
  fluid.SoundSpeed = 0.0;
  EXPECT_FALSE(fluid.Validate());
}

TEST(GasLattice, HasAboutTheCountAskedForWithNearlyCubicCells)
{
  for (const int count : { 64, 500, 2500, 20000 })
  {
    for (const Vec3& size : { Vec3(4, 4, 4), Vec3(8, 2, 3), Vec3(1, 5, 2) })
    {
      const GasLattice lattice =
        GasLattice::Make(Box{ Vec3(-1, -2, 0), Vec3(-1, -2, 0) + size }, count);
      const double made = double(lattice.Points().size());
      EXPECT_NEAR(made / count, 1.0, count < 100 ? 0.3 : 0.12);
      EXPECT_NEAR(std::pow(lattice.Spacing, 3) * made, size.prod(), 1e-9);
    }
  }
}

TEST(GasLattice, HasDensityOneBesideWallsEdgesAndCorners)
{
  // Cells that are cubes, flat or long; layers so few that both walls are felt at once.
  for (const std::array<int, 3>& cells :
       { std::array<int, 3>{ 7, 7, 7 }, { 13, 14, 14 }, { 3, 8, 4 }, { 6, 5, 7 } })
  {
    for (const double h : { 1.0, 1.2, 1.6 })
    {
      SphFluid fluid;
      fluid.SmoothingLength = h;
      const GasLattice lattice =
        GasLattice::Make(Box{ Vec3::Zero(), Vec3(1.0, 1.05, 0.97) }, cells);
      fluid.GasMass = lattice.ParticleMass(fluid);
      RestDensity rest;
      rest.Build(lattice, fluid);
      SphVolume volume(lattice.SizeInSpacings());
      volume.Rest = &rest;
      SphState still;
      still.Positions = lattice.Points();
      still.Velocities.assign(still.Positions.size(), Vec3::Zero());
      still.NumberOfGas = still.Positions.size();
      SphRates rates;
      EvaluateSph(fluid, volume, still, rates);
      double density = 0.0, acceleration = 0.0;
      for (std::size_t i = 0; i < still.NumberOfGas; ++i)
      {
        density = std::max(density, std::abs(rates.Densities[i] - 1.0));
        acceleration = std::max(acceleration, rates.Accelerations[i].norm());
      }
      EXPECT_LT(density, 1e-13);
      EXPECT_LT(acceleration, 1e-13);
      // The field is what makes the difference.
      EvaluateSph(fluid, lattice.SizeInSpacings(), still, rates);
      for (const Vec3& a : rates.Accelerations)
      {
        acceleration = std::max(acceleration, a.norm());
      }
      EXPECT_GT(acceleration, 1e-3);
    }
  }
}

TEST(GasLattice, StaysAtRest)
{
  RandomGas gas({ 6, 7, 7 }, 0, 0.0);
  SphState& state = gas.State;
  const SphState before = state;
  for (Vec3& v : state.Velocities)
  {
    v.setZero();
  }
  SphRates rates;
  for (int frame = 0; frame < 300; ++frame)
  {
    EvaluateSph(gas.Fluid, gas.Volume(), state, rates);
    for (std::size_t i = 0; i < state.Positions.size(); ++i)
    {
      state.Velocities[i] += rates.Accelerations[i];
      state.Positions[i] += state.Velocities[i];
    }
  }
  double moved = 0.0;
  for (std::size_t i = 0; i < state.Positions.size(); ++i)
  {
    moved = std::max(moved, (state.Positions[i] - before.Positions[i]).norm());
  }
  EXPECT_LT(moved, 1e-9);
}

TEST(RestDensity, IsSmoothAndHasItsDerivatives)
{
  const RandomGas gas({ 6, 7, 5 }, 0, 0.0);
  Random random(3);
  const double h = 1e-5;
  for (int sample = 0; sample < 300; ++sample)
  {
    const Vec3 x = random.InBox({ Vec3::Constant(-0.5), gas.Size + Vec3::Constant(0.5) });
    Vec3 gradient, high, low;
    Mat3 hessian, unused;
    (void)gas.Rest.Evaluate(x, gradient, hessian);
    for (int a = 0; a < 3; ++a)
    {
      const Vec3 step = h * Vec3::Unit(a);
      const double plus = gas.Rest.Evaluate(x + step, high, unused);
      const double minus = gas.Rest.Evaluate(x - step, low, unused);
      EXPECT_NEAR((plus - minus) / (2.0 * h), gradient[a], 1e-9);
      // C2: across a site too, where the third derivative jumps.
      EXPECT_LT(((high - low) / (2.0 * h) - hessian.col(a)).norm(), 1e-4);
    }
  }
}

TEST(RestDensity, IsZeroAtTheWalls)
{
  const RandomGas gas({ 6, 7, 5 }, 0, 0.0);
  Random random(4);
  Vec3 gradient;
  Mat3 hessian;
  for (int sample = 0; sample < 60; ++sample)
  {
    Vec3 x = random.InBox({ Vec3::Zero(), gas.Size });
    x[sample % 3] = sample % 2 ? gas.Size[sample % 3] : 0.0;
    EXPECT_NEAR(gas.Rest.Evaluate(x, gradient, hessian), 0.0, 1e-13);
  }
  EXPECT_GT(std::abs(gas.Rest.Evaluate(Vec3::Constant(0.5), gradient, hessian)), 1e-3);
}

TEST(RestDensity, MakesUpForAnObstacleThatStandsStill)
{
  ObstacleMesh ball;
  ball.Mesh = MakeSphere(Vec3(2.1, 1.8, 1.2), 0.8);
  const Box box{ Vec3::Zero(), Vec3(4.0, 4.0, 3.0) };
  const GasLattice lattice = GasLattice::Make(box, { 12, 12, 9 });
  ObstacleField field;
  ASSERT_TRUE(
    field.Build({ ball }, box, 0.4 * lattice.Spacing, lattice.Spacing, 3.4 * lattice.Spacing, 1));
  SphFluid fluid;
  fluid.GasMass = lattice.ParticleMass(fluid);
  SphVolume volume(lattice.SizeInSpacings());
  volume.Obstacles = &field;
  SphState still;
  std::vector<char> isThere;
  std::vector<double> surfaces;
  for (const Vec3& x : lattice.Points())
  {
    isThere.push_back(field.Distance(x, 0) > 0.25 ? 1 : 0);
    surfaces.push_back(SurfaceDensity(fluid, volume, x).Value);
    if (isThere.back())
    {
      still.Positions.push_back(x);
      still.Velocities.push_back(Vec3::Zero());
    }
  }
  still.NumberOfGas = still.Positions.size();
  ASSERT_LT(still.NumberOfGas, isThere.size() - 20);
  RestDensity rest;
  rest.Build(lattice, fluid, isThere, surfaces);
  volume.Rest = &rest;
  SphRates rates;
  EvaluateSph(fluid, volume, still, rates);
  for (const Vec3& a : rates.Accelerations)
  {
    EXPECT_LT(a.norm(), 1e-13);
  }
}

TEST(GasLattice, ComesToRestWhenReplayed)
{
  RandomGas gas(5, 0, 0.08);
  SphRates rates;
  const auto energy = [&]
  {
    double sum = 0.0;
    for (const Vec3& v : gas.State.Velocities)
    {
      sum += v.squaredNorm();
    }
    return sum;
  };
  const double before = energy();
  for (int frame = 0; frame < 60; ++frame)
  {
    EvaluateSph(gas.Fluid, gas.Volume(), gas.State, rates);
    for (std::size_t i = 0; i < gas.State.Positions.size(); ++i)
    {
      gas.State.Velocities[i] += rates.Accelerations[i];
      gas.State.Positions[i] += gas.State.Velocities[i]; // semi-implicit
    }
  }
  EXPECT_LT(energy(), 0.2 * before);
}
