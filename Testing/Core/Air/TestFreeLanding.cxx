// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Drift/FreeLanding.h"
#include "Base/Primitives.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace waft;

namespace
{

constexpr int FallFrames = 91;
constexpr double FallRate = 30.0; // 1/s

/// A body that falls through air that moves as one, and its path, which keeps its clearance.
struct Falling
{
  SceneInfo Scene;
  ObstacleSet Obstacles;
  MotionObject Body;
  std::vector<Vec3> Path;
  HalfSeries Air;

  explicit Falling(const Vec3& wind, double upTo = 0.0, bool moves = false)
  {
    this->Scene.Time = { FallFrames, FallRate };
    ObstacleMesh ground;
    ground.Mesh = MakeBox({ Vec3(-5.0, -5.0, -1.0), Vec3(5.0, 5.0, upTo) });
    for (int f = 0; moves && f < FallFrames; ++f)
    {
      ground.Offsets.emplace_back(0.01 * f, 0.0, 0.0);
    }
    EXPECT_TRUE(this->Obstacles.Build({ ground }));
    this->Body.SettlingSpeed = 0.8;
    this->Body.ClearanceRadius = 0.05;
    this->Body.RestHeight = 0.002;
    for (int f = 0; f < FallFrames; ++f)
    {
      this->Path.emplace_back(0.0, 0.0, std::max(upTo + 0.06, 1.0 - f / FallRate * 0.8));
    }
    FieldSeries air;
    air.Meaning = FieldMeaning::Velocity;
    air.Dimensions = { 2, 2, 2 };
    air.Origin = Vec3(-5.0, -5.0, 0.0);
    air.Spacing = Vec3::Constant(10.0);
    for (int f = 0; f < FallFrames; ++f)
    {
      air.Times.push_back(f / FallRate);
      air.Values.emplace_back(
        8, std::array<float, 3>{ float(wind.x()), float(wind.y()), float(wind.z()) });
    }
    this->Air = HalfSeries(air);
  }

  FreeLanding Found(int first = 1) const
  {
    const DriftScene around{ this->Scene, this->Obstacles, false };
    return FindFreeLanding(around, this->Body, AirSampler(this->Air), this->Path, first);
  }
};

} // namespace

TEST(FreeLanding, SinksFromItsClearanceToTheSurface)
{
  for (const double top : { 0.0, 0.3 })
  {
    const FreeLanding landing = Falling(Vec3::Zero(), top).Found();
    // The last of the way is as long as the way so far was quick.
    EXPECT_NEAR(landing.Frame, (1.0 - top - 0.002) / 0.8 * FallRate, 1.5) << top;
    EXPECT_LT((landing.Place - Vec3(0.0, 0.0, top)).norm(), 1e-9) << top;
  }
}

TEST(FreeLanding, IsBrakedAlongTheSurface)
{
  const FreeLanding landing = Falling(Vec3(0.5, 0.0, 0.0)).Found();
  ASSERT_GT(landing.Frame, 0);
  EXPECT_GT(landing.Place.x(), 0.0);
  EXPECT_LT(landing.Place.x(), 0.7 * 0.5 * 0.07 / 0.8) << "with the wind all the way";
}

TEST(FreeLanding, IsNoneWhereTheAirLiftsOrTheGroundMovesOrAMarkIsLater)
{
  EXPECT_LT(Falling(Vec3(0.0, 0.0, 1.2)).Found().Frame, 0);
  EXPECT_LT(Falling(Vec3::Zero(), 0.0, true).Found().Frame, 0);
  EXPECT_GE(Falling(Vec3::Zero()).Found(70).Frame, 70);
  EXPECT_LT(Falling(Vec3::Zero()).Found(FallFrames).Frame, 0);
}

TEST(FreeLanding, OfABodyIsARestOfNoRowThatLastsToTheEnd)
{
  const Falling scene(Vec3::Zero());
  const DriftScene around{ scene.Scene, scene.Obstacles, false };
  MotionObject body = scene.Body;
  body.Position = Vec3(0.0, 0.0, 1.0);
  Constraint mark;
  mark.ObjectId = body.ObjectId;
  mark.Frame = 20;
  mark.Value = Vec3(0.1, 0.0, 0.6);
  BodyProblem problem(around, body, scene.Path, { mark });
  EXPECT_EQ(problem.FreeFrom(), 21);
  EXPECT_EQ(problem.FreeLanding(), nullptr);
  problem.LandFreely(50, Vec3::Zero());
  ASSERT_NE(problem.FreeLanding(), nullptr);
  EXPECT_EQ(problem.FreeLanding()->Row, OfNoRow);
  EXPECT_EQ(problem.FreeLanding()->Target, OfNoRow);
  EXPECT_EQ(FirstFrame(*problem.FreeLanding()), 50);
  EXPECT_EQ(LastFrame(*problem.FreeLanding()), FallFrames - 1);
  ASSERT_NE(problem.HeldAt(FallFrames - 1), nullptr);
  EXPECT_NEAR(problem.HeldAt(50)->z(), body.RestHeight, 1e-12);
  EXPECT_EQ(problem.HeldAt(49), nullptr);
}
