// SPDX-License-Identifier: BSD-3-Clause
// A scene that is written and read again is the same scene.
#include "Base/SameLists.h"
#include "Base/SameVortices.h"
#include "SameSceneFields.h"
#include "Scene/WriteScene.h"
#include "SchemaChecks.h"
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
                                          item.Row, item.Target, item.Group, item.ClassId,
                                          item.Side, item.Facing, item.FacingTolerance,
                                          item.FrameFrom, item.IsOpenWindow, item.On, item.Hold,
                                          item.Drifts, item.HoldRadius, item.Goes.From);
                        });
}

void ExpectSameObjects(const std::vector<MotionObject>& a, const std::vector<MotionObject>& b)
{
  test::ExpectSameItems("object", a, b,
                        [](const MotionObject& item)
                        {
                          return std::tie(item.ObjectId, item.ShapeId, item.ClassId, item.Mass,
                                          item.Position, item.Velocity, item.Orientation.coeffs(),
                                          item.VelocityGiven, item.OrientationGiven,
                                          item.AngularVelocity, item.SettlingSpeed,
                                          item.ClearanceRadius, item.RestHeight, item.On);
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
    {"shape": "leaf", "position": [1, -1, 4.5], "class": ""},
    {"shape": "leaf", "position": [0, 0, 1.5], "on": 9, "release": 30}],
  "constraints": [
    {"kind": "position", "object": 40, "frame": 20, "value": [0, 0, 2], "radius": 0.1,
      "facing": {"direction": [0, -1, 0], "tolerance": 0.3}},
    {"kind": "position", "object": -1, "frame": 30, "value": [0, 0.1, 2]},
    {"kind": "rest", "object": 0, "frame": 40, "until": 50, "value": [0, 0, 2], "faceUp": "down"},
    {"kind": "velocity", "object": 1, "frame": 20, "value": [0, 0, 0.3], "radius": 0.1},
    {"kind": "acceleration", "object": 1, "frame": 30, "value": [0, 0, 0]},
    {"kind": "orientation", "object": 1, "frame": 20, "value": [1, 0.2, 0, 0], "radius": 0.1},
    {"kind": "path", "object": 2, "firstFrame": 20, "points": [[0, 0, 1], [0, 0.1, 1]], "radius": 0.02},
    {"kind": "path", "object": 2, "firstFrame": 30, "points": [[0, 0.2, 1]]},
    {"kind": "rest", "object": 3, "frame": 30, "until": 40, "value": [0, 0.2, 1], "on": 9},
    {"kind": "position", "object": 4, "frame": 30, "value": [0, 0.2, 1], "hold": 9, "drift": true,
      "holdRadius": 0.2},
    {"kind": "keyframe", "frame": 40, "targets": {"points": [[0, 0, 1], [0.1, 0, 1]]}, "on": 9},
    {"kind": "keyframe", "frame": 55, "targets": {"text": "L", "origin": [0, 0, 0.5], "width": 2},
      "velocity": "rest", "until": 80, "faceUp": "up"},
    {"kind": "keyframe", "frame": 84, "targets": {"points": [[0, 0, 1], [1, 0, 1], [1, 1, 1]]},
      "velocity": [0, 0, 1], "objects": [3, -1, 2], "assign": "inOrder", "radius": 0.3,
      "facing": {"direction": [0, 0, 1], "tolerance": 0.35}},
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
  test::ExpectSameFields(Json::parse(Full), WAFT_SOURCE_DIR, Json::parse(text.Json),
                         WAFT_SOURCE_DIR);
  // Writing again gives the same text.
  EXPECT_EQ(Written(Parsed(text.Json)).Json, text.Json);
}

TEST(WriteScene, TheScenesOfTheProjectAreWrittenAsTheyWere)
{
  int count = 0;
  const std::string folder = std::string(WAFT_SOURCE_DIR) + "/Data/Scenes";
  for (const auto& entry : std::filesystem::directory_iterator(folder))
  {
    if (entry.path().extension() == ".json" && !NamesAPicture(entry.path().string()))
    {
      SCOPED_TRACE(entry.path());
      Scene scene;
      ASSERT_TRUE(ReadScene(entry.path().string(), TestAssets(), scene));
      SceneText text;
      ASSERT_TRUE(FormatScene(scene, TestAssets(), folder, "s", text));
      test::ExpectSameFields(LoadJson(entry.path().string()), folder, Json::parse(text.Json),
                             folder);
      Scene again;
      ASSERT_TRUE(ParseScene(text.Json, "written", folder, TestAssets(), again));
      ExpectSameScene(scene, again);
      ++count;
    }
  }
  EXPECT_GE(count, 10);
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
  EXPECT_EQ(text.Meshes[0].Index, 1u);
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

TEST(WriteScene, WindowsAreWrittenThoughTheirTargetsMoved)
{
  const std::string begin = R"({"waft": 1, "shapes": {"a": {"builtin": "leaf"}},
    "objects": [{"shape": "a", "positions": [[0, 0, 3], [1, 0, 3], [-1, 0, 3]]}], "constraints": [
    {"kind": "keyframe", "frame": {"from": 90, "to": 150}, "targets": {"points":
     [[0, 0, 1], [1, 0, 1], [-1, 0, 1]]})";
  for (
    const char* order :
    { "", R"(, "order": "left-to-right")", R"(, "order": "random", "spread": "ease-out")",
      R"(, "order": "outward", "velocity": "rest", "until": 200)",
      R"(, "order": [2, 2, 0], "velocity": [0, 0, -1], "spread": "ease-in")",
      R"(, "hold": 9, "leave": {"frame": {"from": 160, "to": 180}, "order": [0, 2, 1], "fade": 3})",
      R"(, "velocity": "rest", "leave": {"frame": {"from": 190, "to": 220}, "place": [0, 0, 1]})" })
  {
    Scene scene = Parsed(begin + order + "}]}");
    for (Constraint& row : scene.Constraints)
    {
      row.Value += IsPositional(row.Kind) ? Vec3(0.0, 0.2, 0.0) : Vec3(Vec3::Zero());
    }
    ExpectSameRows(scene.Constraints, Parsed(Written(scene).Json).Constraints);
  }
  Scene single = Parsed(R"({"waft": 1, "shapes": {"a": {"builtin": "leaf"}},
    "objects": [{"shape": "a", "position": [0, 0, 3]}], "constraints": [
    {"kind": "rest", "object": 0, "frame": {"from": 90, "to": 150}, "value": [0, 0, 1]}]})");
  single.Constraints[0].Value.x() += 0.1;
  ExpectSameRows(single.Constraints, Parsed(Written(single).Json).Constraints);
}

TEST(WriteScene, PlacesOnAnObstacleStayRelativeToIt)
{
  const Scene read = Parsed(R"({"waft": 1, "shapes": {"a": {"builtin": "leaf"}},
    "objects": [{"shape": "a", "positions": [[0, 0, 0.5], [1, 0, 0.5]], "on": 7, "release": 9}],
    "obstacles": [{"kind": "sphere", "id": 7, "center": [0, 0, 1], "radius": 0.1,
      "motion": [{"frame": 0, "position": [0, 0, 1]}, {"frame": 100, "position": [1, 0, 2]}]}],
    "constraints": [
    {"kind": "position", "object": 0, "frame": 50, "value": [0, 0.1, 0.3], "on": 7, "hold": 9},
    {"kind": "keyframe", "frame": 80, "targets": {"points": [[0, 0, 1], [1, 0, 1]]}, "on": 7}]})");
  Scene edited = read;
  for (Constraint& row : edited.Constraints)
  {
    row.Value.y() += 0.2;
  }
  for (MotionObject& object : edited.Objects)
  {
    object.Position.y() += 0.2;
  }
  const auto expect = [](const Scene& wanted, const std::string& text)
  {
    const Scene again = Parsed(text);
    ASSERT_EQ(again.Constraints.size(), 3u);
    ASSERT_EQ(again.Objects.size(), 2u);
    for (std::size_t i = 0; i < 3; ++i)
    {
      EXPECT_EQ(again.Constraints[i].On, 7);
      EXPECT_LT((again.Constraints[i].Value - wanted.Constraints[i].Value).norm(), 1e-12) << i;
    }
    for (std::size_t i = 0; i < 2; ++i)
    {
      EXPECT_EQ(again.Objects[i].On, 7);
      EXPECT_LT((again.Objects[i].Position - wanted.Objects[i].Position).norm(), 1e-12) << i;
    }
  };
  expect(read, Written(read).Json);
  const Json json = Json::parse(Written(edited).Json);
  EXPECT_NEAR(json["constraints"][0]["value"][2].get<double>(), 0.3, 1e-12);
  expect(edited, json.dump());
  // As a mesh of its own its reference point is the origin.
  edited.Obstacles[0].Mesh.Points[0] *= 0.999;
  const Json mesh = Json::parse(Written(edited).Json);
  EXPECT_NEAR(mesh["constraints"][0]["value"][2].get<double>(), 1.3, 1e-12);
  EXPECT_NEAR(mesh["objects"][0]["positions"][0][2].get<double>(), 1.5, 1e-12);
}

namespace
{

// What has an entry for each thing that can be edited.
const char* const Edited =
  R"({"waft": 1, "title": "Edited", "_story": "kept", "seed": 3, "time": {"frames": 90},
  "shapes": {"leaf": {"builtin": "leaf", "class": "red"}, "disc": {"builtin": "disc"}},
  "objects": [
    {"shape": "leaf", "count": 4, "region": {"min": [-1.5, -1.5, 2], "max": [1.5, 1.5, 3.5]}},
    {"shape": "disc", "positions": [[0, 0, 1], [1, 0, 1]], "mass": 0.002},
    {"shape": "disc", "position": [1.6, 1.6, 1], "id": 6}],
  "constraints": [
    {"kind": "keyframe", "frame": 40, "targets": {"text": "L", "origin": [0, 0, 1], "width": 2,
      "u": [0, 1, 0], "v": [1, 0, 0], "count": 5}},
    {"kind": "keyframe", "frame": 60, "objects": [5, 4, 2], "assign": "optimal",
      "targets": {"points": [[0, 0, 2], [1, 0, 2], [0, 1, 2]]}},
    {"kind": "path", "object": 1, "firstFrame": 70, "points": [[0, 0, 1], [0, 0.1, 1]]}],
  "obstacles": [
    {"kind": "sphere", "center": [1.5, -1.5, 1], "radius": 0.2},
    {"kind": "mesh", "file": "LICENSE", "scale": 0.3, "position": [-1.7, 1, 1]},
    {"kind": "box", "min": [-1.8, -1.8, 0.1], "max": [-1.5, -1.5, 0.4], "motion": [
      {"frame": 10, "position": [-1.65, -1.65, 0.25]}, {"frame": 33, "position": [-1.4, -1.65, 1]}]}],
  "ground": {"height": 0.05}})";

// What an edited scene is written as, after it was seen that this reads back the same.
Json WrittenEdited(const Scene& edited)
{
  const SceneText text = Written(edited);
  Scene read = Parsed(text.Json);
  Scene expected = edited;
  for (std::vector<Constraint>* rows : { &read.Constraints, &expected.Constraints })
  {
    for (Constraint& row : *rows) // numbered anew
    {
      row.Row = row.Group = row.Group < 0 ? -1 : 0;
    }
  }
  ExpectSameObjects(expected.Objects, read.Objects);
  ExpectSameRows(expected.Constraints, read.Constraints);
  return Json::parse(text.Json);
}

} // namespace

TEST(WriteScene, WhatWasEditedIsWrittenAsItIsAndTheRestAsItWas)
{
  const Json authored = Json::parse(Edited);
  const Scene scene = Parsed(Edited);
  const auto edit = [&](const auto& change)
  {
    Scene edited = scene;
    change(edited);
    return WrittenEdited(edited);
  };
  test::ExpectSameFields(authored, WAFT_SOURCE_DIR, WrittenEdited(scene), WAFT_SOURCE_DIR);

  // An object of a region moved by hand: all four by their places, others as they were.
  Json json = edit([](Scene& s) { s.Objects[2].Position.z() += 0.001; });
  EXPECT_EQ(json["objects"][0]["positions"].size(), 4u) << json["objects"];
  EXPECT_EQ(json["objects"][1], authored["objects"][1]);
  EXPECT_EQ(json["objects"][2], authored["objects"][2]);
  EXPECT_EQ(json["constraints"][0], authored["constraints"][0]);

  // Another seed would spread otherwise; it draws the same strokes.
  json = edit([](Scene& s) { s.Info.Seed = 4; });
  EXPECT_EQ(json["objects"][0]["positions"].size(), 4u);
  EXPECT_EQ(json["constraints"][0], authored["constraints"][0]);
  EXPECT_EQ(json["constraints"][2], authored["constraints"][2]);

  // A target moved.
  json = edit([](Scene& s) { s.Constraints[3].Value.x() += 0.01; });
  EXPECT_EQ(json["constraints"][0]["targets"]["points"].size(), 5u);
  EXPECT_EQ(json["constraints"][1], authored["constraints"][1]);

  // Other objects than those that the keyframe chooses.
  json = edit(
    [](Scene& s)
    {
      ASSERT_EQ(s.Constraints[5].Frame, 60);
      std::swap(s.Constraints[5].ObjectId, s.Constraints[6].ObjectId);
    });
  EXPECT_EQ(json["constraints"][1]["assign"], "inOrder");
  EXPECT_EQ(json["constraints"][0], authored["constraints"][0]);

  // The first entry deleted: the second would choose otherwise without it.
  json = edit(
    [](Scene& s)
    {
      const auto first = s.Constraints.begin();
      s.Constraints.erase(first, first + 5);
    });
  ASSERT_EQ(json["constraints"].size(), 2u);
  EXPECT_EQ(json["constraints"][0]["assign"], "inOrder");
  EXPECT_EQ(json["constraints"][1], authored["constraints"][2]);

  // An object deleted: the single one keeps its id and its words.
  json = edit(
    [](Scene& s)
    {
      s.Constraints.clear();
      s.Objects.erase(s.Objects.begin() + 4);
    });
  EXPECT_EQ(json["objects"][0], authored["objects"][0]);
  EXPECT_EQ(json["objects"].back(), authored["objects"][2]);

  // The number of a shape: its body keeps its words.
  json = edit([](Scene& s) { s.Shapes[0].Thickness = 0.002; });
  EXPECT_EQ(json["shapes"]["leaf"],
            (Json{ { "builtin", "leaf" }, { "class", "red" }, { "thickness", 0.002 } }));
  EXPECT_EQ(json["shapes"]["disc"], authored["shapes"]["disc"]);
}

TEST(WriteScene, AnEditOfAnObstacleWins)
{
  const Json authored = Json::parse(Edited);
  const Scene scene = Parsed(Edited);
  for (const std::size_t moved : { 0u, 1u, 2u })
  {
    SCOPED_TRACE(moved);
    Scene edited = scene;
    for (Vec3& p : edited.Obstacles[moved].Mesh.Points)
    {
      p.z() += 1e-3;
    }
    SceneText text = Written(edited);
    const Json json = Json::parse(text.Json);
    ASSERT_EQ(text.Meshes.size(), 1u);
    EXPECT_EQ(text.Meshes[0].Index, moved);
    EXPECT_EQ(json["ground"], authored["ground"]);
    for (std::size_t i = 0; i < 3; ++i)
    {
      const Json& entry = json["obstacles"][i];
      EXPECT_EQ(entry == authored["obstacles"][i], i != moved) << entry;
      EXPECT_EQ(entry["kind"] == "mesh", i == moved || i == 1);
    }
    EXPECT_EQ(json["obstacles"][moved].contains("motion"), moved == 2);
  }

  Scene other = scene; // of the last, the motion alone
  other.Obstacles[2].Offsets.back().x() += 1e-3;
  EXPECT_EQ(Json::parse(Written(other).Json)["obstacles"][2]["kind"], "mesh");

  Scene lower = scene;
  for (Vec3& p : lower.Obstacles[3].Mesh.Points)
  {
    p.z() -= 0.01;
  }
  const Json json = Json::parse(Written(lower).Json);
  EXPECT_EQ(json["ground"]["enabled"], false);
  EXPECT_EQ(json["obstacles"][3]["kind"], "mesh");

  // One deleted: the ground is still the ground.
  Scene fewer = scene;
  fewer.Obstacles.erase(fewer.Obstacles.begin() + 1);
  const Json left = Json::parse(Written(fewer).Json);
  EXPECT_EQ(left["ground"], authored["ground"]);
  EXPECT_EQ(left["obstacles"][1]["kind"], "box");
  EXPECT_EQ(left["obstacles"][1]["id"], 2);
}

TEST(WriteScene, AuthoredTextsThatAreNoneAreNotBelieved)
{
  Scene scene = Parsed(Edited);
  const std::string deep = "{\"waft\": 1, \"_a\": " + std::string(1000000, '[') +
                           std::string(1000000, ']') + ", \"objects\": 3, \"obstacles\": [7]}";
  for (const std::string& text : { std::string("{"), std::string("[]"), std::string("\xff"), deep })
  {
    scene.Authored = { text, text, text, text };
    scene.Shapes[0].Authored = text;
    SceneText written;
    const Result result = FormatScene(scene, TestAssets(), WAFT_SOURCE_DIR, "s", written);
    ASSERT_TRUE(result) << result.Message();
    EXPECT_EQ(Json::parse(written.Json)["obstacles"][0]["kind"], "mesh");
  }
  // Nor does a comment that nobody checks bring the reader down.
  const std::string file = "{\"_a\": " + std::string(1000000, '[') + std::string(1000000, ']') +
                           R"(, "waft": 1, "seed": 2})";
  EXPECT_EQ(Parsed(file).Objects.size(), 0u);
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
  expect(why([](Scene& s) { s.Winds.assign(1001, AnalyticWind()); }),
         "expected at most 1000 winds, found 1001");
  expect(why([](Scene& s) { s.Title = "a\x01"; }), "title: expected a name without control");
  expect(why([](Scene& s) { s.Shapes[0].Name = "a\u202eb"; }),
         "Shapes: block a\\u202eb: expected a name");
}
