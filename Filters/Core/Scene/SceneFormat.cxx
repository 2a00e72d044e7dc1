// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/SceneFormat.h"

#include "Base/Characters.h"

#include <algorithm>

namespace waft
{

namespace
{

constexpr std::size_t LongestLine = 100;

void Print(const SceneJson& json, std::size_t indent, std::string& text)
{
  const std::string flat = json.dump();
  const bool isList =
    json.is_array() &&
    std::none_of(json.begin(), json.end(), [](const SceneJson& item) { return item.is_object(); });
  if (!json.is_structured() || json.empty() ||
      (flat.size() + indent <= LongestLine && (isList || json.is_object()) && indent > 0) ||
      (isList && !json.front().is_structured()))
  {
    // Blanks behind commas and colons outside of texts.
    bool inText = false;
    for (std::size_t i = 0; i < flat.size(); ++i)
    {
      text += flat[i];
      inText ^= flat[i] == '"';
      if (inText && flat[i] == '\\' && i + 1 < flat.size())
      {
        text += flat[++i];
      }
      else if (!inText && (flat[i] == ',' || flat[i] == ':'))
      {
        text += ' ';
      }
    }
    return;
  }
  const std::string blanks(indent + 2, ' ');
  text += json.is_array() ? "[\n" : "{\n";
  bool isFirst = true;
  for (const auto& item : json.items())
  {
    text += isFirst ? "" : ",\n";
    isFirst = false;
    text += blanks + (json.is_array() ? "" : SceneJson(item.key()).dump() + ": ");
    Print(item.value(), indent + 2, text);
  }
  text += "\n" + std::string(indent, ' ') + (json.is_array() ? "]" : "}");
}

} // namespace

SceneJson FormatVector(const Vec3& v)
{
  return SceneJson::array({ v.x(), v.y(), v.z() });
}

SceneJson FormatRotation(const Quat& q)
{
  return SceneJson::array({ q.w(), q.x(), q.y(), q.z() });
}

std::string PrettyText(const SceneJson& json)
{
  std::string text;
  Print(json, 0, text);
  return text + "\n";
}

void RequireName(const std::string& name, const std::string& owner)
{
  const std::string control = FirstControl(name);
  if (!control.empty())
  {
    throw SceneError{ owner + ": expected a name without control characters and marks that turn " +
                      "the direction of writing, found " + control };
  }
}

bool IsReadable(const std::function<void()>& read)
{
  try
  {
    read();
    return true;
  }
  catch (const SceneError&)
  {
    return false;
  }
}

} // namespace waft
