// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/Scene.h"
#include "Scene/SceneReader.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

namespace waft
{

namespace
{

constexpr int MostFrames = 1000000;

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

SceneJson ParseText(const std::string& text, const std::string& name)
{
  // A field that stands twice in an object would silently win or lose.
  std::vector<std::set<std::string>> fields;
  const auto refuseTwice = [&](int, SceneJson::parse_event_t event, SceneJson& value)
  {
    if (event == SceneJson::parse_event_t::object_start)
    {
      fields.emplace_back();
    }
    else if (event == SceneJson::parse_event_t::object_end)
    {
      fields.pop_back();
    }
    else if (event == SceneJson::parse_event_t::key &&
             !fields.back().insert(value.get<std::string>()).second)
    {
      throw SceneError{ name + ": expected every field of an object once, found " + value.dump() +
                        " twice" };
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
    const std::size_t place = std::min(text.find(number), text.size());
    throw SceneError{ name + ": " + LineAndColumn(text, place + 1) +
                      ": expected a finite number, found " + number };
  }
}

} // namespace

int SceneReader::Frame(const SceneNode& node) const
{
  return static_cast<int>(
    node.Integer(0, this->Out.Info.Time.NumberOfFrames - 1, "a frame of the scene"));
}

std::string SceneReader::File(const SceneNode& node) const
{
  const std::string text = node.Text();
  const std::filesystem::path path = std::filesystem::path(this->Folder) / text;
  std::error_code error;
  if (text.empty() || !std::filesystem::is_regular_file(path, error))
  {
    node.FailWith("expected a file that exists, found none at \"" + path.string() + "\"");
  }
  return path.lexically_normal().string();
}

void SceneReader::Check(const Result& result, const SceneNode& node) const
{
  if (!result)
  {
    node.FailWith(result.Message());
  }
}

void SceneReader::ReadInfo(const SceneNode& root)
{
  SceneInfo& info = this->Out.Info;
  root.At("waft", "the format's version 1").Integer(1, 1, "the format's version 1");
  if (root.Has("title"))
  {
    this->Out.Title = root.At("title", "").Text();
  }
  if (root.Has("seed"))
  {
    constexpr std::int64_t largest = 9007199254740991; // 2^53 - 1: exact in any JSON reader
    info.Seed = static_cast<std::uint64_t>(root.At("seed", "").Integer(0, largest, "a seed"));
  }
  if (root.Has("time"))
  {
    const SceneNode time = root.At("time", "");
    time.CheckFields("time");
    if (time.Has("frames"))
    {
      info.Time.NumberOfFrames =
        static_cast<int>(time.At("frames", "").Integer(2, MostFrames, "a number of frames"));
    }
    if (time.Has("framesPerSecond"))
    {
      info.Time.FramesPerSecond = time.At("framesPerSecond", "").Positive();
    }
  }
  if (root.Has("domain"))
  {
    const SceneNode domain = root.At("domain", "");
    domain.CheckFields("domain");
    if (domain.Has("min"))
    {
      info.Bounds.Min = domain.At("min", "").Vector();
    }
    if (domain.Has("max"))
    {
      info.Bounds.Max = domain.At("max", "").Vector();
    }
    if (!(info.Bounds.Size().minCoeff() > 0.0))
    {
      domain.Fail("a volume whose max is above its min along each axis");
    }
  }
  this->GroundHeight = info.Bounds.Min.z();
  if (root.Has("ground"))
  {
    const SceneNode ground = root.At("ground", "");
    ground.CheckFields("ground");
    if (ground.Has("height"))
    {
      this->GroundHeight = ground.At("height", "").Number();
      if (this->GroundHeight >= info.Bounds.Max.z())
      {
        ground.At("height", "").Fail("a height below the top of the volume");
      }
    }
    this->HasGround = !ground.Has("enabled") || ground.At("enabled", "").Boolean();
  }
  if (root.Has("air"))
  {
    const SceneNode air = root.At("air", "");
    air.CheckFields("air");
    if (air.Has("density"))
    {
      info.AirDensity = air.At("density", "").Positive();
    }
  }
}

void SceneReader::Read(const SceneNode& root)
{
  root.CheckFields("scene");
  this->ReadInfo(root);
  // Obstacles before objects (they keep clear of them), objects before constraints (which name
  // them).
  if (root.Has("shapes"))
  {
    this->ReadShapes(root.At("shapes", ""));
  }
  if (root.Has("obstacles"))
  {
    this->ReadObstacles(root.At("obstacles", ""));
  }
  this->AddGround();
  if (root.Has("objects"))
  {
    this->ReadObjects(root.At("objects", ""));
  }
  if (root.Has("constraints"))
  {
    this->ReadConstraints(root.At("constraints", ""));
  }
  if (root.Has("winds"))
  {
    this->ReadWinds(root.At("winds", ""));
  }
  if (root.Has("vortices"))
  {
    this->ReadVortices(root.At("vortices", ""));
  }
}

Result ParseScene(const std::string& text, const std::string& name, const std::string& folder,
                  const SceneAssets& assets, Scene& scene)
{
  try
  {
    const SceneJson json = ParseText(text, name);
    Scene read;
    try
    {
      SceneReader(name, folder, assets, read).Read(SceneNode(json, ""));
    }
    catch (const SceneError& error)
    {
      return Result::Error(name + ": " + error.Message);
    }
    scene = std::move(read);
    return Result::Ok();
  }
  catch (const SceneError& error)
  {
    return Result::Error(error.Message);
  }
  catch (const std::exception& error)
  {
    return Result::Error(name + ": " + error.what());
  }
}

Result ReadScene(const std::string& file, const SceneAssets& assets, Scene& scene)
{
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
  {
    return Result::Error(file + ": expected a scene file, found no such file");
  }
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream)
  {
    return Result::Error(file + ": expected a scene file that can be read");
  }
  return ParseScene(text.str(), file, std::filesystem::path(file).parent_path().string(), assets,
                    scene);
}

} // namespace waft
