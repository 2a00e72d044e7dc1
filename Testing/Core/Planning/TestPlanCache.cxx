// SPDX-License-Identifier: BSD-3-Clause
// A change plans only the objects anew that it touches, to the same bytes as a plan of all.
#include "PlanScenes.h"
#include "Planning/PlanCache.h"
#include "Planning/Takes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

using namespace waft;
using namespace waft::test;

namespace
{

// All that a plan gives but its seconds, digit for digit.
std::string TextOf(const PlanOutput& plan)
{
  std::ostringstream text;
  text.precision(17);
  const auto point = [&](const Vec3& x) { text << x.x() << ' ' << x.y() << ' ' << x.z() << '\n'; };
  for (const Track& track : plan.Tracks)
  {
    text << "track " << track.ObjectId << '\n';
    for (std::size_t k = 0; k < track.Positions.size(); ++k)
    {
      point(track.Positions[k]);
      point(track.VortexAccelerations[k]);
      point(track.WindAccelerations[k]);
      text << static_cast<int>(track.ForceTypes[k]) << ' ' << track.VortexIds[k] << '\n';
    }
  }
  for (const TreeBranch& branch : plan.Trees)
  {
    text << "branch " << branch.ObjectId << ' ' << branch.Span << ' ' << branch.Tree << ' '
         << branch.Parent << ' ' << branch.Segment << ' ' << branch.Cost << ' ' << branch.Frame
         << '\n';
    for (const Vec3& x : branch.Points)
    {
      point(x);
    }
  }
  for (const ReportRow& line : plan.Report)
  {
    text << "line " << line.Row << ' ' << line.Target << ' ' << line.ObjectId << ' ' << line.Frame
         << ' ' << line.Residual << ' ' << ToString(line.Status) << ' ' << line.Message << '\n';
  }
  for (const Constraint& row : plan.Constraints)
  {
    text << "row " << row.Row << ' ' << row.ObjectId << ' ' << ToString(row.Status) << '\n';
  }
  for (const Vortex& vortex : plan.Vortices)
  {
    text << "vortex " << vortex.VortexId << ' ' << vortex.CenterTime << '\n';
    point(vortex.P1);
    point(vortex.P2);
  }
  for (const FlightRow& flight : plan.Flights)
  {
    text << "flight " << flight.ObjectId << ' ' << flight.Row << ' ' << flight.Target << ' '
         << flight.Frame << ' ' << flight.IsReached << ' ' << flight.RetimingFactor << ' '
         << flight.Cost << ' ' << flight.NumberOfBranches << '\n';
  }
  for (const ObjectRow& own : plan.Objects)
  {
    text << "object " << own.ObjectId << ' ' << own.NumberOfRows << ' ' << own.NumberOfMet << ' '
         << ToString(own.Status) << ' ' << own.Cost << ' ' << own.NumberOfBranches << ' '
         << own.Message << '\n';
  }
  return text.str();
}

struct Remembered
{
  PlanScene Scene;
  PlanOptions Options;
  PlanCache Memory;

  Remembered()
  {
    for (int i = 0; i < 6; ++i)
    {
      this->Scene.AddObject(Vec3(-1.2 + 0.4 * i, -0.8, 2.4));
    }
    this->Scene.AddBox(Vec3(-0.2, -0.3, 0.0), Vec3(0.2, 0.3, 1.8));
    for (int i = 0; i < 4; ++i)
    {
      this->Scene.AddRow(ConstraintKind::Position, i, 150, Vec3(-1.0 + 0.5 * i, 0.8, 2.0));
    }
    for (int i = 0; i < 2; ++i)
    {
      Constraint& any =
        this->Scene.AddRow(ConstraintKind::Position, -1, 250, Vec3(-0.9 + 2.1 * i, 0.5, 2.2));
      any.Group = 9;
    }
    this->Scene.Scene.Time.NumberOfFrames = 280;
  }

  PlanOutput Run(PlanCache* memory)
  {
    PlanScene::Check(this->Scene.Obstacles.Build(this->Scene.Meshes));
    const PlanInput input{ SwirlDatabase(),       this->Scene.Objects, this->Scene.Constraints,
                           this->Scene.Obstacles, this->Scene.Scene,   this->Scene.Guides };
    PlanOutput output;
    SilentMonitor monitor;
    PlanScene::Check(PlanMotion(input, this->Options, SerialFor(), monitor, output, memory));
    return output;
  }

  /// How many objects are planned now; what comes out equals a plan without memory.
  int PlansAnew()
  {
    const PlanOutput plan = this->Run(&this->Memory);
    EXPECT_EQ(TextOf(plan), TextOf(this->Run(nullptr)));
    return static_cast<int>(std::count_if(plan.Objects.begin(), plan.Objects.end(),
                                          [](const ObjectRow& own) { return own.IsPlanned; }));
  }
};

} // namespace

TEST(PlanCache, PlansOnlyWhatAChangeTouchesToTheSameBytes)
{
  Remembered r;
  EXPECT_EQ(r.PlansAnew(), 6);
  EXPECT_EQ(r.PlansAnew(), 0) << "nothing changed";
  r.Scene.Constraints[1].Value.z() += 0.1;
  EXPECT_EQ(r.PlansAnew(), 1) << "a row of one object";
  r.Scene.Objects[2].SettlingSpeed = 0.5;
  EXPECT_EQ(r.PlansAnew(), 1) << "an object";
  r.Scene.Guides.push_back({ 3, { Vec3(0.0, -0.8, 2.4), Vec3(0.9, 0.2, 2.6), Vec3(0.5, 0.8, 2) } });
  EXPECT_EQ(r.PlansAnew(), 1) << "a guide";
  r.Scene.Objects.push_back(r.Scene.Objects[5]);
  r.Scene.Objects[6].ObjectId = 6;
  r.Scene.Objects[6].Position = Vec3(0.0, -1.4, 1.0);
  EXPECT_EQ(r.PlansAnew(), 1) << "one more object, that no row names";
}

TEST(PlanCache, RowsOfOthersMayComeAndGo)
{
  Remembered r;
  EXPECT_EQ(r.PlansAnew(), 6);
  // A row in front of all others shifts their indices and numbers.
  Constraint row;
  row.ObjectId = 5;
  row.Frame = row.Until = 90;
  row.Value = Vec3(1.3, 0.1, 2.3);
  r.Scene.Constraints.insert(r.Scene.Constraints.begin(), row);
  for (std::size_t i = 0; i < r.Scene.Constraints.size(); ++i)
  {
    r.Scene.Constraints[i].Row = static_cast<int>(i);
  }
  EXPECT_LE(r.PlansAnew(), 2) << "its own, and one that may take another target of the group";
  r.Scene.Constraints.pop_back();
  EXPECT_LE(r.PlansAnew(), 2);
}

TEST(PlanCache, RowsForAnyAreAssignedOverAllAgain)
{
  Remembered r;
  EXPECT_EQ(r.PlansAnew(), 6);
  const PlanOutput before = r.Run(&r.Memory);
  // The two targets for any trade places: whoever takes another one is planned again, nobody else.
  std::swap(r.Scene.Constraints[4].Value, r.Scene.Constraints[5].Value);
  const PlanOutput after = r.Run(&r.Memory);
  EXPECT_EQ(TextOf(after), TextOf(r.Run(nullptr)));
  int changed = 0;
  for (std::size_t i = 0; i < after.Objects.size(); ++i)
  {
    EXPECT_FALSE(!after.Objects[i].IsPlanned &&
                 after.Tracks[i].Positions != before.Tracks[i].Positions);
    changed += after.Objects[i].IsPlanned;
  }
  EXPECT_LE(changed, 2);
}

TEST(PlanCache, WhatAllShareIsPlannedForAll)
{
  Remembered r;
  EXPECT_EQ(r.PlansAnew(), 6);
  r.Scene.Meshes[1].Mesh.Points[3].z() += 1e-9;
  EXPECT_EQ(r.PlansAnew(), 6) << "an obstacle";
  r.Options.NumberOfCandidates = 8;
  EXPECT_EQ(r.PlansAnew(), 6) << "an option";
  r.Scene.Scene.Bounds.Max.z() += 0.5;
  EXPECT_EQ(r.PlansAnew(), 6) << "the volume";
  r.Options.Seed = 4;
  EXPECT_EQ(r.PlansAnew(), 6) << "the seed";
  r.Options.Seed = 1;
  EXPECT_EQ(r.PlansAnew(), 0) << "a seed that was planned before";
}

TEST(PlanCache, EveryTakeIsRemembered)
{
  Remembered r;
  PlanScene::Check(r.Scene.Obstacles.Build(r.Scene.Meshes));
  const auto run = [&](PlanCache* memory, std::vector<TakeScore>& scores)
  {
    const PlanInput input{ SwirlDatabase(),   r.Scene.Objects, r.Scene.Constraints,
                           r.Scene.Obstacles, r.Scene.Scene,   r.Scene.Guides };
    PlanOutput output;
    SilentMonitor monitor;
    PlanScene::Check(
      PlanTakes(input, r.Options, { 3, -1 }, SerialFor(), monitor, output, scores, memory));
    return output;
  };
  std::vector<TakeScore> scores, again, alone;
  (void)run(&r.Memory, scores);
  EXPECT_EQ(r.Memory.Size(), 18u);
  r.Scene.Constraints[0].Value.x() += 0.1;
  const PlanOutput plan = run(&r.Memory, again);
  EXPECT_EQ(TextOf(plan), TextOf(run(nullptr, alone)));
  EXPECT_EQ(std::count_if(plan.Objects.begin(), plan.Objects.end(),
                          [](const ObjectRow& own) { return own.IsPlanned; }),
            1);
  for (std::size_t k = 0; k < 3; ++k)
  {
    EXPECT_EQ(again[k].Score, alone[k].Score);
  }
}

TEST(PlanCache, TreesThatThereWasNoRoomForAreGrownWhereThereIs)
{
  Remembered all;
  all.Options.MaximumNumberOfStoredBranches = 40;
  const PlanOutput before = all.Run(&all.Memory);
  EXPECT_EQ(before.Trees.size(), 40u);
  EXPECT_EQ(TextOf(before), TextOf(all.Run(nullptr)));
  // The last ones come first now, without the trees that they had.
  std::reverse(all.Scene.Objects.begin(), all.Scene.Objects.end());
  const PlanOutput after = all.Run(&all.Memory);
  EXPECT_NE(after.Trees.front().ObjectId, before.Trees.front().ObjectId);
  EXPECT_EQ(TextOf(after), TextOf(all.Run(nullptr)));
}

TEST(PlanCache, KeepsToItsLimit)
{
  Remembered r;
  r.Memory = PlanCache(60000);
  EXPECT_EQ(r.PlansAnew(), 6);
  EXPECT_LE(r.Memory.Bytes(), 60000u);
  EXPECT_GT(r.Memory.Size(), 0u);
  EXPECT_LT(r.Memory.Size(), 6u);
  EXPECT_GT(r.PlansAnew(), 0);
}
