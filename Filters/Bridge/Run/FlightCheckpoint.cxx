// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/FlightCheckpoint.h"

#include "Base/AtomicFile.h"
#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Data/TrackData.h"
#include "Bridge/Data/VortexData.h"
#include "Bridge/Files/DataFiles.h"
#include "Bridge/Files/FlightFiles.h"
#include "Bridge/Files/FlightJson.h"

#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkTable.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace waft
{
namespace
{

constexpr const char* PlanFiles[] = { "planned.vtp", "constraints.vtp", "vortices.vtp" };
constexpr const char* KeyFile = "key";
// Of the assimilation on its way, and when it is done.
constexpr const char* States[] = { "assimilation.state", "assimilated.state" };
constexpr const char* NotFound = "no stopped run of this scene, seed and version";

/// One of a run's own names, or of a state that is being written.
bool IsOwnName(const std::string& name)
{
  const auto isPart = [&name](const std::string& state)
  {
    const std::string head = state + ".part";
    return name.size() > head.size() && name.compare(0, head.size(), head) == 0 &&
           name.find_first_not_of("0123456789", head.size()) == std::string::npos;
  };
  return name == KeyFile || name == "report.csv" || // of former versions
         std::find(std::begin(PlanFiles), std::end(PlanFiles), name) != std::end(PlanFiles) ||
         std::any_of(std::begin(States), std::end(States),
                     [&](const char* state) { return name == state || isPart(state); });
}

/// A table of texts, as RowsAsJson had it.
Result TableFromJson(const SceneJson& rows, vtkTable* table)
{
  const Result wrong = Result::Error("report: expected rows of texts");
  if (!rows.is_array())
  {
    return wrong;
  }
  std::map<std::string, vtkSmartPointer<vtkStringArray>> columns;
  for (const SceneJson& row : rows)
  {
    if (!row.is_object() || (!columns.empty() && row.size() != columns.size()))
    {
      return wrong;
    }
    for (const auto& [name, value] : row.items())
    {
      if (!value.is_string() || (&row != &rows.front() && columns.count(name) == 0))
      {
        return wrong;
      }
      vtkSmartPointer<vtkStringArray>& column = columns[name];
      if (column == nullptr)
      {
        column = vtkSmartPointer<vtkStringArray>::New();
        column->SetName(name.c_str());
      }
      column->InsertNextValue(value.get<std::string>());
    }
  }
  for (const auto& [name, column] : columns)
  {
    table->AddColumn(column);
  }
  return Result::Ok();
}

Result PlannedFromJson(const SceneJson& entries, std::vector<ObjectRow>& rows)
{
  const Result wrong = Result::Error("objects: expected an entry an object that was planned");
  if (!entries.is_array())
  {
    return wrong;
  }
  for (const SceneJson& entry : entries)
  {
    const auto number = [&entry](const char* name, auto& value)
    {
      using Number = std::decay_t<decltype(value)>;
      const auto found = entry.find(name);
      const bool isNull = found != entry.end() && found->is_null(); // of what is no number
      const bool isRight = found != entry.end() && (isNull || found->is_number());
      value = isRight && !isNull ? found->get<Number>() : static_cast<Number>(std::nan(""));
      return isRight;
    };
    ObjectRow row;
    std::string status;
    bool isRight = entry.is_object() && number("objectId", row.ObjectId) &&
                   number("rows", row.NumberOfRows) && number("met", row.NumberOfMet) &&
                   number("cost", row.Cost) && number("branches", row.NumberOfBranches) &&
                   number("seconds", row.Seconds) && entry.contains("status") &&
                   entry["status"].is_string() && entry.contains("message") &&
                   entry["message"].is_string();
    if (isRight)
    {
      status = entry["status"].get<std::string>();
      row.Message = entry["message"].get<std::string>();
      isRight = false;
      for (const ConstraintStatus one :
           { ConstraintStatus::Met, ConstraintStatus::Infeasible, ConstraintStatus::Conflict,
             ConstraintStatus::Unreachable })
      {
        if (status == ToString(one))
        {
          row.Status = one;
          isRight = true;
        }
      }
    }
    if (!isRight)
    {
      return wrong;
    }
    rows.push_back(std::move(row));
  }
  return Result::Ok();
}

} // namespace

Result FlightCheckpoint::Look()
{
  FolderBelow root, folder;
  std::optional<struct stat> about;
  if (!root.Open(this->Place.Root()))
  {
    return Result::Ok(); // it is not there yet
  }
  WAFT_RETURN_IF_FAILED(root.About(Name, about));
  if (!about)
  {
    return Result::Ok();
  }
  const Result foreign =
    Result::Error(this->Folder() +
                  ": expected no such folder, or one that a stopped run left: it holds something "
                  "else and stays as it is: move it away, or choose another place for the "
                  "results");
  std::vector<std::string> names;
  if (!S_ISDIR(about->st_mode) || !folder.Open(root, Name) || !folder.Names(names))
  {
    return foreign;
  }
  for (const std::string& name : names)
  {
    bool isFile = false;
    if (!IsOwnName(name) || !folder.HasFile(name, isFile) || !isFile)
    {
      return foreign;
    }
  }
  const bool hasPlan = std::all_of(
    std::begin(PlanFiles), std::end(PlanFiles),
    [&](const char* file) { return std::find(names.begin(), names.end(), file) != names.end(); });
  Manifest manifest;
  bool hasManifest = false;
  const bool isOurs =
    names.empty() || hasPlan || (ManifestIn(folder, KeyFile, manifest, hasManifest) && hasManifest);
  return isOurs ? Result::Ok() : foreign;
}

Result FlightCheckpoint::ReadKept(const FolderBelow& folder, SceneJson& kept,
                                  std::string& damage) const
{
  Manifest manifest;
  bool hasManifest = false;
  std::string text;
  const bool isRead =
    ManifestIn(folder, KeyFile, manifest, hasManifest) && hasManifest && folder.Read(KeyFile, text);
  kept = SceneJson::parse(text, nullptr, false); // which ManifestIn has looked at
  const bool isWhole = isRead && kept.contains("key") && kept["key"].is_string() &&
                       kept.contains("objects") && kept.contains("report") &&
                       std::all_of(std::begin(PlanFiles), std::end(PlanFiles),
                                   [&](const char* file) { return manifest.count(file) > 0; });
  if (!isWhole)
  {
    damage = folder.PathOf(KeyFile) + " is damaged, or of another version";
    return Result::Ok();
  }
  if (kept["key"].get<std::string>() != this->Key)
  {
    return Result::Error(NotFound);
  }
  for (const auto& [name, entry] : manifest)
  {
    if (!Fits(folder, name, entry))
    {
      damage = folder.PathOf(name) + " is damaged";
      return Result::Ok();
    }
  }
  return Result::Ok();
}

// Files that are as their digests say need be no plan: somebody else may have written both.
Result FlightCheckpoint::ReadPlan(const FolderBelow& folder, const SceneJson& kept,
                                  const SceneInfo& info, PlanOutput& plan) const
{
  vtkNew<vtkPolyData> tracks, rows, vortices;
  vtkNew<vtkTable> report;
  std::size_t number = 0;
  for (vtkPolyData* data : { tracks.Get(), rows.Get(), vortices.Get() })
  {
    const std::string path = folder.PathOf(PlanFiles[number++]);
    const Result read = ReadPolyDataFile(path, data);
    if (!read)
    {
      return Result::Error(path + ": " + read.Message());
    }
  }
  WAFT_RETURN_IF_FAILED(TracksFromPolyData(tracks, plan.Tracks));
  WAFT_RETURN_IF_FAILED(VorticesFromPolyData(vortices, plan.Vortices));
  if (rows->GetNumberOfPoints() > 0)
  {
    WAFT_RETURN_IF_FAILED(ConstraintsFromPolyData(rows, info.Time, plan.Constraints));
  }
  const auto ofKey = [&](const Result& result)
  { return result ? result : Result::Error(folder.PathOf(KeyFile) + ": " + result.Message()); };
  WAFT_RETURN_IF_FAILED(ofKey(TableFromJson(kept["report"], report)));
  WAFT_RETURN_IF_FAILED(ofKey(ReportFromTable(report, "planned report", plan.Report)));
  return ofKey(PlannedFromJson(kept["objects"], plan.Objects));
}

void FlightCheckpoint::TakePlan(const SceneInfo& info, PlanOutput& plan, std::string& lack)
{
  FolderBelow root, folder;
  bool isThere = false;
  if (!root.Open(this->Place.Root()) || !root.HasFolder(Name, isThere) || !isThere ||
      !folder.Open(root, Name))
  {
    lack = NotFound;
    return;
  }
  SceneJson kept;
  PlanOutput read;
  const Result found = this->ReadKept(folder, kept, lack);
  lack = found ? lack : found.Message();
  if (lack.empty())
  {
    const Result taken = this->ReadPlan(folder, kept, info, read);
    lack = taken ? "" : "it cannot be read: " + taken.Message();
  }
  if (lack.empty())
  {
    plan = std::move(read);
  }
}

Result FlightCheckpoint::KeepPlan(const SceneInfo& info, const PlanOutput& plan)
{
  std::string path;
  WAFT_RETURN_IF_FAILED(this->Place.Apart(Name, path));
  WAFT_RETURN_IF_FAILED(WritePlan(info, plan, path));
  FolderBelow folder;
  Manifest manifest;
  WAFT_RETURN_IF_FAILED(folder.Open(path));
  WAFT_RETURN_IF_FAILED(ManifestOf(folder, manifest));
  vtkNew<vtkTable> report;
  ReportToTable(plan.Report, info, report);
  const SceneJson kept = { { "key", this->Key },
                           { "objects", PlannedAsJson(plan.Objects) },
                           { "report", RowsAsJson(report) },
                           { "manifest", ManifestRows(manifest) } };
  WAFT_RETURN_IF_FAILED(WriteWholeFile(
    folder.PathOf(KeyFile), kept.dump(2, ' ', true, SceneJson::error_handler_t::replace) + "\n"));
  WAFT_RETURN_IF_FAILED(this->Clear());
  return this->Place.Put(Name);
}

void FlightCheckpoint::HandOn(const StateStore& store) const
{
  store.Keep(this->Key, this->Place.Folder(), std::string(Name) + "/" + AirState);
}

Result FlightCheckpoint::Clear() const
{
  FolderBelow folder;
  bool isThere = false;
  WAFT_RETURN_IF_FAILED(this->Place.Folder().HasFolder(Name, isThere));
  if (!isThere)
  {
    return Result::Ok();
  }
  std::vector<std::string> names;
  WAFT_RETURN_IF_FAILED(folder.Open(this->Place.Folder(), Name));
  WAFT_RETURN_IF_FAILED(folder.Names(names));
  for (const std::string& name : names)
  {
    WAFT_RETURN_IF_FAILED(IsOwnName(name) ? folder.Remove(name) : Result::Ok());
  }
  this->Place.Folder().RemoveEmpty(Name);
  return Result::Ok();
}

} // namespace waft
