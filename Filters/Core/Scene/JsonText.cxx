// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/JsonText.h"

#include <algorithm>
#include <set>

namespace waft
{

namespace
{

constexpr std::size_t LongestLine = 100;
// Of an object, comments among them: the library looks for each new one among those before.
constexpr std::size_t MostFields = 10000;

// "line 3, column 7" of a byte of the text.
std::string LineAndColumn(const std::string& text, std::size_t byte)
{
  std::size_t line = 1;
  std::size_t column = 1;
  for (std::size_t i = 0; i + 1 < byte && i < text.size(); ++i)
  {
    ++column;
    if (text[i] == '\n')
    {
      ++line;
      column = 1;
    }
  }
  return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

// The library's own words behind "[json.exception.parse_error.101] parse error at line 1, column 2:
// ".
std::string Reason(const std::string& what)
{
  const std::size_t column = what.find("column ");
  const std::size_t colon = what.find(": ", column == std::string::npos ? 0 : column);
  return colon == std::string::npos ? what : what.substr(colon + 2);
}

// Where a parser stands in a text, and the fields that it met in the objects around it.
class ParserPosition
{
public:
  /// False at a field that its object had before.
  bool Pass(SceneJson::parse_event_t event, const SceneJson& value)
  {
    using Event = SceneJson::parse_event_t;
    if (event == Event::key)
    {
      this->Levels.back().Field = value.get<std::string>();
      return this->Levels.back().Fields.insert(this->Levels.back().Field).second;
    }
    if (event == Event::object_end || event == Event::array_end)
    {
      this->Levels.pop_back();
      return true;
    }
    if (!this->Levels.empty() && this->Levels.back().IsList)
    {
      ++this->Levels.back().Index;
    }
    if (event == Event::object_start || event == Event::array_start)
    {
      this->Levels.push_back({ event == Event::array_start, 0, {}, {} });
    }
    return true;
  }

  std::string Pointer() const
  {
    std::string pointer;
    for (const Level& level : this->Levels)
    {
      pointer += "/" + (level.IsList ? std::to_string(level.Index - 1) : PointerToken(level.Field));
    }
    return pointer;
  }
  const std::string& Field() const { return this->Levels.back().Field; }
  bool HasTooMany() const
  {
    return !this->Levels.empty() && this->Levels.back().Fields.size() > MostFields;
  }

private:
  struct Level
  {
    bool IsList;
    std::size_t Index; // one past the element
    std::string Field;
    std::set<std::string> Fields;
  };
  std::vector<Level> Levels;
};

/// Blanks behind commas and colons outside of texts.
std::string Spaced(const std::string& flat)
{
  std::string text;
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
  return text;
}

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
    text += Spaced(flat);
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

SceneJson ParseText(const std::string& text, const std::string& name)
{
  // A field that stands twice in an object would silently win or lose.
  ParserPosition position;
  const auto refuseTwice = [&](int depth, SceneJson::parse_event_t event, SceneJson& value)
  {
    if (IsTooDeep(depth, event))
    {
      return false;
    }
    if (position.HasTooMany())
    {
      throw SceneError{ name + ": " + position.Pointer() + ": expected at most " +
                        std::to_string(MostFields) + " fields in an object, found more" };
    }
    if (!position.Pass(event, value))
    {
      throw SceneError{ name + ": " + position.Pointer() +
                        ": expected every field of an object once, found \"" +
                        Shortened(position.Field()) + "\" twice" };
    }
    return true;
  };
  try
  {
    return SceneJson::parse(text, refuseTwice);
  }
  catch (const SceneJson::parse_error& error)
  {
    throw SceneError{ name + ": " + LineAndColumn(text, error.byte) + ": expected JSON, " +
                      Reason(error.what()) };
  }
  catch (const SceneJson::out_of_range& error) // "... number overflow parsing '1e999'"
  {
    const std::string what = error.what();
    const std::size_t quote = what.find('\'');
    const std::string number =
      quote == std::string::npos ? what : what.substr(quote + 1, what.rfind('\'') - quote - 1);
    const std::size_t at = std::min(text.find(number), text.size());
    throw SceneError{ name + ": " + LineAndColumn(text, at + 1) +
                      ": expected a finite number, found " + number };
  }
}

std::string PrettyText(const SceneJson& json)
{
  std::string text;
  Print(json, 0, text);
  return text + "\n";
}

std::string OneLine(const SceneJson& json)
{
  return Spaced(json.dump());
}

} // namespace waft
