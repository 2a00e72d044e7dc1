// SPDX-License-Identifier: BSD-3-Clause
#include "Base/AtomicFile.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

using namespace waft;
namespace fs = std::filesystem;

TEST(WriteWholeFile, ReplacesWhatWasThereAndLeavesNothingBeside)
{
  const fs::path folder = fs::path(testing::TempDir()) / "waft-atomic-file";
  fs::remove_all(folder);
  fs::create_directories(folder);
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
  fs::remove_all(folder);
}
