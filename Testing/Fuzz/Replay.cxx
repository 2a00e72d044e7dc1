// SPDX-License-Identifier: BSD-3-Clause
// A target without a fuzzer: replays every file of the folders that are named, in the order of
// their names.
#include "Fuzz.h"

#include <algorithm>
#include <iostream>
#include <iterator>
#include <vector>

int main(int count, char** arguments)
{
  std::vector<std::filesystem::path> files;
  for (int a = 1; a < count; ++a)
  {
    for (const auto& entry : std::filesystem::directory_iterator(arguments[a]))
    {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  for (const std::filesystem::path& path : files)
  {
    std::cout << path.filename().string() << std::endl; // so that a crash tells its input
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{ std::istreambuf_iterator<char>(file), {} };
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  }
  return files.empty() ? 1 : 0;
}
