// SPDX-License-Identifier: BSD-3-Clause
#include "Base/NumberText.h"
#include "Constraints/LoopRows.h"
#include "Scene/AuthoredParts.h"
#include "Scene/JsonText.h"
#include "Scene/Scene.h"
#include "Scene/SceneEdits.h"
#include "Scene/SceneReader.h"
#include "Scene/SettledStarts.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace waft
{

namespace
{

constexpr double LeastSide = 1e-3; // of the volume, m
constexpr double MostSlender = 1000.0;
constexpr int MostAlike = 5; // warnings of one kind

} // namespace

int SceneReader::Frame(const SceneNode& node) const
{
  return static_cast<int>(
    node.Integer(0, this->Out.Info.Time.NumberOfFrames - 1, "a frame of the scene"));
}

std::string SceneReader::File(const SceneNode& node) const
{
  const std::string text = node.Text();
  const std::filesystem::path path = FileOfScene(this->Name, this->Folder, text);
  std::error_code error;
  if (text.empty() || !std::filesystem::is_regular_file(path, error))
  {
    node.FailWith("expected a file that exists, found none at \"" + ShortenedPath(path.string()) +
                  "\"");
  }
  return path.lexically_normal().string();
}

void SceneReader::Check(const SceneNode& node, const std::function<Result()>& load)
{
  Result result = Result::Ok();
  try
  {
    result = load();
  }
  catch (const std::exception& error) // of a library below, or of memory
  {
    result = Result::Error(error.what());
  }
  if (!result)
  {
    node.FailWith(result.Message());
  }
}

void SceneReader::Warn(const char* kind, const SceneNode& node, const std::string& what)
{
  if (++this->WarningsOf[kind] <= MostAlike)
  {
    this->Out.Warnings.push_back(this->Name + ": " + node.Pointer() + ": " + what);
  }
}

void SceneReader::WarnOfMore()
{
  for (const auto& [kind, count] : this->WarningsOf)
  {
    if (count > MostAlike)
    {
      this->Out.Warnings.push_back(this->Name + ": " + std::to_string(count - MostAlike) +
                                   " more of " + kind);
    }
  }
}

void SceneReader::ReadInfo(const SceneNode& root)
{
  SceneInfo& info = this->Out.Info;
  root.At("waft", "the format's version 1").Integer("the format's version 1");
  root.Take("title", this->Out.Title);
  root.Take("seed", info.Seed, "a seed");
  if (root.Has("time"))
  {
    const SceneNode time = root.At("time", "");
    time.CheckFields("time");
    time.Take("frames", info.Time.NumberOfFrames, "a number of frames");
    time.Take("framesPerSecond", info.Time.FramesPerSecond);
    info.Loops = time.Has("loop") && time.At("loop", "").Boolean() ? 1 : 0;
  }
  if (root.Has("domain"))
  {
    const SceneNode domain = root.At("domain", "");
    domain.CheckFields("domain");
    domain.Take("min", info.Bounds.Min);
    domain.Take("max", info.Bounds.Max);
    if (domain.Has("open"))
    {
      const SceneNode open = domain.At("open", "");
      const std::size_t count = open.Size("a list of x, y and top");
      for (std::size_t i = 0; i < count; ++i)
      {
        const auto* side =
          std::find(std::begin(OpenSides), std::end(OpenSides), open.Item(i).Text());
        if (side == std::end(OpenSides))
        {
          open.Item(i).Fail("x, y or top");
        }
        info.Open[static_cast<std::size_t>(side - std::begin(OpenSides))] = 1;
      }
    }
    const Vec3 size = info.Bounds.Size();
    if (!(size.minCoeff() > 0.0))
    {
      domain.Fail("a volume whose max is above its min along each axis");
    }
    if (size.minCoeff() < LeastSide || size.maxCoeff() > MostSlender * size.minCoeff())
    {
      domain.Fail("a volume of sides from " + NumberText(LeastSide) +
                  " m on, the longest at most " + NumberText(MostSlender) + " times the shortest");
    }
  }
  if (root.Has("air"))
  {
    const SceneNode air = root.At("air", "");
    air.CheckFields("air");
    air.Take("density", info.AirDensity);
    this->ReadBreeze(air);
  }
}

void SceneReader::ReadBreeze(const SceneNode& air)
{
  if (!air.Has("breeze") ||
      (air.At("breeze", "").IsString() && air.At("breeze", "").Text() == "none"))
  {
    return;
  }
  const SceneNode node = air.At("breeze", "");
  if (!node.IsArray())
  {
    node.Fail("a vector [x, y, z] or \"none\"");
  }
  SceneInfo& info = this->Out.Info;
  info.Breeze = node.Vector();
  constexpr const char* axes = "xyz";
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const bool isOpen = axis < 2 && info.Open[axis] != 0;
    if (info.Breeze[static_cast<int>(axis)] != 0.0 && !isOpen)
    {
      node.FailWith(std::string("expected 0 along ") + axes[axis] +
                    (axis < 2 ? ", whose sides are closed" : ", as the floor is closed") +
                    ", found " + NumberText(info.Breeze[static_cast<int>(axis)]));
    }
  }
}

void SceneReader::ReadGround(const SceneNode& root)
{
  const Box& bounds = this->Out.Info.Bounds;
  this->GroundHeight = bounds.Min.z();
  if (root.Has("ground"))
  {
    const SceneNode ground = root.At("ground", "");
    ground.CheckFields("ground");
    if (ground.Has("height"))
    {
      this->GroundHeight = ground.At("height", "").Number();
      if (this->GroundHeight > bounds.Max.z() - LeastSide)
      {
        ground.At("height", "").Fail("a height below the top of the volume");
      }
    }
    this->HasGround = !ground.Has("enabled") || ground.At("enabled", "").Boolean();
  }
}

void SceneReader::Read(const SceneNode& root)
{
  root.CheckFields("scene");
  this->ReadInfo(root);
  this->ReadGround(root);
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
    std::string moved;
    Check(root.Has("obstacles") ? root.At("obstacles", "") : root,
          [&] {
            return SettleStarts(this->Out.Obstacles, this->Out.Constraints, this->Out.Objects,
                                moved);
          });
    if (!moved.empty())
    {
      this->Out.Warnings.push_back(this->Name + ": /objects: " + moved);
    }
  }
  if (this->Out.Info.Loops != 0)
  {
    Check(root.At("time", "").At("loop", ""), [this] { return this->CheckLoop(); });
  }
  if (root.Has("winds"))
  {
    this->ReadWinds(root.At("winds", ""));
  }
  if (root.Has("vortices"))
  {
    this->ReadVortices(root.At("vortices", ""));
  }
  this->LiftByFronts();
  this->WarnOfMore();
}

Result SceneReader::CheckLoop() const
{
  ObstacleSet obstacles;
  WAFT_RETURN_IF_FAILED(obstacles.Build(this->Out.Obstacles));
  std::vector<Constraint> rows = this->Out.Constraints;
  int number = 0;
  return CloseLoop(this->Out.Info, this->Out.Objects, obstacles, rows, number);
}

namespace
{

// A scene from a text, and what its keyframes draw where that is asked for.
Result Parse(const std::string& text, const std::string& name, const std::string& folder,
             const SceneAssets& assets, Scene& scene, std::vector<SceneDrawing>* drawings)
{
  try
  {
    const SceneJson json = ParseText(text, name);
    Scene read;
    try
    {
      SceneReader reader(name, folder, assets, read);
      if (drawings != nullptr)
      {
        reader.KeepDrawings(*drawings);
      }
      reader.Read(SceneNode(json, ""));
      KeepAuthored(json, name, folder, read);
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

} // namespace

Result ParseScene(const std::string& text, const std::string& name, const std::string& folder,
                  const SceneAssets& assets, Scene& scene)
{
  return Parse(text, name, folder, assets, scene, nullptr);
}

bool IsSceneFile(const std::string& file)
{
  std::ifstream stream(file, std::ios::binary);
  const auto keeps = [](int depth, SceneJson::parse_event_t event, const SceneJson&)
  { return !IsTooDeep(depth, event); };
  const SceneJson json = SceneJson::parse(stream, keeps, false);
  return json.is_object() && json.contains("waft");
}

Result ReadSceneText(const std::string& file, std::string& text)
{
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
  {
    return Result::Error(file + ": expected a scene file, found no such file");
  }
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (!error && size > SceneLists::Bytes)
  {
    return Result::Error(file + ": expected a scene file of at most " +
                         std::to_string(SceneLists::Bytes / 1000000) + " MB, found " +
                         std::to_string(size / 1000000) + " MB");
  }
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  if (!stream)
  {
    return Result::Error(file + ": expected a scene file that can be read");
  }
  text = bytes.str();
  return Result::Ok();
}

Result ReadScene(const std::string& file, const SceneAssets& assets, Scene& scene)
{
  std::string text;
  WAFT_RETURN_IF_FAILED(ReadSceneText(file, text));
  return ParseScene(text, file, std::filesystem::path(file).parent_path().string(), assets, scene);
}

Result ReadDrawings(const std::string& file, const SceneAssets& assets,
                    std::vector<SceneDrawing>& drawings)
{
  std::string text;
  WAFT_RETURN_IF_FAILED(ReadSceneText(file, text));
  Scene scene;
  drawings.clear();
  return Parse(text, file, std::filesystem::path(file).parent_path().string(), assets, scene,
               &drawings);
}

} // namespace waft
