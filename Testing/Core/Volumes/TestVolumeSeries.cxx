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

TEST(VolumeSeries, FindsTheOneNumberThatDiffers)
{
  const test::TemporaryFolder folder;
  for (const char* name :
       { "a_0000_v2.vdb", "a_0010_v2.vdb", "b_0001_v1.vdb", "b_0001_v2.vdb", "b_0002_v2.vdb",
         "cache3_01.vdb", "cache3_02.vdb", "cache4_02.vdb", "cache5_02.vdb", "only_0007_v2.vdb" })
  {
    folder.Write(name, "x");
  }
  const auto frames = [&](const char* name)
  {
    std::vector<int> all;
    for (const auto& [frame, file] : SeriesFiles(folder.File(name)))
    {
      all.push_back(frame);
    }
    return all;
  };
  EXPECT_EQ(frames("a_0000_v2.vdb"), (std::vector<int>{ 0, 10 }));
  EXPECT_EQ(frames("b_0001_v2.vdb"), (std::vector<int>{ 1, 2 })) << "frames have more digits";
  EXPECT_EQ(frames("cache3_02.vdb"), (std::vector<int>{ 1, 2 }));
  EXPECT_EQ(frames("only_0007_v2.vdb"), std::vector<int>{ 2 }) << "alone";
}

TEST(VolumeSeries, NamesTheFileOfAFrame)
{
  EXPECT_EQ(SeriesFile("/a/smoke.vdb", 12), "/a/smoke_0012.vdb");
  EXPECT_EQ(SeriesFile("smoke.vdb", 12345), "smoke_12345.vdb");
}
