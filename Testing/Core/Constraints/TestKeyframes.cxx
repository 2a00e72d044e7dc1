// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/Keyframes.h"

#include <gtest/gtest.h>

using namespace waft;

namespace
{

MotionObject ObjectAt(int id, const Vec3& position, int classId = -1)
{
  MotionObject object;
  object.ObjectId = id;
  object.Position = position;
  object.ClassId = classId;
  return object;
}

Constraint AnyAt(int row, int target, int frame, const Vec3& value, int group)
{
  Constraint constraint;
  constraint.Row = row;
  constraint.Target = target;
  constraint.Frame = frame;
  constraint.Value = value;
  constraint.Group = group;
  return constraint;
}

} // namespace

TEST(AssignKeyframes, StartsEachKeyframeFromThePlacesOfTheOneBefore)
{
  const std::vector<MotionObject> objects{ ObjectAt(0, Vec3(0, 0, 0)), ObjectAt(1, Vec3(1, 0, 0)) };
  // Listed in the wrong order of time: the second keyframe is decided from the first one's places.
  std::vector<Constraint> rows{ AnyAt(0, 0, 50, Vec3(0, 9, 0), 1),
                                AnyAt(0, 1, 50, Vec3(5, 9, 0), 1),
                                AnyAt(1, 0, 20, Vec3(5, 0, 0), 0),
                                AnyAt(1, 1, 20, Vec3(-5, 0, 0), 0) };
  AssignKeyframes(objects, rows);
  EXPECT_EQ(rows[2].ObjectId, 1);
  EXPECT_EQ(rows[3].ObjectId, 0);
  EXPECT_EQ(rows[0].ObjectId, 0);
  EXPECT_EQ(rows[1].ObjectId, 1);
}

TEST(AssignKeyframes, KeepsClassesNamedObjectsAndTargetsTogether)
{
  const std::vector<MotionObject> objects{ ObjectAt(7, Vec3(0, 0, 0), 1),
                                           ObjectAt(8, Vec3(1, 0, 0), 2),
                                           ObjectAt(9, Vec3(2, 0, 0), 2) };
  std::vector<Constraint> rows{ AnyAt(0, 0, 10, Vec3(0, 0, 0), 3),
                                AnyAt(0, 0, 10, Vec3(0, 0, 1), 3),
                                AnyAt(0, 1, 10, Vec3(1, 0, 0), 3),
                                AnyAt(0, 2, 10, Vec3(2, 0, 0), 3) };
  rows[0].ClassId = 2;
  rows[1].Kind = ConstraintKind::Velocity;
  rows[2].ObjectId = 8; // named, so the open target of class 2 goes to 9
  AssignKeyframes(objects, rows);
  EXPECT_EQ(rows[0].ObjectId, 9);
  EXPECT_EQ(rows[1].ObjectId, 9);
  EXPECT_EQ(rows[2].ObjectId, 8);
  EXPECT_EQ(rows[3].ObjectId, 7);
}

TEST(AssignKeyframes, LeavesTargetsOverThatNobodyCanTake)
{
  const std::vector<MotionObject> objects{ ObjectAt(0, Vec3::Zero()) };
  std::vector<Constraint> rows{ AnyAt(0, 0, 10, Vec3(2, 0, 0), 0),
                                AnyAt(0, 1, 10, Vec3(1, 0, 0), 0) };
  AssignKeyframes(objects, rows);
  EXPECT_EQ(rows[0].ObjectId, -1);
  EXPECT_EQ(rows[1].ObjectId, 0);
}

TEST(AssignKeyframes, ChooseAmongTheObjectsThatAreAllowed)
{
  const std::vector<MotionObject> objects{ ObjectAt(0, Vec3(0, 0, 0)), ObjectAt(1, Vec3(1, 0, 0)),
                                           ObjectAt(2, Vec3(2, 0, 0)) };
  // The keyframe of all, listed last, takes 2 to where 0 was; the one of two goes on from there.
  std::vector<Constraint> rows{ AnyAt(0, 0, 50, Vec3(0, 0, 0), 0),
                                AnyAt(1, 0, 20, Vec3(0, 0, 0), 1),
                                AnyAt(1, 1, 20, Vec3(-9, 0, 0), 1),
                                AnyAt(1, 2, 20, Vec3(9, 0, 0), 1) };
  AssignKeyframes(objects, rows, { { 0, { 0, 2 } } });
  EXPECT_EQ(rows[1].ObjectId, 1);
  EXPECT_EQ(rows[2].ObjectId, 0);
  EXPECT_EQ(rows[3].ObjectId, 2);
  EXPECT_EQ(rows[0].ObjectId, 0) << "2 is at the same distance and comes later";
}

TEST(AssignKeyframes, TakesWhoIsElsewhereAtTheTimeLast)
{
  const std::vector<MotionObject> objects{ ObjectAt(0, Vec3(0, 0, 0)), ObjectAt(1, Vec3(5, 0, 0)) };
  std::vector<Constraint> rows{ AnyAt(0, 0, 10, Vec3(0, 1, 0), -1),
                                AnyAt(1, 0, 20, Vec3(0, 0, 0), 1),
                                AnyAt(1, 1, 20, Vec3(1, 0, 0), 1) };
  rows[0].ObjectId = 0;
  rows[0].Kind = ConstraintKind::Rest;
  rows[0].Until = 30;
  std::vector<Constraint> one(rows.begin(), rows.begin() + 2);
  AssignKeyframes(objects, one);
  EXPECT_EQ(one[1].ObjectId, 1);
  AssignKeyframes(objects, rows);
  EXPECT_EQ(rows[1].ObjectId + rows[2].ObjectId, 1) << "both are needed";
}

TEST(AssignKeyframes, LeavesSinglePlacesAlone)
{
  const std::vector<MotionObject> objects{ ObjectAt(0, Vec3(0, 0, 0)) };
  std::vector<Constraint> rows{ AnyAt(0, 0, 10, Vec3(0, 1, 0), -1),
                                AnyAt(1, 0, 10, Vec3(0, 1, 0), -1) };
  rows[1].Kind = ConstraintKind::Velocity;
  AssignKeyframes(objects, rows);
  EXPECT_EQ(rows[0].ObjectId, -1);
  EXPECT_EQ(rows[1].ObjectId, 0);
}

TEST(CollectChosen, TellsWhoMayTakeWhat)
{
  const std::vector<MotionObject> objects{ ObjectAt(0, Vec3(0, 0, 0)), ObjectAt(1, Vec3(1, 0, 0)),
                                           ObjectAt(2, Vec3(2, 0, 0)), ObjectAt(3, Vec3(3, 0, 0)),
                                           ObjectAt(4, Vec3(9, 9, 9)) };
  std::vector<Constraint> rows{ AnyAt(0, 0, 50, Vec3(0, 9, 0), 1),
                                AnyAt(0, 1, 50, Vec3(5, 9, 0), 1),
                                AnyAt(1, 0, 20, Vec3(5, 0, 0), 0),
                                AnyAt(1, 1, 20, Vec3(0, 0, 0), 0) };
  rows.push_back(AnyAt(2, 0, 30, Vec3(2, 2, 2), -1)); // somebody's own
  rows.back().ObjectId = 2;
  AssignKeyframes(objects, rows, { { 1, { 0, 1 } } });
  EXPECT_EQ(rows[0].Choice, ObjectChoice::AmongListed);
  EXPECT_EQ(rows[2].Choice, ObjectChoice::AmongAll);
  EXPECT_EQ(rows[4].Choice, ObjectChoice::Given);
  const std::vector<ChosenTargets> groups = CollectChosen(objects, rows, std::vector<char>(5, 1));
  ASSERT_EQ(groups.size(), std::size_t{ 2 });
  EXPECT_EQ(groups[0].Targets.front().Frame, 20);
  EXPECT_EQ(groups[0].Candidates, (std::vector<std::size_t>{ 3, 0, 4 })); // 4 has no place
  EXPECT_EQ(groups[1].Candidates.size(), std::size_t{ 2 });
  std::vector<char> counts(5, 1);
  counts[2] = 0; // a row that cannot be met stays where it is
  EXPECT_EQ(CollectChosen(objects, rows, counts)[0].Targets.size(), std::size_t{ 1 });
}

TEST(AssignKeyframes, WindowsOfAGroupAreOneTime)
{
  // Who has another place in the window of the group is taken last, though not at the frame itself.
  const std::vector<MotionObject> objects{ ObjectAt(0, Vec3(0, 0, 0)), ObjectAt(1, Vec3(9, 0, 0)) };
  std::vector<Constraint> rows{ AnyAt(0, 0, 60, Vec3(0, 1, 0), 0),
                                AnyAt(1, 0, 50, Vec3(0, 0, 2), -1) };
  rows[0].FrameFrom = 40;
  rows[0].IsOpenWindow = true;
  rows[1].ObjectId = 0;
  AssignKeyframes(objects, rows);
  EXPECT_EQ(rows[0].ObjectId, 1);
  rows[0].ObjectId = -1;
  SetArrival(60, rows[0].Value, rows[0]);
  AssignKeyframes(objects, rows);
  EXPECT_EQ(rows[0].ObjectId, 0);
}
