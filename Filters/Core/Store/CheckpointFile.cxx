// SPDX-License-Identifier: BSD-3-Clause
#include "Store/CheckpointFile.h"

#include <utility>

namespace waft
{
CheckpointFile::CheckpointFile(Checkpoint what, std::vector<std::string>& warnings) :
  What(std::move(what)), Warnings(warnings)
{
}

void CheckpointFile::Write(const Content& content)
{
  StateFileWriter file(this->What.Path, this->What.Kind, this->What.Key);
  content(file);
  const Result result = file.Commit();
  if (!result)
  {
    this->HasFailed = true;
    this->Warnings.push_back("no checkpoint is kept: " + result.Message() + " (CheckpointFile)");
  }
}

bool CheckpointFile::Read(const StateContent& content)
{
  const StateLack lack = ReadStateFile(this->What.Path, this->What.Kind, this->What.Key, content);
  if (lack != StateLack::None && lack != StateLack::NoFile)
  {
    this->Warnings.push_back("the checkpoint " + this->What.Path + " " +
                             ToString(lack, this->What.Kind) + ": ignored, " + this->What.Done +
                             " from the start (CheckpointFile)");
  }
  return lack == StateLack::None;
}

void CheckpointFile::Remove() const
{
  if (this->IsNamed())
  {
    RemoveStateFile(this->What.Path);
  }
}

} // namespace waft
