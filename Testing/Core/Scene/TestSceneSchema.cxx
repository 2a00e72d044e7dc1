// SPDX-License-Identifier: BSD-3-Clause
// The published schema against the reader: the same fields, and the same answer on good and bad
// scenes.
#include "Scene/SceneFields.h"
#include "TestAssets.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

using namespace waft;
using Json = nlohmann::json;

namespace
{

Json LoadJson(const std::string& path)
{
  std::ifstream stream(path);
  return Json::parse(stream);
}

const Json& Schema()
{
  static const Json schema =
    LoadJson(std::string(WAFT_SOURCE_DIR) + "/Documentation/scene.schema.json");
  return schema;
}

bool HasType(const Json& value, const std::string& type)
{
  return (type == "object" && value.is_object()) || (type == "array" && value.is_array()) ||
         (type == "string" && value.is_string()) || (type == "boolean" && value.is_boolean()) ||
         (type == "number" && value.is_number()) ||
         (type == "integer" && value.is_number() &&
          value.get<double>() == std::floor(value.get<double>()));
}

bool IsValid(const Json& value, const Json& schema);

bool IsValidObject(const Json& value, const Json& schema)
{
  for (const Json& name : schema.value("required", Json::array()))
  {
    if (!value.contains(name.get<std::string>()))
    {
      return false;
    }
  }
  const Json properties = schema.value("properties", Json::object());
  const Json patterns = schema.value("patternProperties", Json::object());
  for (const auto& item : value.items())
  {
    bool known = properties.contains(item.key());
    if (known && !IsValid(item.value(), properties[item.key()]))
    {
      return false;
    }
    for (const auto& pattern : patterns.items())
    {
      if (std::regex_search(item.key(), std::regex(pattern.key())))
      {
        known = true;
        if (!IsValid(item.value(), pattern.value()))
        {
          return false;
        }
      }
    }
    if (!known && schema.contains("additionalProperties"))
    {
      const Json& rest = schema["additionalProperties"];
      if (rest.is_boolean() ? !rest.get<bool>() : !IsValid(item.value(), rest))
      {
        return false;
      }
    }
  }
  return true;
}

int CountValid(const Json& value, const Json& schemas)
{
  int count = 0;
  for (const Json& schema : schemas)
  {
    count += IsValid(value, schema);
  }
  return count;
}

// The keywords of draft-07 that the schema uses; any other fails the test below.
bool IsValid(const Json& value, const Json& schema)
{
  if (schema.contains("$ref"))
  {
    const std::string ref = schema["$ref"];
    return IsValid(value, Schema().at(Json::json_pointer(ref.substr(1))));
  }
  if (schema.contains("if"))
  {
    const char* branch = IsValid(value, schema["if"]) ? "then" : "else";
    if (schema.contains(branch) && !IsValid(value, schema[branch]))
    {
      return false;
    }
  }
  if ((schema.contains("type") && !HasType(value, schema["type"])) ||
      (schema.contains("const") && value != schema["const"]) ||
      (schema.contains("enum") &&
       std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end()) ||
      (schema.contains("oneOf") && CountValid(value, schema["oneOf"]) != 1) ||
      (schema.contains("anyOf") && CountValid(value, schema["anyOf"]) == 0) ||
      (schema.contains("allOf") &&
       CountValid(value, schema["allOf"]) != static_cast<int>(schema["allOf"].size())))
  {
    return false;
  }
  if (value.is_number())
  {
    const double number = value;
    return number >= schema.value("minimum", -1e300) && number <= schema.value("maximum", 1e300) &&
           number > schema.value("exclusiveMinimum", -1e300);
  }
  if (value.is_string())
  {
    const std::string text = value;
    return text.size() >= schema.value("minLength", 0u) &&
           (!schema.contains("pattern") ||
            std::regex_search(text, std::regex(schema["pattern"].get<std::string>())));
  }
  if (value.is_array())
  {
    if (value.size() < schema.value("minItems", std::size_t(0)) ||
        value.size() > schema.value("maxItems", std::size_t(1) << 40))
    {
      return false;
    }
    return !schema.contains("items") ||
           std::all_of(value.begin(), value.end(),
                       [&](const Json& item) { return IsValid(item, schema["items"]); });
  }
  return !value.is_object() || IsValidObject(value, schema);
}

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

std::set<std::string> KeysOf(const Json& object)
{
  std::set<std::string> keys;
  for (const auto& item : object.items())
  {
    keys.insert(item.key());
  }
  return keys;
}

const char* const Everything = R"({"waft": 1, "title": "T", "seed": 3, "_comment": 1,
  "time": {"frames": 60, "framesPerSecond": 25}, "domain": {"min": [-3, -3, 0], "max": [3, 3, 5]},
  "ground": {"height": 0.1, "enabled": true}, "air": {"density": 1.2},
  "shapes": {"leaf": {"builtin": "leaf", "texture": "LICENSE", "size": 0.1, "areaDensity": 0.1,
      "thickness": 0.001, "dragCoefficient": 1.2, "settlingSpeed": 0.8, "color": [1, 0.5, 0],
      "class": "red"}, "own": {"mesh": "LICENSE", "class": "blue"}},
  "objects": [{"shape": "leaf", "position": [0, 0, 3], "velocity": [0, 0, 0],
      "orientation": [1, 0, 0, 0], "angularVelocity": [0, 0, 1], "mass": 0.001},
    {"shape": "leaf", "count": 5, "region": {"min": [-2, -2, 1], "max": [2, 2, 4]}, "seed": 2},
    {"shape": "own", "positions": [[2, 2, 4], [-2, 2, 4]]}],
  "constraints": [{"kind": "position", "object": 0, "frame": 20, "value": [0, 0, 2], "radius": 0.1},
    {"kind": "rest", "object": 0, "frame": 40, "until": 50, "value": [0, 0, 2]},
    {"kind": "velocity", "object": 1, "frame": 20, "value": [0, 0, 0], "radius": 0.1},
    {"kind": "acceleration", "object": 1, "frame": 30, "value": [0, 0, 0], "radius": 0.1},
    {"kind": "orientation", "object": 1, "frame": 20, "value": [1, 0, 0, 0], "radius": 0.1},
    {"kind": "path", "object": 2, "firstFrame": 20, "points": [[0, 0, 1], [0, 0.1, 1]],
     "radius": 0.02},
    {"kind": "keyframe", "frame": 55, "targets": {"text": "L", "font": "sans",
      "origin": [0, 0, 0.2], "u": [1, 0, 0], "v": [0, 1, 0], "width": 2, "count": 4},
      "objects": [3, 4, 5, 6], "assign": "inOrder", "velocity": "rest", "until": 59, "radius": 0},
    {"kind": "keyframe", "frame": 50, "targets": {"points": [[0, 0, 1]]}, "velocity": [0, 0, 1]},
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

// All places of objects inside a value.
void CollectObjects(const Json& value, const Json::json_pointer& at,
                    std::vector<Json::json_pointer>& places)
{
  if (value.is_object())
  {
    places.push_back(at);
    for (const auto& item : value.items())
    {
      CollectObjects(item.value(), at / item.key(), places);
    }
  }
  else if (value.is_array())
  {
    for (std::size_t i = 0; i < value.size(); ++i)
    {
      CollectObjects(value[i], at / i, places);
    }
  }
}

} // namespace

TEST(SceneSchema, HasTheFieldsOfTheReader)
{
  std::set<std::string> tables;
  for (const SceneFieldTable& table : SceneFieldTables())
  {
    SCOPED_TRACE(table.Name);
    tables.insert(table.Name);
    const Json& schema = table.Name == "scene" ? Schema() : Schema()["definitions"][table.Name];
    EXPECT_EQ(KeysOf(schema["properties"]),
              std::set<std::string>(table.Fields.begin(), table.Fields.end()));
    EXPECT_EQ(schema["additionalProperties"], Json(false));
    EXPECT_TRUE(schema["patternProperties"].contains("^_"));
  }
  for (const auto& definition : Schema()["definitions"].items())
  {
    if (definition.value().contains("additionalProperties"))
    {
      EXPECT_TRUE(tables.count(definition.key())) << definition.key();
    }
  }
}

TEST(SceneSchema, UsesOnlyKeywordsThatThisTestUnderstands)
{
  std::set<std::string> keywords;
  CollectKeywords(Schema(), keywords);
  const std::set<std::string> known = { "$schema",
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
                                        "minimum",
                                        "exclusiveMinimum",
                                        "maximum",
                                        "minLength",
                                        "pattern",
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

TEST(SceneSchema, RefusesWhatTheReaderRefuses)
{
  const Json scene = Json::parse(Everything);
  std::vector<Json::json_pointer> places;
  CollectObjects(scene, Json::json_pointer(), places);
  int refused = 0;
  for (const Json::json_pointer& place : places)
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
      Scene scene;
      const Result result = ReadScene(entry.path().string(), TestAssets(), scene);
      EXPECT_TRUE(result) << result.Message();
      EXPECT_TRUE(scene.Warnings.empty());
    }
  }
}
