// SPDX-License-Identifier: BSD-3-Clause
#include "Base/ShapeMeasures.h"
#include "Scene/LetterSpacing.h"
#include "TestAssets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

using namespace waft;

namespace
{

const char* const Leaf = R"("shapes": {"leaf": {"builtin": "leaf"}})";

std::string WithObjects(const std::string& objects, const std::string& rest = "")
{
  return std::string(R"({"waft": 1, )") + Leaf + R"(, "objects": )" + objects + rest + "}";
}

} // namespace

TEST(ReadScene, TheSmallestSceneHasThePublishedDefaults)
{
  const Scene scene = Parsed(R"({"waft": 1})");
  EXPECT_EQ(scene.Info.Bounds.Min, Vec3(-2.0, -2.0, 0.0));
  EXPECT_EQ(scene.Info.Bounds.Max, Vec3(2.0, 2.0, 4.0));
  EXPECT_EQ(scene.Info.Time.NumberOfFrames, 300);
  EXPECT_EQ(scene.Info.Time.FramesPerSecond, 30.0);
  EXPECT_EQ(scene.Info.AirDensity, 1.2);
  EXPECT_EQ(scene.Info.Seed, 1u);
  ASSERT_EQ(scene.Obstacles.size(), 1u) << "the ground";
  EXPECT_EQ(scene.GroundId, scene.Obstacles[0].ObstacleId);
  double top = -1e300;
  for (const Vec3& p : scene.Obstacles[0].Mesh.Points)
  {
    top = std::max(top, p.z());
  }
  EXPECT_EQ(top, 0.0);
}

TEST(ReadScene, EveryFieldOfTheGlobalSections)
{
  const Scene scene = Parsed(R"({"waft": 1, "_note": [1, "a comment"], "title": "T", "seed": 42,
    "time": {"frames": 120, "framesPerSecond": 24, "_x": 1},
    "domain": {"min": [-1, -2, -3], "max": [3, 2, 1], "open": ["x"]}, "ground": {"height": -2.5},
    "air": {"density": 1.1, "breeze": [0.4, 0, 0]},
    "winds": [{"direction": [0, 3, 4], "strength": 0.5, "center": [1, 2, 3], "radius": 0.7,
               "centerTime": 1.5, "duration": 2}],
    "vortices": [{"p1": [0, 0, 0], "p2": [0, 0, 2], "strength": -0.4, "centerTime": 3,
                  "duration": 1, "coreRadius": 0.2}]})");
  EXPECT_EQ(scene.Title, "T");
  EXPECT_EQ(scene.Info.Seed, 42u);
  EXPECT_EQ(scene.Info.Time.NumberOfFrames, 120);
  EXPECT_EQ(scene.Info.Time.FramesPerSecond, 24.0);
  EXPECT_EQ(scene.Info.Bounds.Max, Vec3(3.0, 2.0, 1.0));
  EXPECT_EQ(scene.Info.AirDensity, 1.1);
  EXPECT_EQ(scene.Info.Breeze, Vec3(0.4, 0.0, 0.0));
  ASSERT_EQ(scene.Winds.size(), 1u);
  EXPECT_LT((scene.Winds[0].Direction - Vec3(0.0, 0.6, 0.8)).norm(), 1e-15);
  EXPECT_EQ(scene.Winds[0].Radius, 0.7);
  EXPECT_EQ(scene.Winds[0].CenterTime, 1.5);
  ASSERT_EQ(scene.Vortices.size(), 1u);
  EXPECT_EQ(scene.Vortices[0].VortexId, 0);
  EXPECT_EQ(scene.Vortices[0].Strength, -0.4);
  EXPECT_EQ(scene.Vortices[0].CoreRadius, 0.2);
  EXPECT_TRUE(Parsed(R"({"waft": 1, "ground": {"enabled": false}})").Obstacles.empty());
}

TEST(ReadScene, AMissingTextureIsReported)
{
  const Scene scene =
    Parsed(R"({"waft": 1, "shapes": {"leaf": {"builtin": "leaf", "texture": "none.png"}}})");
  ASSERT_EQ(scene.Shapes.size(), 1u);
  EXPECT_EQ(scene.Shapes[0].Texture, "");
  ASSERT_EQ(scene.Warnings.size(), 1u);
  EXPECT_NE(scene.Warnings[0].find("/shapes/leaf/texture"), std::string::npos);
  EXPECT_NE(scene.Warnings[0].find("none.png"), std::string::npos);
}

TEST(ReadScene, ShapesTakeWhatTheFileGives)
{
  const Scene scene = Parsed(R"({"waft": 1, "shapes": {
    "z": {"builtin": "feather", "size": 0.25, "settlingSpeed": 0.35, "class": "white",
          "texture": "LICENSE", "color": [0.1, 0.2, 0.3], "areaDensity": 0.05, "thickness": 0.002,
          "dragCoefficient": 1.4},
    "a": {"mesh": "LICENSE", "size": 0.5, "class": "red"},
    "b": {"builtin": "leaf", "class": "white"}},
    "objects": [{"shape": "a", "position": [0, 0, 1]}, {"shape": "b", "position": [1, 0, 1]}]})");
  ASSERT_EQ(scene.Shapes.size(), 3u);
  EXPECT_EQ(scene.Shapes[0].Name, "z"); // the order of the file
  EXPECT_NEAR(LargestExtent(scene.Shapes[0].Mesh), 0.25, 1e-12);
  EXPECT_EQ(scene.Shapes[0].SettlingSpeed, 0.35);
  EXPECT_EQ(scene.Shapes[0].AreaDensity, 0.05);
  EXPECT_EQ(scene.Shapes[0].Thickness, 0.002);
  EXPECT_EQ(scene.Shapes[0].DragCoefficient, 1.4);
  EXPECT_EQ(scene.Shapes[0].Color[2], 0.3);
  EXPECT_EQ(scene.Shapes[0].Tint, scene.Shapes[0].Color);
  EXPECT_EQ(scene.Shapes[2].Tint, Shape().Tint); // its own colour tints no texture
  const Scene plain =
    Parsed(R"({"waft": 1, "shapes": {"leaf": {"builtin": "leaf", "color": [0.9, 0.1, 0.2]}}})");
  // Without a texture it is the colour, not a filter before that of the built-in one.
  EXPECT_EQ(plain.Shapes[0].Color, (std::array<double, 3>{ 0.9, 0.1, 0.2 }));
  EXPECT_NE(scene.Shapes[2].Color, Shape().Color);
  EXPECT_NE(scene.Shapes[0].Texture.find("/LICENSE"), std::string::npos);
  EXPECT_NEAR(LargestExtent(scene.Shapes[1].Mesh), 0.5, 1e-12);
  EXPECT_EQ(scene.Classes, (std::vector<std::string>{ "white", "red" }));
  EXPECT_EQ(scene.Objects[0].ShapeId, 1);
  EXPECT_EQ(scene.Objects[0].ClassId, 1);
  EXPECT_EQ(scene.Objects[1].ClassId, 0);
  EXPECT_EQ(scene.Objects[1].SettlingSpeed, 0.8);
  EXPECT_EQ(scene.Objects[1].Mass, ShellMass(scene.Shapes[2]));
  EXPECT_EQ(scene.Objects[1].RestHeight, RestHeight(scene.Shapes[2]));
  EXPECT_NEAR(scene.Objects[1].ClearanceRadius, 0.05, 1e-12);
}

TEST(ReadScene, ObjectsAreNumberedAlongTheExpandedList)
{
  const Scene scene = Parsed(WithObjects(R"([
    {"shape": "leaf", "position": [0, 0, 3], "velocity": [1, 0, 0], "orientation": [0, 2, 0, 0],
     "angularVelocity": [0, 0, 5], "mass": 0.004},
    {"shape": "leaf", "positions": [[1, 0, 3], [1, 1, 3]]},
    {"shape": "leaf", "count": 5, "region": {"min": [-2, -2, 1], "max": [2, 2, 3.9]}, "seed": 9}])"));
  ASSERT_EQ(scene.Objects.size(), 8u);
  for (int id = 0; id < 8; ++id)
  {
    EXPECT_EQ(scene.Objects[id].ObjectId, id);
  }
  EXPECT_EQ(scene.Objects[0].Mass, 0.004);
  EXPECT_EQ(scene.Objects[0].Orientation.x(), 1.0);
  EXPECT_EQ(scene.Objects[0].AngularVelocity.z(), 5.0);
  EXPECT_EQ(scene.Objects[2].Position, Vec3(1.0, 1.0, 3.0));
}

TEST(ReadScene, RegionsAreClearOfWallsObstaclesAndOtherObjects)
{
  const Scene scene = Parsed(WithObjects(R"([
    {"shape": "leaf", "position": [1, 1, 1]},
    {"shape": "leaf", "count": 40, "region": {"min": [0, 0, -1], "max": [3, 3, 2]}}])",
                                         R"(, "obstacles": [{"kind": "box", "min": [0, 0, 0],
    "max": [1.5, 0.8, 2]}, {"kind": "sphere", "center": [1, 1.5, 1], "radius": 0.3}])"));
  ASSERT_EQ(scene.Objects.size(), 41u);
  for (const MotionObject& object : scene.Objects)
  {
    const Vec3& x = object.Position;
    EXPECT_GE(scene.Info.Bounds.InnerDistance(x), 0.05);
    EXPECT_FALSE(x.x() < 1.55 && x.y() < 0.85 && x.x() < 1.5 && x.y() < 0.8);
    EXPECT_GE((x - Vec3(1.0, 1.5, 1.0)).norm(), 0.345);
    for (const MotionObject& other : scene.Objects)
    {
      EXPECT_TRUE(other.ObjectId == object.ObjectId || (x - other.Position).norm() >= 0.1);
    }
  }
  EXPECT_TRUE(scene.Warnings.empty());
  const Scene crowded = Parsed(WithObjects(
    R"([{"shape": "leaf", "count": 60, "region": {"min": [0, 0, 1], "max": [0.3, 0.3, 1.3]}}])"));
  EXPECT_EQ(crowded.Objects.size(), 60u);
  EXPECT_EQ(crowded.Warnings.size(), 1u);
}

TEST(ReadScene, SimpleConstraintsAreOneRowEach)
{
  const Scene scene =
    Parsed(WithObjects(R"([{"shape": "leaf", "positions": [[0, 0, 3], [1, 0, 3]]}])",
                       R"(, "constraints": [
    {"kind": "position", "object": 1, "frame": 100, "value": [1, 2, 3], "radius": 0.05},
    {"kind": "rest", "object": -1, "frame": 200, "value": [1, 1, 1]},
    {"kind": "rest", "object": 0, "frame": 150, "until": 160, "value": [1, 1, 1]},
    {"kind": "velocity", "object": 0, "frame": 5, "value": [0, 0, -1], "radius": 0.1},
    {"kind": "acceleration", "object": 0, "frame": 6, "value": [0, 0, -2]},
    {"kind": "orientation", "object": 0, "frame": 7, "value": [2, 0, 0, 0], "radius": 0.2}])"));
  ASSERT_EQ(scene.Constraints.size(), 6u);
  for (int row = 0; row < 6; ++row)
  {
    EXPECT_EQ(scene.Constraints[row].Row, row);
    EXPECT_EQ(scene.Constraints[row].Target, 0);
    EXPECT_EQ(scene.Constraints[row].Group, -1);
  }
  EXPECT_EQ(scene.Constraints[0].Kind, ConstraintKind::Position);
  EXPECT_EQ(scene.Constraints[0].ObjectId, 1);
  EXPECT_EQ(scene.Constraints[0].Radius, 0.05);
  EXPECT_EQ(scene.Constraints[1].Kind, ConstraintKind::Rest);
  EXPECT_EQ(scene.Constraints[1].ObjectId, -1);
  EXPECT_EQ(scene.Constraints[1].Until, 299);
  EXPECT_EQ(scene.Constraints[2].Until, 160);
  EXPECT_EQ(scene.Constraints[3].Kind, ConstraintKind::Velocity);
  EXPECT_EQ(scene.Constraints[4].Kind, ConstraintKind::Acceleration);
  EXPECT_EQ(scene.Constraints[5].Kind, ConstraintKind::Orientation);
  EXPECT_EQ(scene.Constraints[5].Orientation.w(), 1.0);
}

TEST(ReadScene, APathIsOneRowAFrame)
{
  const Scene scene = Parsed(WithObjects(R"([{"shape": "leaf", "position": [0, 0, 3]}])",
                                         R"(, "constraints": [{"kind": "path", "object": 0,
    "firstFrame": 297, "points": [[0, 0, 1], [0, 1, 1], [0, 2, 1]], "radius": 0.01}])"));
  ASSERT_EQ(scene.Constraints.size(), 3u);
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_EQ(scene.Constraints[i].Frame, 297 + i);
    EXPECT_EQ(scene.Constraints[i].Row, 0);
    EXPECT_EQ(scene.Constraints[i].Target, 0);
    EXPECT_EQ(scene.Constraints[i].Value.y(), i);
    EXPECT_EQ(scene.Constraints[i].Radius, 0.01);
  }
}

TEST(ReadScene, KeyframesBecomeGroups)
{
  const std::string objects =
    R"([{"shape": "leaf", "positions": [[0, 0, 3], [1, 0, 3], [-1, 0, 3]]}])";
  const auto keyframe = [&](const std::string& fields)
  {
    return Parsed(WithObjects(objects, R"(, "constraints": [{"kind": "keyframe", "frame": 200, )" +
                                         fields + "}]"));
  };
  const std::string three = R"("targets": {"points": [[1, 1, 0], [0, 1, 0], [-1, 1, 0]]})";

  Scene scene = keyframe(three + R"(, "velocity": "rest", "until": 250)");
  ASSERT_EQ(scene.Constraints.size(), 3u);
  for (int t = 0; t < 3; ++t)
  {
    EXPECT_EQ(scene.Constraints[t].Kind, ConstraintKind::Rest);
    EXPECT_EQ(scene.Constraints[t].Until, 250);
    EXPECT_EQ(scene.Constraints[t].ObjectId, -1);
    EXPECT_EQ(scene.Constraints[t].Target, t);
    EXPECT_EQ(scene.Constraints[t].Group, 0);
  }
  scene = keyframe(three + R"(, "velocity": [0, 0, -0.5], "radius": 0.1)");
  ASSERT_EQ(scene.Constraints.size(), 6u);
  EXPECT_EQ(scene.Constraints[2].Kind, ConstraintKind::Position);
  EXPECT_EQ(scene.Constraints[2].Radius, 0.1);
  EXPECT_EQ(scene.Constraints[3].Kind, ConstraintKind::Velocity);
  EXPECT_EQ(scene.Constraints[3].Target, scene.Constraints[2].Target);
  EXPECT_EQ(scene.Constraints[3].Radius, 0.0);

  scene = keyframe(three + R"(, "assign": "inOrder", "objects": [2, 0, 1])");
  EXPECT_EQ(scene.Constraints[0].ObjectId, 2);
  EXPECT_EQ(scene.Constraints[1].ObjectId, 0);
  EXPECT_EQ(scene.Constraints[2].ObjectId, 1);

  // A choice among some objects is made at once, by least total squared distance.
  scene = keyframe(R"("targets": {"points": [[-1, 1, 0], [1, 1, 0]]}, "objects": [1, 2])");
  EXPECT_EQ(scene.Constraints[0].ObjectId, 2);
  EXPECT_EQ(scene.Constraints[1].ObjectId, 1);

  scene = keyframe(three);
  EXPECT_EQ(scene.Constraints[0].Kind, ConstraintKind::Position);
}

TEST(ReadScene, WindowsAreOpenOrSpreadInOrder)
{
  const std::string objects =
    R"([{"shape": "leaf", "positions": [[0, 0, 3], [1, 0, 3], [-1, 0, 3], [0, 1, 3]]}])";
  const auto frames = [&](const std::string& fields)
  {
    const Scene scene = Parsed(
      WithObjects(objects,
                  R"(, "constraints": [{"kind": "keyframe", "frame": {"from": 100, "to": 160},
           "targets": {"points": [[1, 0, 0], [0, 1, 2], [-1, 0, 1], [0, 0, 4]]})" +
                    fields + "}]"));
    std::vector<int> found;
    for (const Constraint& row : scene.Constraints)
    {
      EXPECT_EQ(row.FrameFrom, 100);
      EXPECT_EQ(row.IsOpenWindow, fields.find("order") == std::string::npos);
      if (IsPositional(row.Kind))
      {
        found.push_back(row.Frame);
      }
    }
    return found;
  };
  using Frames = std::vector<int>;
  EXPECT_EQ(frames(""), (Frames{ 160, 160, 160, 160 })) << "open: till the air decides";
  EXPECT_EQ(frames(R"(, "order": "left-to-right")"), (Frames{ 160, 120, 100, 140 }));
  EXPECT_EQ(frames(R"(, "order": "right-to-left")"), (Frames{ 100, 120, 160, 140 }));
  EXPECT_EQ(frames(R"(, "order": "bottom-up")"), (Frames{ 100, 140, 120, 160 }));
  EXPECT_EQ(frames(R"(, "order": "top-down")"), (Frames{ 160, 120, 140, 100 }));
  EXPECT_EQ(frames(R"(, "order": {"direction": [0, 2, 0.1]})"), (Frames{ 100, 160, 120, 140 }));
  EXPECT_EQ(frames(R"(, "order": [3, 0, 0, 1])"), (Frames{ 160, 100, 100, 120 }));
  EXPECT_EQ(frames(R"(, "order": "left-to-right", "spread": "ease-in")"),
            (Frames{ 160, 107, 100, 127 }));
  // From the middle (0, 0.25, 1.75): 2.03, 0.79, 1.27 and 2.26 m
  EXPECT_EQ(frames(R"(, "order": "outward")"), (Frames{ 140, 100, 120, 160 }));
  EXPECT_EQ(frames(R"(, "order": "inward")"), (Frames{ 120, 160, 140, 100 }));
  Frames random = frames(R"(, "order": "random")");
  EXPECT_EQ(random, frames(R"(, "order": "random")"));
  std::sort(random.begin(), random.end());
  EXPECT_EQ(random, (Frames{ 100, 120, 140, 160 }));

  // The velocity of a target goes with it; so does what the body faces.
  const Scene moving = Parsed(WithObjects(
    objects, R"(, "constraints": [{"kind": "keyframe", "frame": {"from": 100, "to": 160},
      "order": "left-to-right", "velocity": [0, 0, -1],
      "targets": {"points": [[1, 0, 1], [0, 0, 1]]}}])"));
  ASSERT_EQ(moving.Constraints.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i)
  {
    EXPECT_EQ(moving.Constraints[i].Frame, i < 2 ? 160 : 100);
    EXPECT_EQ(moving.Constraints[i].Until, moving.Constraints[i].Frame);
  }
  // A rest lasts as ever; points on a floor are seen from above.
  const Scene lying = Parsed(WithObjects(
    objects, R"(, "constraints": [{"kind": "keyframe", "frame": {"from": 100, "to": 160},
      "order": "top-down", "velocity": "rest", "until": 200,
      "targets": {"points": [[0, -1, 1], [0, 1, 1]]}},
      {"kind": "rest", "object": 3, "frame": {"from": 20, "to": 40}, "value": [0, 0, 1],
       "until": 70},
      {"kind": "position", "object": 3, "frame": {"from": 90, "to": 90}, "value": [0, 0, 1]}])"));
  EXPECT_EQ(lying.Constraints[0].Frame, 160);
  EXPECT_EQ(lying.Constraints[1].Frame, 100);
  EXPECT_EQ(lying.Constraints[0].Until, 200);
  EXPECT_TRUE(lying.Constraints[2].IsOpenWindow);
  EXPECT_EQ(lying.Constraints[2].Until, 70);
  EXPECT_FALSE(lying.Constraints[3].IsOpenWindow) << "one frame leaves no choice";
}

TEST(ReadScene, ObjectsAreReleasedAtFramesOfTheirOwn)
{
  const auto releases = [](const std::string& fields)
  {
    const Scene scene = Parsed(WithObjects(
      R"([{"shape": "leaf", "positions": [[1, 0, 3], [0, 0, 3.5], [-1, 0, 2], [0.5, 1, 3]])" +
        fields + "}]",
      R"(, "constraints": [{"kind": "position", "object": 2, "frame": 200, "value": [0, 0, 1]}])"));
    std::vector<int> found;
    for (const MotionObject& object : scene.Objects)
    {
      found.push_back(object.Release);
    }
    EXPECT_EQ(scene.Constraints[0].Release, found[2]) << "rows have it of their object";
    return found;
  };
  using Frames = std::vector<int>;
  EXPECT_EQ(releases(""), (Frames{ -1, -1, -1, -1 }));
  EXPECT_EQ(releases(R"(, "release": 0)"), (Frames{ -1, -1, -1, -1 }));
  EXPECT_EQ(releases(R"(, "release": 40)"), (Frames{ 40, 40, 40, 40 }));
  EXPECT_EQ(releases(R"(, "release": {"from": 0, "to": 90}, "order": "left-to-right")"),
            (Frames{ 90, 30, 0, 60 }));
  EXPECT_EQ(releases(R"(, "release": {"from": 10, "to": 100}, "order": "top-down",
                       "spread": "ease-in")"),
            (Frames{ 20, 10, 100, 50 }));
  EXPECT_EQ(releases(R"(, "release": {"from": 10, "rate": 2}, "order": [0, 1, 2, 3])"),
            (Frames{ 10, 25, 40, 55 }))
    << "two a second at 30 frames a second";
  Frames random = releases(R"(, "release": {"from": 10, "to": 100})");
  EXPECT_EQ(random, releases(R"(, "release": {"from": 10, "to": 100}, "order": "random")"));
  std::sort(random.begin(), random.end());
  EXPECT_EQ(random, (Frames{ 10, 40, 70, 100 }));
}

TEST(ReadScene, LettersWordsAndLinesOfADrawnText)
{
  // "AB C" above "D": bars of 4 by 8 pixels, C behind a wider gap; B is in two parts above each
  // other.
  Picture drawn;
  drawn.Width = 40;
  drawn.Height = 30;
  drawn.Pixels.assign(1200, { 0.f, 0.f, 0.f, 0.f });
  const auto bar = [&](int left, int low, int high)
  {
    for (int y = low; y < high; ++y)
    {
      for (int x = left; x < left + 4; ++x)
      {
        drawn.Pixels[static_cast<std::size_t>(y * 40 + x)][3] = 1.f;
      }
    }
  };
  bar(2, 18, 28);  // A
  bar(9, 18, 23);  // B
  bar(9, 25, 28);  // and what is above it
  bar(26, 18, 28); // C
  bar(12, 2, 12);  // D
  const std::vector<TextPlace> places =
    PlacesInText(drawn, "AB C\nD", { { 3, 20 }, { 10, 19 }, { 10, 27 }, { 31, 29 }, { 13, 1 } });
  const int expected[][3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 0, 0 }, { 2, 1, 0 }, { 3, 2, 1 } };
  ASSERT_EQ(places.size(), 5u);
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    EXPECT_EQ(places[i].Letter, expected[i][0]) << i;
    EXPECT_EQ(places[i].Word, expected[i][1]) << i;
    EXPECT_EQ(places[i].Line, expected[i][2]) << i;
  }
}

TEST(ReadScene, TextImageAndMeshTargets)
{
  const std::string objects = R"([{"shape": "leaf", "count": 20,
    "region": {"min": [-2, -2, 1], "max": [2, 2, 4]}}])";
  const auto targets = [&](const std::string& fields)
  {
    return Parsed(WithObjects(objects, R"(, "constraints": [{"kind": "keyframe", "frame": 9,
      "targets": {)" + fields + "}}]"))
      .Constraints;
  };
  // The letter L of the test's font, 0.6 by 1.
  auto rows = targets(
    R"("text": "L", "origin": [0.5, 0, 0.2], "u": [0, 1, 0], "v": [0, 0, 1], "width": 1.2)");
  ASSERT_EQ(rows.size(), 20u) << "the number of objects";
  for (const Constraint& row : rows)
  {
    EXPECT_EQ(row.Value.x(), 0.5);
    EXPECT_LE(std::abs(row.Value.y()), 0.6);
    EXPECT_LE(std::abs(row.Value.z() - 0.2), 1.0);
    EXPECT_TRUE(row.Value.y() < -0.4 + 1e-9 || row.Value.z() < -0.6 + 1e-9) << row.Value;
  }
  rows = targets(R"("text": "L", "origin": [0, 0, 0], "width": 1, "count": 7)");
  EXPECT_EQ(rows.size(), 7u);
  rows = targets(R"("image": "LICENSE", "origin": [0, 0, 0], "width": 2)");
  EXPECT_EQ(rows.size(), 20u);
  rows = targets(R"("mesh": "LICENSE", "origin": [1, 0, 2], "width": 0.4)");
  ASSERT_EQ(rows.size(), 20u);
  for (const Constraint& row : rows)
  {
    EXPECT_NEAR((row.Value - Vec3(1.0, 0.0, 2.0)).cwiseAbs().maxCoeff(), 0.2, 1e-12);
  }
}

TEST(ReadScene, ImageClassesSendShapesToTheirColours)
{
  const Scene scene = Parsed(R"({"waft": 1,
    "shapes": {"r": {"builtin": "maple", "class": "red"}, "b": {"builtin": "oak", "class": "blue"},
               "other": {"builtin": "leaf"}},
    "objects": [{"shape": "other", "position": [0, 0, 1]},
                {"shape": "r", "count": 6, "region": {"min": [-2, -2, 1], "max": [2, 2, 4]}},
                {"shape": "b", "count": 14, "region": {"min": [-2, -2, 1], "max": [2, 2, 4]}}],
    "constraints": [{"kind": "keyframe", "frame": 50, "targets": {"image": "LICENSE",
      "origin": [0, 0, 0], "u": [1, 0, 0], "v": [0, 1, 0], "width": 2,
      "classes": {"blue": [0, 0, 1], "red": [1, 0, 0]}}}]})");
  ASSERT_EQ(scene.Constraints.size(), 20u);
  int red = 0;
  for (const Constraint& row : scene.Constraints)
  {
    red += row.ClassId == 0;
    EXPECT_EQ(row.ClassId == 0, row.Value.x() < 0.0) << "red is the left half";
  }
  EXPECT_EQ(red, 6);
}

TEST(ReadScene, ObstaclesOfEveryKindAndTheirMotion)
{
  const Scene scene = Parsed(R"({"waft": 1, "time": {"frames": 100}, "obstacles": [
    {"kind": "box", "min": [0, 0, 0], "max": [1, 1, 1], "id": 7},
    {"kind": "sphere", "center": [0, 0, 2], "radius": 0.5,
     "motion": [{"frame": 10, "position": [0, 0, 2]}, {"frame": 30, "position": [2, 0, 2]},
                {"frame": 40, "position": [2, 1, 2]}]},
    {"kind": "cylinder", "base": [1, 0, 0], "top": [1, 0, 3], "radius": 0.2},
    {"kind": "mesh", "file": "LICENSE", "position": [1, 1, 1], "scale": 2}]})");
  ASSERT_EQ(scene.Obstacles.size(), 5u);
  EXPECT_EQ(scene.Obstacles[0].ObstacleId, 7);
  EXPECT_EQ(scene.Obstacles[1].ObstacleId, 1);
  EXPECT_EQ(scene.Obstacles[4].ObstacleId, 8) << "the ground has an id of its own";
  EXPECT_EQ(scene.GroundId, 8);
  EXPECT_FALSE(scene.Obstacles[0].IsMoving());
  const ObstacleMesh& ball = scene.Obstacles[1];
  ASSERT_EQ(ball.Offsets.size(), 100u);
  EXPECT_EQ(ball.Offsets[0], Vec3(0.0, 0.0, 0.0));
  EXPECT_LT((ball.Offsets[20] - Vec3(1.0, 0.0, 0.0)).norm(), 1e-15);
  EXPECT_LT((ball.Offsets[35] - Vec3(2.0, 0.5, 0.0)).norm(), 1e-15);
  EXPECT_LT((ball.Offsets[99] - Vec3(2.0, 1.0, 0.0)).norm(), 1e-15);
  EXPECT_EQ(scene.Obstacles[3].Mesh.Points.back(), Vec3(3.0, 3.0, 3.0));
}

TEST(ReadScene, MotionIsWhereTheReferencePointIs)
{
  const Scene scene = Parsed(R"({"waft": 1, "time": {"frames": 20}, "obstacles": [
    {"kind": "box", "min": [0, 0, 0], "max": [1, 1, 1],
     "motion": [{"frame": 5, "position": [2, 0, 3]}, {"frame": 15, "position": [3, 0, 3]}]},
    {"kind": "sphere", "center": [0, 0, 9], "radius": 0.5,
     "motion": [{"frame": 5, "position": [1, 1, 1]}, {"frame": 6, "position": [1, 1, 2]}]},
    {"kind": "cylinder", "base": [0, 0, 0], "top": [0, 0, 3], "radius": 0.2,
     "motion": [{"frame": 0, "position": [1, 0, 1]}, {"frame": 10, "position": [1, 2, 1]}]},
    {"kind": "mesh", "file": "LICENSE", "position": [9, 9, 9],
     "motion": [{"frame": 0, "position": [1, 1, 1]}, {"frame": 10, "position": [2, 1, 1]}]},
    {"kind": "box", "min": [0, 0, 0], "max": [1, 1, 1],
     "motion": [{"frame": 7, "position": [2, 0, 3]}]}]})");
  const auto middle = [&](std::size_t i, double frame)
  {
    const ObstacleMesh& obstacle = scene.Obstacles[i];
    Vec3 low = obstacle.Mesh.Points.front();
    Vec3 high = low;
    for (const Vec3& p : obstacle.Mesh.Points)
    {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    return Vec3(0.5 * (low + high) + obstacle.Offset(frame));
  };
  EXPECT_LT((middle(0, 0) - Vec3(2, 0, 3)).norm(), 1e-12) << "still before the first key";
  EXPECT_LT((middle(0, 10) - Vec3(2.5, 0, 3)).norm(), 1e-12);
  EXPECT_LT((middle(0, 19) - Vec3(3, 0, 3)).norm(), 1e-12);
  EXPECT_LT((middle(1, 19) - Vec3(1, 1, 2)).norm(), 1e-12);
  EXPECT_LT((middle(2, 5) - Vec3(1, 1, 2.5)).norm(), 1e-12) << "of the base, up to its top";
  EXPECT_EQ(scene.Obstacles[3].Mesh.Points.front() - Vec3(1, 1, 1), Vec3(0, 0, 0));
  EXPECT_EQ(scene.Obstacles[3].Offset(10), Vec3(1, 0, 0));
  EXPECT_FALSE(scene.Obstacles[4].IsMoving());
  EXPECT_LT((middle(4, 3) - Vec3(2, 0, 3)).norm(), 1e-12);
}

TEST(ReadScene, TheSameTextGivesTheSameScene)
{
  const std::string text = WithObjects(
    R"([{"shape": "leaf", "count": 30, "region": {"min": [-2, -2, 1], "max": [2, 2, 4]}}])",
    R"(, "constraints": [{"kind": "keyframe", "frame": 9, "targets":
      {"text": "L", "origin": [0, 0, 0], "width": 2}}])");
  const Scene a = Parsed(text);
  const Scene b = Parsed(text);
  for (std::size_t i = 0; i < a.Objects.size(); ++i)
  {
    EXPECT_EQ(a.Objects[i].Position, b.Objects[i].Position);
    EXPECT_EQ(a.Constraints[i].Value, b.Constraints[i].Value);
  }
}

TEST(ReadScene, PlacesOnAnObstacleAreRelativeToItsReferencePoint)
{
  const Scene scene = Parsed(
    WithObjects(R"([{"shape": "leaf", "positions": [[0, 0, 0.5], [1, 0, 0.5]], "on": 7},
      {"shape": "leaf", "count": 3, "region": {"min": [-1, -1, 1], "max": [1, 1, 1]}, "on": 7}])",
                R"(, "obstacles": [{"kind": "sphere", "id": 7, "center": [9, 9, 9], "radius": 0.1,
      "motion": [{"frame": 0, "position": [0, 0, 1]}, {"frame": 100, "position": [1, 0, 2]}]}],
    "constraints": [
    {"kind": "position", "object": 0, "frame": 50, "value": [0, 0.1, 0.3], "on": 7, "hold": 9},
    {"kind": "rest", "object": 1, "frame": {"from": 80, "to": 100}, "value": [0, 0, 0.2], "on": 7},
    {"kind": "keyframe", "frame": {"from": 0, "to": 50}, "order": "left-to-right", "on": 7,
     "targets": {"points": [[0, 0, 1], [0.5, 0, 1]]}, "objects": [2, 3]},
    {"kind": "position", "object": 0, "frame": 200, "value": [0, 0.1, 0.3]}])"));
  const auto expectNear = [](const Vec3& a, const Vec3& b) { EXPECT_LT((a - b).norm(), 1e-12); };
  ASSERT_EQ(scene.Objects.size(), 5u);
  EXPECT_EQ(scene.Objects[0].On, 7);
  expectNear(scene.Objects[1].Position, Vec3(1, 0, 1.5));
  EXPECT_NEAR(scene.Objects[4].Position.z(), 2.0, 1e-12);
  ASSERT_EQ(scene.Constraints.size(), 5u);
  EXPECT_EQ(scene.Constraints[0].On, 7);
  expectNear(scene.Constraints[0].Value, Vec3(0.5, 0.1, 1.8));
  expectNear(scene.Constraints[1].Value, Vec3(1, 0, 2.2)); // at the window's end
  expectNear(scene.Constraints[2].Value, Vec3(0, 0, 2));   // each at its frame
  expectNear(scene.Constraints[3].Value, Vec3(1, 0, 2.5));
  EXPECT_EQ(scene.Constraints[4].On, -1);
}
