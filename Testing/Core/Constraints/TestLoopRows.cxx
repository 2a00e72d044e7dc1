// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/LoopRows.h"

#include "Obstacles/Shapes.h"

#include <gtest/gtest.h>

#include <map>
#include <vector>

namespace waft
{
namespace
{

/// Three objects above a ground; the second and the third are of one shape.
struct Loop
{
  std::vector<MotionObject> Objects{ 3 };
  std::vector<Constraint> Rows;
  std::vector<ObstacleMesh> Meshes{ 1 };
  SceneInfo Scene;
  int Number = -1;

  Loop()
  {
    this->Meshes[0].Mesh = MakeBox({ Vec3(-2, -2, -1), Vec3(2, 2, 0) });
    for (int id = 0; id < 3; ++id)
    {
      MotionObject& object = this->Objects[static_cast<std::size_t>(id)];
      object.ObjectId = id;
      object.ShapeId = id > 0 ? 1 : 0;
      object.Position = Vec3(id, 0, 2);
    }
    this->Scene.Time.NumberOfFrames = 100;
  }
  Result Close()
  {
    ObstacleSet obstacles;
    const Result built = obstacles.Build(this->Meshes);
    return built ? CloseLoop(this->Scene, this->Objects, obstacles, this->Rows, this->Number)
                 : built;
  }
  Constraint& Rest(int id, int frame, int until, const Vec3& value)
  {
    Constraint row;
    row.Kind = ConstraintKind::Rest;
    row.ObjectId = id;
    row.Frame = frame;
    row.Until = until;
    row.Value = value;
    this->Rows.push_back(row);
    return this->Rows.back();
  }
  /// Of those that close it, by object.
  std::map<int, Constraint> Closing() const
  {
    std::map<int, Constraint> rows;
    for (const Constraint& row : this->Rows)
    {
      if (row.Row == this->Number && IsPositional(row.Kind))
      {
        rows[row.ObjectId] = row;
      }
    }
    return rows;
  }
};

TEST(LoopRows, LeadToTheStartsOfTheirShape)
{
  Loop loop;
  Constraint crossed; // the second ends where the third begins
  crossed.ObjectId = 1;
  crossed.Frame = 50;
  crossed.Value = Vec3(2.1, 0, 2);
  loop.Rows.push_back(crossed);
  crossed.ObjectId = 2;
  crossed.Value = Vec3(0.9, 0, 2);
  loop.Rows.push_back(crossed);
  ASSERT_TRUE(loop.Close());
  const std::map<int, Constraint> rows = loop.Closing();
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows.at(0).Target, 0);
  EXPECT_EQ(rows.at(1).Target, 2);
  EXPECT_EQ(rows.at(2).Target, 1);
  EXPECT_EQ(rows.at(1).Frame, 100);
  EXPECT_EQ(rows.at(1).Value, Vec3(2, 0, 2));
  EXPECT_EQ(rows.at(1).Choice, ObjectChoice::AmongListed);
}

TEST(LoopRows, AskForTheVelocityOfWhoHangs)
{
  Loop loop;
  loop.Objects[0].Release = 30;
  ASSERT_TRUE(loop.Close());
  EXPECT_EQ(loop.Rows.size(), 4u);
  EXPECT_TRUE(std::any_of(loop.Rows.begin(), loop.Rows.end(),
                          [](const Constraint& row)
                          { return row.Kind == ConstraintKind::Velocity && row.Value.isZero(); }));
}

TEST(LoopRows, WhoAppearsTakesThePlaceOfOneThatLeaves)
{
  Loop loop;
  loop.Objects[1].Release = 30;
  loop.Objects[1].Appears = 1;
  EXPECT_FALSE(loop.Close());
  loop.Objects[2].Goes.From = 40;
  ASSERT_TRUE(loop.Close());
  EXPECT_EQ(loop.Closing().at(1).Target, 2);
  EXPECT_EQ(loop.Closing().count(2), 0u);
}

TEST(LoopRows, WhatLiesAtTheEndLiesAtTheStart)
{
  Loop loop;
  loop.Rest(1, 60, 99, Vec3(0.5, 0.5, 1));
  EXPECT_NE(loop.Close().Message().find("object 1 lies at"), std::string::npos);
  loop.Objects[2].Position = Vec3(0.5, 0.5, loop.Objects[2].RestHeight);
  ASSERT_TRUE(loop.Close());
  EXPECT_EQ(loop.Closing().at(1).Target, 2);
  EXPECT_EQ(loop.Closing().at(2).Target, 1);
  EXPECT_EQ(loop.Rows.front().Until, 100);
}

TEST(LoopRows, ObstaclesComeBack)
{
  Loop loop;
  ObstacleMesh lift;
  lift.ObstacleId = 7;
  lift.Mesh = MakeBox({ Vec3(-1.5, -0.5, 0.5), Vec3(-1, 0, 0.6) });
  for (int f = 0; f < 100; ++f)
  {
    lift.Offsets.emplace_back(0.0, 0.0, 0.01 * f);
  }
  loop.Meshes.push_back(lift);
  EXPECT_NE(loop.Close().Message().find("obstacle 7 ends"), std::string::npos);
  for (int f = 0; f < 100; ++f)
  {
    loop.Meshes[1].Offsets[static_cast<std::size_t>(f)].z() = 0.01 * std::min(f, 99 - f);
  }
  EXPECT_TRUE(loop.Close());
}

} // namespace
} // namespace waft
