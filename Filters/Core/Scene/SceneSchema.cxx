// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/SceneSchema.h"

#include "Scene/JsonText.h"
#include "Scene/SceneFields.h"

#include <cmath>
#include <cstdint>

namespace waft
{

namespace
{

// Base/Characters.h has them for the reader.
constexpr const char* Controls =
  R"(\u007f-\u009f\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069\ufffe\uffff])";
constexpr const char* PlainText =
  "a text without control characters and marks that turn the direction of writing";

std::string NamePattern()
{
  return std::string(R"(^(?![\s\S]*[\u0000-\u001f)") + Controls + ")";
}

std::string LinesPattern() // with line feeds
{
  return std::string(R"(^(?![\s\S]*[\u0000-\u0009\u000b-\u001f)") + Controls + ")";
}

SceneJson Reference(const std::string& part)
{
  return { { "$ref", "#/definitions/" + part } };
}

SceneJson NumberJson(double number)
{
  return number == std::floor(number) ? SceneJson(static_cast<std::int64_t>(number))
                                      : SceneJson(number);
}

SceneJson NumberSchema(const char* type, const limits::Range& range)
{
  return { { "type", type },
           { "minimum", NumberJson(range.Low) },
           { "maximum", NumberJson(range.High) } };
}

SceneJson NumbersSchema(const limits::Range& range, int count)
{
  return { { "type", "array" },
           { "items", NumberSchema("number", range) },
           { "minItems", count },
           { "maxItems", count } };
}

SceneJson TextSchema(const SceneField& field)
{
  SceneJson text{ { "type", "string" } };
  if (field.MostLetters != SceneField::NoList)
  {
    text["minLength"] = 1;
    text["maxLength"] = field.MostLetters;
  }
  if (field.Holds == SceneValue::Lines)
  {
    text["pattern"] = LinesPattern();
    text["description"] = PlainText;
    return text;
  }
  if (field.Holds != SceneValue::Name)
  {
    text["format"] = field.Holds == SceneValue::Font ? "font" : "file";
  }
  if (!field.Words.empty())
  {
    std::string endings;
    for (const std::string& ending : field.Words)
    {
      endings += (endings.empty() ? "" : "|") + ending;
    }
    text["pattern"] = "\\.(" + endings + ")$";
  }
  text["allOf"] = { Reference("name") };
  return text;
}

/// Or an object in the place of the value.
SceneJson OrPart(const SceneJson& value, const std::string& part)
{
  return part.empty() ? value : SceneJson{ { "anyOf", { value, Reference(part) } } };
}

/// Of one of what a field holds.
SceneJson ValueSchema(const SceneField& field)
{
  switch (field.Holds)
  {
    case SceneValue::Number:
      return NumberSchema("number", *field.Range);
    case SceneValue::Whole:
      return field.Range->Low == field.Range->High
               ? SceneJson{ { "const", NumberJson(field.Range->Low) } }
               : OrPart(NumberSchema("integer", *field.Range), field.Part);
    case SceneValue::Flag:
      return { { "type", "boolean" } };
    case SceneValue::Word:
      return field.Words.size() == 1 ? SceneJson{ { "const", field.Words[0] } }
                                     : OrPart(SceneJson{ { "enum", field.Words } }, field.Part);
    case SceneValue::Vector:
    {
      const SceneJson vector = NumbersSchema(*field.Range, 3);
      return field.Words.empty()
               ? vector
               : SceneJson{ { "anyOf", { SceneJson{ { "enum", field.Words } }, vector } } };
    }
    case SceneValue::Quaternion:
      return NumbersSchema(*field.Range, 4);
    case SceneValue::Color:
      return NumbersSchema(*field.Range, 3);
    case SceneValue::Part:
      return Reference(field.Part);
    case SceneValue::Name:
    case SceneValue::Lines:
    case SceneValue::File:
    case SceneValue::Font:
      break;
  }
  return TextSchema(field);
}

SceneJson FieldSchema(const SceneField& field)
{
  SceneJson schema = ValueSchema(field);
  if (field.Count == SceneCount::List)
  {
    schema = SceneJson{ { "type", "array" }, { "items", schema } };
    if (field.Fewest > 0)
    {
      schema["minItems"] = field.Fewest;
    }
    schema["maxItems"] = field.Most;
  }
  else if (field.Count == SceneCount::OneOrList)
  {
    schema["anyOf"].push_back({ { "type", "array" },
                                { "items", NumberSchema("integer", *field.Range) },
                                { "maxItems", field.Most } });
  }
  else if (field.Count == SceneCount::Named)
  {
    schema = { { "type", "object" },
               { "propertyNames", Reference("name") },
               { "patternProperties", { { "^_", SceneJson::object() } } },
               { "additionalProperties", schema },
               { "maxProperties", field.Most } };
  }
  if (!field.Default.empty())
  {
    schema["default"] = SceneJson::parse(field.Default);
  }
  if (!field.Sentence.empty())
  {
    if (schema.contains("$ref")) // beside which draft-07 hears nothing
    {
      schema = { { "allOf", SceneJson::array({ schema }) } };
    }
    schema["description"] = field.Sentence;
  }
  return schema;
}

/// What fields of one object ask of each other.
SceneJson Together(const std::string& table)
{
  if (table == "shape")
  {
    return SceneJson::parse(R"({"oneOf": [{"required": ["builtin"]}, {"required": ["mesh"]}],
      "if": {"required": ["align"]}, "then": {"required": ["mesh"]}})");
  }
  const bool isKeyframe = table == "keyframeConstraint";
  if (!isKeyframe && table != "positionConstraint" && table != "restConstraint")
  {
    return SceneJson::object();
  }
  SceneJson all = SceneJson::parse(R"([
    {"if": {"properties": {"order": {"const": "air"}}},
     "else": {"properties": {"frame": {"type": "object"}}}},
    {"if": {"properties": {"spread": {"const": "even"}}}, "else": {"required": ["order"]}}])");
  if (table != "restConstraint")
  {
    all.push_back(SceneJson::parse(R"(
      {"if": {"properties": {"hold": {"const": 0}}},
       "else": {"properties": {"radius": {"const": 0}, "velocity": {"const": "none"}}}})"));
  }
  if (isKeyframe)
  {
    all.push_back(SceneJson::parse(R"(
      {"if": {"anyOf": [{"required": ["until"]}, {"required": ["faceUp"]}]},
       "then": {"required": ["velocity"], "properties": {"velocity": {"const": "rest"}}}})"));
    all.push_back(SceneJson::parse(R"(
      {"if": {"required": ["facing"]},
       "then": {"properties": {"velocity": {"anyOf": [{"const": "none"}, {"type": "array"}]}}}})"));
  }
  return { { "allOf", all } };
}

SceneJson TableSchema(const SceneFieldTable& table)
{
  SceneJson schema{ { "type", "object" } };
  if (!table.Sentence.empty())
  {
    schema["description"] = table.Sentence;
  }
  SceneJson required = SceneJson::array();
  for (const SceneField& field : table.Fields)
  {
    schema["properties"][field.Name] = FieldSchema(field);
    if (field.IsRequired)
    {
      required.push_back(field.Name);
    }
  }
  if (!required.empty())
  {
    schema["required"] = required;
  }
  schema["patternProperties"] = { { "^_", SceneJson::object() } };
  schema["additionalProperties"] = false;
  schema.update(Together(table.Name));
  return schema;
}

bool EndsWith(const std::string& text, const std::string& end)
{
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// An entry whose field `kind` says which of the tables of this ending it is.
SceneJson OneOfKinds(const std::string& ending)
{
  SceneJson kinds = SceneJson::array();
  SceneJson choices = SceneJson::array();
  for (const SceneFieldTable& table : SceneFieldTables())
  {
    if (EndsWith(table.Name, ending))
    {
      const std::string& kind = table.Find("kind")->Words[0];
      kinds.push_back(kind);
      choices.push_back({ { "if", { { "properties", { { "kind", { { "const", kind } } } } } } },
                          { "then", Reference(table.Name) } });
    }
  }
  return { { "type", "object" },
           { "required", { "kind" } },
           { "properties", { { "kind", { { "enum", kinds } } } } },
           { "allOf", choices } };
}

/// What is one of several kinds of object, told by the fields that it has.
SceneJson Choices()
{
  SceneJson choices = SceneJson::parse(R"({
    "object": {
      "if": {"anyOf": [{"required": ["count"]}, {"required": ["region"]}]},
      "then": {"$ref": "#/definitions/objectsInRegion"},
      "else": {"if": {"required": ["positions"]}, "then": {"$ref": "#/definitions/objectsAtPositions"},
               "else": {"$ref": "#/definitions/singleObject"}}},
    "targets": {"oneOf": [{"$ref": "#/definitions/pointTargets"}, {"$ref": "#/definitions/textTargets"},
      {"$ref": "#/definitions/imageTargets"}, {"$ref": "#/definitions/meshTargets"}]},
    "wind": {"if": {"required": ["file"]}, "then": {"$ref": "#/definitions/windFile"},
             "else": {"if": {"required": ["kind"]}, "then": {"$ref": "#/definitions/windFront"},
                      "else": {"$ref": "#/definitions/analyticWind"}}}})");
  choices["constraint"] = OneOfKinds("Constraint");
  choices["obstacle"] = OneOfKinds("Obstacle");
  return choices;
}

} // namespace

std::string SceneSchemaText()
{
  SceneJson schema{ { "$schema", "http://json-schema.org/draft-07/schema#" },
                    { "title", "Waft scene, version 1" },
                    { "description",
                      "Metres, seconds, kilograms, radians; z is up; frames are numbered from 0. "
                      "Fields that begin with _ are comments." } };
  SceneJson definitions{
    { "name", { { "type", "string" }, { "pattern", NamePattern() }, { "description", PlainText } } }
  };
  definitions.update(Choices());
  for (const SceneFieldTable& table : SceneFieldTables())
  {
    if (table.Name == "scene")
    {
      schema.update(TableSchema(table));
    }
    else
    {
      definitions[table.Name] = TableSchema(table);
    }
  }
  schema["definitions"] = definitions;
  return PrettyText(schema);
}

} // namespace waft
