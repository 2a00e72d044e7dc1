// SPDX-License-Identifier: BSD-3-Clause
// A scene file that is edited while it is open: read, saved, and left alone.
#include "Chain/BuiltinAssets.h"
#include "Chain/EditedScene.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

using namespace waft;

namespace
{

constexpr const char* Sheet = R"({
  "waft": 1,
  "shapes": {"leaf": {"builtin": "leaf"}},
  "objects": [{"shape": "leaf", "position": [0, 0, 3]}]
}
)";
constexpr const char* Moved =
  R"([{"op": "replace", "path": "/objects/0/position", "value": [1, 0, 3]}])";

} // namespace

class EditedSceneTest : public testing::Test
{
protected:
  void SetUp() override
  {
    std::filesystem::create_directory(this->Folder);
    this->Write(Sheet);
  }
  void TearDown() override { std::filesystem::remove_all(this->Folder); }

  void Write(const std::string& text) const { std::ofstream(this->File) << text; }
  std::string Text() const
  {
    std::ifstream stream(this->File);
    return { std::istreambuf_iterator<char>(stream), {} };
  }

  const std::filesystem::path Folder =
    std::filesystem::path(testing::TempDir()) /
    testing::UnitTest::GetInstance()->current_test_info()->name();
  const std::string File = (Folder / "s.waft.json").string();
  EditedScene Scene;
};

TEST_F(EditedSceneTest, HasTheEditsAndSavesThem)
{
  this->Scene.Read(this->File, Moved, BuiltinAssets());
  ASSERT_EQ(this->Scene.Error(), "");
  EXPECT_EQ(this->Scene.Parts().Objects[0].Position, Vec3(1, 0, 3));
  EXPECT_NE(this->Scene.Handles().find("\"start\""), std::string::npos);
  EXPECT_EQ(this->Text(), Sheet);
  EXPECT_TRUE(this->Scene.Save());
  this->Scene.Read(this->File, "", BuiltinAssets());
  EXPECT_EQ(this->Scene.Parts().Objects[0].Position, Vec3(1, 0, 3));
}

TEST_F(EditedSceneTest, DoesNotWriteOverAFileThatSomebodyChanged)
{
  this->Scene.Read(this->File, Moved, BuiltinAssets());
  const std::string other = std::string(Sheet) + "\n";
  this->Write(other);
  const Result result = this->Scene.Save();
  EXPECT_NE(result.Message().find("changed since"), std::string::npos) << result.Message();
  EXPECT_EQ(this->Text(), other);
}

TEST_F(EditedSceneTest, SavesNothingWhereNothingWasRead)
{
  this->Scene.Read(this->File, Moved, BuiltinAssets());
  this->Write("{");
  this->Scene.Read(this->File, "", BuiltinAssets());
  EXPECT_NE(this->Scene.Error(), "");
  EXPECT_EQ(this->Scene.Parts().Objects.size(), 1u); // as it was read before
  EXPECT_EQ(this->Scene.Handles(), "");
  EXPECT_FALSE(this->Scene.Save());
  EXPECT_EQ(this->Text(), "{");
}
