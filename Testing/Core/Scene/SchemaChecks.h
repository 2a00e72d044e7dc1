// SPDX-License-Identifier: BSD-3-Clause
// The published JSON schema and a validator for the keywords that it uses.
#pragma once

#include "Base/Characters.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <regex>
#include <string>

namespace waft
{

using Json = nlohmann::json;

inline Json LoadJson(const std::string& path)
{
  std::ifstream stream(path);
  return Json::parse(stream);
}

inline const Json& Schema()
{
  static const Json schema =
    LoadJson(std::string(WAFT_SOURCE_DIR) + "/Documentation/scene.schema.json");
  return schema;
}

inline std::wstring Wide(const std::string& text)
{
  std::wstring wide;
  for (std::size_t at = 0; at < text.size(); at += CharacterAt(text, at).Bytes)
  {
    wide += static_cast<wchar_t>(CharacterAt(text, at).Code);
  }
  return wide;
}

inline bool Matches(const std::string& text, const std::string& pattern)
{
  static std::map<std::string, std::wregex> made; // which takes longer than to search
  const auto found = made.try_emplace(pattern, Wide(pattern)).first;
  return std::regex_search(Wide(text), found->second);
}

inline bool HasType(const Json& value, const std::string& type)
{
  return (type == "object" && value.is_object()) || (type == "array" && value.is_array()) ||
         (type == "string" && value.is_string()) || (type == "boolean" && value.is_boolean()) ||
         (type == "number" && value.is_number()) ||
         (type == "integer" && value.is_number() &&
          value.get<double>() == std::floor(value.get<double>()));
}

bool IsValid(const Json& value, const Json& schema);

inline bool IsValidObject(const Json& value, const Json& schema)
{
  for (const Json& name : schema.value("required", Json::array()))
  {
    if (!value.contains(name.get<std::string>()))
    {
      return false;
    }
  }
  if (value.size() > schema.value("maxProperties", std::size_t(1) << 40))
  {
    return false;
  }
  const Json properties = schema.value("properties", Json::object());
  const Json patterns = schema.value("patternProperties", Json::object());
  for (const auto& item : value.items())
  {
    if (schema.contains("propertyNames") && !IsValid(item.key(), schema["propertyNames"]))
    {
      return false;
    }
    bool known = properties.contains(item.key());
    if (known && !IsValid(item.value(), properties[item.key()]))
    {
      return false;
    }
    for (const auto& pattern : patterns.items())
    {
      if (Matches(item.key(), pattern.key()))
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

inline int CountValid(const Json& value, const Json& schemas)
{
  int count = 0;
  for (const Json& schema : schemas)
  {
    count += IsValid(value, schema);
  }
  return count;
}

// The keywords of draft-07 that the schema uses; any other fails the test below.
inline bool IsValid(const Json& value, const Json& schema)
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
           (!schema.contains("pattern") || Matches(text, schema["pattern"].get<std::string>()));
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

/// Pictures cannot be read here; a stand-in's colours are not those that a scene asks for.
inline bool NamesAPicture(const std::string& sceneFile)
{
  return LoadJson(sceneFile).dump().find("\"image\":") != std::string::npos;
}

} // namespace waft
