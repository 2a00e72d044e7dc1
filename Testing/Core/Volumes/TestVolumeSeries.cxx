// SPDX-License-Identifier: BSD-3-Clause
#include "Base/TemporaryFolder.h"
#include "Volumes/VolumeSeries.h"

#include <gtest/gtest.h>

#include <filesystem>

using namespace waft;

TEST(VolumeSeries, FindsTheFilesThatDifferInTheirLastDigits)
{
  const test::TemporaryFolder folder;
  for (const char* name : { "run2_0010.vdb", "run2_0002.vdb", "run2_7.vdb", "run3_0001.vdb",
                            "run2_0003.vdbx", "run2_.vdb", "2.vdb", "11.vdb" })
  {
    folder.Write(name, "x");
  }
  const auto frames = [&](const char* name)
  {
    std::vector<int> all;
    for (const auto& [frame, file] : SeriesFiles(folder.File(name)))
    {
      EXPECT_TRUE(std::filesystem::exists(file)) << file;
      all.push_back(frame);
    }
    return all;
  };
  EXPECT_EQ(frames("run2_0002.vdb"), (std::vector<int>{ 2, 7, 10 }));
  EXPECT_EQ(frames("run2_9999.vdb"), (std::vector<int>{ 2, 7, 10 })); // it need not be there itself
  EXPECT_EQ(frames("run2_.vdb"), std::vector<int>{ 0 });
  EXPECT_EQ(frames("2.vdb"), (std::vector<int>{ 2, 11 }));
  EXPECT_TRUE(frames("other_1.vdb").empty());
}

TEST(VolumeSeries, NamesTheFileOfAFrame)
{
  EXPECT_EQ(SeriesFile("/a/smoke.vdb", 12), "/a/smoke_0012.vdb");
  EXPECT_EQ(SeriesFile("smoke.vdb", 12345), "smoke_12345.vdb");
}
