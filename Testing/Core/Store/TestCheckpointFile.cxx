// SPDX-License-Identifier: BSD-3-Clause
#include "Base/TemporaryFolder.h"
#include "Store/CheckpointFile.h"

#include <gtest/gtest.h>

#include <filesystem>

using namespace waft;

namespace
{

constexpr StateKind Steps = { "steps", 1 };

void WriteSteps(CheckpointFile& file, int steps)
{
  file.Write([steps](StateArchive& stream) { stream.Values(steps); });
}

/// -1 where it is not gone on from.
int StepsOf(CheckpointFile& file)
{
  int steps = 0;
  const auto content = [&steps](StateArchive& stream)
  {
    stream.Values(steps);
    return steps >= 0;
  };
  return file.Read(content) ? steps : -1;
}

} // namespace

TEST(CheckpointFile, IsGoneOnFromByTheSameRunAlone)
{
  const test::TemporaryFolder folder;
  const std::string path = folder.File("checkpoint");
  std::vector<std::string> warnings;
  CheckpointFile file({ path, Steps, 7, "done" }, warnings);
  EXPECT_EQ(StepsOf(file), -1);
  EXPECT_TRUE(warnings.empty()); // there is none
  EXPECT_TRUE(file.IsDue());
  WriteSteps(file, 3);
  EXPECT_EQ(StepsOf(file), 3);
  EXPECT_TRUE(warnings.empty());

  CheckpointFile other({ path, Steps, 8, "done" }, warnings);
  EXPECT_EQ(StepsOf(other), -1);
  WriteSteps(file, -5); // what cannot be
  EXPECT_EQ(StepsOf(file), -1);
  EXPECT_EQ(warnings, (std::vector<std::string>{
                        "the checkpoint " + path +
                          " belongs to other inputs or properties: ignored, done from the start "
                          "(CheckpointFile)",
                        "the checkpoint " + path +
                          " is incomplete: ignored, done from the start (CheckpointFile)" }));
  file.Remove();
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(CheckpointFile, IsAWarningOnceWhereItCannotBeWritten)
{
  std::vector<std::string> warnings;
  CheckpointFile file({ "/nonexistent/folder/checkpoint", Steps, 7, "done" }, warnings);
  WriteSteps(file, 3);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].find("no checkpoint is kept: cannot write /nonexistent/folder/checkpoint"),
            0u);
  EXPECT_FALSE(file.IsDue());
}

TEST(CheckpointFile, LeavesFilesOfOthersAlone)
{
  const test::TemporaryFolder folder;
  const std::string path = folder.Write("own.png", "a picture of somebody's");
  std::vector<std::string> warnings;
  CheckpointFile file({ path, Steps, 7, "done" }, warnings);
  WriteSteps(file, 3);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find(path + ": nothing was written"), std::string::npos) << warnings[0];
  file.Remove();
  EXPECT_EQ(std::filesystem::file_size(path), 23u);
}

TEST(CheckpointFile, OfNoNameIsNeverDue)
{
  std::vector<std::string> warnings;
  CheckpointFile file({ "", Steps, 7, "done" }, warnings);
  EXPECT_FALSE(file.IsDue());
  EXPECT_EQ(StepsOf(file), -1);
  file.Remove();
  EXPECT_TRUE(warnings.empty());
}
