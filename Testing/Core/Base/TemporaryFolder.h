// SPDX-License-Identifier: BSD-3-Clause
// Where tests write files.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <stdlib.h>
#include <string>
#include <vector>

namespace waft
{
namespace test
{

/// An empty folder that nobody else has, so that tests may run side by side; it goes away with all
/// that is in it.
class TemporaryFolder
{
public:
  TemporaryFolder()
  {
    std::string path = (std::filesystem::temp_directory_path() / "waft-test-XXXXXX").string();
    if (::mkdtemp(path.data()) == nullptr)
    {
      throw std::runtime_error("cannot make a folder " + path);
    }
    this->Place = path;
  }
  ~TemporaryFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(this->Place, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& Path() const { return this->Place; }
  /// The path of a file in it, which need not be there.
  std::string File(const std::string& name) const { return (this->Place / name).string(); }
  /// Writes a file and returns its path.
  std::string Write(const std::string& name, const std::string& text) const
  {
    std::ofstream(this->Place / name) << text;
    return this->File(name);
  }
  /// Of all that is in it, sorted.
  std::vector<std::string> Names() const
  {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(this->Place))
    {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

private:
  std::filesystem::path Place;
};

} // namespace test
} // namespace waft
