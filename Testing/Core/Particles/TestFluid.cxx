// SPDX-License-Identifier: BSD-3-Clause
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

TEST(GasLattice, StaysAtRest)
{
  const RandomGas gas(7, 0, 0.0);
  SphState still = gas.State;
  for (Vec3& v : still.Velocities)
  {
    v.setZero();
  }
  SphRates rates;
  EvaluateSph(gas.Fluid, gas.Size, still, rates);
  Vec3 force = Vec3::Zero();
  for (std::size_t i = 0; i < still.Positions.size(); ++i)
  {
    EXPECT_LT(rates.Averages[i].norm(), 1e-15);
    const double wall =
      std::min(still.Positions[i].minCoeff(), (gas.Size - still.Positions[i]).minCoeff());
    if (wall > 2.4)
    {
      EXPECT_NEAR(rates.Densities[i], 1.0, 1e-12);
    }
    // Beside walls the lattice is a few percent off the density that the wall stands for.
    EXPECT_NEAR(rates.Densities[i], 1.0, 0.06);
    EXPECT_LT(rates.Accelerations[i].norm(), 0.02);
    force += rates.Accelerations[i];
  }
  EXPECT_LT(force.norm(), 1e-12);
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
    EvaluateSph(gas.Fluid, gas.Size, gas.State, rates);
    for (std::size_t i = 0; i < gas.State.Positions.size(); ++i)
    {
      gas.State.Velocities[i] += rates.Accelerations[i];
      gas.State.Positions[i] += gas.State.Velocities[i]; // semi-implicit
    }
  }
  EXPECT_LT(energy(), 0.2 * before);
}
