// SPDX-License-Identifier: BSD-3-Clause
#include "Base/TemporaryFolder.h"
#include "Store/StateFile.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sys/stat.h>

using namespace waft;
namespace fs = std::filesystem;

namespace
{

constexpr StateKind Sample = { "sample", 3 };
constexpr std::uint64_t Key = 42;

const std::vector<std::string> Words{ "leaf", "", "feather" };

void WriteSample(const std::string& path)
{
  StateFileWriter writer(path, Sample, Key);
  writer.Values(Words);           // const
  EXPECT_FALSE(fs::exists(path)); // not before it is whole
  ASSERT_TRUE(writer.Commit());
}

StateLack Read(const std::string& path, const StateKind& kind = Sample,
               std::optional<std::uint64_t> key = Key, std::vector<std::string>* words = nullptr)
{
  std::vector<std::string> read;
  const auto content = [&read](StateArchive& file)
  {
    file.Values(read);
    return file.IsGood();
  };
  const StateLack lack = ReadStateFile(path, kind, key, content);
  if (words != nullptr)
  {
    *words = read;
  }
  return lack;
}

std::string BytesOf(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

} // namespace

TEST(StateFile, ReadsBackWhatWasWritten)
{
  const test::TemporaryFolder folder;
  const std::string path = folder.File("state");
  WriteSample(path);
  for (const auto key : { std::optional(Key), std::optional<std::uint64_t>() })
  {
    std::vector<std::string> read;
    EXPECT_EQ(Read(path, Sample, key, &read), StateLack::None);
    EXPECT_EQ(read, Words);
  }
}

TEST(StateFile, IsRefusedWhereItIsOfSomethingElse)
{
  const test::TemporaryFolder folder;
  const std::string path = folder.File("state");
  WriteSample(path);
  EXPECT_EQ(Read(path, { "other", 3 }), StateLack::OtherKind);
  EXPECT_EQ(Read(path, { "sample", 4 }), StateLack::OtherKind);
  EXPECT_EQ(Read(path, Sample, Key + 1), StateLack::OtherKey);
  EXPECT_EQ(ToString(StateLack::OtherKind, { "other", 3 }), "is no other of this version");

  // A whole file of a format before this one: a text, a number, a checksum.
  const std::string text = "Waft sample 2";
  Digest sum;
  std::string bytes;
  const auto append = [&](const void* at, std::size_t size)
  { bytes.append(static_cast<const char*>(at), size); };
  const std::uint64_t size = text.size();
  append(&size, sizeof(size));
  bytes += text;
  append(&Key, sizeof(Key));
  sum.Add(bytes.data(), bytes.size());
  const std::uint64_t checksum = sum.Sum();
  append(&checksum, sizeof(checksum));
  EXPECT_EQ(Read(folder.Write("former", bytes)), StateLack::OtherKind);
}

TEST(StateFile, IsRefusedWhereAByteIsAnotherOrMissing)
{
  const test::TemporaryFolder folder;
  const std::string path = folder.File("state");
  WriteSample(path);
  const std::string whole = BytesOf(path);
  for (std::size_t at = 0; at < whole.size(); ++at)
  {
    std::string bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x40);
    EXPECT_EQ(Read(folder.Write("changed", bytes)), StateLack::Damaged) << at;
    const StateLack lack = at < sizeof(std::uint64_t) ? StateLack::NoFile : StateLack::Damaged;
    EXPECT_EQ(Read(folder.Write("cut", whole.substr(0, at))), lack) << at;
  }
  EXPECT_EQ(Read(folder.Write("longer", whole + "x")), StateLack::Damaged);
  EXPECT_EQ(ToString(StateLack::Damaged, Sample), "is damaged");
}

TEST(StateFile, IsRefusedWhereItsContentDoesNotFit)
{
  const test::TemporaryFolder folder;
  const std::string path = folder.File("state");
  {
    StateFileWriter writer(path, Sample, Key);
    const std::uint64_t many = std::uint64_t(1) << 60; // of words: must not ask for petabytes
    writer.Values(many);
    ASSERT_TRUE(writer.Commit());
  }
  EXPECT_EQ(Read(path), StateLack::Incomplete);
  {
    StateFileWriter writer(path, Sample, Key);
    const int more = 1;
    writer.Values(Words, more);
    ASSERT_TRUE(writer.Commit());
  }
  EXPECT_EQ(Read(path), StateLack::Incomplete);
  WriteSample(folder.File("sound"));
  EXPECT_EQ(ReadStateFile(folder.File("sound"), Sample, Key,
                          [](StateArchive& file)
                          {
                            std::vector<std::string> read;
                            file.Values(read);
                            return false; // what was read cannot be
                          }),
            StateLack::Incomplete);
}

TEST(StateFile, IsNoneWhereThereIsNoFile)
{
  const test::TemporaryFolder folder;
  EXPECT_EQ(Read(folder.File("none")), StateLack::NoFile);
  EXPECT_EQ(Read(""), StateLack::NoFile);
  EXPECT_EQ(Read(folder.Path().string()), StateLack::NoFile);
  EXPECT_EQ(Read("/dev/zero"), StateLack::NoFile);
  ASSERT_EQ(::mkfifo(folder.File("pipe").c_str(), 0600), 0);
  EXPECT_EQ(Read(folder.File("pipe")), StateLack::NoFile); // is not waited for
}

TEST(StateFile, LeavesTheOldFileUntilTheNewOneIsWhole)
{
  const test::TemporaryFolder folder;
  const std::string path = folder.File("state");
  WriteSample(path);
  {
    StateFileWriter writer(path, Sample, Key + 1);
    writer.Values(Words); // and gives up
  }
  EXPECT_EQ(Read(path), StateLack::None);
  EXPECT_EQ(
    std::distance(fs::directory_iterator(fs::path(path).parent_path()), fs::directory_iterator()),
    1);
  StateFileWriter nowhere(path + "/none/state", Sample, Key);
  nowhere.Values(Words);
  const Result result = nowhere.Commit();
  EXPECT_FALSE(result);
  EXPECT_NE(result.Message().find("cannot write"), std::string::npos);
}
