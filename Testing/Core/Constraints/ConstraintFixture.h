// SPDX-License-Identifier: BSD-3-Clause
// A scene with a ground, a box and a lift, to judge constraints in.
#pragma once

#include "Constraints/ConstraintCheck.h"
#include "Obstacles/Shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace waft
{
namespace testing
{

constexpr auto Met = ConstraintStatus::Met;
constexpr auto Infeasible = ConstraintStatus::Infeasible;
constexpr auto Conflict = ConstraintStatus::Conflict;
constexpr auto Unreachable = ConstraintStatus::Unreachable;

struct Fixture
{
  std::vector<Constraint> Rows;
  std::vector<MotionObject> Objects;
  ObstacleSet Obstacles;
  SceneInfo Scene;

  Fixture()
  {
    ObstacleMesh ground, box, lift;
    ground.Mesh = MakeBox({ Vec3(-2, -2, -1), Vec3(2, 2, 0) });
    box.ObstacleId = 1;
    box.Mesh = MakeBox({ Vec3(0.5, -0.5, 0), Vec3(1.5, 0.5, 1) });
    lift.ObstacleId = 2;
    lift.Mesh = MakeBox({ Vec3(-1.5, -0.5, 0.5), Vec3(-1, 0, 0.6) });
    for (int f = 0; f < 100; ++f)
    {
      lift.Offsets.emplace_back(0.0, 0.0, 0.01 * std::max(0, f - 50));
    }
    const Result result = this->Obstacles.Build({ ground, box, lift });
    EXPECT_TRUE(static_cast<bool>(result)) << result.Message();
    for (int id = 0; id < 3; ++id)
    {
      MotionObject object;
      object.ObjectId = id;
      object.ClassId = id / 2;
      object.Position = Vec3(0, 0, 2);
      object.RestHeight = 0.01;
      this->Objects.push_back(object);
    }
    this->Scene.Time.NumberOfFrames = 100;
    this->Scene.Time.FramesPerSecond = 10.0;
  }
  Constraint& Add(ConstraintKind kind, int frame, const Vec3& value, double radius = 0.0)
  {
    Constraint row;
    row.ObjectId = 0;
    row.Kind = kind;
    row.Frame = frame;
    row.Until = frame;
    row.Value = value;
    row.Radius = radius;
    row.Row = static_cast<int>(this->Rows.size());
    this->Rows.push_back(row);
    return this->Rows.back();
  }
  std::vector<ReportRow> Judged() const
  {
    return JudgeConstraints(this->Rows, this->Objects, this->Obstacles, this->Scene);
  }
  std::vector<ConstraintStatus> Statuses() const
  {
    std::vector<ConstraintStatus> statuses;
    for (const ReportRow& line : this->Judged())
    {
      EXPECT_EQ(line.Message.empty(), line.Status == Met) << line.Message;
      statuses.push_back(line.Status);
    }
    return statuses;
  }
};

using Statuses = std::vector<ConstraintStatus>;
using Kind = ConstraintKind;

} // namespace testing
} // namespace waft
