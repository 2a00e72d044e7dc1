// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/FlyScene.h"

#include "Bridge/Files/EmbeddedDatabase.h"
#include "Bridge/Files/FlightFiles.h"
#include "Bridge/Files/FlightJson.h"
#include "Bridge/Files/InstalledData.h"
#include "Bridge/Files/SceneFiles.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Run/BuildName.h"
#include "Bridge/Run/FlightCheckpoint.h"
#include "Bridge/Run/MakeDatabase.h"
#include "Bridge/Run/ResultPlace.h"
#include "Bridge/Run/StateStore.h"

#include <vtkNew.h>
#include <vtkTable.h>

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>
#include <utility>

namespace waft
{
namespace
{

namespace fs = std::filesystem;

constexpr const char* ReportName = "report.json";
constexpr const char* StateName = "assimilated.state";
constexpr const char* PosesName = "poses.csv";
constexpr const char* NotPlanned = "stopped before the paths were planned: nothing was written";

ResultPlace::Form PlaceOf(const std::string& folder)
{
  return { folder, ReportName, "", {} };
}

bool DoObstaclesMove(const Scene& scene)
{
  return std::any_of(scene.Obstacles.begin(), scene.Obstacles.end(),
                     [](const ObstacleMesh& obstacle) { return obstacle.IsMoving(); });
}

/// What a run writes, folders with a slash at their end.
std::vector<std::string> ResultNames(const FlightRequest& request, const Scene& scene)
{
  std::vector<std::string> names = { "planned.vtp",     "optimized.vtp",   "poses.vtp",
                                     "vortices.vtp",    "objects.vtp",     "shapes.vtm",
                                     "shapes/",         "constraints.vtp", "constraints.csv",
                                     "convergence.csv", "animation.glb",   ReportName };
  const auto addIf = [&names](bool isWritten, std::initializer_list<const char*> own)
  { names.insert(names.end(), own.begin(), isWritten ? own.end() : own.begin()); };
  const Quality quality = request.Options.Detail;
  addIf(request.HasCsv, { PosesName });
  addIf(RunsAt(ChainStage::Spacetime, quality), { "wind.pvd", "wind/" });
  addIf(RunsAt(ChainStage::Assimilation, quality),
        { "assimilated.vtp", "air.pvd", "air/", "air_wind.pvd", "air_wind/", "rounds.csv" });
  addIf(RunsAt(ChainStage::Assimilation, quality) && request.KeepsState, { StateName });
  addIf(RunsAt(ChainStage::VortexFit, quality), { "fitted_vortices.vtp" });
  addIf(DoObstaclesMove(scene), { "obstacles.pvd", "obstacles/" });
  addIf(!DoObstaclesMove(scene), { "obstacles.vtp" });
  addIf(request.HasMeshes, { "meshes.pvd", "meshes/" });
  addIf(request.HasParticles, { "particles.pvd", "particles/" });
  return names;
}

/// With the quality that the scene is flown at, and what that gives.
FlightRequest AsFlown(const FlightRequest& request, const Scene& scene)
{
  FlightRequest flown = request;
  flown.Options.Detail = FlownQuality(scene, request.Options.Detail);
  flown.HasParticles = flown.HasParticles && RunsAt(ChainStage::Spacetime, flown.Options.Detail);
  return flown;
}

SceneJson ParsedObject(const std::string& text)
{
  const SceneJson parsed = SceneJson::parse(text, nullptr, false);
  return parsed.is_object() ? parsed : SceneJson::object();
}

/// What a finished run says of itself.
struct EditedRun
{
  std::string State; // the file with its air; empty: it is kept no more
  std::string Key;
  std::int64_t Seed = -1;
};

Result FindEdited(const FlightRequest& request, EditedRun& run)
{
  const std::string& folder = request.EditOf;
  if (request.Options.Detail == Quality::Paper)
  {
    return Result::Error("edit_of: a run of quality paper has no air to keep");
  }
  std::error_code failure;
  if (!fs::is_directory(folder, failure))
  {
    return Result::Error(folder + ": no such folder; `waft synthesize` makes it");
  }
  ResultPlace place(PlaceOf(folder));
  WAFT_RETURN_IF_FAILED(place.Settle());
  FolderBelow below;
  std::string text;
  bool hasState = false, hasReport = false;
  WAFT_RETURN_IF_FAILED(below.Open(folder));
  WAFT_RETURN_IF_FAILED(below.HasFile(StateName, hasState));
  WAFT_RETURN_IF_FAILED(below.HasFile(ReportName, hasReport));
  WAFT_RETURN_IF_FAILED(hasReport ? below.Read(ReportName, text) : Result::Ok());
  const SceneJson report = ParsedObject(text);
  const auto seed = report.find("seed"), key = report.find("key"), quality = report.find("quality");
  if (hasReport && (seed == report.end() || !seed->is_number_unsigned()))
  {
    return Result::Error(below.PathOf(ReportName) +
                         ": /seed: expected a whole number from 0, found something else");
  }
  if (!hasState && (!hasReport || (quality != report.end() && *quality == "paper")))
  {
    return Result::Error(below.PathOf(StateName) +
                         ": no such file; expected the folder of a finished run, of another "
                         "quality than paper");
  }
  run.Seed = hasReport ? seed->get<std::int64_t>() : -1;
  run.Key = key != report.end() && key->is_string() ? key->get<std::string>() : "";
  run.State = hasState ? below.PathOf(StateName) : StateStore().Found(run.Key);
  return Result::Ok();
}

/// Where the database of a request is, and which of those that were there at times.
std::string DatabaseName(const FlightRequest& request)
{
  std::string path = request.Database;
  if (path.empty())
  {
    (void)FindDataFile("Database/embedded.vtm", path);
  }
  std::error_code failure;
  struct stat about = {};
  (void)::stat(path.c_str(), &about);
  return fs::weakly_canonical(path, failure).string() + " " + std::to_string(about.st_size) + " " +
         std::to_string(about.st_mtim.tv_sec) + "." + std::to_string(about.st_mtim.tv_nsec);
}

std::string KeyOf(const FlightRequest& request, const ChainInputs& inputs,
                  const ChainOptions& options, const std::string& edited)
{
  return Sha256(DatabaseName(request) + "\n" + DigestOfRun(inputs.TheScene, inputs.Wind, options) +
                "\n" + edited + "\n" + BuildName)
    .substr(std::strlen("sha256:"));
}

/// Where airs are kept for runs with other marks: among those of finished runs.
DrawnAirs KeptDrawnAirs()
{
  const auto name = [](std::uint64_t key)
  {
    return Sha256("drawn air\n" + std::to_string(key) + "\n" + BuildName)
      .substr(std::strlen("sha256:"));
  };
  return { [name](std::uint64_t key) { return StateStore().Found(name(key)); },
           [name](std::uint64_t key, const std::function<Result(const std::string&)>& write)
           { StateStore().Make(name(key), write); } };
}

/// Stops for those stages alone whose best so far is a motion, and keeps what was asked.
class StageMonitor : public Monitor
{
public:
  StageMonitor(FlightMonitor& whole, bool endsWhole) : Whole(whole), EndsWhole(endsWhole) {}
  bool Tick(double fraction, const std::string& text) override
  {
    this->Done = fraction;
    this->IsAsked = !this->Whole.Tick(fraction, text) || this->IsAsked;
    return !this->IsAsked || (this->EndsWhole && this->Stage > ChainStage::Spacetime);
  }
  bool Publishes() const override { return this->Whole.Publishes(); }
  void Begin(ChainStage stage)
  {
    this->Stage = stage;
    this->Whole.Begin(stage);
  }
  /// Whether it is to stop now.
  bool Ask(const std::string& text) { return !this->Tick(this->Done, text) || this->IsAsked; }

  FlightMonitor& Whole;
  bool EndsWhole;
  ChainStage Stage = ChainStage::Scene;
  double Done = 0.0;
  bool IsAsked = false;
};

/// One flight.
class Flying
{
public:
  Flying(const FlightRequest& request, const ChainInputs& inputs, FlightMonitor& monitor,
         Motion& made, ChainMemory* memory, FlightRecord& record) :
    Request(request),
    Inputs(inputs), Watch(monitor, request.EndsWhole), Made(made), Memory(memory), Record(record),
    Options(request.Options), Place(PlaceOf(request.Output))
  {
  }

  Result Fly()
  {
    WAFT_RETURN_IF_FAILED(this->Prepare());
    const Result flown = this->Run();
    if (!flown && this->Place.IsHeld() && flown.Kind() == ErrorKind::Input)
    {
      WAFT_RETURN_IF_FAILED(this->Checkpoint->Clear()); // it would only be refused anew
    }
    WAFT_RETURN_IF_FAILED(flown);
    WAFT_RETURN_IF_FAILED(this->Writes() ? this->Write() : Result::Ok());
    return this->Record.IsStopped ? Result::Stopped() : Result::Ok();
  }

private:
  bool Writes() const { return !this->Request.Output.empty(); }

  Result Prepare();
  Result Run();
  Result Planned();
  Result Write();

  const FlightRequest& Request;
  const ChainInputs& Inputs;
  StageMonitor Watch;
  Motion& Made;
  ChainMemory* Memory;
  FlightRecord& Record;
  ChainOptions Options;
  ResultPlace Place;
  std::optional<FlightCheckpoint> Checkpoint;
  Effort Start = Effort::Now();
  bool IsPlanned = false;
};

Result Flying::Prepare()
{
  const Scene& scene = this->Inputs.TheScene;
  if (scene.Objects.empty())
  {
    return Result::Error(this->Request.Scene +
                         ": /objects: expected at least one object, found none");
  }
  EditedRun edited;
  if (!this->Request.EditOf.empty())
  {
    WAFT_RETURN_IF_FAILED(FindEdited(this->Request, edited));
    this->Options.Air.EditOf = edited.State;
    edited.Key = edited.Key.empty() ? this->Request.EditOf : edited.Key;
    if (edited.State.empty())
    {
      this->Record.Warnings.push_back("edit_of: " + this->Request.EditOf +
                                      ": the state of that run is kept no more: flown from the "
                                      "start, in an air of its own");
    }
  }
  if (this->Options.Seed < 0)
  {
    this->Options.Seed =
      edited.Seed >= 0 ? edited.Seed : static_cast<std::int64_t>(scene.Info.Seed);
  }
  this->Record.EditedState = this->Options.Air.EditOf;
  this->Record.Seed = this->Options.Seed;
  this->Record.Key = KeyOf(this->Request, this->Inputs, this->Options,
                           this->Request.EditOf.empty() ? this->Options.Air.EditOf : edited.Key);
  this->Record.IsKept = false;
  if (this->Request.TakesKept && this->Options.Air.EditOf.empty() &&
      RunsAt(ChainStage::Assimilation, this->Options.Detail))
  {
    this->Options.Air.EditOf = StateStore().Found(this->Record.Key);
    this->Record.IsKept = !this->Options.Air.EditOf.empty();
  }
  if (!this->Writes())
  {
    return Result::Ok();
  }
  WAFT_RETURN_IF_FAILED(this->Place.Look(ResultNames(this->Request, scene)));
  this->Checkpoint.emplace(this->Place, this->Record.Key);
  WAFT_RETURN_IF_FAILED(this->Checkpoint->Look());
  const std::string folder = this->Checkpoint->Folder();
  this->Options.Air.CheckpointFile = folder + "/assimilation.state";
  this->Options.Air.StateFile = this->Checkpoint->AirFile();
  if (this->Request.Resumes)
  {
    std::string lack;
    this->Checkpoint->TakePlan(scene.Info, this->Made.Plan, lack);
    this->Options.HasPlan = lack.empty();
    if (!lack.empty())
    {
      this->Record.Warnings.push_back("--resume: " + this->Request.Output + ": " + lack +
                                      ": done from the start");
    }
    std::error_code failure; // the air was done when the run was stopped
    if (lack.empty() && fs::is_regular_file(this->Checkpoint->AirFile(), failure))
    {
      this->Options.Air.EditOf = this->Checkpoint->AirFile();
    }
  }
  return Result::Ok();
}

// Now there is something to write, the plan at first, unless it was found there.
Result Flying::Planned()
{
  if (this->Request.EndsWhole && this->Watch.Ask("planned"))
  {
    return Result::Error(NotPlanned, ErrorKind::Stopped);
  }
  this->IsPlanned = true;
  this->Watch.Whole.Keep();
  if (!this->Writes())
  {
    return Result::Ok();
  }
  WAFT_RETURN_IF_FAILED(this->Place.Enter());
  return this->Options.HasPlan
           ? Result::Ok()
           : this->Checkpoint->KeepPlan(this->Inputs.TheScene.Info, this->Made.Plan);
}

Result Flying::Run()
{
  ChainInputs inputs = this->Inputs;
  inputs.Drawn = KeptDrawnAirs();
  bool hasBegun = false;
  inputs.Begins = [&](ChainStage stage)
  {
    hasBegun = true;
    this->Watch.Begin(stage);
  };
  inputs.Ended = [this](ChainStage stage)
  { return stage == ChainStage::Planner ? this->Planned() : Result::Ok(); };
  if (this->Options.TimeLimit > 0.0)
  {
    constexpr double least = 0.001; // 0 is none
    const double passed = this->Record.Reading.Seconds + Effort::Now().Since(this->Start).Seconds;
    this->Options.TimeLimit = std::max(this->Options.TimeLimit - passed, least);
  }
  const Result flown =
    RunChain(inputs, this->Options, SmpFor(), this->Watch, this->Made, this->Memory);
  if (!flown && !hasBegun) // the scene as a whole
  {
    return Result::Error(this->Request.Scene + ": " + flown.Message(), flown.Kind());
  }
  if (!flown && !this->Request.Database.empty() &&
      flown.Message().rfind("motion database: ", 0) == 0)
  {
    return Result::Error(this->Request.Database + ": " + flown.Message(), flown.Kind());
  }
  WAFT_RETURN_IF_FAILED(flown);
  this->Record.IsHurried = this->Watch.IsAsked;
  this->Record.IsStopped = this->Made.IsStopped || this->Watch.IsAsked;
  if (this->Request.EndsWhole && this->Record.IsStopped && !this->IsPlanned)
  {
    return Result::Error(NotPlanned, ErrorKind::Stopped);
  }
  for (const auto& [stage, effort] : this->Made.Efforts) // what was kept has warned already
  {
    const std::vector<std::string>& own = this->Made.Warnings[stage];
    this->Record.Warnings.insert(this->Record.Warnings.end(), own.begin(), own.end());
  }
  if (this->Record.IsStopped && this->Made.MovedBy() == ChainStage::Planner &&
      RunsAt(ChainStage::Assimilation, this->Options.Detail))
  {
    this->Record.Warnings.emplace_back(
      "stopped before the paths of the plan were moved by air: they are the plan's");
  }
  return Result::Ok();
}

struct Writing
{
  ResultPlace& Place;
  std::string PlannedFile, AirFile;
  bool IsShown = false;
};

SceneJson Summary(const FlightRequest& request, const Scene& scene, const Motion& made,
                  const FlightRecord& record)
{
  SceneJson report = { { "version", WaftVersion },
                       { "scene", fs::path(request.Scene).filename().string() },
                       { "title", scene.Title },
                       { "seed", record.Seed },
                       { "key", record.Key } };
  SceneJson& stages = report["stages"] = SceneJson::object();
  stages[TraitsOf(ChainStage::Scene).Word] = AsJson(record.Reading);
  for (const ChainStageTraits& stage : ChainStages())
  {
    const auto effort = made.Efforts.find(stage.Stage);
    if (effort != made.Efforts.end())
    {
      stages[stage.Word] = AsJson(effort->second);
    }
  }
  report["writing"] = nullptr; // in its place
  report["quality"] = ToString(request.Options.Detail);
  report["defaults"] = ParsedObject(request.Defaults);
  return report;
}

void Tell(const FlightRequest& request, const SceneInfo& info, const Motion& made,
          const FlightRecord& record, SceneJson& report)
{
  vtkNew<vtkTable> table;
  JoinedReportToTable(made.Report, info, table);
  SceneJson counts = SceneJson::object(), unmet = SceneJson::array();
  for (const ConstraintStatus status :
       { ConstraintStatus::Met, ConstraintStatus::Infeasible, ConstraintStatus::Conflict,
         ConstraintStatus::Unreachable })
  {
    counts[ToString(status)] = 0;
  }
  for (const SceneJson& row : RowsAsJson(table))
  {
    const std::string status = row["Status"].get<std::string>();
    counts[status] = counts[status].get<int>() + 1;
    if (status != ToString(ConstraintStatus::Met))
    {
      unmet.push_back(row);
    }
  }
  report["constraints"] = counts;
  report["constraints"]["unmet"] = unmet;
  report["objects"] = PlannedAsJson(made.Plan.Objects);
  report["without"] = SceneJson::array();
  if (!request.HasCsv)
  {
    report["without"].push_back(PosesName);
  }
  report["stoppedEarly"] = record.IsStopped;
  if (record.IsStopped)
  {
    report["stopped"] = { { "in", made.IsStopped ? TraitsOf(made.StoppedIn).Word : "" },
                          { "motion", TraitsOf(made.MovedBy()).Word },
                          { "leftOut", record.LeftOut(request, made) } };
  }
  report["warnings"] = record.Warnings;
}

/// Every file of a flight, all at once.
Result WriteFolder(const FlightRequest& request, const Scene& scene, const Motion& made,
                   FlightRecord& record, const Writing& writing)
{
  const Effort begin = Effort::Now();
  std::string path;
  WAFT_RETURN_IF_FAILED(writing.Place.StagedPath(ReportName, path));
  std::error_code failure;
  const bool hasAir = !made.Air.Air->Velocity.IsEmpty();
  FlightFileOptions options;
  options.Folder = fs::path(path).parent_path().string();
  options.HasCsv = request.HasCsv;
  options.HasMeshes = request.HasMeshes;
  options.HasParticles = request.HasParticles;
  options.HasAllAir = request.KeepsAir;
  options.IsHurried = record.IsHurried;
  options.HasFields = !writing.IsShown;
  options.PlannedFile = writing.PlannedFile;
  if (request.KeepsState && hasAir && !record.IsHurried &&
      fs::is_regular_file(writing.AirFile, failure))
  {
    options.AirStateFile = writing.AirFile;
  }
  SilentMonitor silent;
  SceneJson told;
  std::vector<std::string> odd;
  const Result written = WriteFlight(scene, made, options, silent, told, odd);
  if (!written)
  {
    return Result::Error(written.Message(), ErrorKind::Disk);
  }
  for (const std::string& warning : odd)
  {
    if (std::find(record.Warnings.begin(), record.Warnings.end(), warning) == record.Warnings.end())
    {
      record.Warnings.push_back(warning);
    }
  }
  SceneJson report = Summary(request, scene, made, record);
  report.update(told);
  Tell(request, scene.Info, made, record, report);
  report["writing"] = AsJson(Effort::Now().Since(begin));
  return writing.Place.Commit(std::move(report));
}

Result Flying::Write()
{
  this->Watch.Whole.Write();
  WAFT_RETURN_IF_FAILED(WriteFolder(
    this->Request, this->Inputs.TheScene, this->Made, this->Record,
    { this->Place, this->Checkpoint->PlannedFile(), this->Checkpoint->AirFile(), false }));
  if (!this->Record.IsStopped)
  {
    this->Checkpoint->HandOn(StateStore());
    WAFT_RETURN_IF_FAILED(this->Checkpoint->Clear());
  }
  this->Place.Release();
  return Result::Ok();
}

} // namespace

FlightRequest FlightRequestFromJson(const std::string& text)
{
  const SceneJson given = ParsedObject(text);
  FlightRequest request;
  request.Output = given.value("Output", request.Output);
  request.EditOf = given.value("EditOf", request.EditOf);
  request.Resumes = given.value("Resumes", request.Resumes);
  request.HasCsv = given.value("HasCsv", request.HasCsv);
  request.HasMeshes = given.value("HasMeshes", request.HasMeshes);
  request.HasParticles = given.value("HasParticles", request.HasParticles);
  request.KeepsAir = given.value("KeepsAir", request.KeepsAir);
  request.KeepsState = given.value("KeepsState", request.KeepsState);
  request.EndsWhole = given.value("EndsWhole", request.EndsWhole);
  request.Defaults = given.value("Defaults", SceneJson::object()).dump();
  return request;
}

std::vector<std::string> FlightRecord::LeftOut(const FlightRequest& request,
                                               const Motion& made) const
{
  std::vector<std::string> names;
  const auto addIf = [&](bool isLeftOut, const char* name)
  {
    if (isLeftOut && this->IsHurried)
    {
      names.emplace_back(name);
    }
  };
  const bool hasAir = !made.Air.Air->Velocity.IsEmpty();
  addIf(hasAir, "air.pvd");
  addIf(hasAir, "air_wind.pvd");
  addIf(made.MovedBy() == ChainStage::Spacetime, "wind.pvd");
  addIf(request.HasMeshes, "meshes.pvd");
  addIf(request.HasParticles, "particles.pvd");
  return names;
}

bool Flight::IsMet() const
{
  return std::all_of(this->Made.Report.begin(), this->Made.Report.end(),
                     [](const JoinedRow& row)
                     { return row.Target == OfNoRow || row.Status == ConstraintStatus::Met; });
}

Result CheckSceneFile(const std::string& path)
{
  struct stat about = {};
  const bool isThere = path.find('\0') == std::string::npos && ::stat(path.c_str(), &about) == 0;
  if (!isThere && path != "-")
  {
    return Result::Error(path + ": no such scene file");
  }
  const std::string found =
    isThere ? KindOf(about) : "a pipe"; // as other programs call their input
  return found.empty() ? Result::Ok()
                       : Result::Error(path + ": expected a regular file, found " + found);
}

Result FlyInto(const FlightRequest& request, const ChainInputs& inputs, FlightMonitor& monitor,
               Motion& made, ChainMemory* memory, FlightRecord& record)
{
  try
  {
    const FlightRequest flown = AsFlown(request, inputs.TheScene);
    if (flown.Options.Detail != request.Options.Detail)
    {
      record.Warnings.push_back(
        std::string("quality ") + ToString(request.Options.Detail) +
        ": it knows no open sides, no loop, nor objects that appear or leave: flown as " +
        ToString(flown.Options.Detail));
    }
    return Flying(flown, inputs, monitor, made, memory, record).Fly();
  }
  catch (const std::bad_alloc&)
  {
    return Result::Error(request.Scene + ": found too little memory for it", ErrorKind::Memory);
  }
}

Result FlyScene(const FlightRequest& request, Communicator* ranks, FlightMonitor& monitor,
                Flight& flight)
{
  const Effort begin = Effort::Now();
  const std::string& database = request.Database;
  WAFT_RETURN_IF_FAILED(CheckSceneFile(request.Scene));
  WAFT_RETURN_IF_FAILED(database.empty() ? Result::Ok() : CheckDatabase(database));
  try
  {
    WAFT_RETURN_IF_FAILED(
      ReadSceneAndWind(request.Scene, VtkSceneAssets(), flight.TheScene, flight.Wind));
    flight.Record.Reading = Effort::Now().Since(begin);
    WAFT_RETURN_IF_FAILED(database.empty() ? ReadEmbeddedDatabase(flight.Database)
                                           : ReadDatabaseFile(database, flight.Database));
  }
  catch (const std::bad_alloc&)
  {
    return Result::Error(request.Scene + ": found too little memory for it", ErrorKind::Memory);
  }
  flight.Record.Warnings = flight.TheScene.Warnings;
  return FlyInto(request, { flight.TheScene, flight.Wind, flight.Database, ranks }, monitor,
                 flight.Made, nullptr, flight.Record);
}

Result SaveFlight(const FlightRequest& wanted, const Scene& scene, const Motion& made,
                  FlightRecord& record, bool isShown)
{
  const FlightRequest request = AsFlown(wanted, scene);
  ResultPlace place(PlaceOf(request.Output));
  WAFT_RETURN_IF_FAILED(place.Enter());
  WAFT_RETURN_IF_FAILED(place.Check(ResultNames(request, scene)));
  return WriteFolder(request, scene, made, record,
                     { place, "", StateStore().Found(record.Key), isShown });
}

} // namespace waft
