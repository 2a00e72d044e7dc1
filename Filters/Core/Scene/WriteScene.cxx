// SPDX-License-Identifier: BSD-3-Clause
// The frame of a scene file, and the files that it names.
#include "Scene/WriteScene.h"

#include "Scene/AuthoredParts.h"
#include "Scene/JsonText.h"
#include "Scene/SceneFormat.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace waft
{

SceneFormat::SceneFormat(const Scene& scene, const SceneAssets& assets, std::string folder,
                         std::string stem) :
  In(scene),
  Folder(folder.empty() ? "." : std::move(folder)), Stem(std::move(stem)),
  Reader({}, {}, assets, Written)
{
}

std::string SceneFormat::Relative(const std::string& path) const
{
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path folder = fs::absolute(this->Folder, error).lexically_normal();
  const fs::path relative =
    error ? fs::path() : fs::path(path).lexically_normal().lexically_relative(folder);
  return relative.empty() ? path : relative.generic_string();
}

std::string SceneFormat::ExistingFile(const std::string& path, const std::string& owner) const
{
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::absolute(path, error);
  if (error || !std::filesystem::is_regular_file(whole, error))
  {
    throw SceneError{ owner + ": expected a file that exists, found none at \"" + path + "\"" };
  }
  return this->Relative(whole.string());
}

/// An authored entry with its files named from where the scene will be.
SceneJson SceneFormat::AsWritten(SceneJson entry)
{
  RenameFiles(entry,
              [&](const std::string& path)
              {
                this->Out.NamedFiles.push_back(path);
                return this->Relative(path);
              });
  return entry;
}

std::string SceneFormat::SideFile(const std::string& what, const char* ending) const
{
  std::string name = this->Stem + "." + what;
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return std::isalnum(c) || c == '.' || c == '-' ? c : '_'; });
  return name.substr(0, 200) + ending;
}

void SceneFormat::WriteInfo()
{
  const SceneInfo& info = this->In.Info;
  const auto require = [](bool holds, const std::string& message)
  {
    if (!holds)
    {
      throw SceneError{ message };
    }
  };
  constexpr std::uint64_t largest = 9007199254740991; // 2^53 - 1: exact in any JSON reader
  require(info.Time.NumberOfFrames >= 2,
          "NumberOfFrames: expected at least 2, found " + std::to_string(info.Time.NumberOfFrames));
  require(info.Seed <= largest, "Seed: expected at most " + std::to_string(largest));
  require(info.AirDensity > 0.0, "AirDensity: expected more than 0");
  this->Root["waft"] = 1;
  const SceneJson authored = AuthoredPart(this->In.Authored.Objects);
  if (!this->In.Title.empty())
  {
    RequireName(this->In.Title, "title");
    this->Root["title"] = this->In.Title;
  }
  for (const auto& item : authored.items())
  {
    const bool isTitle = item.key() == "title" && item.value().is_string();
    if ((isTitle && this->In.Title.empty()) || item.key().rfind('_', 0) == 0)
    {
      this->Root[item.key()] = item.value();
    }
  }
  this->Root["seed"] = info.Seed;
  this->Root["time"] = { { "frames", info.Time.NumberOfFrames },
                         { "framesPerSecond", info.Time.FramesPerSecond } };
  if (info.Loops != 0)
  {
    this->Root["time"]["loop"] = true;
  }
  this->Root["domain"] = { { "min", FormatVector(info.Bounds.Min) },
                           { "max", FormatVector(info.Bounds.Max) } };
  for (std::size_t side = 0; side < info.Open.size(); ++side)
  {
    if (info.Open[side] != 0)
    {
      this->Root["domain"]["open"].push_back(OpenSides[side]);
    }
  }
  this->Root["air"] = { { "density", info.AirDensity } };
  if (!info.Breeze.isZero())
  {
    this->Root["air"]["breeze"] = FormatVector(info.Breeze);
  }
}

// What the reader would not take is not written.
void SceneFormat::CheckLists() const
{
  for (const SceneField& field : SceneFieldsOf("scene").Fields)
  {
    const auto written = this->Root.find(field.Name);
    if (written != this->Root.end() && written->is_structured() && written->size() > field.Most)
    {
      throw SceneError{ "the scene cannot be written: expected at most " +
                        std::to_string(field.Most) + " " + field.Name + ", found " +
                        std::to_string(written->size()) };
    }
  }
}

SceneText SceneFormat::Write()
{
  this->Root = SceneJson::object();
  this->WriteInfo();
  this->NameClasses();
  this->Written.Info = this->In.Info;
  this->Written.Classes = this->In.Classes;
  // Obstacles before objects, as the reader has them: objects keep clear of them.
  this->WriteShapes();
  this->WriteObstacles();
  this->WriteObjects();
  this->WriteConstraints();
  this->WriteWinds();
  this->WriteVortices();
  this->CheckLists();
  this->Out.Json = PrettyText(this->Root);
  return std::move(this->Out);
}

Result FormatScene(const Scene& scene, const SceneAssets& assets, const std::string& folder,
                   const std::string& stem, SceneText& text)
{
  try
  {
    text = SceneFormat(scene, assets, folder, stem).Write();
    return Result::Ok();
  }
  catch (const SceneError& error)
  {
    return Result::Error(error.Message);
  }
  catch (const std::exception& error) // a text that is no UTF-8
  {
    return Result::Error(std::string("the scene cannot be written: ") + error.what());
  }
}

} // namespace waft
