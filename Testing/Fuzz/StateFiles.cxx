// SPDX-License-Identifier: BSD-3-Clause
// Files that go on with a run: as they are, and with the checksums and headers that let them be
// read.
#include "Fuzz.h"

#include "Database/TracedFiles.h"
#include "Store/StateFile.h"
#include "Trajectory/DatabaseFile.h"

#include <vector>

using namespace waft;

namespace
{

constexpr StateKind Lists = { "lists", 1 };

void ReadLists(const std::string& path)
{
  const auto content = [](StateArchive& file)
  {
    std::string text;
    std::vector<double> numbers;
    std::vector<Vec3> points;
    std::vector<std::vector<int>> lists;
    int value = 0;
    file.Values(text, numbers, points, lists, value);
    return true;
  };
  (void)ReadStateFile(path, Lists, {}, content);
}

/// A whole file of this kind and key.
bool Write(const std::string& path, const StateKind& kind, std::uint64_t key,
           const std::string& content)
{
  StateFileWriter writer(path, kind, key);
  writer.Raw(content.data(), content.size());
  return bool(writer.Commit());
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string input = FuzzBytes(data, size);
  {
    const FuzzFile file("fuzz.state", input);
    ReadLists(file.Path);
    // Of no kind that there is: the header itself is of these bytes.
    Digest digest;
    digest.Add(input.data(), input.size());
    const std::uint64_t sum = digest.Sum();
    const FuzzFile headed("fuzz.header",
                          input + std::string(reinterpret_cast<const char*>(&sum), sizeof(sum)));
    ReadLists(headed.Path);
    if (Write(file.Path, Lists, 0, input))
    {
      ReadLists(file.Path);
    }
  }

  const FuzzFile traced("simulation0", "");
  TracedSimulation simulation;
  if (Write(traced.Path, { "traced simulation", 3 }, DigestOf(std::string(), 0), input))
  {
    (void)TracedFiles(traced.Folder.string(), "").Read(0, simulation);
  }

  const FuzzFile kept("fuzz.motions", "");
  MotionDatabase database;
  if (Write(kept.Path, { "motion database", 2 }, 0, input))
  {
    (void)ReadDatabase(kept.Path, database);
  }
  return 0;
}
