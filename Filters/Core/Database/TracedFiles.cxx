// SPDX-License-Identifier: BSD-3-Clause
#include "Database/TracedFiles.h"

#include "Store/StateFile.h"

#include <filesystem>
#include <utility>

namespace waft
{

namespace
{

constexpr StateKind TracedKind = { "traced simulation", 3 };

} // namespace

TracedFiles::TracedFiles(std::string folder, std::string parameters) :
  Folder(std::move(folder)), Parameters(std::move(parameters))
{
}

std::string TracedFiles::PathOf(int simulation) const
{
  return (std::filesystem::path(this->Folder) / ("simulation" + std::to_string(simulation)))
    .string();
}

bool TracedFiles::Read(int simulation, TracedSimulation& traced) const
{
  if (this->Folder.empty())
  {
    return false;
  }
  TracedSimulation read;
  const auto content = [&read](StateArchive& file)
  {
    MoveTraced(file, read);
    return true;
  };
  if (ReadStateFile(this->PathOf(simulation), TracedKind, DigestOf(this->Parameters, simulation),
                    content) != StateLack::None)
  {
    return false;
  }
  traced = std::move(read);
  return true;
}

Result TracedFiles::Write(int simulation, const TracedSimulation& traced) const
{
  if (this->Folder.empty())
  {
    return Result::Ok();
  }
  std::error_code error;
  std::filesystem::create_directories(this->Folder, error);
  if (error)
  {
    return Result::Error("cannot make the folder " + this->Folder + ": " + error.message());
  }
  StateFileWriter file(this->PathOf(simulation), TracedKind,
                       DigestOf(this->Parameters, simulation));
  MoveTraced(file, traced);
  return file.Commit();
}

} // namespace waft
