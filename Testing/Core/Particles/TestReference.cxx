// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Primitives.h"
#include "Particles/SphReference.h"
#include "RandomGas.h"

#include <gtest/gtest.h>

using namespace waft;

namespace
{

SphState Moved(const SphState& state, const SphState& change, double step)
{
  SphState moved = state;
  for (std::size_t i = 0; i < state.Positions.size(); ++i)
  {
    moved.Positions[i] += step * change.Positions[i];
    moved.Velocities[i] += step * change.Velocities[i];
  }
  return moved;
}

// In the midst of the gas, so that most of it feels walls, obstacle and the rest density.
ObstacleField BallIn(const RandomGas& gas)
{
  ObstacleMesh ball;
  ball.Mesh = MakeSphere(0.5 * gas.Size, 0.9);
  ObstacleField field;
  const Result result = field.Build({ ball }, Box{ Vec3::Zero(), gas.Size }, 0.4, 1.0, 3.4, 1);
  EXPECT_TRUE(result) << result.Message();
  return field;
}

} // namespace

TEST(SphReference, TangentEqualsCentralDifferences)
{
  const RandomGas gas(5, 6, 0.1);
  const ObstacleField ball = BallIn(gas);
  const SphVolume volume = gas.Volume(ball);
  const SphState change = gas.RandomChange(3);
  SphRates tangent, high, low;
  TangentSph(gas.Fluid, volume, gas.State, change, tangent);
  const double h = 1e-6;
  EvaluateSph(gas.Fluid, volume, Moved(gas.State, change, h), high);
  EvaluateSph(gas.Fluid, volume, Moved(gas.State, change, -h), low);
  for (std::size_t i = 0; i < gas.State.Positions.size(); ++i)
  {
    const Vec3 a = (high.Accelerations[i] - low.Accelerations[i]) / (2.0 * h);
    const Vec3 d = (high.Averages[i] - low.Averages[i]) / (2.0 * h);
    EXPECT_LT((a - tangent.Accelerations[i]).norm(), 1e-6 * (1.0 + a.norm()));
    EXPECT_LT((d - tangent.Averages[i]).norm(), 1e-6 * (1.0 + d.norm()));
    EXPECT_NEAR((high.Densities[i] - low.Densities[i]) / (2.0 * h), tangent.Densities[i], 1e-6);
  }
}

TEST(SphReference, AdjointIsTheTransposeOfTheTangent)
{
  for (const double gamma : { 1.0, 7.0 })
  {
    RandomGas gas(5, 6, 0.1);
    gas.Fluid.Gamma = gamma;
    const ObstacleField ball = BallIn(gas);
    const SphVolume volume = gas.Volume(ball);
    const SphState change = gas.RandomChange(3);
    const SphState other = gas.RandomChange(4);
    SphRates tangent, weights;
    weights.Accelerations = other.Positions;
    weights.Averages = other.Velocities;
    SphState adjoint;
    TangentSph(gas.Fluid, volume, gas.State, change, tangent);
    AdjointSph(gas.Fluid, volume, gas.State, weights, adjoint);
    double left = 0.0, right = 0.0, scale = 0.0;
    for (std::size_t i = 0; i < change.Positions.size(); ++i)
    {
      left += tangent.Accelerations[i].dot(weights.Accelerations[i]) +
              tangent.Averages[i].dot(weights.Averages[i]);
      right += change.Positions[i].dot(adjoint.Positions[i]) +
               change.Velocities[i].dot(adjoint.Velocities[i]);
      scale += tangent.Accelerations[i].norm() * weights.Accelerations[i].norm();
    }
    EXPECT_NEAR(left, right, 1e-12 * scale);
  }
}

TEST(SphReference, PairsConserveMomentum)
{
  RandomGas gas(6, 5, 0.1);
  // Away from the walls only pairs act.
  for (Vec3& x : gas.State.Positions)
  {
    x += Vec3::Constant(20.0);
  }
  SphRates rates;
  EvaluateSph(gas.Fluid, SphVolume(gas.Size + Vec3::Constant(40.0)), gas.State, rates);
  Vec3 sum = Vec3::Zero();
  double scale = 0.0;
  for (std::size_t i = 0; i < gas.State.Positions.size(); ++i)
  {
    const double mass = i < gas.State.NumberOfGas ? gas.Fluid.GasMass : gas.Fluid.ObjectMass;
    sum += mass * rates.Accelerations[i];
    scale += mass * rates.Accelerations[i].norm();
  }
  EXPECT_GT(scale, 1e-2);
  EXPECT_LT(sum.norm(), 1e-13 * scale);
}

TEST(SphReference, AFreeCloudKeepsItsMomentumAndItsTurn)
{
  RandomGas gas(4, 5, 0.15);
  for (Vec3& x : gas.State.Positions)
  {
    x += Vec3::Constant(10.0); // away from walls
  }
  gas.Size += Vec3::Constant(20.0);
  Vec3 momentum = Vec3::Zero(), turn = Vec3::Zero();
  double energy = 0.0;
  const auto measure = [&]
  {
    momentum.setZero();
    turn.setZero();
    energy = 0.0;
    for (std::size_t i = 0; i < gas.State.Positions.size(); ++i)
    {
      const double mass = i < gas.State.NumberOfGas ? gas.Fluid.GasMass : gas.Fluid.ObjectMass;
      momentum += mass * gas.State.Velocities[i];
      turn += mass * gas.State.Positions[i].cross(gas.State.Velocities[i]);
      energy += mass * gas.State.Velocities[i].squaredNorm();
    }
  };
  measure();
  const Vec3 before = momentum, turnBefore = turn;
  const double energyBefore = energy;
  SphRates rates;
  for (int frame = 0; frame < 20; ++frame)
  {
    EvaluateSph(gas.Fluid, gas.Size, gas.State, rates);
    for (std::size_t i = 0; i < gas.State.Positions.size(); ++i)
    {
      gas.State.Velocities[i] += rates.Accelerations[i];
      gas.State.Positions[i] += gas.State.Velocities[i];
    }
  }
  measure();
  EXPECT_LT((momentum - before).norm(), 1e-12);
  EXPECT_LT((turn - turnBefore).norm(), 1e-11);
  EXPECT_GT(std::abs(energy / energyBefore - 1.0), 0.05); // it did move
}

TEST(SphReference, ApproachingParticlesAreBraked)
{
  // Eq. 9 with v_ij = v_i - v_j: two particles that approach each other push apart.
  SphFluid fluid;
  SphState state;
  state.NumberOfGas = 2;
  state.Positions = { Vec3(10.0, 10.0, 10.0), Vec3(11.0, 10.0, 10.0) };
  state.Velocities = { Vec3(0.3, 0.0, 0.0), Vec3(-0.3, 0.0, 0.0) };
  SphRates moving, still;
  EvaluateSph(fluid, SphVolume(Vec3::Constant(20.0)), state, moving);
  state.Velocities = { Vec3::Zero(), Vec3::Zero() };
  EvaluateSph(fluid, SphVolume(Vec3::Constant(20.0)), state, still);
  EXPECT_LT(moving.Accelerations[0].x(), still.Accelerations[0].x() - 1e-3);
  // And the velocity average draws the velocities together (Eq. 10).
  EXPECT_LT(moving.Averages[0].x(), 0.0);
}
