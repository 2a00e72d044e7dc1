// SPDX-License-Identifier: BSD-3-Clause
// What every target has, and a file made of a fuzzer's bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

/// What libFuzzer calls; Replay.cxx calls it with the files of a corpus.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace waft
{

/// A file in a folder of this process, in memory where the system can; it is there as long as this.
class FuzzFile
{
public:
  FuzzFile(const std::string& name, const std::string& bytes)
  {
    const std::filesystem::path memory = "/dev/shm";
    this->Folder =
      (std::filesystem::exists(memory) ? memory : std::filesystem::temp_directory_path()) /
      ("waft-fuzz-" + std::to_string(getpid()));
    std::filesystem::create_directories(this->Folder);
    this->Path = (this->Folder / name).string();
    std::ofstream(this->Path, std::ios::binary) << bytes;
  }
  ~FuzzFile()
  {
    std::error_code isNotEmpty;
    std::filesystem::remove(this->Path, isNotEmpty);
    std::filesystem::remove(this->Folder, isNotEmpty);
  }
  FuzzFile(const FuzzFile&) = delete;
  void operator=(const FuzzFile&) = delete;

  std::filesystem::path Folder;
  std::string Path;
};

/// The bytes of an input behind the first `from`.
inline std::string FuzzBytes(const std::uint8_t* data, std::size_t size, std::size_t from = 0)
{
  return std::string(reinterpret_cast<const char*>(data) + from, size - from);
}

} // namespace waft
