// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Drift/Formation.h"
#include "Obstacles/Shapes.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace waft;
using namespace waft::testing;

namespace
{

constexpr int Frames = 121;
constexpr double Settling = 0.5; // m/s

using Flow = std::function<Vec3(const Vec3&)>;

HalfSeries AirOf(const Flow& velocity)
{
  constexpr int points = 17;
  FieldSeries air;
  air.Meaning = FieldMeaning::Velocity;
  air.Dimensions = { points, points, points };
  air.Origin = Vec3(-2.0, -2.0, 0.0);
  air.Spacing = Vec3::Constant(4.0 / (points - 1));
  std::vector<std::array<float, 3>> values;
  for (int k = 0; k < points; ++k)
  {
    for (int j = 0; j < points; ++j)
    {
      for (int i = 0; i < points; ++i)
      {
        const Vec3 u = velocity(air.Origin + Vec3(i, j, k).cwiseProduct(air.Spacing));
        values.push_back({ float(u.x()), float(u.y()), float(u.z()) });
      }
    }
  }
  for (int f = 0; f < Frames; ++f)
  {
    air.Times.push_back(f / 30.0);
    air.Values.push_back(values);
  }
  return HalfSeries(air);
}

/// A word of a metre across, upright, that is held from frame 20 to 110.
Formation Moved(const Flow& velocity, const ObstacleSet& obstacles = ObstacleSet())
{
  std::vector<FormationPlace> places;
  for (int i = 0; i < 12; ++i)
  {
    places.push_back({ Vec3(-0.5 + i / 11.0, 0.0, 1.8 + 0.2 * (i % 3)), Settling, 0.1 });
  }
  SceneInfo scene;
  scene.Time = { Frames, 30.0 };
  Formation form;
  form.Begin = 20;
  form.End = 110;
  const HalfSeries air = AirOf(velocity);
  MoveFormation(places, AirSampler(air), obstacles, scene, form);
  EXPECT_EQ(form.Shifts.size(), 91u);
  EXPECT_EQ(form.Turns.size(), 91u);
  for (std::size_t k = 0; k + 1 < form.Shifts.size(); ++k)
  {
    const int frame = form.Begin + static_cast<int>(k);
    EXPECT_LT(Eigen::JacobiSVD<Mat3>(form.Turns[k]).singularValues().maxCoeff(), 1.1 + 1e-9);
    EXPECT_GT(Eigen::JacobiSVD<Mat3>(form.Turns[k]).singularValues().minCoeff(), 0.9 - 1e-9);
    for (const FormationPlace& place : places)
    {
      const Vec3 step = form.At(place.Place, frame + 1) - form.At(place.Place, frame);
      EXPECT_GT(step.z(), -0.15 / 30.0 - 1e-9);
      EXPECT_LT(k == 0 ? step.norm() : 0.0, 0.1 / 30.0); // from rest
    }
  }
  return form;
}

} // namespace

TEST(Formation, GoesWithTheAirThatBearsIt)
{
  const Formation form = Moved([](const Vec3&) { return Vec3(0.3, 0.1, Settling); });
  const Vec3 step = form.Shifts.back() - form.Shifts[form.Shifts.size() - 2];
  EXPECT_LT((step * 30.0 - Vec3(0.3, 0.1, 0.0)).norm(), 0.01);
  EXPECT_LT((form.Turns.back() - Mat3::Identity()).norm(), 1e-3);
}

TEST(Formation, SinksSlowlyInStillAirAndWaitsAboveWhatIsBelow)
{
  const Flow still = [](const Vec3&) { return Vec3(0.0, 0.0, 0.0); };
  const Formation form = Moved(still);
  EXPECT_NEAR(form.Shifts.back().z(), -0.15 * 90 / 30.0, 0.05);
  ObstacleMesh table;
  table.Mesh = MakeBox({ Vec3(-2, -2, 1.4), Vec3(2, 2, 1.6) });
  ObstacleSet obstacles;
  ASSERT_TRUE(obstacles.Build({ table }));
  const Formation above = Moved(still, obstacles);
  EXPECT_LT(above.Shifts.back().z(), -0.08);
  EXPECT_GT(above.Shifts.back().z(), -0.1 - 1e-9); // its lowest place keeps its room
}

TEST(Formation, TurnsWithTheAirAndIsStrainedByATenthAtMost)
{
  const auto about = [](double turn, double strain)
  {
    return [turn, strain](const Vec3& x)
    { return Vec3(strain * x.x() - turn * x.y(), turn * x.x() - strain * x.y(), Settling); };
  };
  const Formation turned = Moved(about(0.3, 0.0));
  const Vec3 along = turned.Turns.back() * Vec3::UnitX();
  EXPECT_GT(std::atan2(along.y(), along.x()), 0.3); // what the ridge leaves of 0.3 rad/s
  EXPECT_LT(std::atan2(along.y(), along.x()), 0.3 * 3.0);
  EXPECT_NEAR(along.norm(), 1.0, 0.1);
  const Formation strained = Moved(about(0.0, 0.4));
  EXPECT_NEAR((strained.Turns.back() * Vec3::UnitX()).norm(), 1.1, 0.01);
}

TEST(Formation, IsFoundByItsRows)
{
  Formation group, row;
  group.IsGroup = 1;
  group.Number = row.Number = 3;
  Constraint own;
  own.Row = 3;
  EXPECT_EQ(FindFormation({ group }, own), nullptr);
  const std::vector<Formation> both{ group, row };
  EXPECT_EQ(FindFormation(both, own), &both[1]);
  own.Group = 3;
  EXPECT_EQ(FindFormation(both, own), &both[0]);
}
