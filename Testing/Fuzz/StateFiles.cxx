// SPDX-License-Identifier: BSD-3-Clause
// Files that go on with a run: as they are, and with the checksums and headers that let them be
// read.
#include "Fuzz.h"

#include "Base/StateArchive.h"
#include "Database/TracedFiles.h"
#include "Trajectory/DatabaseFile.h"

#include <vector>

using namespace waft;

namespace
{

void ReadLists(const std::string& path)
{
  StateFileReader reader(path);
  std::string text;
  std::vector<double> numbers;
  std::vector<Vec3> points;
  std::vector<std::vector<int>> lists;
  int value = 0;
  reader.Text(text);
  reader.List(numbers);
  reader.List(points);
  reader.List(lists, [](StateArchive& stream, std::vector<int>& list) { stream.List(list); });
  reader.Value(value);
  (void)reader.IsAtEnd();
}

template <class T>
void Append(std::string& bytes, const T& value)
{
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  std::string input = FuzzBytes(data, size);
  {
    const FuzzFile file("fuzz.state", input);
    (void)IsWholeStateFile(file.Path);
    ReadLists(file.Path);
    StateFileWriter writer(file.Path);
    writer.Raw(input.data(), input.size());
    if (writer.Commit())
    {
      ReadLists(file.Path);
    }
  }

  const std::string format = "Waft traced simulation 2";
  std::string traced;
  Append(traced, static_cast<std::uint64_t>(format.size()));
  traced += format;
  Append(traced, std::uint64_t{ 0 }); // no parameters
  Append(traced, 0);                  // the simulation
  traced += input;
  Digest digest;
  digest.Add(traced.data(), traced.size());
  Append(traced, digest.Sum());
  const FuzzFile file("simulation0", traced);
  TracedSimulation simulation;
  (void)TracedFiles(file.Folder.string(), "").Read(0, simulation);

  const FuzzFile kept("fuzz.motions", "");
  StateFileWriter writer(kept.Path);
  std::string version = "Waft motion database 1";
  writer.Text(version);
  writer.Raw(input.data(), input.size());
  MotionDatabase database;
  if (writer.Commit())
  {
    (void)ReadDatabase(kept.Path, database);
  }
  return 0;
}
