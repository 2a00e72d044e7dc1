// SPDX-License-Identifier: BSD-3-Clause
#include "Chain/EditedScene.h"

#include "Base/AtomicFile.h"
#include "Chain/ChainScene.h"
#include "Scene/SceneEdits.h"

namespace waft
{

void EditedScene::Read(const std::string& file, const std::string& edits, const SceneAssets& assets)
{
  this->File = file;
  this->Edited.clear();
  const Result result = [&]() -> Result
  {
    WAFT_RETURN_IF_FAILED(ReadSceneText(file, this->Text));
    this->Edited = this->Text;
    WAFT_RETURN_IF_FAILED(EditSceneText(edits, file, this->Edited));
    return ParseSceneAndWind(this->Edited, file, assets, this->Whole, this->Blowing);
  }();
  this->Fault = result.Message();
}

Result EditedScene::CheckText() const
{
  return this->Edited.empty() || !this->Fault.empty()
           ? Result::Error(this->File + ": expected a scene that could be read, found none: not "
                                        "saved")
           : Result::Ok();
}

Result EditedScene::SaveAs(const std::string& file, const SceneAssets& assets) const
{
  WAFT_RETURN_IF_FAILED(this->CheckText());
  Scene there;
  SceneWind blowing;
  const Result read = ParseSceneAndWind(this->Edited, file, assets, there, blowing);
  if (!read || there.Warnings.size() > this->Whole.Warnings.size())
  {
    return Result::Error((read ? there.Warnings.back() : read.Message()) +
                         ": not saved: what a scene names by a relative path lies beside it, so "
                         "save it in the folder of " +
                         this->File);
  }
  return WriteWholeFile(file, this->Edited);
}

Result EditedScene::Save()
{
  WAFT_RETURN_IF_FAILED(this->CheckText());
  std::string now;
  WAFT_RETURN_IF_FAILED(ReadSceneText(this->File, now));
  if (now != this->Text)
  {
    return Result::Error(this->File + ": expected the file as it was read, found another one: it "
                                      "was changed since, and is not written over. Reload it "
                                      "first; the edits are kept");
  }
  WAFT_RETURN_IF_FAILED(WriteWholeFile(this->File, this->Edited));
  this->Text = this->Edited;
  return Result::Ok();
}

std::string EditedScene::Handles() const
{
  std::string handles;
  return !this->Edited.empty() && DescribeHandles(this->Edited, this->File, handles)
           ? handles
           : std::string();
}

} // namespace waft
