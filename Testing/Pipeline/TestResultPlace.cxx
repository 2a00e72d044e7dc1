// SPDX-License-Identifier: BSD-3-Clause
// Folders of results: what a run replaces, and what becomes of them when it is killed at any
// moment.
#include "Bridge/Run/ResultPlace.h"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <string>
#include <vector>

namespace
{

int Left = -1; // calls that change names until the process dies; below 0: it does not

void Count()
{
  if (Left == 0)
  {
    ::_exit(9);
  }
  Left -= Left > 0 ? 1 : 0;
}

} // namespace

// In the place of the system's: what is linked into this program calls these.
extern "C"
{
  int renameat(int from, const char* name, int to, const char* newName)
  {
    Count();
    return static_cast<int>(::syscall(SYS_renameat2, from, name, to, newName, 0));
  }
  int rename(const char* name, const char* newName) noexcept
  {
    return renameat(AT_FDCWD, name, AT_FDCWD, newName);
  }
  int unlinkat(int folder, const char* name, int flags) noexcept
  {
    Count();
    return static_cast<int>(::syscall(SYS_unlinkat, folder, name, flags));
  }
  int mkdirat(int folder, const char* name, mode_t mode) noexcept
  {
    Count();
    return static_cast<int>(::syscall(SYS_mkdirat, folder, name, mode));
  }
}

namespace
{

using namespace waft;
namespace fs = std::filesystem;

using Texts = std::map<std::string, std::string>;

class ResultPlaces : public testing::Test
{
protected:
  void SetUp() override
  {
    std::string name = fs::temp_directory_path() / "waft-places-XXXXXX";
    ASSERT_NE(nullptr, ::mkdtemp(&name[0]));
    this->Out = fs::path(name) / "out";
  }
  void TearDown() override { fs::remove_all(this->Out.parent_path()); }

  void Put(const std::string& name, const std::string& text) const
  {
    fs::create_directories((this->Out / name).parent_path());
    std::ofstream(this->Out / name) << text;
  }
  static std::string TextOf(const fs::path& path)
  {
    std::ifstream stream(path);
    return { std::istreambuf_iterator<char>(stream), {} };
  }
  /// Of all files that are no seal.
  Texts Found() const
  {
    Texts texts;
    for (const auto& entry : fs::recursive_directory_iterator(this->Out))
    {
      if (entry.is_regular_file() && entry.path().filename() != "seal.json")
      {
        texts[entry.path().lexically_relative(this->Out).string()] = TextOf(entry.path());
      }
    }
    return texts;
  }
  ResultPlace::Form Form(const std::string& room = "") const
  {
    return { this->Out.string(), "seal.json", room, {} };
  }
  Result Write(const std::string& text, const std::vector<std::string>& names,
               const std::string& room = "") const
  {
    ResultPlace place(this->Form(room));
    WAFT_RETURN_IF_FAILED(place.Enter());
    WAFT_RETURN_IF_FAILED(place.Check(names));
    for (const std::string& name : names)
    {
      std::string path;
      WAFT_RETURN_IF_FAILED(place.StagedPath(name, path));
      std::ofstream(path) << text;
    }
    return place.Commit({ { "text", text } });
  }
  static int InChild(const std::function<void()>& work)
  {
    const pid_t child = ::fork();
    if (child == 0)
    {
      work();
      ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  fs::path Out;
};

TEST_F(ResultPlaces, AnswerWhatARunWroteAndNothingElse)
{
  ASSERT_TRUE(this->Write("old", { "a", "b/c" }));
  this->Put("notes", "mine");
  ASSERT_TRUE(this->Write("new", { "a", "d/e" }));
  EXPECT_EQ(this->Found(), (Texts{ { "a", "new" }, { "d/e", "new" }, { "notes", "mine" } }));
  EXPECT_FALSE(fs::exists(this->Out / "b"));
  this->Put("a", "changed");
  EXPECT_NE(this->Write("newer", { "a" }).Message().find("changed since a run wrote it"),
            std::string::npos);
  fs::remove(this->Out / "a");
  fs::create_symlink("notes", this->Out / "a");
  EXPECT_NE(this->Write("newer", { "a" }).Message().find("no run of waft wrote it"),
            std::string::npos);
  EXPECT_NE(this->Write("newer", { "notes" }).Message().find("no run of waft wrote it"),
            std::string::npos);
  EXPECT_EQ(TextOf(this->Out / "notes"), "mine");
}

TEST_F(ResultPlaces, AreHeldByOneRunAndLeaveNothingWhereNothingWasWritten)
{
  ResultPlace place(this->Form());
  ASSERT_TRUE(place.Look({ "a" }));
  EXPECT_FALSE(fs::exists(this->Out));
  ASSERT_TRUE(place.Enter());
  ResultPlace other(this->Form());
  EXPECT_NE(other.Enter().Message().find("another run of waft is at work there"),
            std::string::npos);
  place.Release();
  EXPECT_FALSE(fs::exists(this->Out));
  this->Put("a", "mine");
  EXPECT_FALSE(place.Look({ "a" }));
  EXPECT_FALSE(ResultPlace({ (this->Out / "a/b").string(), "seal.json", "", {} }).Enter());
  EXPECT_EQ(this->Found(), (Texts{ { "a", "mine" } }));
}

TEST_F(ResultPlaces, LookAtNamesOfOthersLikeAnyInput)
{
  this->Put("../precious", "mine");
  for (const char* name : { "../precious", "/etc/passwd", "", "a/../../precious" })
  {
    this->Put("seal.json",
              SceneJson{ { "manifest",
                           { { { "name", name }, { "size", 4 }, { "digest", Sha256("mine") } } } } }
                .dump());
    EXPECT_NE(this->Write("new", { "a" }).Message().find("/manifest/0/name"), std::string::npos);
  }
  EXPECT_EQ(TextOf(this->Out / "../precious"), "mine");
  this->Put("seal.json", "[]");
  EXPECT_FALSE(this->Write("new", { "a" }));
}

// Old or new results are whole, whenever the process dies, once the next run has looked.
TEST_F(ResultPlaces, AreOldOrNewAfterAKillAtAnyMoment)
{
  for (const std::string room : { "", "beside" })
  {
    int moments = 0;
    bool isDead = true;
    for (; isDead; ++moments)
    {
      fs::remove_all(this->Out);
      ASSERT_TRUE(this->Write("old", { "a", "b/c", "b/d", "e" }, room));
      this->Put("notes", "mine");
      const Texts old = this->Found();
      const int status = InChild(
        [&]
        {
          Left = moments;
          (void)this->Write("new", { "a", "b/c", "f/g" }, room);
        });
      isDead = status == 9;
      ASSERT_TRUE(isDead || status == 0);
      const bool isSealed = fs::exists(this->Out / "seal.json");
      const Texts found = this->Found();
      ResultPlace place(this->Form(room));
      ASSERT_TRUE(place.Settle());
      ASSERT_TRUE(place.Enter());
      place.Release();
      const Texts made = {
        { "a", "new" }, { "b/c", "new" }, { "f/g", "new" }, { "notes", "mine" }
      };
      const Texts settled = this->Found();
      EXPECT_TRUE(settled == old || settled == made) << moments;
      EXPECT_TRUE(isSealed || settled == made) << "what has begun to change hands is finished";
      EXPECT_EQ(TextOf(this->Out / "seal.json").find(settled == made ? "new" : "old"),
                TextOf(this->Out / "seal.json").find("text") + 8);
      EXPECT_FALSE(fs::exists(this->Out / ".waft-lock"));
    }
    EXPECT_GT(moments, 15);
  }
}

} // namespace
