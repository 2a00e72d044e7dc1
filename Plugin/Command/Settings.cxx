// SPDX-License-Identifier: BSD-3-Clause
#include "Settings.h"

#include "Bridge/Run/FolderBelow.h"
#include "Messages.h"
#include "Scene/SceneNode.h"

#include <toml++/toml.h>

#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

namespace waft::command
{
namespace
{

namespace fs = std::filesystem;

constexpr const char* FileName = "waft.toml";
constexpr std::size_t MostBytes = 1u << 14; // bytes

std::string Variable(const char* name)
{
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

/// The file, be it there or not; empty without a home.
fs::path Place()
{
  const fs::path named = Variable("XDG_CONFIG_HOME");
  if (named.is_absolute()) // others are to be ignored, as the convention has it
  {
    return named / FileName;
  }
  const std::string home = Variable("HOME");
  return home.empty() ? fs::path() : fs::path(home) / ".config" / FileName;
}

Result ReadText(const fs::path& path, std::string& text)
{
  struct stat about = {};
  const std::string expected = "; expected a file of TOML";
  if (::stat(path.c_str(), &about) != 0)
  {
    return Result::Error(path.string() + ": " + std::strerror(errno) + expected);
  }
  if (!KindOf(about).empty())
  {
    return Result::Error(path.string() + ": expected a file of TOML, found " + KindOf(about));
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream)
  {
    return Result::Error(path.string() + ": it may not be opened" + expected);
  }
  text.assign(std::istreambuf_iterator<char>(stream), {});
  return text.size() <= MostBytes
           ? Result::Ok()
           : Result::Error(path.string() + ": expected a file of at most " +
                           std::to_string(MostBytes) + " bytes, found one of " +
                           std::to_string(text.size()) + " or more");
}

/// What a line is about.
std::string KeyOf(const std::string& text, unsigned line)
{
  std::istringstream lines(text);
  std::string found;
  for (unsigned i = 0; i < line && std::getline(lines, found); ++i)
  {
  }
  std::string key = found.substr(0, found.find('='));
  const auto isSpace = [](char letter) { return std::isspace(static_cast<unsigned char>(letter)); };
  key.erase(key.begin(), std::find_if_not(key.begin(), key.end(), isSpace));
  key.erase(std::find_if_not(key.rbegin(), key.rend(), isSpace).base(), key.end());
  return key.empty() ? "(no key)" : Shortened(key, 60);
}

/// What is right of the file, by name.
Result ReadSettings(const fs::path& path, const std::vector<Setting>& settings,
                    std::map<std::string, std::string>& values)
{
  std::error_code failure;
  if (path.empty() || fs::symlink_status(path, failure).type() == fs::file_type::not_found)
  {
    return Result::Ok();
  }
  std::string text;
  WAFT_RETURN_IF_FAILED(ReadText(path, text));
  toml::table table;
  try
  {
    table = toml::parse(text);
  }
  catch (const toml::parse_error& error)
  {
    const unsigned line = error.source().begin.line;
    return Result::Error(
      path.string() + ": line " + std::to_string(line) + ": " + KeyOf(text, line) +
      ": expected TOML such as quality = \"preview\": " + std::string(error.description()));
  }
  for (auto&& [key, value] : table)
  {
    const std::string name(key.str());
    const std::string where =
      path.string() + ": line " + std::to_string(key.source().begin.line) + ": " + name;
    const auto found = std::find_if(settings.begin(), settings.end(),
                                    [&](const Setting& one) { return one.Name == name; });
    if (found == settings.end())
    {
      std::string names;
      for (const Setting& one : settings)
      {
        names += (names.empty() ? "" : ", ") + one.Name;
      }
      return Result::Error(where + ": expected one of " + names + ", found a key of another name");
    }
    std::ostringstream shown;
    shown << toml::node_view<const toml::node>(value);
    const bool isRight = found->IsWhole ? value.is_integer() : value.is_string();
    if (!isRight)
    {
      return Result::Error(where + ": expected " +
                           (found->IsWhole ? "a whole number" : "a text in quotes") + ", found " +
                           Shortened(shown.str(), 100));
    }
    values[name] = found->IsWhole ? shown.str() : value.value_or(std::string());
    const std::string expected = found->Check(values[name]);
    if (!expected.empty())
    {
      return Result::Error(where + ": " + expected);
    }
  }
  return Result::Ok();
}

} // namespace

Result ApplySettings(const std::vector<Setting>& settings, std::string& defaults)
{
  defaults = "{}";
  if (Variable("WAFT_DEFAULTS") == "off")
  {
    return Result::Ok();
  }
  std::map<std::string, std::string> values;
  WAFT_RETURN_IF_FAILED(ReadSettings(Place(), settings, values));
  SceneJson taken = SceneJson::object();
  for (const Setting& setting : settings)
  {
    std::string variable = "WAFT_";
    for (const char letter : setting.Name)
    {
      variable += static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
    }
    const std::string said = Variable(variable.c_str());
    const bool isInFile = values.count(setting.Name) > 0;
    if (!setting.IsOpen || (said.empty() && !isInFile))
    {
      continue;
    }
    const std::string& value = said.empty() ? values[setting.Name] : said;
    const std::string expected = setting.Check(value);
    if (!expected.empty())
    {
      return Result::Error(variable + ": " + expected);
    }
    const std::string meant = setting.Take(value);
    taken[setting.Name] = { { "value",
                              setting.IsWhole ? SceneJson(std::stoll(meant)) : SceneJson(meant) },
                            { "from", said.empty() ? std::string(FileName) : variable } };
  }
  defaults = taken.dump(-1, ' ', false, SceneJson::error_handler_t::replace);
  return Result::Ok();
}

} // namespace waft::command
