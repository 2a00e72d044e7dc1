// SPDX-License-Identifier: BSD-3-Clause
// What no plan can do, and what is said of it.
#include "PlanScenes.h"

#include <gtest/gtest.h>

using namespace waft;
using namespace waft::test;

TEST(Planner, NamesASealedWayAndPlansAllTheRest)
{
  PlanScene scene;
  scene.AddBox(Vec3(-0.05, -2.0, 0.0), Vec3(0.05, 2.0, 4.0));
  scene.AddObject(Vec3(-1.5, 0.0, 2.0));
  scene.AddObject(Vec3(1.0, 0.0, 2.0));
  scene.AddRow(ConstraintKind::Position, 0, 150, Vec3(1.2, 0.0, 2.0));
  scene.AddRow(ConstraintKind::Position, 0, 280, Vec3(-1.2, 0.3, 2.0));
  scene.AddRow(ConstraintKind::Position, 1, 150, Vec3(1.2, 1.0, 2.0));
  scene.AddRow(ConstraintKind::Position, 1, 250, Vec3(0.0, 0.0, 2.0)); // inside the wall
  const PlanOutput output = scene.Run(1);
  std::map<int, ConstraintStatus> status;
  for (const ReportRow& line : output.Report)
  {
    status[line.Row] = line.Status;
  }
  EXPECT_EQ(status[0], ConstraintStatus::Unreachable);
  EXPECT_EQ(status[1], ConstraintStatus::Met);
  EXPECT_EQ(status[2], ConstraintStatus::Met);
  EXPECT_EQ(status[3], ConstraintStatus::Infeasible);
  // Later stages know what not to force.
  for (const Constraint& row : output.Constraints)
  {
    EXPECT_EQ(row.Status, status[row.Row]) << row.Row;
  }
  EXPECT_EQ(output.Tracks[0].Positions[280], Vec3(-1.2, 0.3, 2.0));
  for (const Track& track : output.Tracks)
  {
    EXPECT_GE(LeastSlack(scene, track, 0, 299), -0.004);
  }
}

TEST(Planner, NamesAStartThatCannotBe)
{
  PlanScene scene;
  scene.AddBox(Vec3(-1.3, -0.3, 1.7), Vec3(-0.7, 0.3, 2.3));
  scene.AddObject(Vec3(-1.2, 0.0, 2.0));
  scene.AddObject(Vec3(2.5, 0.0, 2.0));
  scene.AddObject(Vec3(1.0, 0.0, 2.0));
  for (int object = 0; object < 3; ++object)
  {
    scene.AddRow(ConstraintKind::Position, object, 200, Vec3(0.5, 0.3 * object, 2.0));
  }
  const PlanOutput output = scene.Run(1);
  ASSERT_EQ(output.Report.size(), 3u);
  EXPECT_NE(output.Report[0].Message.find("object 0 at its start: "), std::string::npos);
  EXPECT_NE(output.Report[0].Message.find("inside obstacle 1"), std::string::npos)
    << output.Report[0].Message;
  EXPECT_NE(output.Report[1].Message.find("outside the volume"), std::string::npos)
    << output.Report[1].Message;
  EXPECT_EQ(output.Report[2].Message.find("start"), std::string::npos);
  EXPECT_EQ(output.Report[2].Status, ConstraintStatus::Met);
}

TEST(Planner, NamesAConstraintThatIsFarTooFast)
{
  PlanScene scene;
  scene.AddObject(Vec3(-1.8, 0.0, 2.0));
  scene.AddRow(ConstraintKind::Position, 0, 15, Vec3(1.8, 0.0, 2.0));
  const PlanOutput output = scene.Run(1);
  EXPECT_EQ(output.Report[0].Status, ConstraintStatus::Unreachable);
  EXPECT_NE(output.Report[0].Message.find("top speed"), std::string::npos);
  EXPECT_LE(FastestStep(output.Tracks[0]), 1.5 * test::SwirlDatabase().TopSpeed);
}

TEST(Planner, StopsWhenAskedInTheMiddleOfASearch)
{
  // Sealed, with far more branches than there is patience for.
  PlanScene scene;
  scene.AddBox(Vec3(-0.05, -2.0, 0.0), Vec3(0.05, 2.0, 4.0));
  scene.AddObject(Vec3(-1.5, 0.0, 2.0));
  scene.AddRow(ConstraintKind::Position, 0, 299, Vec3(1.2, 0.0, 2.0));
  ASSERT_TRUE(bool(scene.Obstacles.Build(scene.Meshes)));
  struct StopsAtThird : Monitor
  {
    bool Tick(double, const std::string&) override { return ++this->Ticks < 3; }
    int Ticks = 0;
  } monitor;
  PlanOptions options;
  options.MaximumNumberOfBranches = 1000000;
  PlanOutput output;
  const PlanInput input{ test::SwirlDatabase(), scene.Objects, scene.Constraints, scene.Obstacles,
                         scene.Scene };
  const Result result = PlanMotion(input, options, SerialFor(), monitor, output);
  EXPECT_TRUE(result.IsStopped());
  EXPECT_EQ(monitor.Ticks, 3);
  EXPECT_TRUE(output.Tracks.empty());
}

TEST(Planner, StoppedBeforeTheFirstFlightItHasJudgedTheRows)
{
  PlanScene scene;
  scene.AddObject(Vec3(0, 0, 2));
  constexpr int count = 3000; // one path through all of them takes minutes and gigabytes
  scene.Scene.Time.NumberOfFrames = count + 2;
  for (int frame = 1; frame <= count; ++frame)
  {
    scene.AddRow(ConstraintKind::Velocity, 0, frame, Vec3(0, 0, -0.0001));
  }
  scene.AddRow(ConstraintKind::Position, 0, 100, Vec3(0, 0, 9));
  ASSERT_TRUE(bool(scene.Obstacles.Build(scene.Meshes)));
  struct StopsAtSecond : Monitor
  {
    bool Tick(double, const std::string&) override { return ++this->Ticks < 2; }
    int Ticks = 0;
  } monitor;
  PlanOutput output;
  const PlanInput input{ test::SwirlDatabase(), scene.Objects, scene.Constraints, scene.Obstacles,
                         scene.Scene };
  const Result result = PlanMotion(input, PlanOptions(), SerialFor(), monitor, output);
  EXPECT_TRUE(result.IsStopped());
  EXPECT_TRUE(output.Tracks.empty());
  ASSERT_EQ(output.Report.size(), count + 1u);
  EXPECT_EQ(output.Report.back().Status, ConstraintStatus::Infeasible);
}

TEST(Planner, RefusesWhatIsMalformed)
{
  PlanScene scene;
  scene.AddObject(Vec3(0, 0, 2));
  scene.AddRow(ConstraintKind::Position, 0, 300, Vec3(0, 0, 2));
  ASSERT_TRUE(bool(scene.Obstacles.Build(scene.Meshes)));
  SilentMonitor monitor;
  PlanOutput output;
  const auto run = [&]()
  {
    const PlanInput input{ test::SwirlDatabase(), scene.Objects, scene.Constraints, scene.Obstacles,
                           scene.Scene };
    return PlanMotion(input, PlanOptions(), SerialFor(), monitor, output);
  };
  EXPECT_NE(run().Message().find("frame 300"), std::string::npos);
  scene.Constraints[0].Frame = 10;
  scene.Constraints[0].ObjectId = 4;
  EXPECT_NE(run().Message().find("no object 4"), std::string::npos);
  scene.Constraints.clear();
  scene.Scene.Time.NumberOfFrames = 0;
  EXPECT_NE(run().Message().find("no frames"), std::string::npos);
  scene.Scene.Time.NumberOfFrames = 300;
  const MotionDatabase nothing;
  const PlanInput input{ nothing, scene.Objects, scene.Constraints, scene.Obstacles, scene.Scene };
  EXPECT_FALSE(bool(PlanMotion(input, PlanOptions(), SerialFor(), monitor, output)));
  EXPECT_TRUE(output.Tracks.empty());
}
