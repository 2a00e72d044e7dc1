// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/Rest.h"

#include "Obstacles/Shapes.h"

#include <gtest/gtest.h>

using namespace waft;
using namespace waft::testing;

namespace
{

/// Ground, and a wedge whose upper face climbs 30 degrees along x.
ObstacleSet Scene()
{
  ObstacleMesh ground, wedge, wall;
  ground.Mesh = MakeBox({ Vec3(-4, -4, -1), Vec3(4, 4, 0) });
  wedge.ObstacleId = 1;
  wedge.Mesh = MakeBox({ Vec3(0, -1, 0), Vec3(1, 1, 1) });
  for (Vec3& p : wedge.Mesh.Points)
  {
    p.z() = p.z() > 0.5 ? 0.2 + p.x() * std::tan(EIGEN_PI / 6.0) : 0.0;
  }
  wall.ObstacleId = 2;
  wall.Mesh = MakeBox({ Vec3(-1.2, -1, 0), Vec3(-1.1, 1, 2) });
  ObstacleSet set;
  const Result result = set.Build({ ground, wedge, wall });
  EXPECT_TRUE(static_cast<bool>(result)) << result.Message();
  return set;
}

Constraint RestRow(const Vec3& value, int frame, int until)
{
  Constraint row;
  row.ObjectId = 5;
  row.Kind = ConstraintKind::Rest;
  row.Value = value;
  row.Frame = frame;
  row.Until = until;
  return row;
}

MotionObject Leaf()
{
  MotionObject leaf;
  leaf.ObjectId = 5;
  leaf.ClearanceRadius = 0.05;
  leaf.RestHeight = 0.01;
  return leaf;
}

} // namespace

TEST(Rest, BodyTouchesTheSlope)
{
  const ObstacleSet set = Scene();
  Vec3 centre;
  SurfaceHit hit;
  ASSERT_TRUE(RestingPosition(set, Vec3(0.4, 0.1, 3.0), 0, 0.02, centre, hit));
  EXPECT_EQ(hit.ObstacleId, 1);
  EXPECT_NEAR(set.SignedDistance(centre, 0), 0.02, 1e-12);
  EXPECT_EQ(centre.x(), 0.4);
  EXPECT_EQ(centre.y(), 0.1);
  ASSERT_TRUE(
    RestingPosition(set, Vec3(2, 2, -0.3), 0, 0.0, centre, hit)); // a target in the ground
  EXPECT_EQ(centre.z(), 0.0);
  EXPECT_FALSE(RestingPosition(set, Vec3(9, 0, 3), 0, 0.02, centre, hit));
}

TEST(Rest, WindowsSpanOneSecondBeforeAndAfter)
{
  const ObstacleSet set = Scene();
  const MotionObject leaf = Leaf();
  std::vector<Constraint> rows{ RestRow(Vec3(2, 2, 1), 100, 120), RestRow(Vec3(0.5, 0, 3), 60, 70),
                                RestRow(Vec3(9, 9, 1), 10, 20) };
  rows.push_back(RestRow(Vec3(1, 1, 1), 5, 6));
  rows.back().ObjectId = 4;
  const auto windows = LandingWindows(leaf, rows, set, 10.0);
  ASSERT_EQ(windows.size(), 2u);
  EXPECT_EQ(windows[0].ObstacleId, 1);
  EXPECT_EQ(windows[0].First, 50.0);
  EXPECT_EQ(windows[0].Last, 80.0);
  EXPECT_EQ(windows[1].ObstacleId, 0);
  EXPECT_EQ(RequiredClearance(leaf, windows, 49.9).Exempt, -1);
  EXPECT_EQ(RequiredClearance(leaf, windows, 50.0).Exempt, 1);
  EXPECT_EQ(RequiredClearance(leaf, windows, 50.0).LandingDistance, 0.01);
  EXPECT_EQ(RequiredClearance(leaf, windows, 85.0).Exempt, -1);
  EXPECT_EQ(RequiredClearance(leaf, windows, 130.0).Exempt, 0);
  EXPECT_EQ(RequiredClearance(leaf, windows, 130.0).Radius, 0.05);
}

TEST(Rest, LandingIsAllowedInItsWindowOnly)
{
  const ObstacleSet set = Scene();
  const MotionObject leaf = Leaf();
  const auto windows = LandingWindows(leaf, { RestRow(Vec3(-0.5, 0, 3), 100, 120) }, set, 10.0);
  ASSERT_EQ(windows.size(), 1u);
  const Vec3 place = windows[0].Centre.Place;
  EXPECT_NEAR(place.z(), 0.01, 1e-15);
  const Vec3 above = place + Vec3(0, 0, 0.03);
  EXPECT_TRUE(IsMotionClear(set, leaf, windows, above, 99, place, 100));
  EXPECT_TRUE(IsMotionClear(set, leaf, windows, place, 100, place, 120));
  EXPECT_FALSE(IsMotionClear(set, leaf, windows, above, 85, above, 89)); // too early
  EXPECT_FALSE(IsMotionClear(set, leaf, windows, above, 85, above, 95)); // begins too early
  EXPECT_FALSE(IsMotionClear(set, leaf, windows, place, 110, place - Vec3(0, 0, 0.001), 111));
  // The wall still counts while the leaf lies on the ground.
  EXPECT_FALSE(IsMotionClear(set, leaf, windows, Vec3(-1.06, 0, 0.01), 110, place, 111));
  EXPECT_TRUE(IsMotionClear(set, leaf, windows, Vec3(-1.04, 0, 0.01), 110, place, 111));
}

/// At the foot of the wedge the ground is nearer than the radius: a body that is to lie there may
/// come as near to it, while it lands and lies.
TEST(Rest, OtherSurfacesGiveWayAsFarAsTheRestItselfLeaves)
{
  const ObstacleSet set = Scene();
  MotionObject leaf = Leaf();
  leaf.ClearanceRadius = 0.4;
  const Constraint row = RestRow(Vec3(0.1, 0.0, 1.0), 60, 80);
  const std::vector<LandingWindow> windows = LandingWindows(leaf, { row }, set, 30.0);
  ASSERT_EQ(windows.size(), 1u);
  ASSERT_EQ(windows[0].ObstacleId, 1);
  const Vec3& rest = windows[0].Centre.Place;
  EXPECT_NEAR(windows[0].Room, rest.z(), 1e-12);
  EXPECT_LT(windows[0].Room, leaf.ClearanceRadius);
  for (const double frame : { 45.0, 60.0, 80.0 })
  {
    EXPECT_TRUE(IsMotionClear(set, leaf, windows, rest, frame, rest, frame)) << frame;
    const Vec3 beside(-0.3, 0.0, 0.5 * rest.z()); // nearer to the ground than it lies
    EXPECT_FALSE(IsMotionClear(set, leaf, windows, beside, frame, beside, frame)) << frame;
  }
  EXPECT_FALSE(IsMotionClear(set, leaf, windows, rest, 10.0, rest, 10.0));
  const std::vector<LandingWindow> level =
    LandingWindows(Leaf(), { RestRow(Vec3(3.0, 0.0, 1.0), 60, 80) }, set, 30.0);
  EXPECT_EQ(RequiredClearance(Leaf(), level, 60.0).Radius, Leaf().ClearanceRadius);
}

TEST(Rest, FloorOfTheVolumeGivesWayToALanding)
{
  const ObstacleSet set = Scene();
  const MotionObject leaf = Leaf();
  const auto windows = LandingWindows(leaf, { RestRow(Vec3(-0.5, 0, 3), 100, 120) }, set, 10.0);
  const Box volume;
  EXPECT_TRUE(KeepsInside(volume, RequiredClearance(leaf, windows, 110), windows[0].Centre.Place));
  EXPECT_FALSE(KeepsInside(volume, RequiredClearance(leaf, windows, 50), windows[0].Centre.Place));
  EXPECT_TRUE(KeepsInside(volume, RequiredClearance(leaf, windows, 50), Vec3(0, 0, 0.05)));
  EXPECT_FALSE(KeepsInside(volume, RequiredClearance(leaf, windows, 50), Vec3(0, 1.96, 1)));
}

/// A tray that moves from frame 40 on, a fifth of a metre a frame along x.
TEST(Rest, GoesAlongWithWhatItLiesOn)
{
  ObstacleMesh tray;
  tray.ObstacleId = 4;
  tray.Mesh = MakeBox({ Vec3(-0.5, -0.5, 0.9), Vec3(0.5, 0.5, 1) });
  for (int f = 0; f < 100; ++f)
  {
    tray.Offsets.emplace_back(0.2 * std::max(0, f - 40), 0.0, 0.0);
  }
  ObstacleSet set;
  ASSERT_TRUE(set.Build({ tray }));
  Constraint row = RestRow(Vec3(2.1, 0.3, 1.5), 50, 60);
  const std::vector<LandingWindow> windows = LandingWindows(Leaf(), { row }, set, 10.0);
  ASSERT_EQ(windows.size(), 1u);
  const auto expectNear = [](const Vec3& a, const Vec3& b) { EXPECT_LT((a - b).norm(), 1e-12); };
  expectNear(windows[0].Centre.At(50), Vec3(2.1, 0.3, 1.01));
  expectNear(windows[0].Centre.At(45), Vec3(1.1, 0.3, 1.01)); // had it touched down by then
  expectNear(windows[0].Point.At(60), Vec3(4.1, 0.3, 1.0));
  expectNear(windows[0].Centre.Velocity(55, 10.0), Vec3(2.0, 0.0, 0.0));
  expectNear(windows[0].Centre.Velocity(30, 10.0), Vec3::Zero());
  CarriedPlace place;
  ASSERT_TRUE(WantedPlace(row, 0.01, set, place));
  expectNear(place.At(60), windows[0].Centre.At(60));
  row.Kind = ConstraintKind::Position;
  ASSERT_TRUE(WantedPlace(row, 0.01, set, place));
  expectNear(place.At(60), row.Value); // it is on nothing
  row.On = 4;
  ASSERT_TRUE(WantedPlace(row, 0.01, set, place));
  expectNear(place.At(60), Vec3(4.1, 0.3, 1.5));
  expectNear(ValueAt(row, 41, set), Vec3(0.3, 0.3, 1.5));
  MotionObject leaf = Leaf();
  leaf.Position = Vec3(0, 0, 2);
  expectNear(StartPlace(leaf, set).At(60), Vec3(0, 0, 2));
  leaf.On = 4;
  expectNear(StartPlace(leaf, set).At(60), Vec3(4, 0, 2));
}

TEST(Rest, TheWayIntoAHollowComesAsNearAsThePlace)
{
  // A gentle slope along x, and a steep one that begins 5 mm beside the place.
  const std::vector<Vec3> outline{ Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(1, 0, 1.2), Vec3(0, 0, 1),
                                   Vec3(-0.1, 0, 2) };
  ObstacleMesh block;
  for (const double y : { -1.0, 1.0 })
  {
    for (const Vec3& p : outline)
    {
      block.Mesh.Points.push_back(p + y * Vec3::UnitY());
    }
  }
  for (int i = 0; i < 5; ++i)
  {
    const int j = (i + 1) % 5;
    block.Mesh.Triangles.push_back({ i, i + 5, j + 5 });
    block.Mesh.Triangles.push_back({ i, j + 5, j });
  }
  for (const auto& [i, j] : { std::pair(4, 0), { 0, 1 }, { 1, 2 } })
  {
    block.Mesh.Triangles.push_back({ 3, i, j });
    block.Mesh.Triangles.push_back({ 8, j + 5, i + 5 });
  }
  ObstacleSet set;
  ASSERT_TRUE(set.Build({ block }));
  const MotionObject leaf = Leaf();
  const auto windows = LandingWindows(leaf, { RestRow(Vec3(0.005, 0, 3), 100, 120) }, set, 10.0);
  ASSERT_EQ(windows.size(), 1u);
  const Vec3 place = windows[0].Centre.Place;
  const double least = set.SignedDistance(place, 0);
  EXPECT_LT(least, 0.8 * leaf.RestHeight);
  EXPECT_NEAR(windows[0].Least, least, 1e-5);
  EXPECT_TRUE(IsMotionClear(set, leaf, windows, place + Vec3(0, 0, 0.2), 98, place, 100));
  EXPECT_FALSE(IsMotionClear(set, leaf, windows, place, 100, place - Vec3(0, 0, 0.002), 101));
}

TEST(Rest, SinksFromItsClearanceAtHalfItsSettlingSpeed)
{
  MotionObject leaf = Leaf();
  leaf.SettlingSpeed = 0.5;
  for (const auto& [radius, frames] : { std::pair(0.02, 6.0), { 0.1, 12.0 }, { 0.4, 30.0 } })
  {
    leaf.ClearanceRadius = radius;
    EXPECT_NEAR(SinkingFrames(leaf, 30.0), frames, 1e-12);
  }
}

TEST(Rest, WhatHangsAtAnObstacleMayLeaveIt)
{
  const ObstacleSet set = Scene();
  MotionObject leaf = Leaf();
  leaf.Position = Vec3(-1.12 + 0.05, 0.0, 1.0); // 3 cm from the wall, 2
  LandingWindow window;
  EXPECT_FALSE(HangingWindow(leaf, set, 10.0, window)); // it flies from the first frame
  leaf.Release = 40;
  ASSERT_TRUE(HangingWindow(leaf, set, 10.0, window));
  EXPECT_EQ(window.ObstacleId, 2);
  EXPECT_EQ(window.Last, 50.0);
  const std::vector<LandingWindow> windows{ window };
  const Vec3 away = leaf.Position + Vec3(0.01, 0.0, 0.0);
  EXPECT_TRUE(IsMotionClear(set, leaf, windows, leaf.Position, 40, away, 41));
  EXPECT_FALSE(IsMotionClear(set, leaf, {}, leaf.Position, 40, away, 41));
  EXPECT_FALSE(IsMotionClear(set, leaf, windows, leaf.Position, 40,
                             leaf.Position - Vec3(0.025, 0.0, 0.0), 41)); // not into it
  EXPECT_FALSE(IsMotionClear(set, leaf, windows, away, 55, away, 56));    // for a second
  leaf.Position.x() += 1.0;
  leaf.Position.z() = 1.5;
  EXPECT_FALSE(HangingWindow(leaf, set, 10.0, window)); // nothing is near
}
