// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/MakeDatabase.h"

#include "Bridge/Data/DatabaseConversion.h"
#include "Bridge/Files/BlocksFile.h"
#include "Bridge/Files/DataFiles.h"
#include "Bridge/Files/FlightFiles.h"
#include "Bridge/Pipeline/Ranks.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Run/ResultPlace.h"
#include "Files/XmlTags.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkTable.h>

#include <filesystem>
#include <system_error>

namespace waft
{
namespace
{

namespace fs = std::filesystem;

std::string CoverageName(const fs::path& path)
{
  return path.stem().string() + ".coverage.csv";
}

ResultPlace::Form DatabasePlaceOf(const fs::path& path)
{
  const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".";
  const std::string blocks = path.stem().string() + "/";
  const std::string name = path.filename().string(), coverage = CoverageName(path);
  return { folder, blocks + "manifest.json", name + ".kept", [=](const std::string& own) {
            return own == name || own == coverage || own.compare(0, blocks.size(), blocks) == 0;
          } };
}

/// simulationN, or a part of one that is being written.
bool IsSimulation(const std::string& name)
{
  const auto digits = [&name](std::size_t from)
  { return name.find_first_not_of("0123456789", from); };
  const std::string head = "simulation", part = ".part";
  if (name.compare(0, head.size(), head) != 0 || digits(head.size()) == head.size())
  {
    return false;
  }
  const std::size_t end = digits(head.size());
  return end == std::string::npos ||
         (name.compare(end, part.size(), part) == 0 && end + part.size() < name.size() &&
          digits(end + part.size()) == std::string::npos);
}

Result CheckKept(const FolderBelow& kept)
{
  std::vector<std::string> names;
  WAFT_RETURN_IF_FAILED(kept.Names(names));
  for (const std::string& name : names)
  {
    bool isFile = false;
    if (name != ResultPlace::LockName &&
        !(IsSimulation(name) && kept.HasFile(name, isFile) && isFile))
    {
      return Result::Error(kept.PathOf(name) +
                           ": expected what a stopped run left, found something else: it stays as "
                           "it is: move it away, or choose another name for the database");
    }
  }
  return Result::Ok();
}

/// Removes the simulations that wait there; nothing else.
Result Forget(const FolderBelow& kept)
{
  std::vector<std::string> names;
  WAFT_RETURN_IF_FAILED(kept.Names(names));
  for (const std::string& name : names)
  {
    WAFT_RETURN_IF_FAILED(IsSimulation(name) ? kept.Remove(name) : Result::Ok());
  }
  return Result::Ok();
}

/// Whether it was asked to stop.
class AskedMonitor : public Monitor
{
public:
  explicit AskedMonitor(FlightMonitor& whole) : Whole(whole) {}
  bool Tick(double fraction, const std::string& text) override
  {
    this->IsAsked = !this->Whole.Tick(fraction, text) || this->IsAsked;
    return !this->IsAsked;
  }
  bool IsAsked = false;

private:
  FlightMonitor& Whole;
};

} // namespace

Result CheckDatabase(const std::string& path)
{
  std::error_code failure;
  WAFT_RETURN_IF_FAILED(ResultPlace(DatabasePlaceOf(path)).Settle());
  if (!fs::is_regular_file(path, failure))
  {
    return Result::Error(path + ": no such motion database file");
  }
  const fs::path own =
    fs::canonical(path, failure); // it may be linked itself, as installed files are
  FolderBelow folder;
  std::string text;
  WAFT_RETURN_IF_FAILED(folder.Open(own.parent_path().string()));
  WAFT_RETURN_IF_FAILED(folder.Read(own.filename().string(), text));
  XmlTags tags(text);
  for (XmlTag tag; tags.Next(tag);)
  {
    const std::string name = Unescaped(tag.Attribute("file"));
    bool isThere = false;
    const Result below = name.empty() ? Result::Ok() : folder.HasFile(name, isThere);
    if (!below)
    {
      return Result::Error(own.string() + ": " + below.Message());
    }
  }
  const Result checked = CheckBlocksFile(path);
  return checked ? checked : Result::Error(path + ": " + checked.Message());
}

Result MakeDatabaseFile(const std::string& path, const DatabaseOptions& options, bool resumes,
                        Communicator* ranks, FlightMonitor& monitor,
                        std::vector<CoveragePoint>& coverage, bool& isStopped)
{
  const fs::path file = path;
  if (file.extension() != ".vtm")
  {
    return Result::Error(path + ": expected a file name that ends with .vtm");
  }
  const std::string name = file.filename().string(), blocks = file.stem().string() + "/";
  ResultPlace place(DatabasePlaceOf(file));
  WAFT_RETURN_IF_FAILED(place.Enter());
  WAFT_RETURN_IF_FAILED(place.Check({ name, blocks, CoverageName(file) }));
  WAFT_RETURN_IF_FAILED(CheckKept(place.Room()));
  WAFT_RETURN_IF_FAILED(resumes ? Result::Ok() : Forget(place.Room()));
  DatabaseOptions own = options;
  own.KeptIn = place.RoomPath();
  own.SimulationsAtOnce = ItemsAtOnce();
  AskedMonitor watch(monitor);
  MotionDatabase database;
  ControllerCommunicator alone(nullptr);
  const Result built =
    BuildDatabase(own, ranks != nullptr ? *ranks : alone, SmpFor(), watch, database, coverage);
  if (!built)
  {
    WAFT_RETURN_IF_FAILED(built.Kind() == ErrorKind::Disk ? Result::Ok() : Forget(place.Room()));
    return built;
  }
  if (database.Segments.empty())
  {
    return Result::Error("stopped before a simulation was whole", ErrorKind::Stopped);
  }
  vtkNew<vtkMultiBlockDataSet> data;
  vtkNew<vtkTable> table;
  DatabaseToMultiBlock(database, data);
  CoverageToTable(coverage, table);
  std::string staged, beside;
  WAFT_RETURN_IF_FAILED(place.StagedPath(name, staged));
  WAFT_RETURN_IF_FAILED(place.StagedPath(CoverageName(file), beside));
  WAFT_RETURN_IF_FAILED(WriteBlocksFile(staged, data));
  WAFT_RETURN_IF_FAILED(WriteCsv(beside, table, {}));
  std::string seal;
  WAFT_RETURN_IF_FAILED(place.StagedPath(blocks + "manifest.json", seal));
  WAFT_RETURN_IF_FAILED(place.Commit(SceneJson::object()));
  isStopped = watch.IsAsked && static_cast<int>(coverage.size()) + 1 < options.NumberOfSimulations;
  return isStopped ? Result::Ok() : Forget(place.Room());
}

} // namespace waft
