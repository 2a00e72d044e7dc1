// SPDX-License-Identifier: BSD-3-Clause
// Two scene files that say the same, field by field.
#pragma once

#include "Scene/Scene.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <set>
#include <string>

namespace waft
{
namespace test
{

/// The scene with names of files resolved against its folder, and what it leaves out about frames,
/// volume, air and seed.
inline nlohmann::json WholeFields(nlohmann::json json, const std::string& folder)
{
  static const std::set<std::string> files = { "mesh", "texture", "file", "image" };
  const std::function<void(nlohmann::json&)> resolve = [&](nlohmann::json& value)
  {
    for (const auto& item : value.items())
    {
      if (item.value().is_string() && files.count(item.key()) > 0)
      {
        const std::filesystem::path path(item.value().get<std::string>());
        item.value() = (std::filesystem::absolute(folder) / path).lexically_normal().string();
      }
      else if (item.value().is_structured())
      {
        resolve(item.value());
      }
    }
  };
  resolve(json);
  const SceneInfo info;
  const auto list = [](const Vec3& v) { return nlohmann::json{ v.x(), v.y(), v.z() }; };
  nlohmann::json whole = {
    { "seed", info.Seed },
    { "time",
      { { "frames", info.Time.NumberOfFrames },
        { "framesPerSecond", info.Time.FramesPerSecond } } },
    { "domain", { { "min", list(info.Bounds.Min) }, { "max", list(info.Bounds.Max) } } },
    { "air", { { "density", info.AirDensity } } }
  };
  whole.merge_patch(json);
  return whole;
}

inline void ExpectSameFields(const nlohmann::json& authored, const std::string& folder,
                             const nlohmann::json& written, const std::string& folderOfWritten)
{
  const nlohmann::json a = WholeFields(authored, folder);
  const nlohmann::json b = WholeFields(written, folderOfWritten);
  EXPECT_EQ(a, b) << nlohmann::json::diff(a, b).dump(1);
}

} // namespace test
} // namespace waft
