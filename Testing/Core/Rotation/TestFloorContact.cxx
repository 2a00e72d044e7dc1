// SPDX-License-Identifier: BSD-3-Clause
// Surfaces that stop a body as it flies: at lift-off, at a touch in passing, on the way to a rest.
#include "Base/Random.h"
#include "Refining.h"
#include "Rotation/FloorContact.h"

using namespace waft;
using namespace waft::fixtures;

namespace
{
struct Prepared
{
  explicit Prepared(const Shape& shape)
  {
    const Result measured = ComputeShellProperties(shape, this->Properties);
    EXPECT_TRUE(measured) << measured.Message();
    const Result built = this->Panels.Build(shape, this->Properties, 32, ThreadedFor(1));
    EXPECT_TRUE(built) << built.Message();
  }

  FlightBody Body() const
  {
    return FlightBody(this->Panels, this->Properties, 1e-3, 1.2, AirCoefficients(), 0.0, 0.0);
  }

  ShellProperties Properties;
  PanelBody Panels;
};

double Lowest(const Quat& q, const Floor& floor)
{
  double lowest = 1e300;
  for (const Vec3& point : *floor.Points)
  {
    lowest = std::min(lowest, floor.Height + (q * point).dot(floor.Normal));
  }
  return lowest;
}

double TurningEnergy(const FlightBody& body, const FlightState& state)
{
  return 0.5 * state.AngularVelocity(body).dot(state.AngularMomentum);
}

ObstacleSet Ground()
{
  ObstacleMesh slab;
  slab.Mesh = MakeBox({ Vec3(-4.0, -4.0, -1.0), Vec3(4.0, 4.0, 0.0) });
  ObstacleSet ground;
  const Result result = ground.Build({ slab });
  EXPECT_TRUE(result) << result.Message();
  return ground;
}

double FastestTurn(const PoseTrack& poses, int first, int last)
{
  double fastest = 0.0;
  for (int k = first; k < last; ++k)
  {
    fastest = std::max(fastest, 30.0 * Angle(poses.Orientations[k + 1], poses.Orientations[k]));
  }
  return fastest;
}
} // namespace

TEST(FloorContact, WhatDoesNotTouchStaysToTheBit)
{
  const Shape leaf = CurledLeaf();
  const Prepared prepared(leaf);
  FlightState state;
  state.Orientation = ExpMap(Vec3(0.3, 0.4, 0.5));
  state.AngularMomentum = Vec3(1e-6, 2e-6, -1e-6);
  const FlightState before = state;
  Floor floor;
  floor.Points = &leaf.Mesh.Points;
  floor.Height = 0.06;
  EXPECT_FALSE(TouchFloor(prepared.Body(), floor, state));
  EXPECT_EQ(before.Orientation.coeffs(), state.Orientation.coeffs());
  EXPECT_EQ(before.AngularMomentum, state.AngularMomentum);
}

TEST(FloorContact, AnyPoseIsTurnedUpAndGainsNoEnergy)
{
  const Shape sheet = Sheet(0.1, 0.06);
  const Prepared prepared(sheet);
  const FlightBody body = prepared.Body();
  Random random(5);
  for (int i = 0; i < 200; ++i)
  {
    Floor floor;
    floor.Points = &sheet.Mesh.Points;
    floor.Normal = random.Direction();
    floor.Height = random.Uniform(-0.01, 0.05); // at times too low for any pose
    FlightState state;
    state.Orientation = ExpMap(3.0 * random.Direction());
    state.SetAngularVelocity(body, random.Uniform(0.0, 30.0) * random.Direction());
    const double energy = TurningEnergy(body, state);
    TouchFloor(body, floor, state);
    EXPECT_GE(Lowest(state.Orientation, floor), std::min(0.0, floor.Height) - 1e-6) << i;
    EXPECT_LE(TurningEnergy(body, state), energy * (1.0 + 1e-9)) << i;
    EXPECT_NEAR(1.0, state.Orientation.norm(), 1e-12);
  }
}

TEST(FloorContact, APlateOnItsEdgeIsStoppedThere)
{
  // A strip about its long axis: the lower edge is 0.03 sin(0.5) below the centre.
  const Shape strip = Sheet(0.1, 0.06);
  const Prepared prepared(strip);
  const FlightBody body = prepared.Body();
  Floor floor;
  floor.Points = &strip.Mesh.Points;
  floor.Height = 0.03 * std::sin(0.3);
  FlightState state;
  state.Orientation = ExpMap(Vec3(-0.5, 0.0, 0.0));
  state.SetAngularVelocity(body, Vec3(-4.0, 0.0, 0.0));
  EXPECT_TRUE(TouchFloor(body, floor, state));
  EXPECT_NEAR(0.0, Angle(state.Orientation, ExpMap(Vec3(-0.3, 0.0, 0.0))), 1e-6);
  EXPECT_NEAR(0.0, state.AngularVelocity(body).norm(), 1e-6);
  // Turning up it is let go.
  state.Orientation = ExpMap(Vec3(-0.5, 0.0, 0.0));
  state.SetAngularVelocity(body, Vec3(4.0, 0.0, 0.0));
  TouchFloor(body, floor, state);
  EXPECT_NEAR(4.0, state.AngularVelocity(body).x(), 1e-6);
}

TEST(FloorContact, AGustLiftsALeafWithoutSpinningIt)
{
  // Down nearly level, at rest from frame 60 to 70, then up slowly in a gust that would turn it
  // over at once.
  const ObstacleSet ground = Ground();
  const Shape leaf = CurledLeaf(0.17);
  const double height = RestHeight(leaf);
  Random random(7);
  for (int i = 0; i < 60; ++i)
  {
    const Vec3 gust = random.Uniform(0.5, 1.5) * random.Direction();
    const double rise = random.Uniform(0.1, 0.4);
    std::vector<Vec3> path;
    std::vector<Vec3> air;
    for (int k = 0; k <= 120; ++k)
    {
      const double left = std::max(0, 60 - k) / 30.0;
      const double gone = std::max(0, k - 70) / 30.0;
      path.emplace_back(0.0, 0.2 * gone * gone,
                        height + 0.6 * left * left / (0.3 + left) + rise * gone * gone);
      air.push_back(std::min(1.0, 8.0 * gone) * gust);
    }
    RotationInput input = OneObject(leaf, path);
    input.Tracks[0].AirVelocities = air;
    input.Objects[0].Orientation = ExpMap(0.5 * random.Direction());
    input.Obstacles = &ground;
    input.Constraints = { RestRow(60, 70, Vec3::Zero()) };
    RotationOptions options;
    options.Seed = static_cast<std::uint64_t>(i) + 1;
    options.RasterSize = 32;
    const RotationOutput output = Refine(input, options);
    EXPECT_LT(FastestTurn(output.Poses[0], 30, 60), 16.0) << i; // rad/s
    EXPECT_LT(FastestTurn(output.Poses[0], 70, 120), 50.0)
      << i; // without the floor's part: up to 84
    Floor floor;
    floor.Points = &leaf.Mesh.Points;
    for (int k = 0; k <= 120; ++k)
    {
      floor.Height = path[k].z() + (output.Shifts[0].empty() ? 0.0 : output.Shifts[0][k].z());
      EXPECT_GE(Lowest(output.Poses[0].Orientations[k], floor), -1e-9) << k;
    }
  }
}
