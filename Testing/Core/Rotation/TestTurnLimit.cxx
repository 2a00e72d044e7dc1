// SPDX-License-Identifier: BSD-3-Clause
// The most that a body turns from a frame to the next: who keeps to it, who is slowed and how.
#include "Base/NumberText.h"
#include "Base/Random.h"
#include "Refining.h"
#include "Rotation/Flight.h"
#include "StirredAir.h"

using namespace waft;
using namespace waft::fixtures;

namespace
{
constexpr double Degree = 0.017453292519943295; // rad

/// Narrow and light: it rolls about its shaft faster than frames can show.
Shape Feather()
{
  Shape feather = Sheet(0.2, 0.016, 8);
  feather.Name = "feather";
  feather.AreaDensity = 0.05;
  return feather;
}

/// A fall at 1.6 m/s that sways.
std::vector<Vec3> FastPath(int frames, double phase)
{
  std::vector<Vec3> path = SwayingPath(frames, phase);
  for (std::size_t k = 0; k < path.size(); ++k)
  {
    path[k].z() -= 0.8 * static_cast<double>(k) / 30.0;
  }
  return path;
}

RotationInput FallingFeather(double phase = 0.0)
{
  RotationInput input = OneObject(Feather(), FastPath(150, phase));
  input.Objects[0].Orientation = ExpMap(Vec3(0.4, 0.2, phase));
  return input;
}

RotationOptions Limit(double degrees)
{
  RotationOptions options;
  options.MaximumTurn = degrees;
  options.RasterSize = 32;
  return options;
}

/// rad, the greatest between two frames.
double GreatestTurn(const PoseTrack& poses)
{
  double greatest = 0.0;
  for (std::size_t k = 1; k < poses.Orientations.size(); ++k)
  {
    greatest = std::max(greatest, Angle(poses.Orientations[k], poses.Orientations[k - 1]));
  }
  return greatest;
}

/// rad/s, the greatest change of the angular velocity from a frame to the next.
double GreatestJerk(const PoseTrack& poses)
{
  double greatest = 0.0;
  for (std::size_t k = 1; k < poses.AngularVelocities.size(); ++k)
  {
    greatest =
      std::max(greatest, (poses.AngularVelocities[k] - poses.AngularVelocities[k - 1]).norm());
  }
  return greatest;
}

struct Strip
{
  Shape Body = Sheet(0.2, 0.02);
  ShellProperties Properties;
  PanelBody Panels;

  Strip()
  {
    EXPECT_TRUE(ComputeShellProperties(this->Body, this->Properties));
    EXPECT_TRUE(this->Panels.Build(this->Body, this->Properties, 32, ThreadedFor(1)));
  }
  FlightBody Flies() const
  {
    return FlightBody(this->Panels, this->Properties, 1e-4, 1.2, AirCoefficients(), 0.0, 0.0);
  }
};

/// Sixteen like bodies that fall from poses by chance.
RotationInput Falling(double width, double framesPerSecond)
{
  const int frames = static_cast<int>(6.0 * framesPerSecond);
  RotationInput input =
    OneObject(Sheet(0.12, width), StraightPath(Vec3(0.0, 0.0, 9.0), Vec3(0.05, 0.0, -0.7), frames,
                                               1.0 / framesPerSecond));
  input.Scene.Time.FramesPerSecond = framesPerSecond;
  input.Objects[0].SettlingSpeed = 0.7;
  input.Objects[0].OrientationGiven = 0;
  for (int i = 1; i < 16; ++i)
  {
    input.Objects.push_back(input.Objects[0]);
    input.Objects[i].ObjectId = i;
    input.Tracks.push_back(input.Tracks[0]);
    input.Tracks[i].ObjectId = i;
  }
  return input;
}

/// Degrees in 1/30 s, from every frame to the next, in order of size.
std::vector<double> TurnsOf(const RotationOutput& output)
{
  std::vector<double> turns;
  for (const PoseTrack& poses : output.Poses)
  {
    const double rate = (static_cast<double>(poses.Orientations.size()) / 6.0) / 30.0;
    for (std::size_t k = 0; k + 1 < poses.Orientations.size(); ++k)
    {
      turns.push_back(Angle(poses.Orientations[k + 1], poses.Orientations[k]) / Degree * rate);
    }
  }
  std::sort(turns.begin(), turns.end());
  return turns;
}

std::size_t Above(const std::vector<double>& turns, double turn)
{
  return static_cast<std::size_t>(turns.end() - std::upper_bound(turns.begin(), turns.end(), turn));
}

double Energy(const FlightBody& body, const FlightState& state)
{
  return 0.5 * state.AngularVelocity(body).dot(state.AngularMomentum);
}
} // namespace

TEST(TurnLimit, TheLeastPushTakesTheTurningBack)
{
  const Strip strip;
  const FlightBody body = strip.Flies();
  Random random(3);
  for (int i = 0; i < 100; ++i)
  {
    FlightState state;
    state.Orientation = ExpMap(2.0 * random.Direction());
    state.SetAngularVelocity(body, random.Uniform(20.0, 400.0) * random.Direction());
    const FlightState before = state;
    const double fastest = random.Uniform(1.0, 19.0);
    ASSERT_TRUE(LimitTurning(body, fastest, state));
    const Vec3 omega = state.AngularVelocity(body);
    EXPECT_NEAR(omega.norm(), fastest, 1e-9 * fastest);
    EXPECT_LT(Energy(body, state), Energy(body, before));
    // No other angular velocity within the limit is nearer.
    const auto distance = [&](const Vec3& other)
    {
      FlightState way = before;
      way.SetAngularVelocity(body, other - before.AngularVelocity(body));
      return Energy(body, way);
    };
    const double own = distance(omega);
    for (int j = 0; j < 50; ++j)
    {
      const Vec3 beside = (omega + 0.3 * fastest * random.Direction()).normalized() * fastest;
      EXPECT_GE(distance(beside), own * (1.0 - 1e-9));
    }
  }
}

TEST(TurnLimit, WhatTurnsSlowerStaysToTheBit)
{
  const Strip strip;
  const FlightBody body = strip.Flies();
  FlightState state;
  state.SetAngularVelocity(body, Vec3(3.0, 4.0, 0.0));
  const Vec3 before = state.AngularMomentum;
  EXPECT_FALSE(LimitTurning(body, 5.1, state));
  EXPECT_EQ(before, state.AngularMomentum);
}

TEST(TurnLimit, ABodyThatKeepsToItFliesAsWithoutItToTheBit)
{
  RotationInput input = OneObject(CurledLeaf(), SwayingPath(150));
  const RotationOutput wide = Refine(input, Limit(180.0));
  ASSERT_LT(GreatestTurn(wide.Poses[0]), 60.0 * Degree);
  const RotationOutput limited = Refine(input, Limit(60.0));
  for (std::size_t k = 0; k < 150; ++k)
  {
    EXPECT_EQ(wide.Poses[0].Orientations[k].coeffs(), limited.Poses[0].Orientations[k].coeffs());
    EXPECT_EQ(wide.Poses[0].AngularVelocities[k], limited.Poses[0].AngularVelocities[k]);
  }
  EXPECT_TRUE(limited.Warnings.empty());
}

TEST(TurnLimit, ANarrowFeatherIsSlowedSmoothlyAndReported)
{
  for (int i = 0; i < 6; ++i)
  {
    const RotationInput input = FallingFeather(0.9 * i);
    const PoseTrack wide = Refine(input, Limit(180.0)).Poses[0];
    EXPECT_GT(GreatestTurn(wide), 80.0 * Degree) << i;
    EXPECT_GT(GreatestJerk(wide), 30.0 * 60.0 * Degree) << i; // back and forth
    std::size_t first = 0;
    while (Angle(wide.Orientations[first + 1], wide.Orientations[first]) <= 60.0 * Degree)
    {
      ++first;
    }
    const PoseTrack slowed = Refine(input, Limit(60.0)).Poses[0];
    // Own flight up to 8 frames before, or further to where it turns slower than the limit.
    std::size_t own = first > 8 ? first - 8 : 0;
    while (own > 0 && wide.AngularVelocities[own].norm() > 30.0 * 60.0 * Degree)
    {
      --own;
    }
    for (std::size_t k = 0; k <= own; ++k)
    {
      EXPECT_EQ(wide.Orientations[k].coeffs(), slowed.Orientations[k].coeffs()) << k;
    }
    for (const double degrees : { 60.0, 20.0 })
    {
      const RotationOutput output = Refine(input, Limit(degrees));
      const double turn = GreatestTurn(output.Poses[0]);
      EXPECT_LE(turn, degrees * Degree * (1.0 + 1e-9)) << i;
      EXPECT_GT(turn, 0.9 * degrees * Degree) << i; // it goes on tumbling
      EXPECT_LE(GreatestJerk(output.Poses[0]), 0.7 * 30.0 * degrees * Degree) << i;
      ASSERT_EQ(output.Warnings.size(), 1u);
      EXPECT_NE(output.Warnings[0].find("1 object, "), std::string::npos) << output.Warnings[0];
      EXPECT_NE(output.Warnings[0].find("(object 0 at frames "), std::string::npos);
      EXPECT_NE(
        output.Warnings[0].find(" is slowed to " + NumberText(degrees) + " degrees a frame"),
        std::string::npos);
      EXPECT_NE(output.Warnings[0].find("is slowed to MaximumTurn"), std::string::npos);
    }
  }
}

TEST(TurnLimit, AWholeTurnAFrameIsNoRest)
{
  // Seen frame by frame it would stand still.
  RotationInput input = OneObject(Sheet(0.1, 0.1), StraightPath(Vec3::Zero(), Vec3::Zero(), 20));
  input.Scene.AirDensity = 0.0;
  input.Shapes[0].Damping = 0.0;
  input.Objects[0].AngularVelocity = Vec3(0.0, 0.0, 360.0 * Degree * 30.0);
  RotationOptions options = Limit(60.0);
  options.Damping = 0.0;
  const PoseTrack poses = Refine(input, options).Poses[0];
  for (std::size_t k = 1; k < 20; ++k)
  {
    EXPECT_NEAR(Angle(poses.Orientations[k], poses.Orientations[k - 1]), 60.0 * Degree, 1e-9);
  }
}

TEST(TurnLimit, OrientationRowsStayExactWithinIt)
{
  Random random(11);
  for (int i = 0; i < 6; ++i)
  {
    RotationInput input = FallingFeather(0.9 * i);
    for (const int frame : { 30, 70, 82, 120 })
    {
      input.Constraints.push_back(OrientationRow(frame, ExpMap(3.0 * random.Direction())));
    }
    const RotationOutput output = Refine(input, Limit(60.0));
    for (const Constraint& row : input.Constraints)
    {
      EXPECT_LT(Angle(output.Poses[0].Orientations[row.Frame], row.Orientation), 1e-9);
    }
    EXPECT_LE(GreatestTurn(output.Poses[0]), 60.0 * Degree * (1.0 + 1e-9)) << i;
  }
}

TEST(TurnLimit, ARowThatAsksForMoreIsMetAndReported)
{
  RotationInput input = OneObject(CurledLeaf(), SwayingPath(60));
  input.Constraints = { OrientationRow(30, Quat::Identity()),
                        OrientationRow(31, ExpMap(90.0 * Degree * Vec3::UnitX())) };
  const RotationOutput output = Refine(input, Limit(60.0));
  EXPECT_EQ(output.Report[1].Status, ConstraintStatus::Met);
  ASSERT_FALSE(output.Warnings.empty());
  EXPECT_EQ(output.Warnings.back(),
            "1 object, 1 frame (object 0 at frame 31): orientations asked for, rests or surfaces "
            "turn by up to 90 degrees, more than 60 degrees a frame: ask for orientations more "
            "frames apart, and for more time before a rest (MaximumTurn)");
}

TEST(TurnLimit, LandingsKeepToIt)
{
  ObstacleMesh slab;
  slab.Mesh = MakeBox({ Vec3(-4.0, -4.0, -1.0), Vec3(4.0, 4.0, 0.0) });
  ObstacleSet ground;
  ASSERT_TRUE(ground.Build({ slab }));
  Random random(5);
  for (int i = 0; i < 20; ++i)
  {
    const Shape feather = Feather();
    RotationInput input =
      OneObject(feather, LandingPath(Vec3(0.0, 0.0, RestHeight(feather)), 90, 110, 0.7 * i));
    input.Objects[0].Orientation = ExpMap(3.0 * random.Direction());
    input.Obstacles = &ground;
    input.Constraints = { RestRow(90, 109, Vec3::Zero()) };
    const RotationOutput output = Refine(input, Limit(60.0));
    EXPECT_LE(GreatestTurn(output.Poses[0]), 60.0 * Degree * (1.0 + 1e-9)) << i;
  }
}

TEST(TurnLimit, ByItselfABodyTurnsAsAnEyeCanFollow)
{
  // Narrow, usual and wide, that fall at the speeds of leaves and feathers.
  for (const double width : { 0.012, 0.03, 0.08 })
  {
    for (const double framesPerSecond : { 24.0, 60.0 })
    {
      const std::vector<double> turns = TurnsOf(Refine(Falling(width, framesPerSecond)));
      EXPECT_LE(Above(turns, 25.0), turns.size() / 20) << width;
      EXPECT_LE(Above(turns, 39.0), turns.size() / 20) << width; // the limit is 40
      EXPECT_GT(turns[turns.size() / 2], 1.0) << width << ": it does not stand still";
    }
  }
}

TEST(TurnLimit, SoItDoesInGusts)
{
  for (const double width : { 0.03, 0.06, 0.12 })
  {
    RotationInput input = Falling(width, 30.0);
    input.Glides = true;
    std::vector<std::vector<Vec3>> velocities;
    std::vector<std::vector<Mat3>> gradients;
    for (const Track& track : input.Tracks)
    {
      const StirredAir air(0.5, 0.5, 0.25, 1.0, Random(7, velocities.size()));
      velocities.emplace_back();
      gradients.emplace_back();
      for (std::size_t k = 0; k < track.Positions.size(); ++k)
      {
        Mat3 gradient;
        velocities.back().push_back(
          air.At(track.Positions[k], static_cast<double>(k) / 30.0, gradient));
        gradients.back().push_back(gradient);
      }
    }
    const AirOnTracks air(velocities, gradients);
    input.Air = &air;
    const std::vector<double> turns = TurnsOf(Refine(input));
    EXPECT_LE(Above(turns, 25.0), turns.size() / 20) << width;
    EXPECT_LE(Above(turns, turns.back() - 1.0), turns.size() / 20) << width << ": at a limit";
  }
}

TEST(TurnLimit, WhatIsAboveTheEaseGoesByAndBy)
{
  const Strip strip;
  const FlightBody body(strip.Panels, strip.Properties, 1e-4, 0.0, AirCoefficients(), 0.0, 0.0);
  FlightPath path;
  path.RelativeVelocities.assign(2, Vec3::Zero());
  path.Ease = { 10.0, 40.0 };
  for (const double rate : { 9.0, 15.0 })
  {
    FlightState state;
    state.SetAngularVelocity(body, Vec3(0.0, 0.0, rate));
    const FrameEvents events = AdvanceFrame(body, path, 0, Settling(), nullptr, state);
    const double above = std::max(rate - 10.0, 0.0);
    EXPECT_NEAR(state.AngularVelocity(body).z(), rate - above * (1.0 - std::exp(-40.0 / 30.0)),
                1e-9);
    EXPECT_FALSE(events.Slowed) << "no limit";
  }
}

TEST(TurnLimit, AWideBodyTurnsAsItFalls)
{
  // A pace of 1: as under a limit that nothing comes to.
  RotationInput input = OneObject(Sheet(0.2, 0.15), SwayingPath(60));
  const RotationOutput output = Refine(input);
  RotationOptions options;
  options.MaximumTurn = 180.0;
  const RotationOutput unlimited = Refine(input, options);
  EXPECT_EQ(output.Poses[0].Orientations[59].coeffs(),
            unlimited.Poses[0].Orientations[59].coeffs());
}
