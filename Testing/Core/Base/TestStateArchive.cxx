// SPDX-License-Identifier: BSD-3-Clause
#include "Base/StateArchive.h"
#include "Base/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sys/stat.h>

using namespace waft;
namespace fs = std::filesystem;

namespace
{

struct Sample
{
  int Number = 7;
  bool Flag = true;
  Vec3 Place{ 1.0, -0.0, 1e-300 };
  std::string Name = "leaf";
  std::vector<float> Row{ 1.0f, 2.0f, 3.0f };
  std::vector<Vec3> Points{ Vec3(1, 2, 3) };
  std::vector<std::vector<double>> Rows{ { 1.0 }, {}, { 2.0, 3.0 } };

  void Serialise(StateArchive& stream)
  {
    stream.Values(this->Number, this->Flag, this->Place);
    stream.Text(this->Name);
    stream.List(this->Row);
    stream.List(this->Points);
    stream.List(this->Rows, [](StateArchive& s, std::vector<double>& row) { s.List(row); });
  }
};

void WriteSample(const std::string& path)
{
  Sample sample;
  StateFileWriter writer(path);
  sample.Serialise(writer);
  ASSERT_TRUE(writer.Commit());
}

} // namespace

TEST(StateArchive, ReadsBackWhatWasWritten)
{
  const test::TemporaryFolder folder;
  const std::string path = folder.File("state");
  Sample sample;
  {
    StateFileWriter writer(path);
    sample.Serialise(writer);
    EXPECT_FALSE(fs::exists(path)); // not before it is whole
    ASSERT_TRUE(writer.Commit());
  }
  EXPECT_TRUE(IsWholeStateFile(path));
  Sample read;
  read = { 0, false, Vec3::Zero(), "", {}, { Vec3::Zero(), Vec3::Zero() }, { { 4.0 } } };
  StateFileReader reader(path);
  read.Serialise(reader);
  EXPECT_TRUE(reader.IsAtEnd());
  EXPECT_EQ(read.Number, sample.Number);
  EXPECT_EQ(read.Flag, sample.Flag);
  EXPECT_EQ(read.Place, sample.Place);
  EXPECT_EQ(read.Name, sample.Name);
  EXPECT_EQ(read.Row, sample.Row);
  EXPECT_EQ(read.Points, sample.Points);
  EXPECT_EQ(read.Rows, sample.Rows);
}

TEST(StateArchive, SeesDamageAndBelievesNoNumberOfElements)
{
  const test::TemporaryFolder folder;
  const std::string path = folder.File("state");
  WriteSample(path);
  const auto size = static_cast<long>(fs::file_size(path));
  for (long at = 0; at < size; ++at)
  {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(at);
    const char byte = static_cast<char>(file.get());
    file.seekp(at);
    file.put(static_cast<char>(byte ^ 0x40));
    file.close();
    EXPECT_FALSE(IsWholeStateFile(path)) << at;
    StateFileReader reader(path); // must not ask for petabytes
    Sample read;
    read.Serialise(reader);
    std::fstream back(path, std::ios::in | std::ios::out | std::ios::binary);
    back.seekp(at);
    back.put(byte);
  }
  ASSERT_TRUE(IsWholeStateFile(path));
  fs::resize_file(path, static_cast<std::uintmax_t>(size - 1));
  EXPECT_FALSE(IsWholeStateFile(path));
  fs::resize_file(path, 3);
  EXPECT_FALSE(IsWholeStateFile(path));
  EXPECT_FALSE(IsWholeStateFile(path + "none"));
  EXPECT_FALSE(StateFileReader(path + "none").IsGood());
  ASSERT_EQ(::mkfifo((path + "pipe").c_str(), 0600), 0);
  EXPECT_FALSE(StateFileReader(path + "pipe").IsGood()); // is not waited for
  EXPECT_FALSE(StateFileReader("/dev/zero").IsGood());
}

TEST(StateArchive, LeavesTheOldFileUntilTheNewOneIsWhole)
{
  const test::TemporaryFolder folder;
  const std::string path = folder.File("state");
  WriteSample(path);
  Sample sample;
  {
    StateFileWriter writer(path);
    writer.Value(sample.Number); // and gives up
  }
  EXPECT_TRUE(IsWholeStateFile(path));
  EXPECT_EQ(
    std::distance(fs::directory_iterator(fs::path(path).parent_path()), fs::directory_iterator()),
    1);
  StateFileWriter nowhere(path + "/none/state");
  sample.Serialise(nowhere);
  const Result result = nowhere.Commit();
  EXPECT_FALSE(result);
  EXPECT_NE(result.Message().find("cannot write"), std::string::npos);
}
