// SPDX-License-Identifier: BSD-3-Clause
// The store of states: what is kept, found and dropped; nothing of others is touched.
#include "Base/TemporaryFolder.h"
#include "Bridge/Run/StateStore.h"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

using namespace waft;

namespace
{

namespace fs = std::filesystem;

const std::string Keys[] = { std::string(63, '0') + "a", std::string(63, '0') + "b",
                             std::string(63, '0') + "c" };

std::string ContentOf(const fs::path& path)
{
  std::ifstream stream(path);
  return { std::istreambuf_iterator<char>(stream), {} };
}

class StateStoreTest : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Cache = fs::path(this->Own.File("cache")) / "waft";
    this->Name(this->Cache.string());
    ASSERT_TRUE(this->Folder.Open(fs::path(this->Own.File("x")).parent_path().string()));
  }
  void TearDown() override
  {
    setenv("HOME", this->Home.c_str(), 1);
    unsetenv("WAFT_CACHE");
  }
  static void Name(const std::string& cache) { setenv("WAFT_CACHE", cache.c_str(), 1); }
  void Keep(const std::string& key, std::size_t size = 100, std::uint64_t most = 5000000000)
  {
    this->Own.Write("made", std::string(size, 'x'));
    StateStore(most).Keep(key, this->Folder, "made");
  }
  std::string File(const std::string& key) const { return this->Cache / (key + ".state"); }

  const test::TemporaryFolder Own;
  const std::string Home = std::getenv("HOME") != nullptr ? std::getenv("HOME") : "";
  FolderBelow Folder;
  fs::path Cache;
};

} // namespace

TEST_F(StateStoreTest, FindsAStateByTheKeyOfItsRun)
{
  this->Keep(Keys[0]);
  EXPECT_EQ(StateStore().Found(Keys[0]), this->File(Keys[0]));
  EXPECT_EQ(StateStore().Found(Keys[1]), "");
  EXPECT_FALSE(fs::exists(this->Own.File("made"))) << "it was taken over";
  EXPECT_EQ(fs::status(this->Cache).permissions(), fs::perms::owner_all) << "this user's alone";
  this->Keep(Keys[0], 7);
  EXPECT_EQ(fs::file_size(StateStore().Found(Keys[0])), 7u);
}

TEST_F(StateStoreTest, DropsTheOldestWhereThereAreTooMany)
{
  for (int k = 0; k < 2; ++k)
  {
    this->Keep(Keys[k], 100, 250);
    const timespec then[2] = { { 1000 + k, 0 }, { 1000 + k, 0 } };
    ASSERT_EQ(utimensat(AT_FDCWD, this->File(Keys[k]).c_str(), then, 0), 0);
  }
  EXPECT_NE(StateStore().Found(Keys[0]), ""); // used now, so that the other is the oldest
  this->Keep(Keys[2], 100, 250);
  EXPECT_TRUE(fs::exists(this->File(Keys[0])) && fs::exists(this->File(Keys[2])));
  EXPECT_FALSE(fs::exists(this->File(Keys[1])));
  this->Keep(Keys[1], 1000, 250);
  EXPECT_TRUE(fs::exists(this->File(Keys[1]))) << "the latest stays, however large";
  EXPECT_FALSE(fs::exists(this->File(Keys[0])) || fs::exists(this->File(Keys[2])));
}

TEST_F(StateStoreTest, TakesNothingForAKeyThatIsNone)
{
  for (const std::string& wrong :
       { std::string(), std::string("../../x"), std::string(64, 'g'), Keys[0] + "\n" })
  {
    this->Keep(wrong);
    EXPECT_EQ(StateStore().Found(wrong), "");
  }
  EXPECT_TRUE(fs::is_empty(this->Cache));
}

TEST_F(StateStoreTest, IsNotNeeded)
{
  const std::string file = this->Own.Write("file", "mine");
  for (const std::string& place : { file + "/below", std::string("/proc/none") })
  {
    Name(place);
    this->Keep(Keys[0]);
    EXPECT_EQ(StateStore().Found(Keys[0]), "");
  }
  EXPECT_EQ(ContentOf(file), "mine");
  Name("");
  unsetenv("HOME");
  this->Keep(Keys[0]);
  EXPECT_EQ(StateStore().Found(Keys[0]), "");
}

TEST_F(StateStoreTest, IsBelowHomeWithoutAName)
{
  Name("");
  const fs::path home = fs::path(this->Own.File("made")).parent_path();
  setenv("HOME", home.c_str(), 1);
  this->Keep(Keys[0]);
  EXPECT_TRUE(fs::is_regular_file(home / ".cache/waft" / (Keys[0] + ".state")));
}

TEST_F(StateStoreTest, LeavesLinksAndFilesOfOthersAlone)
{
  const std::string other = this->Own.Write("other", "mine");
  fs::create_directories(this->Cache);
  fs::create_symlink(other, this->File(Keys[0]));
  std::ofstream(this->Cache / "notes.txt") << "mine";
  EXPECT_EQ(StateStore().Found(Keys[0]), "");
  this->Keep(Keys[1], 100, 10);
  EXPECT_EQ(ContentOf(this->Cache / "notes.txt"), "mine");
  this->Keep(Keys[0]); // a link's own name is taken, not what it leads to
  EXPECT_EQ(ContentOf(other), "mine");
}
