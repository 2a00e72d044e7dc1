// SPDX-License-Identifier: BSD-3-Clause
// Scene files that a test writes.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

/// A folder of its own that goes away with the test.
class SceneFolder
{
public:
  SceneFolder() :
    Path(std::filesystem::temp_directory_path() /
         ("waft-scene-" + std::to_string(static_cast<long>(::getpid()))))
  {
    std::filesystem::create_directories(this->Path);
  }
  ~SceneFolder() { std::filesystem::remove_all(this->Path); }
  SceneFolder(const SceneFolder&) = delete;
  SceneFolder& operator=(const SceneFolder&) = delete;
  std::string Write(const std::string& name, const std::string& text) const
  {
    std::ofstream(this->Path / name) << text;
    return (this->Path / name).string();
  }
  std::string File(const std::string& name) const { return (this->Path / name).string(); }

private:
  std::filesystem::path Path;
};
