// SPDX-License-Identifier: BSD-3-Clause
// A scene's text that is edited keeps every byte that no edit names.
#include "Scene/Scene.h"
#include "Scene/SceneEdits.h"
#include "TestAssets.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

using namespace waft;
using Json = nlohmann::json;

namespace
{

// As a hand writes it: comments, odd blanks, numbers of its own.
const char* const TypedByHand = R"({
  "waft": 1,   "_why": "a \"note\", [with] {brackets}",
  "objects": [
    {"shape": "leaf", "position": [1e0, 0.50,  2]},
    {"shape": "leaf", "positions": [[0, 0, 3], [0.1, 0, 3]]}
  ],
  "shapes": {"leaf": {"builtin": "leaf"}},
  "obstacles": [{"kind": "box", "min": [0, 0, 0], "max": [1, 1, 1], "_a": 0},
    {"kind": "sphere", "center": [0, 0, 1], "radius": 0.2, "motion": [{"frame": 0, "position": [0, 0, 1]}]}],
  "constraints": [
    {"kind": "position", "object": 0, "frame": 95, "value": [-0.2, 0.5, 2.6]},

    {"kind": "rest", "object": 1, "frame": 200, "_note": "there", "value": [0, 0, 1]},
    {"kind": "keyframe", "frame": 250, "targets": {"text": "HI", "origin": [0, 0, 2], "width": 2}}
  ]
}
)";

std::string EditedText(const std::string& edits, std::string text = TypedByHand)
{
  const Result result = EditSceneText(edits, "s", text);
  EXPECT_TRUE(result) << result.Message();
  EXPECT_NO_THROW(Json::parse(text)) << text;
  return text;
}

std::string Replaced(const std::string& old, const std::string& by, std::string text = TypedByHand)
{
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos);
  return text.replace(at, old.size(), by);
}

std::string WhyNotEdited(const std::string& edits)
{
  std::string text = TypedByHand;
  const Result result = EditSceneText(edits, "s", text);
  EXPECT_FALSE(result);
  EXPECT_EQ(text, TypedByHand);
  return result.Message();
}

// What RFC 6902 makes of it, by the library.
void ExpectAsTheLibrary(const std::string& edits)
{
  EXPECT_EQ(Json::parse(EditedText(edits)), Json::parse(TypedByHand).patch(Json::parse(edits)))
    << edits;
}

} // namespace

TEST(SceneEdits, NothingChangesWithoutEdits)
{
  EXPECT_EQ(EditedText(""), TypedByHand);
  EXPECT_EQ(EditedText("[]"), TypedByHand);
}

TEST(SceneEdits, ReplacesAValueAndKeepsAllElse)
{
  EXPECT_EQ(
    EditedText(R"([{"op": "replace", "path": "/constraints/1/value", "value": [0.25, 0, 1.5]}])"),
    Replaced("\"value\": [0, 0, 1]", "\"value\": [0.25, 0, 1.5]"));
  EXPECT_EQ(
    EditedText(R"([{"op": "replace", "path": "/objects/1/positions/1", "value": [0.2, 0, 3]}])"),
    Replaced("[0.1, 0, 3]", "[0.2, 0, 3]"));
}

TEST(SceneEdits, WhatIsAddedStandsAsItsNeighbours)
{
  const std::string row = R"({"kind": "position", "object": 1, "frame": 9, "value": [0, 0, 1]})";
  EXPECT_EQ(EditedText(R"([{"op": "add", "path": "/constraints/-", "value": )" + row + "}]"),
            Replaced("\"width\": 2}}\n", "\"width\": 2}},\n\n    " + row + "\n"));
  EXPECT_EQ(EditedText(R"([{"op": "add", "path": "/objects/1/positions/-", "value": [1, 1, 1]}])"),
            Replaced("[0.1, 0, 3]", "[0.1, 0, 3], [1, 1, 1]"));
  EXPECT_EQ(EditedText(R"([{"op": "add", "path": "/seed", "value": 7}])"),
            Replaced("\n  ]\n}\n", "\n  ],   \"seed\": 7\n}\n"));
  EXPECT_EQ(EditedText(R"([{"op": "add", "path": "/a", "value": [1]}])", "{}"), R"({"a": [1]})");
}

TEST(SceneEdits, DoesWhatTheStandardSays)
{
  for (
    const char* edits :
    { R"([{"op": "remove", "path": "/constraints/0"}])",
      R"([{"op": "remove", "path": "/constraints/2"}])", R"([{"op": "remove", "path": "/waft"}])",
      R"([{"op": "remove", "path": "/shapes/leaf"}])",
      R"([{"op": "add", "path": "/constraints/1", "value": {"a": "b: c, \"d\""}}])",
      R"([{"op": "add", "path": "/objects/0/position", "value": [0, 0, 1]}])",
      R"([{"op": "add", "path": "/a~1b", "value": 1}, {"op": "replace", "path": "/a~1b", "value": 2}])",
      R"([{"op": "remove", "path": "/objects/1/positions/0"},
             {"op": "remove", "path": "/objects/1/positions/0"},
             {"op": "add", "path": "/objects/1/positions/-", "value": [3, 2, 1]}])" })
  {
    ExpectAsTheLibrary(edits);
  }
}

TEST(SceneEdits, SaysWhatIsWrongAndChangesNothing)
{
  EXPECT_EQ(WhyNotEdited("{}"), "s: Edits: /: expected a list of edits, found {}");
  EXPECT_NE(WhyNotEdited("[").find("s: Edits: line 1, column 2: expected JSON"), std::string::npos);
  EXPECT_EQ(WhyNotEdited(R"([{"op": "replace", "path": "/constraints/0/value", "value": [1, 2, 3]},
                       {"op": "replace", "path": "/constraints/9/value", "value": 1}])"),
            "s: Edits: /1/path: expected a place that the scene has, found "
            "\"/constraints/9/value\"");
  EXPECT_EQ(WhyNotEdited(R"([{"op": "move", "path": "/seed", "from": "/waft"}])"),
            "s: Edits: /0/path: expected a place that the scene has, found \"/seed\"");
  EXPECT_EQ(WhyNotEdited(R"([{"op": "move", "path": "/waft", "from": "/seed"}])"),
            "s: Edits: /0/op: expected add, replace or remove, found \"move\"");
  EXPECT_EQ(WhyNotEdited(R"([{"op": "add", "path": "waft", "value": 1}])"),
            "s: Edits: /0/path: expected a JSON pointer, found \"waft\"");
  EXPECT_EQ(WhyNotEdited(R"([{"op": "replace", "path": "", "value": 1}])"),
            "s: Edits: /0/path: expected a place within the scene, found \"\"");
}

TEST(SceneEdits, NamesWhatAHandMayMove)
{
  std::string text;
  ASSERT_TRUE(DescribeHandles(TypedByHand, "s", text));
  const Json all = Json::parse(text);
  EXPECT_EQ(all["min"], Json({ -2, -2, 0 }));
  EXPECT_EQ(all["frames"], 300);
  EXPECT_EQ(all["lastObject"], 2);
  std::vector<std::string> seen;
  for (const Json& handle : all["handles"])
  {
    seen.push_back(handle["kind"].get<std::string>() + " " + handle["object"].dump() + " " +
                   handle["frame"].dump() + " " + handle["moves"].begin().key());
  }
  const std::vector<std::string> wanted = {
    "start 0 0 /objects/0/position",
    "start 1 0 /objects/1/positions/0",
    "start 2 0 /objects/1/positions/1",
    "mark 0 95 /constraints/0/value",
    "rest 1 200 /constraints/1/value",
    "targets -1 250 /constraints/2/targets/origin",
    "obstacle -1 -1 /obstacles/0/max",
    "corner of obstacle -1 -1 /obstacles/0/min",
    "corner of obstacle -1 -1 /obstacles/0/max",
  };
  EXPECT_EQ(seen, wanted);
  const Json& obstacle = all["handles"][6];
  EXPECT_EQ(obstacle["place"], Json({ 0.5, 0.5, 0.5 }));
  EXPECT_EQ(obstacle["moves"].size(), 2u);
}

TEST(SceneEdits, RegionsVorticesAndWindsHavePlacesAndSizes)
{
  const std::string scene = R"({"waft": 1, "objects": [
    {"shape": "leaf", "count": 3, "region": {"min": [-1, -1, 2.5], "max": [1, 1, 3.5]}}, {"shape": "leaf", "position": [0, 0, 3]}],
    "obstacles": [{"kind": "box", "min": [-3, -0.5, 0], "max": [0, 0.5, 0.01]},
                  {"kind": "cylinder", "base": [1, 1, 0], "top": [1, 1, 1], "radius": 0.1}],
    "vortices": [{"p1": [0, 0, 1], "p2": [0, 1, 3], "strength": 1}],
    "winds": [{"direction": [1, 0, 0], "strength": 1, "center": [0, 0, 2], "radius": 1}, {"file": "w.vti"}]})";
  std::string text;
  ASSERT_TRUE(DescribeHandles(scene, "s", text));
  const Json all = Json::parse(text);
  std::vector<std::string> kinds;
  for (const Json& handle : all["handles"])
  {
    kinds.push_back(handle["kind"]);
  }
  const std::vector<std::string> wanted = { "region",
                                            "corner of region",
                                            "corner of region",
                                            "start",
                                            "obstacle",
                                            "corner of obstacle",
                                            "corner of obstacle",
                                            "obstacle",
                                            "end of obstacle",
                                            "end of obstacle",
                                            "vortex",
                                            "end of vortex",
                                            "end of vortex",
                                            "wind" };
  EXPECT_EQ(kinds, wanted);
  EXPECT_EQ(all["handles"][0]["place"], Json({ 0.0, 0.0, 3.0 }));
  EXPECT_EQ(all["handles"][3]["object"], 3);
  EXPECT_EQ(all["handles"][10]["place"], Json({ 0.0, 0.5, 2.0 }));
  EXPECT_EQ(all["handles"][11]["moves"], Json({ { "/vortices/0/p1", { 0, 0, 1 } } }));
  // The volume is from -2, -2, 0 to 2, 2, 4.
  EXPECT_EQ(all["handles"][1]["least"], Json({ -2.0, -2.0, 0.0 }));
  EXPECT_EQ(all["handles"][1]["most"], Json({ 1 - 0.02, 1 - 0.02, 3.5 - 0.02 }));
  EXPECT_EQ(all["handles"][2]["least"], Json({ -1 + 0.02, -1 + 0.02, 2.5 + 0.02 }));
  EXPECT_EQ(all["handles"][2]["most"], Json({ 2.0, 2.0, 4.0 }));
  // A corner out of the volume may stay there, and a box that is thinner may stay as thin.
  EXPECT_EQ(all["handles"][5]["least"], Json({ -3.0, -2.0, 0.0 }));
  EXPECT_EQ(all["handles"][5]["most"], Json({ 0 - 0.02, 0.5 - 0.02, 0.0 }));
  EXPECT_EQ(all["handles"][6]["least"], Json({ -3 + 0.02, -0.5 + 0.02, 0.01 }));
  EXPECT_FALSE(all["handles"][3].contains("least"));
}

TEST(SceneEdits, EveryHandleOfTheScenesCanBeMoved)
{
  std::size_t moved = 0;
  for (const char* name :
       { "feather-waypoints", "feather-maze", "leaves-word", "scraps-doorway", "bubbles-stairs" })
  {
    const std::string file = std::string(WAFT_SOURCE_DIR) + "/Data/Scenes/" + name + ".waft.json";
    std::string text, handles;
    ASSERT_TRUE(ReadSceneText(file, text));
    ASSERT_TRUE(DescribeHandles(text, file, handles));
    const Json all = Json::parse(handles);
    for (const Json& handle : all["handles"])
    {
      Json edits = Json::array();
      for (const auto& [pointer, point] : handle["moves"].items())
      {
        ASSERT_EQ(Json::parse(text).at(Json::json_pointer(pointer)), point);
        edits.push_back({ { "op", "replace" }, { "path", pointer }, { "value", { 0, 0, 1 } } });
        ++moved;
      }
      EditedText(edits.dump(), text);
    }
  }
  EXPECT_GT(moved, 20u);
}

TEST(SceneEdits, HandlesStandWhereAnObstacleCarriesThem)
{
  std::string text;
  ASSERT_TRUE(DescribeHandles(R"({"waft": 1,
    "objects": [{"shape": "leaf", "position": [0, 0, 1], "on": 0}],
    "obstacles": [{"kind": "sphere", "center": [0, 0, 0], "radius": 1, "motion":
      [{"frame": 0, "position": [0, 1, 0]}, {"frame": 100, "position": [0, 2, 0]}]},
      {"kind": "box", "id": 5, "min": [0, 0, 0], "max": [1, 1, 1]}],
    "constraints": [
      {"kind": "position", "object": 0, "frame": {"from": 20, "to": 50}, "value": [1, 0, 1], "on": 0},
      {"kind": "position", "object": 0, "frame": 150, "value": [1, 0, 1], "on": 0},
      {"kind": "rest", "object": 0, "frame": 160, "value": [1, 0, 1], "on": 5}]})",
                              "s", text));
  const Json all = Json::parse(text)["handles"];
  EXPECT_EQ(all[0]["place"], Json({ 0.0, 1.0, 1.0 }));
  EXPECT_EQ(all[1]["place"], Json({ 1.0, 1.5, 1.0 }));
  EXPECT_EQ(all[1]["frame"], 50);
  EXPECT_EQ(all[1]["moves"]["/constraints/0/value"], Json({ 1, 0, 1 }));
  EXPECT_EQ(all[2]["place"], Json({ 1.0, 2.0, 1.0 }));
  EXPECT_EQ(all[3]["place"], Json({ 1.5, 0.5, 1.5 }));
}
