// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/RowConflicts.h"

#include "Base/Random.h"
#include "PlanScenes.h"

#include <gtest/gtest.h>

#include <set>

using namespace waft;
using namespace waft::test;

namespace
{

constexpr double Rate = 30.0;
const SpeedLimit Limit(2.5 / Rate, Rate, 8, 1e-8);

std::vector<ReportRow> Judged(PlanScene& scene)
{
  PlanScene::Check(scene.Obstacles.Build(scene.Meshes));
  return JudgeWithSpeeds(scene.Constraints, scene.Objects, scene.Obstacles, scene.Scene, Limit);
}

std::vector<ConstraintStatus> Statuses(const std::vector<ReportRow>& report)
{
  std::vector<ConstraintStatus> statuses;
  for (const ReportRow& line : report)
  {
    statuses.push_back(line.Status);
  }
  return statuses;
}

constexpr ConstraintStatus Met = ConstraintStatus::Met;
constexpr ConstraintStatus Conflict = ConstraintStatus::Conflict;
constexpr ConstraintStatus Unreachable = ConstraintStatus::Unreachable;
using List = std::vector<ConstraintStatus>;

} // namespace

TEST(RowConflicts, OfTwoThatAreTooFarApartTheLaterIsGivenUp)
{
  PlanScene scene;
  scene.AddObject(Vec3(-1, 0, 2.5));
  scene.AddRow(ConstraintKind::Position, 0, 60, Vec3(-0.3, 0, 2.2));
  scene.AddRow(ConstraintKind::Position, 0, 61, Vec3(1.3, 1.6, 1.2));
  const std::vector<ReportRow> report = Judged(scene);
  EXPECT_EQ(Statuses(report), (List{ Met, Conflict }));
  EXPECT_EQ(report[1].Message,
            "row 1 target 0 (position at frame 61) contradicts row 0 target 0 (position at frame "
            "60): 2.474 m apart in 1 frame, expected at most 0.1167 m, 1.4 times the database's "
            "top speed");
}

TEST(RowConflicts, TheFewestAreGivenUp)
{
  PlanScene scene;
  scene.AddObject(Vec3(0, 0, 2));
  scene.AddRow(ConstraintKind::Position, 0, 60, Vec3(1.8, 0, 2)); // off the way of three others
  scene.AddRow(ConstraintKind::Position, 0, 58, Vec3(0, 0, 2));
  scene.AddRow(ConstraintKind::Position, 0, 62, Vec3(0, 0.1, 2));
  scene.AddRow(ConstraintKind::Position, 0, 66, Vec3(0, 0.2, 2));
  scene.AddRow(ConstraintKind::Position, 0, 200, Vec3(1.8, 0, 2));
  const std::vector<ReportRow> report = Judged(scene);
  EXPECT_EQ(Statuses(report), (List{ Conflict, Met, Met, Met, Met }));
  for (const char* name : { "row 1 ", "row 2 ", "row 3 " })
  {
    EXPECT_NE(report[0].Message.find(name), std::string::npos) << report[0].Message;
  }
}

TEST(RowConflicts, ARestAgainstPlacesWithinIt)
{
  PlanScene scene;
  scene.AddObject(Vec3(0, 0, 2));
  scene.AddRow(ConstraintKind::Rest, 0, 100, Vec3(0, 0, 0.1)).Until = 200;
  scene.AddRow(ConstraintKind::Position, 0, 130, Vec3(0, 0, 1));
  EXPECT_EQ(Statuses(Judged(scene)), (List{ Met, Conflict }));
  scene.AddRow(ConstraintKind::Position, 0, 160, Vec3(0, 1, 1));
  EXPECT_EQ(Statuses(Judged(scene)), (List{ Conflict, Met, Met }));
}

TEST(RowConflicts, AGivenPathMayBeAsFastAsItLikes)
{
  PlanScene scene;
  scene.AddObject(Vec3(-1, 0, 2));
  for (int k = 0; k < 10; ++k)
  {
    scene.AddRow(ConstraintKind::Position, 0, 90 + k, Vec3(-1.0 + 0.2 * k, 0, 2)).Row = 0;
  }
  scene.AddRow(ConstraintKind::Position, 0, 95, Vec3(-1, 1, 2)).Row = 1;  // beside it
  scene.AddRow(ConstraintKind::Position, 0, 96, Vec3(0.2, 0, 2)).Row = 2; // on it
  EXPECT_EQ(Statuses(Judged(scene)), (List{ Met, Conflict, Met }));
}

TEST(RowConflicts, WhatIsTooFarFromTheStartStandsInNobodysWay)
{
  PlanScene scene;
  scene.AddObject(Vec3(-1.9, 0, 2));
  scene.AddRow(ConstraintKind::Position, 0, 5, Vec3(1.9, 0, 2));
  EXPECT_EQ(Statuses(Judged(scene)), List{ Met }) << "the planner comes as near as it can";
  scene.AddRow(ConstraintKind::Position, 0, 40, Vec3(-1.5, 0.5, 2));
  const std::vector<ReportRow> report = Judged(scene);
  EXPECT_EQ(Statuses(report), (List{ Unreachable, Met }));
  EXPECT_NE(report[0].Message.find("too far from the object's start"), std::string::npos);
}

TEST(RowConflicts, BallsMeetHalfWay)
{
  PlanScene scene;
  scene.AddObject(Vec3(0, 0, 2));
  scene.AddRow(ConstraintKind::Position, 0, 60, Vec3(0, 0, 2)).Radius = 0.5;
  scene.AddRow(ConstraintKind::Position, 0, 61, Vec3(1, 0, 2)).Radius = 0.5;
  EXPECT_EQ(Statuses(Judged(scene)), (List{ Met, Met }));
}

TEST(RowConflicts, AsManyAreKeptAsEveryChoiceTriedKeeps)
{
  Random random(8);
  for (int trial = 0; trial < 100; ++trial)
  {
    PlanScene scene;
    scene.AddObject(Vec3(0, 0, 2));
    std::set<int> frames;
    while (frames.size() < 8)
    {
      frames.insert(60 + static_cast<int>(random.Index(50)));
    }
    for (const int frame : frames)
    {
      scene.AddRow(ConstraintKind::Position, 0, frame,
                   random.InBox(Box{ Vec3(-1.5, -1.5, 1), Vec3(1.5, 1.5, 3) }));
    }
    std::size_t kept = 0;
    for (const ConstraintStatus status : Statuses(Judged(scene)))
    {
      kept += status == Met ? 1 : 0;
    }
    std::size_t most = 0;
    for (unsigned choice = 0; choice < 256; ++choice)
    {
      std::vector<Stop> stops;
      for (std::size_t i = 0; i < 8; ++i)
      {
        if ((choice >> i & 1u) != 0)
        {
          stops.push_back(StopOf(scene.Constraints[i], 0.0, scene.Obstacles));
        }
      }
      bool isGood = true;
      for (std::size_t k = 1; k < stops.size(); ++k)
      {
        isGood = isGood && Limit.Haste(stops[k - 1], stops[k]) <= SpeedAllowance;
      }
      most = isGood ? std::max(most, stops.size()) : most;
    }
    EXPECT_EQ(kept, most) << trial;
  }
}

TEST(RowConflicts, ThePlannerMeetsWhatIsKept)
{
  PlanScene scene;
  scene.AddObject(Vec3(-1, 0, 2.5));
  scene.AddRow(ConstraintKind::Position, 0, 60, Vec3(-0.3, 0, 2.2));
  scene.AddRow(ConstraintKind::Position, 0, 61, Vec3(1.3, 1.6, 1.2));
  scene.AddRow(ConstraintKind::Position, 0, 150, Vec3(0.5, 0.6, 1.2));
  const PlanOutput output = scene.Run(1);
  EXPECT_EQ(Statuses(output.Report), (List{ Met, Conflict, Met }));
  EXPECT_EQ(output.Tracks[0].Positions[60], scene.Constraints[0].Value);
  EXPECT_EQ(output.Tracks[0].Positions[150], scene.Constraints[2].Value);
  EXPECT_EQ(output.Constraints[1].Status, Conflict);
}

TEST(RowConflicts, OfThousandsAtOneFrameOneIsKept)
{
  PlanScene scene;
  scene.AddObject(Vec3(0, 0, 2));
  constexpr int count = 4000;
  for (int i = 0; i < count; ++i)
  {
    scene.AddRow(ConstraintKind::Position, 0, 100, Vec3(-1.5 + 3.0 * i / count, 0, 2));
  }
  const std::vector<ReportRow> report = Judged(scene);
  EXPECT_EQ(report[0].Status, Met);
  for (int i = 1; i < count; ++i)
  {
    EXPECT_EQ(report[i].Status, Conflict);
    EXPECT_NE(report[i].Message.find("contradicts row 0 target 0"), std::string::npos);
  }
}

TEST(RowConflicts, ThousandsThatAreEqualAreAllKept)
{
  PlanScene scene;
  scene.AddObject(Vec3(0, 0, 2));
  for (int i = 0; i < 4000; ++i)
  {
    scene.AddRow(ConstraintKind::Position, 0, 100, Vec3(0.5, 0, 2));
  }
  scene.AddRow(ConstraintKind::Position, 0, 100, Vec3(-0.5, 0, 2));
  const std::vector<ReportRow> report = Judged(scene);
  EXPECT_TRUE(std::all_of(report.begin(), report.end() - 1,
                          [](const ReportRow& line) { return line.Status == Met; }));
  EXPECT_EQ(report.back().Status, Conflict);
  EXPECT_NE(report.back().Message.find("row 3 target 0 (position at frame 100): 1 m apart"),
            std::string::npos)
    << report.back().Message;
}
