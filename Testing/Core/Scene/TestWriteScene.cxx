// SPDX-License-Identifier: BSD-3-Clause
// A scene that is written and read again is the same scene.
#include "Base/SameLists.h"
#include "Base/SameVortices.h"
#include "Scene/WriteScene.h"
#include "SceneSchema.h"
#include "TestAssets.h"

#include <filesystem>

using namespace waft;

namespace
{

SceneText Written(const Scene& scene)
{
  SceneText text;
  const Result result = FormatScene(scene, TestAssets(), WAFT_SOURCE_DIR, "s", text);
  EXPECT_TRUE(result) << result.Message();
  EXPECT_TRUE(IsValid(Json::parse(text.Json), Schema())) << text.Json;
  return text;
}

std::string WhyNotWritten(const Scene& scene)
{
  SceneText text;
  const Result result = FormatScene(scene, TestAssets(), WAFT_SOURCE_DIR, "s", text);
  EXPECT_FALSE(result) << text.Json;
  EXPECT_TRUE(text.Json.empty());
  return result.Message();
}

void ExpectSameRows(const std::vector<Constraint>& a, const std::vector<Constraint>& b)
{
  test::ExpectSameItems("row", a, b,
                        [](const Constraint& item)
                        {
                          return std::tie(item.ObjectId, item.Frame, item.Kind, item.Value,
                                          item.Orientation.coeffs(), item.Radius, item.Until,
                                          item.Row, item.Target, item.Group, item.ClassId);
                        });
}

void ExpectSameObjects(const std::vector<MotionObject>& a, const std::vector<MotionObject>& b)
{
  test::ExpectSameItems("object", a, b,
                        [](const MotionObject& item)
                        {
                          return std::tie(item.ObjectId, item.ShapeId, item.ClassId, item.Mass,
                                          item.Position, item.Velocity, item.Orientation.coeffs(),
                                          item.AngularVelocity, item.SettlingSpeed,
                                          item.ClearanceRadius, item.RestHeight);
                        });
}

void ExpectSameShapes(const std::vector<Shape>& a, const std::vector<Shape>& b)
{
  test::ExpectSameItems("shape", a, b,
                        [](const Shape& item)
                        {
                          return std::tie(item.Name, item.Mesh.Points, item.Mesh.Triangles,
                                          item.TextureCoordinates, item.Texture,
                                          item.DragCoefficient, item.AreaDensity, item.Thickness,
                                          item.SettlingSpeed, item.Color, item.Tint, item.ClassId);
                        });
}

void ExpectSameScene(const Scene& a, const Scene& b)
{
  EXPECT_EQ(a.Title, b.Title);
  EXPECT_EQ(a.Info.Seed, b.Info.Seed);
  EXPECT_EQ(a.Info.Time.NumberOfFrames, b.Info.Time.NumberOfFrames);
  EXPECT_EQ(a.Info.Time.FramesPerSecond, b.Info.Time.FramesPerSecond);
  EXPECT_EQ(a.Info.AirDensity, b.Info.AirDensity);
  EXPECT_EQ(a.Info.Bounds.Min, b.Info.Bounds.Min);
  EXPECT_EQ(a.Info.Bounds.Max, b.Info.Bounds.Max);
  EXPECT_EQ(a.Classes, b.Classes);
  ExpectSameShapes(a.Shapes, b.Shapes);
  ExpectSameObjects(a.Objects, b.Objects);
  ExpectSameRows(a.Constraints, b.Constraints);
  test::ExpectSameItems("obstacle", a.Obstacles, b.Obstacles,
                        [](const ObstacleMesh& item) {
                          return std::tie(item.ObstacleId, item.Mesh.Points, item.Mesh.Triangles);
                        });
  for (std::size_t i = 0; i < std::min(a.Obstacles.size(), b.Obstacles.size()); ++i)
  {
    const std::vector<Vec3>& offsets = b.Obstacles[i].Offsets;
    ASSERT_EQ(a.Obstacles[i].Offsets.size(), offsets.size());
    for (std::size_t k = 0; k < offsets.size(); ++k)
    {
      EXPECT_LT((a.Obstacles[i].Offsets[k] - offsets[k]).norm(), 1e-12) << k;
    }
  }
  EXPECT_EQ(a.GroundId, b.GroundId);
  test::ExpectSame(a.Vortices, b.Vortices);
  test::ExpectSameItems("wind", a.Winds, b.Winds,
                        [](const AnalyticWind& item)
                        {
                          return std::tie(item.Direction, item.Strength, item.Center, item.Radius,
                                          item.CenterTime, item.Duration);
                        });
}

const char* const Full =
  R"({"waft": 1, "title": "A \"title\", with: marks", "seed": 9007199254740991,
  "time": {"frames": 90, "framesPerSecond": 23.976}, "air": {"density": 1.1},
  "domain": {"min": [-3.1, -3, 0.1], "max": [3, 3, 5.3]}, "ground": {"height": 0.3},
  "shapes": {
    "leaf": {"builtin": "leaf", "texture": "LICENSE", "size": 0.17, "areaDensity": 0.11,
      "thickness": 0.001, "dragCoefficient": 1.3, "settlingSpeed": 0.7, "color": [1, 0.5, 0.1],
      "class": "red"},
    "bubble": {"builtin": "bubble"},
    "disc": {"builtin": "disc", "size": 0.123456789012, "class": "blue"}},
  "objects": [
    {"shape": "leaf", "position": [0, 0, 3], "velocity": [0.1, 0, 0], "orientation": [1, 2, 3, 4],
      "angularVelocity": [0, 0, 1], "mass": 0.003},
    {"shape": "disc", "count": 5, "region": {"min": [-2, -2, 1], "max": [2, 2, 4]}},
    {"shape": "leaf", "positions": [[2, 2, 4], [-2, 2, 4]]},
    {"shape": "bubble", "position": [1, 1, 4.5], "id": 40, "settlingSpeed": 0, "clearanceRadius": 0.2,
      "restHeight": 0.01, "class": "green"},
    {"shape": "leaf", "position": [1, -1, 4.5], "class": ""}],
  "constraints": [
    {"kind": "position", "object": 40, "frame": 20, "value": [0, 0, 2], "radius": 0.1},
    {"kind": "position", "object": -1, "frame": 30, "value": [0, 0.1, 2]},
    {"kind": "rest", "object": 0, "frame": 40, "until": 50, "value": [0, 0, 2]},
    {"kind": "velocity", "object": 1, "frame": 20, "value": [0, 0, 0.3], "radius": 0.1},
    {"kind": "acceleration", "object": 1, "frame": 30, "value": [0, 0, 0]},
    {"kind": "orientation", "object": 1, "frame": 20, "value": [1, 0.2, 0, 0], "radius": 0.1},
    {"kind": "path", "object": 2, "firstFrame": 20, "points": [[0, 0, 1], [0, 0.1, 1]], "radius": 0.02},
    {"kind": "path", "object": 2, "firstFrame": 30, "points": [[0, 0.2, 1]]},
    {"kind": "keyframe", "frame": 55, "targets": {"text": "L", "origin": [0, 0, 0.5], "width": 2},
      "velocity": "rest", "until": 80},
    {"kind": "keyframe", "frame": 84, "targets": {"points": [[0, 0, 1], [1, 0, 1], [1, 1, 1]]},
      "velocity": [0, 0, 1], "objects": [3, -1, 2], "assign": "inOrder", "radius": 0.3},
    {"kind": "keyframe", "frame": 85, "targets": {"image": "LICENSE", "origin": [0, 0, 1], "width": 2,
      "count": 4, "classes": {"red": [1, 0, 0], "blue": [0, 0, 1]}}},
    {"kind": "keyframe", "frame": 86, "targets": {"points": [[0, 0, 1], [1, 0, 1]],
      "classes": ["green", ""]}}],
  "obstacles": [
    {"kind": "box", "min": [2, 2, 0.1], "max": [2.9, 3, 1], "id": 9, "motion": [
      {"frame": 10, "position": [2.45, 2.5, 0.55]}, {"frame": 19, "position": [2.55, 2.5, 1.55]},
      {"frame": 50, "position": [2.75, 2.5, 1.25]}]},
    {"kind": "sphere", "center": [-2, -2.1, 1.7], "radius": 0.23},
    {"kind": "cylinder", "base": [2, -2, 0.4], "top": [2.1, -2, 1], "radius": 0.21}],
  "winds": [{"direction": [1, 0, 1], "strength": 1.7, "center": [0, 0, 0.3], "radius": 1.1,
    "centerTime": 1.2, "duration": 1.3}],
  "vortices": [{"p1": [0, 0, 0], "p2": [0, 0.1, 1], "strength": -1.9, "centerTime": 1.7,
    "duration": 1.6, "coreRadius": 0.15}]})";

} // namespace

TEST(WriteScene, EveryKindOfThingReadsBackTheSame)
{
  const Scene scene = Parsed(Full);
  const SceneText text = Written(scene);
  EXPECT_TRUE(text.Meshes.empty());
  ExpectSameScene(scene, Parsed(text.Json));
  EXPECT_NE(text.Json.find("\"kind\": \"sphere\""), std::string::npos) << text.Json;
  EXPECT_NE(text.Json.find("\"kind\": \"cylinder\""), std::string::npos);
  EXPECT_NE(text.Json.find("\"builtin\": \"disc\""), std::string::npos);
  // Writing again gives the same text.
  EXPECT_EQ(Written(Parsed(text.Json)).Json, text.Json);
}

TEST(WriteScene, TheScenesOfTheProjectReadBackTheSame)
{
  int count = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(WAFT_SOURCE_DIR) + "/Data/Scenes"))
  {
    if (entry.path().extension() == ".json" && !NamesAPicture(entry.path().string()))
    {
      SCOPED_TRACE(entry.path());
      Scene scene;
      ASSERT_TRUE(ReadScene(entry.path().string(), TestAssets(), scene));
      ExpectSameScene(scene, Parsed(Written(scene).Json));
      ++count;
    }
  }
  EXPECT_GE(count, 4);
}

TEST(WriteScene, MeshesWithoutWordsGoIntoFiles)
{
  Scene scene = Parsed(Full);
  scene.Shapes[1].Mesh.Points[0].x() += 1e-6;
  scene.Shapes[1].Name = "a bubble/dented";
  scene.Obstacles[1].Mesh.Points[0].x() += 1e-6;
  const SceneText text = Written(scene);
  ASSERT_EQ(text.Meshes.size(), 2u);
  EXPECT_TRUE(text.Meshes[0].IsShape);
  EXPECT_EQ(text.Meshes[0].Place, 1u);
  EXPECT_EQ(text.Meshes[0].Name, "s.shape-a_bubble_dented.vtp");
  EXPECT_FALSE(text.Meshes[1].IsShape);
  EXPECT_EQ(text.Meshes[1].Name,
            "s.obstacle-" + std::to_string(scene.Obstacles[1].ObstacleId) + ".vtp");
}

TEST(WriteScene, MixedRowsOfOneNumberAreWrittenOneByOne)
{
  Scene scene = Parsed(R"({"waft": 1, "shapes": {"a": {"builtin": "leaf"}},
    "objects": [{"shape": "a", "positions": [[0, 0, 3], [1, 0, 3]]}], "constraints": [
    {"kind": "keyframe", "frame": 90, "objects": [1, 0], "assign": "inOrder",
     "targets": {"points": [[0, 0, 1], [1, 0, 1]]}}]})");
  scene.Constraints[1].Frame = 100; // one target of the keyframe moved in time
  const Scene read = Parsed(Written(scene).Json);
  ASSERT_EQ(read.Constraints.size(), 2u);
  EXPECT_EQ(read.Constraints[1].ObjectId, 0);
  EXPECT_EQ(read.Constraints[1].Frame, 100);
  EXPECT_EQ(read.Constraints[1].Value, scene.Constraints[1].Value);
}

TEST(WriteScene, NamesWhatCannotBeWritten)
{
  const Scene good = Parsed(Full);
  const auto why = [&](const auto& spoil)
  {
    Scene bad = good;
    spoil(bad);
    return WhyNotWritten(bad);
  };
  const auto expect = [](const std::string& message, const std::string& part)
  { EXPECT_NE(message.find(part), std::string::npos) << message; };
  expect(why([](Scene& s) { s.Info.Time.NumberOfFrames = 1; }), "NumberOfFrames");
  expect(why([](Scene& s) { s.Objects[2].ObjectId = 3; }), "3 stands twice");
  expect(why([](Scene& s) { s.Objects[2].ShapeId = 7; }), "object 2: `ShapeId`");
  expect(why([](Scene& s) { s.Objects[2].Mass = 0.0; }), "object 2: `Mass`");
  expect(why([](Scene& s) { s.Shapes[0].Texture = "/no/where.png"; }), "block leaf: `Texture`");
  expect(why([](Scene& s) { s.Shapes[0].Thickness = 0.0; }), "block leaf: `Thickness`");
  expect(why([](Scene& s) { s.Constraints[0].ObjectId = 12; }), "row 0, target 0: `ObjectId`");
  expect(why([](Scene& s) { s.Constraints[3].ObjectId = -1; }), "row 3, target 0: a velocity");
  expect(why([](Scene& s) { s.Constraints.back().ClassId = 5; }), "`ClassId`");
  expect(why([](Scene& s) { s.Vortices[0].CoreRadius = 0.0; }), "vortex 0");
  expect(why([](Scene& s) { s.Title = "\xff"; }), "cannot be written");
}
