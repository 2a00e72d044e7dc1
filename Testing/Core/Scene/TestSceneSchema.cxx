// SPDX-License-Identifier: BSD-3-Clause
// The published schema against the reader: the same fields, and the same answer on good and bad
// scenes.
#include "Scene/SceneFields.h"
#include "Scene/SceneSchema.h"
#include "Scene/WriteScene.h"
#include "SchemaChecks.h"
#include "TestAssets.h"

#include <filesystem>
#include <set>

using namespace waft;

namespace
{

void CollectKeywords(const Json& schema, std::set<std::string>& keywords)
{
  const std::set<std::string> maps = { "properties", "patternProperties", "definitions" };
  for (const auto& item : schema.items())
  {
    keywords.insert(item.key());
    if (maps.count(item.key()))
    {
      for (const auto& child : item.value().items())
      {
        CollectKeywords(child.value(), keywords);
      }
    }
    else if (item.value().is_object())
    {
      CollectKeywords(item.value(), keywords);
    }
    else if (item.value().is_array())
    {
      for (const Json& child : item.value())
      {
        if (child.is_object())
        {
          CollectKeywords(child, keywords);
        }
      }
    }
  }
}

const char* const Everything = R"({"waft": 1, "title": "T", "seed": 3, "_comment": 1,
  "time": {"frames": 60, "framesPerSecond": 25}, "domain": {"min": [-3, -3, 0], "max": [3, 3, 5]},
  "ground": {"height": 0.1, "enabled": true}, "air": {"density": 1.2},
  "shapes": {"leaf": {"builtin": "leaf", "texture": "LICENSE", "size": 0.1, "areaDensity": 0.1,
      "thickness": 0.001, "dragCoefficient": 1.2, "settlingSpeed": 0.8, "color": [1, 0.5, 0],
      "class": "red"}, "own": {"mesh": "LICENSE", "align": true,
      "class": "blue"}},
  "objects": [{"shape": "leaf", "position": [0, 0, 3], "velocity": [0, 0, 0],
      "orientation": [1, 0, 0, 0], "angularVelocity": [0, 0, 1], "mass": 0.001, "id": 0,
      "settlingSpeed": 0.7, "clearanceRadius": 0.06, "restHeight": 0.001, "class": "red"},
    {"shape": "leaf", "count": 5, "region": {"min": [-2, -2, 1], "max": [2, 2, 4]}, "seed": 2},
    {"shape": "own", "positions": [[2, 2, 4], [-2, 2, 4]]}],
  "constraints": [{"kind": "position", "object": 0, "frame": 20, "value": [0, 0, 2], "radius": 0.1,
      "facing": {"direction": [0, -1, 0], "tolerance": 0.3}},
    {"kind": "rest", "object": 0, "frame": 40, "until": 50, "value": [0, 0, 2], "faceUp": "down"},
    {"kind": "velocity", "object": 1, "frame": 20, "value": [0, 0, 0], "radius": 0.1},
    {"kind": "acceleration", "object": 1, "frame": 30, "value": [0, 0, 0], "radius": 0.1},
    {"kind": "orientation", "object": 1, "frame": 20, "value": [1, 0, 0, 0], "radius": 0.1},
    {"kind": "path", "object": 2, "firstFrame": 20, "points": [[0, 0, 1], [0, 0.1, 1]],
     "radius": 0.02},
    {"kind": "keyframe", "frame": 55, "targets": {"text": "L", "font": "sans",
      "origin": [0, 0, 0.2], "u": [1, 0, 0], "v": [0, 1, 0], "width": 2, "count": 4},
      "objects": [3, 4, 5, 6], "assign": "inOrder", "velocity": "rest", "until": 59, "radius": 0,
      "faceUp": "up"},
    {"kind": "keyframe", "frame": 50, "targets": {"points": [[0, 0, 1]],
      "classes": ["blue"]}, "velocity": [0, 0, 1], "facing": {"direction": [0, 0, 1]}},
    {"kind": "keyframe", "frame": 51, "targets": {"image": "LICENSE", "origin": [0, 0, 0.2],
      "u": [1, 0, 0], "v": [0, 1, 0], "width": 2, "count": 4,
      "classes": {"red": [1, 0, 0], "blue": [0, 0, 1]}}},
    {"kind": "keyframe", "frame": 52, "targets": {"mesh": "LICENSE", "origin": [0, 0, 0.2],
      "u": [1, 0, 0], "v": [0, 1, 0], "width": 2, "count": 4}}],
  "obstacles": [{"kind": "box", "min": [2, 2, 0], "max": [3, 3, 1], "id": 9,
      "motion": [{"frame": 0, "position": [0, 0, 0]}, {"frame": 9, "position": [0, 0, 1]}]},
    {"kind": "sphere", "center": [-2, -2, 1], "radius": 0.2},
    {"kind": "cylinder", "base": [2, -2, 0], "top": [2, -2, 1], "radius": 0.2},
    {"kind": "mesh", "file": "LICENSE", "position": [-3, 2, 0], "scale": 0.5}],
  "winds": [{"direction": [1, 0, 0], "strength": 1, "center": [0, 0, 0], "radius": 1,
      "centerTime": 1, "duration": 1}],
  "vortices": [{"p1": [0, 0, 0], "p2": [0, 0, 1], "strength": 1, "centerTime": 1, "duration": 1,
      "coreRadius": 0.1}]})";

bool ReaderAccepts(const Json& json, std::string& message)
{
  Scene scene;
  const Result result = ParseScene(json.dump(), "t", WAFT_SOURCE_DIR, TestAssets(), scene);
  message = result.Message();
  return static_cast<bool>(result);
}

// JSON pointers to all objects inside a value.
void CollectObjects(const Json& value, const Json::json_pointer& at,
                    std::vector<Json::json_pointer>& pointers)
{
  if (value.is_object())
  {
    pointers.push_back(at);
    for (const auto& item : value.items())
    {
      CollectObjects(item.value(), at / item.key(), pointers);
    }
  }
  else if (value.is_array())
  {
    for (std::size_t i = 0; i < value.size(); ++i)
    {
      CollectObjects(value[i], at / i, pointers);
    }
  }
}

void CollectTexts(const Json& value, const Json::json_pointer& at,
                  std::vector<Json::json_pointer>& pointers)
{
  for (auto item = value.begin(); item != value.end(); ++item)
  {
    const Json::json_pointer place =
      value.is_object() ? at / item.key() : at / static_cast<std::size_t>(item - value.begin());
    if (item->is_structured())
    {
      CollectTexts(*item, place, pointers);
    }
    else if (item->is_string())
    {
      pointers.push_back(place);
    }
  }
}

void CollectNumbers(const Json& value, const Json::json_pointer& at,
                    std::vector<Json::json_pointer>& pointers)
{
  for (auto item = value.begin(); item != value.end(); ++item)
  {
    const Json::json_pointer place =
      value.is_object() ? at / item.key() : at / static_cast<std::size_t>(item - value.begin());
    if (item->is_structured())
    {
      CollectNumbers(*item, place, pointers);
    }
    else if (item->is_number() && place.to_string() != "/_comment")
    {
      pointers.push_back(place);
    }
  }
}

} // namespace

TEST(SceneSchema, IsPublishedAsTheReaderHasIt)
{
  std::ifstream file(std::string(WAFT_SOURCE_DIR) + "/Documentation/scene.schema.json");
  const std::string published{ std::istreambuf_iterator<char>(file), {} };
  EXPECT_TRUE(published == SceneSchemaText())
    << "bin/WaftDescribeScenes prints what Documentation/scene.schema.json is to be";
}

// A field left out is read as one that has its default.
TEST(SceneSchema, StatesTheDefaultsThatTheReaderHas)
{
  const Json scene = Json::parse(Everything);
  const auto read = [](const Json& json)
  {
    Scene result;
    EXPECT_TRUE(ParseScene(json.dump(), "t", WAFT_SOURCE_DIR, TestAssets(), result));
    result.Authored = {}; // what it says, not how
    for (Shape& shape : result.Shapes)
    {
      shape.Authored.clear();
    }
    SceneText text;
    const Result written = FormatScene(result, TestAssets(), WAFT_SOURCE_DIR, "t", text);
    EXPECT_TRUE(written) << written.Message();
    return text.Json;
  };
  int defaults = 0;
  const auto compare = [&](const std::string& kind, const std::string& place)
  {
    const Json::json_pointer at(place);
    for (const SceneField& field : SceneFieldsOf(kind).Fields)
    {
      if (field.Default.empty())
      {
        continue;
      }
      SCOPED_TRACE(place + "/" + field.Name);
      Json without = scene;
      without[at].erase(field.Name);
      Json with = scene;
      with[at][field.Name] = Json::parse(field.Default);
      EXPECT_EQ(read(without), read(with));
      ++defaults;
    }
  };
  compare("scene", "");
  compare("time", "/time");
  compare("domain", "/domain");
  compare("ground", "/ground");
  compare("air", "/air");
  compare("shape", "/shapes/own");
  compare("positionConstraint", "/constraints/0");
  compare("facing", "/constraints/0/facing");
  compare("restConstraint", "/constraints/1");
  compare("velocityConstraint", "/constraints/2");
  compare("accelerationConstraint", "/constraints/3");
  compare("orientationConstraint", "/constraints/4");
  compare("pathConstraint", "/constraints/5");
  compare("textTargets", "/constraints/6/targets");
  compare("imageTargets", "/constraints/8/targets");
  compare("meshTargets", "/constraints/9/targets");
  compare("meshObstacle", "/obstacles/3");
  EXPECT_GT(defaults, 20);
}

TEST(SceneSchema, RefusesAListThatIsTooLong)
{
  const auto refusal = [](const char* place, const Json& value)
  {
    Json scene = Json::parse(Everything);
    scene[Json::json_pointer(place)] = value;
    EXPECT_FALSE(IsValid(scene, Schema()));
    std::string message;
    EXPECT_FALSE(ReaderAccepts(scene, message));
    return message;
  };
  const Json scene = Json::parse(Everything);
  EXPECT_EQ(refusal("/winds", Json(1001, scene["winds"][0])),
            "t: /winds: expected at most 1000 entries, found 1001");
  EXPECT_EQ(refusal("/objects/2/positions", Json(20001, Json{ 0, 0, 3 })),
            "t: /objects/2/positions: expected at most 20000 entries, found 20001");
  Json shapes;
  for (int i = 0; i <= 1000; ++i)
  {
    shapes["s" + std::to_string(i)] = scene["shapes"]["leaf"];
  }
  EXPECT_EQ(refusal("/shapes", shapes), "t: /shapes: expected at most 1000 fields, found 1001");
}

TEST(SceneSchema, RefusesObjectsAndRowsThatAreTooManyInAll)
{
  Json scene = Json::parse(Everything);
  const Json many = { { "shape", "leaf" }, { "positions", Json(15000, Json{ 0, 0, 3 }) } };
  scene["objects"] = { many, many };
  std::string message;
  EXPECT_FALSE(ReaderAccepts(scene, message));
  EXPECT_EQ(message, "t: /objects/1: expected at most 20000 objects in a scene, found more");
  scene = Json::parse(Everything);
  scene["time"]["frames"] = 60000;
  const Json path = { { "kind", "path" },
                      { "object", 2 },
                      { "firstFrame", 0 },
                      { "points", Json(60000, Json{ 0, 0, 1 }) } };
  scene["constraints"] = { path, path };
  EXPECT_FALSE(ReaderAccepts(scene, message));
  EXPECT_EQ(message, "t: /constraints/1: expected constraints of at most 100000 points and targets "
                     "in all, found more");
}

TEST(SceneSchema, RefusesNumbersBeyondTheirBoundsAsTheReaderDoes)
{
  const Json scene = Json::parse(Everything);
  std::vector<Json::json_pointer> pointers;
  CollectNumbers(scene, Json::json_pointer(), pointers);
  EXPECT_GT(pointers.size(), 150u);
  for (const Json::json_pointer& place : pointers)
  {
    for (const double number : { 1e308, -1e308, 3e16, -3e16 })
    {
      Json changed = scene;
      changed[place] = number;
      std::string message;
      EXPECT_FALSE(ReaderAccepts(changed, message)) << place << " " << number;
      EXPECT_EQ(message.find("t: " + place.to_string() + ": expected "), 0u) << message;
      EXPECT_FALSE(IsValid(changed, Schema())) << place << " " << number;
    }
  }
}

TEST(SceneSchema, UsesOnlyKeywordsThatThisTestUnderstands)
{
  std::set<std::string> keywords;
  CollectKeywords(Schema(), keywords);
  const std::set<std::string> known = { "$schema",
                                        "format",
                                        "title",
                                        "description",
                                        "default",
                                        "definitions",
                                        "type",
                                        "required",
                                        "const",
                                        "properties",
                                        "enum",
                                        "patternProperties",
                                        "additionalProperties",
                                        "items",
                                        "minItems",
                                        "maxItems",
                                        "maxProperties",
                                        "minimum",
                                        "exclusiveMinimum",
                                        "maximum",
                                        "minLength",
                                        "maxLength",
                                        "pattern",
                                        "propertyNames",
                                        "$ref",
                                        "oneOf",
                                        "anyOf",
                                        "allOf",
                                        "if",
                                        "then",
                                        "else" };
  for (const std::string& keyword : keywords)
  {
    EXPECT_TRUE(known.count(keyword)) << keyword;
  }
}

TEST(SceneSchema, AcceptsASceneWithEveryFieldAsTheReaderDoes)
{
  const Json scene = Json::parse(Everything);
  std::string message;
  EXPECT_TRUE(ReaderAccepts(scene, message)) << message;
  EXPECT_TRUE(IsValid(scene, Schema()));
}

TEST(SceneSchema, RefusesControlsInEveryTextAsTheReaderDoes)
{
  const Json scene = Json::parse(Everything);
  std::vector<Json::json_pointer> pointers;
  CollectTexts(scene, Json::json_pointer(), pointers);
  EXPECT_GT(pointers.size(), 25u);
  const char* controls[] = { "\n", "\x01", "\xC2\x85", "\xE2\x80\xAE", "\xEF\xBF\xBE" };
  std::size_t next = 0;
  for (const Json::json_pointer& place : pointers)
  {
    const char* control = place.back() == "text" ? "\n" : controls[next++ % 5];
    Json changed = scene;
    changed[place] = scene.at(place).get<std::string>() + control;
    std::string message;
    const bool isDrawn = place.back() == "text";
    EXPECT_EQ(ReaderAccepts(changed, message), isDrawn) << place << " " << message;
    EXPECT_EQ(IsValid(changed, Schema()), isDrawn) << place;
  }
}

TEST(SceneSchema, RefusesWhatTheReaderRefuses)
{
  const Json scene = Json::parse(Everything);
  std::vector<Json::json_pointer> pointers;
  CollectObjects(scene, Json::json_pointer(), pointers);
  int refused = 0;
  for (const Json::json_pointer& place : pointers)
  {
    if (place.to_string() == "/shapes" || place.to_string().find("classes") != std::string::npos)
    {
      continue; // names are free here
    }
    const Json original = scene.at(place);
    for (const auto& item : original.items())
    {
      // Each field in turn misspelt, missing, and of a type that no field has.
      for (const int change : { 0, 1, 2 })
      {
        if (item.key().front() == '_')
        {
          continue;
        }
        Json changed = scene;
        changed[place].erase(item.key());
        if (change == 0)
        {
          changed[place][item.key() + "x"] = item.value();
        }
        else if (change == 2)
        {
          changed[place][item.key()] = nullptr;
        }
        std::string message;
        const bool accepted = ReaderAccepts(changed, message);
        // What hangs together across the file (ids, frames, classes) only the reader knows.
        const bool across = message.find("the id of an object") != std::string::npos ||
                            message.find("the name of a shape") != std::string::npos ||
                            message.find("class") != std::string::npos;
        if (across)
        {
          continue;
        }
        refused += !accepted;
        EXPECT_EQ(IsValid(changed, Schema()), accepted)
          << place << " " << item.key() << " change " << change << ": " << message;
      }
    }
  }
  EXPECT_GT(refused, 200);
}

TEST(SceneSchema, AcceptsTheScenesOfTheProject)
{
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(WAFT_SOURCE_DIR) + "/Data/Scenes"))
  {
    if (entry.path().extension() == ".json")
    {
      EXPECT_TRUE(IsValid(LoadJson(entry.path().string()), Schema())) << entry.path();
      if (NamesAPicture(entry.path().string()))
      {
        continue;
      }
      Scene scene;
      const Result result = ReadScene(entry.path().string(), TestAssets(), scene);
      EXPECT_TRUE(result) << result.Message();
      EXPECT_TRUE(scene.Warnings.empty());
    }
  }
}
