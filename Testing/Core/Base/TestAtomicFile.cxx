// SPDX-License-Identifier: BSD-3-Clause
#include "Base/AtomicFile.h"
#include "Base/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <unistd.h>

using namespace waft;
namespace fs = std::filesystem;

TEST(WriteWholeFile, ReplacesWhatWasThereAndLeavesNothingBeside)
{
  const test::TemporaryFolder temporary;
  const fs::path& folder = temporary.Path();
  const std::string path = (folder / "a.bin").string();
  ASSERT_TRUE(WriteWholeFile(path, "first, and longer"));
  const std::string bytes("sec\0nd", 6);
  ASSERT_TRUE(WriteWholeFile(path, bytes));
  std::ostringstream read;
  read << std::ifstream(path, std::ios::binary).rdbuf();
  EXPECT_EQ(read.str(), bytes);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
  // A folder of that name cannot be replaced: an error, and nothing is left beside it.
  fs::create_directories(folder / "b" / "c");
  const Result result = WriteWholeFile((folder / "b").string(), bytes);
  EXPECT_FALSE(result);
  EXPECT_NE(result.Message().find("cannot write"), std::string::npos);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 2);
  EXPECT_FALSE(WriteWholeFile((folder / "none" / "d").string(), bytes));
}

TEST(WriteWholeFiles, WritesAllOrNothing)
{
  const test::TemporaryFolder temporary;
  const fs::path& folder = temporary.Path();
  fs::create_directories(folder / "taken");
  const std::string first = (folder / "first").string();
  const std::string deep = (folder / "a" / "b" / "second").string();
  ASSERT_TRUE(WriteWholeFile(first, "old"));
  const auto read = [](const std::string& path)
  {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
  };
  // The last of them cannot be written: the first stays, and no folder is left.
  const Result result =
    WriteWholeFiles({ { first, "new" }, { deep, "second" }, { (folder / "taken").string(), "x" } });
  EXPECT_FALSE(result);
  EXPECT_NE(result.Message().find("taken"), std::string::npos) << result.Message();
  EXPECT_EQ(read(first), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 2);
  ASSERT_TRUE(WriteWholeFiles({ { first, "new" }, { deep, "second" } }));
  EXPECT_EQ(read(first), "new");
  EXPECT_EQ(read(deep), "second");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 3);
}

TEST(PartFile, LeavesNothingUntilItIsInPlace)
{
  const test::TemporaryFolder temporary;
  const std::string path = temporary.File("whole");
  const auto count = [&]
  { return std::distance(fs::directory_iterator(temporary.Path()), fs::directory_iterator()); };
  {
    PartFile part(path);
    ASSERT_TRUE(part.Open());
    EXPECT_TRUE(part.Write("half", 4));
    EXPECT_EQ(count(), 1);
    EXPECT_FALSE(fs::exists(path));
  }
  EXPECT_EQ(count(), 0);
  PartFile part(path);
  std::ofstream(part.Name()) << "by another library";
  EXPECT_TRUE(part.PutInPlace());
  EXPECT_TRUE(fs::exists(path));
  EXPECT_EQ(count(), 1);
  // What failed first is what the error says.
  PartFile nowhere(temporary.File("none/a"));
  EXPECT_FALSE(nowhere.Open());
  EXPECT_NE(nowhere.Close().Message().find("No such file"), std::string::npos);
}

TEST(PartFile, TakesNoNameThatIsThere)
{
  const test::TemporaryFolder temporary;
  const std::string path = temporary.File("whole");
  const std::string precious = temporary.File("precious");
  ASSERT_TRUE(WriteWholeFile(precious, "mine"));
  for (const std::string& name : { path + ".part", path + ".part" + std::to_string(::getpid()) })
  {
    fs::create_symlink(precious, name);
  }
  PartFile one(path);
  PartFile other(path);
  ASSERT_TRUE(one.Open());
  ASSERT_TRUE(other.Open());
  EXPECT_NE(one.Name(), other.Name());
  EXPECT_TRUE(one.Write("one", 3));
  EXPECT_TRUE(one.Close());
  EXPECT_TRUE(one.PutInPlace());
  EXPECT_EQ(fs::file_size(precious), 4u);
  EXPECT_FALSE(fs::is_symlink(path));
  EXPECT_TRUE(fs::is_symlink(path + ".part"));
  EXPECT_FALSE(PartFile(temporary.File("never")).PutInPlace());
}
