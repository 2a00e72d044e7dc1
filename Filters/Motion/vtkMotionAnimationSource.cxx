// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMotionAnimationSource.h"

#include "Base/SliceOptions.h"
#include "Base/StateArchive.h"
#include "Bridge/Data/AirData.h"
#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Data/SpacetimeData.h"
#include "Bridge/Data/TrackData.h"
#include "Bridge/Data/VortexData.h"
#include "Bridge/Files/EmbeddedDatabase.h"
#include "Bridge/Files/FlightFiles.h"
#include "Bridge/Files/FlightJson.h"
#include "Bridge/Files/InstalledData.h"
#include "Bridge/Files/SceneFiles.h"
#include "Bridge/Files/ShapeColors.h"
#include "Bridge/Pipeline/MotionOutputs.h"
#include "Bridge/Pipeline/Ranks.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageInputs.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Chain/ChainScene.h"
#include "Chain/EditedScene.h"
#include "Chain/RunChain.h"
#include "Spacetime/Run/Spacetime.h"

#include <vtkCommand.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiProcessController.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTable.h>
#include <vtkTimeStamp.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <map>
#include <utility>

vtkStandardNewMacro(vtkMotionAnimationSource);

struct vtkMotionAnimationSource::Internals : waft::MotionOutputs
{
  vtkMotionAnimationSource* Self;
  vtkTimeStamp Named, ReadTime; // when the file was named, or to be read anew; and read
  waft::EditedScene File;
  waft::MotionDatabase Database; // stays in its place, where the memory's tools look for it
  bool HasDatabase = false;
  waft::ChainMemory Memory;
  std::size_t UntakenByAir = 0; // what was warned of when it was drawn
  std::map<std::pair<waft::ChainStage, std::string>, double> StageOptions;
  std::string CheckpointFolder;
  bool HasPlan = false;
  std::atomic<const char*> AtWork{ "" };
  vtkSmartPointer<vtkMultiProcessController> Controller;

  explicit Internals(vtkMotionAnimationSource* self) :
    MotionOutputs(self, waft::ColorsOfPoints), Self(self)
  {
  }
  ~Internals() override { this->Discard(); }

  bool IsRead() const { return this->ReadTime > this->Named; }
  bool Load();
  const waft::Scene& Read() const override { return this->File.Parts(); }
  waft::ChainOptions Options() const;
  bool Wants(waft::ChainStage stage) const override;
  /// The air was drawn for another scene.
  bool IsEdit() const
  {
    const std::vector<waft::AssimilationRound>& rounds = this->Made.Air.Rounds;
    const auto last = std::find_if(rounds.rbegin(), rounds.rend(),
                                   [](const waft::AssimilationRound& round)
                                   { return round.Stage == "draw" || round.Stage == "edit"; });
    return last != rounds.rend() && last->Stage == "edit";
  }
  bool WantsNewAir() const
  {
    return this->IsEdit() && this->Made.Air.Warnings.size() > this->UntakenByAir;
  }
  waft::Result Run(vtkInformationVector** inputs, waft::Monitor& monitor) override;
  double Slice() const override { return this->Self->Slice; }
  void Clear() override;

  void HandOver(waft::KeptStage& stage) { stage.Give(this->Self, this->Read(), this->Made); }
  const waft::PlanOutput& Planned() const { return this->Made.Plan; }
  waft::Result TakePlan(vtkPolyData* tracks, vtkPolyData* rows, vtkPolyData* vortices,
                        vtkTable* report);
  std::string FlightAsJson() const;
  void FillReport(vtkTable* report) const
  {
    waft::JoinedReportToTable(this->Made.Report, this->Scene, report);
  }
  std::string WriteFiles(const std::string& options) const;
};

waft::Result vtkMotionAnimationSource::Internals::TakePlan(vtkPolyData* tracks, vtkPolyData* rows,
                                                           vtkPolyData* vortices, vtkTable* report)
{
  waft::PlanOutput plan;
  WAFT_RETURN_IF_FAILED(waft::TracksFromPolyData(tracks, plan.Tracks));
  WAFT_RETURN_IF_FAILED(waft::VorticesFromPolyData(vortices, plan.Vortices));
  WAFT_RETURN_IF_FAILED(waft::ReportFromTable(report, "planned report", plan.Report));
  if (rows->GetNumberOfPoints() > 0)
  {
    WAFT_RETURN_IF_FAILED(
      waft::ConstraintsFromPolyData(rows, this->Read().Info.Time, plan.Constraints));
  }
  this->Made.Plan = std::move(plan);
  this->HasPlan = true;
  this->Self->Modified();
  return waft::Result::Ok();
}

std::string vtkMotionAnimationSource::Internals::FlightAsJson() const
{
  return waft::FlightAsJson(this->Made);
}

std::string vtkMotionAnimationSource::Internals::WriteFiles(const std::string& options) const
{
  waft::SilentMonitor monitor;
  return waft::WriteFlightAsJson(this->Read(), this->Made, options, monitor);
}

void vtkMotionAnimationSource::Internals::Clear()
{
  this->MotionOutputs::Clear();
  this->Memory = waft::ChainMemory();
  this->Database = waft::MotionDatabase();
  this->HasDatabase = false;
  this->HasPlan = false;
}

/// True where the file was read now.
bool vtkMotionAnimationSource::Internals::Load()
{
  if (this->IsRead())
  {
    return false;
  }
  this->Discard(); // it works on the scene that there was
  this->File.Read(waft::NamedFile(this->Self->FileName), this->Self->Edits, waft::VtkSceneAssets());
  this->Scene = this->Read().Info;
  this->ReadTime.Modified();
  return true;
}

waft::ChainOptions vtkMotionAnimationSource::Internals::Options() const
{
  waft::ChainOptions options =
    waft::ChainOptions::At(static_cast<waft::Quality>(this->Self->Quality));
  options.Seed = this->Self->Seed;
  options.StopAfter = static_cast<waft::ChainStage>(this->Self->StopAfter);
  options.Takes = waft::OptionsOf<waft::TakeOptions>(*this->Self);
  options.TimeLimit = this->Self->TimeLimit;
  options.HasPlan = this->HasPlan;
  options.Optimiser.MemoryLimit = this->Self->MemoryLimit;
  options.Air.EditOf = this->Self->EditOf;
  if (!this->CheckpointFolder.empty())
  {
    options.Air.CheckpointFile = this->CheckpointFolder + "/assimilation.state";
    options.Air.StateFile = this->CheckpointFolder + "/assimilated.state";
    options.Optimiser.CheckpointFile = this->CheckpointFolder + "/spacetime.state";
  }
  for (const auto& [option, value] : this->StageOptions)
  {
    options.Set(option.first, option.second, value);
  }
  return options;
}

bool vtkMotionAnimationSource::Internals::Wants(waft::ChainStage stage) const
{
  return this->Self->RangeError().empty() && static_cast<int>(stage) <= this->Self->StopAfter &&
         waft::RunsAt(stage, static_cast<waft::Quality>(this->Self->Quality));
}

waft::Result vtkMotionAnimationSource::Internals::Run(vtkInformationVector**,
                                                      waft::Monitor& monitor)
{
  if (this->Read().Objects.empty())
  {
    return waft::Result::Error(this->Self->FileName +
                               ": /objects: expected at least one object, found none");
  }
  if (!this->HasDatabase && this->Wants(waft::ChainStage::Planner))
  {
    if (!monitor.Tick(0.0, "Reading the motion database"))
    {
      return waft::Result::Stopped();
    }
    WAFT_RETURN_IF_FAILED(this->Self->Database.empty()
                            ? waft::ReadEmbeddedDatabase(this->Database)
                            : waft::ReadDatabaseFile(this->Self->Database, this->Database));
    this->HasDatabase = true;
  }
  waft::ControllerCommunicator ranks(this->Controller);
  const waft::ChainInputs given{ this->Read(),
                                 this->File.Wind(),
                                 this->Database,
                                 this->Controller != nullptr ? &ranks : nullptr,
                                 [this](waft::ChainStage stage)
                                 { this->AtWork = waft::TraitsOf(stage).Name; },
                                 [this](waft::ChainStage stage)
                                 {
                                   if (stage != waft::ChainStage::Planner || this->Slice() > 0.0)
                                   {
                                     return waft::Result::Ok();
                                   }
                                   this->Self->InvokeEvent(vtkCommand::UserEvent);
                                   return this->Self->GetAbortExecute() != 0
                                            ? waft::Result::Error("stopped once it was planned")
                                            : waft::Result::Ok();
                                 } };
  const waft::Result result =
    waft::RunChain(given, this->Options(), waft::SmpFor(), monitor, this->Made, &this->Memory);
  const bool hasBegun = *this->AtWork.load() != '\0';
  this->AtWork = "";
  this->Rejoin();
  if (!result && !hasBegun) // the scene as a whole
  {
    return waft::Result::Error(this->Self->FileName + ": " + result.Message());
  }
  WAFT_RETURN_IF_FAILED(result);
  this->UntakenByAir = this->IsEdit() ? this->UntakenByAir : this->Made.Air.Warnings.size();
  for (const auto& [stage, effort] : this->Made.Efforts) // what was kept has warned already
  {
    const std::vector<std::string>& warnings = this->Made.Warnings[stage];
    this->Warnings.insert(this->Warnings.end(), warnings.begin(), warnings.end());
  }
  WAFT_RETURN_IF_FAILED(this->KeepMotion());
  return result;
}

vtkMotionAnimationSource::vtkMotionAnimationSource() : Impl(std::make_unique<Internals>(this))
{
  waft::TakeDefaults<waft::FlightOptions, waft::TakeOptions>(*this);
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(waft::NumberOfMotionPorts);
  this->Impl->Named.Modified();
}

vtkMotionAnimationSource::~vtkMotionAnimationSource() = default;

double vtkMotionAnimationSource::InRange(const char* property, double value)
{
  return waft::InRange<waft::FlightOptions, waft::TakeOptions>(property, value);
}

waft::KeptStage& vtkMotionAnimationSource::Kept()
{
  return *this->Impl;
}

void vtkMotionAnimationSource::SetFileName(const std::string& name)
{
  this->FileName = name;
  this->Reload();
}

void vtkMotionAnimationSource::Reload()
{
  this->Impl->Named.Modified();
  this->Modified();
}

void vtkMotionAnimationSource::SetEdits(const std::string& edits)
{
  if (edits != this->Edits)
  {
    this->Edits = edits;
    this->Reload();
  }
}

std::string vtkMotionAnimationSource::GetHandles() const
{
  return this->Impl->File.Handles();
}

void vtkMotionAnimationSource::SaveScene()
{
  const waft::Result result =
    this->Impl->IsRead() ? this->Impl->File.Save()
                         : waft::Result::Error(this->FileName + ": expected a scene that was read, "
                                                                "found none: not saved");
  if (!result)
  {
    vtkErrorMacro(<< result.Message());
    return;
  }
  this->Edits.clear(); // the scene is the one that it was
}

bool vtkMotionAnimationSource::SaveSceneAs(const std::string& name)
{
  const waft::Result result = this->Impl->File.SaveAs(name, waft::VtkSceneAssets());
  if (!result)
  {
    vtkErrorMacro(<< result.Message());
  }
  return static_cast<bool>(result);
}

int vtkMotionAnimationSource::GetWantsNewAir() const
{
  return this->Impl->WantsNewAir() ? 1 : 0;
}

void vtkMotionAnimationSource::SetDatabase(const std::string& name)
{
  if (name != this->Database)
  {
    this->Database = name;
    this->LetGo();
    this->Modified();
  }
}

std::string vtkMotionAnimationSource::GetSceneDigest() const
{
  const waft::Scene& scene = this->Impl->Read();
  const waft::MotionProblem problem{ scene.Info,
                                     {},
                                     scene.Objects,
                                     scene.Constraints,
                                     waft::ObstaclesOfFrames(scene.Obstacles, scene.Info.Time),
                                     scene.Vortices,
                                     this->Impl->File.Wind().OfFrames(scene.Info.Time) };
  return std::to_string(waft::DigestOf(problem));
}

bool vtkMotionAnimationSource::SetStageOption(const std::string& stage, const std::string& name,
                                              double value)
{
  for (const waft::ChainStageTraits& traits : waft::ChainStages())
  {
    if (stage == traits.Name && waft::ChainOptions().Set(traits.Stage, name, value))
    {
      this->Impl->StageOptions[{ traits.Stage, name }] = value;
      this->Modified();
      return true;
    }
  }
  return false;
}

std::string vtkMotionAnimationSource::GetStageAtWork() const
{
  return this->Impl->AtWork.load();
}

std::string vtkMotionAnimationSource::WritePlan(const std::string& folder)
{
  return waft::WritePlan(this->Impl->Read().Info, this->Impl->Planned(), folder).Message();
}

std::string vtkMotionAnimationSource::TakePlan(vtkPolyData* tracks, vtkPolyData* rows,
                                               vtkPolyData* vortices, vtkTable* report)
{
  return this->Impl->TakePlan(tracks, rows, vortices, report).Message();
}

void vtkMotionAnimationSource::SetCheckpointFolder(const std::string& folder)
{
  this->Impl->CheckpointFolder = folder; // which changes nothing of the motion
}

void vtkMotionAnimationSource::SetController(vtkMultiProcessController* controller)
{
  this->Impl->Controller = controller; // likewise
}

std::string vtkMotionAnimationSource::GetFlight() const
{
  return this->Impl->FlightAsJson();
}

void vtkMotionAnimationSource::HandOver(vtkAlgorithm* stage)
{
  if (auto* sliced = vtkSlicedPolyDataAlgorithm::SafeDownCast(stage))
  {
    this->Impl->HandOver(sliced->Kept());
  }
}

void vtkMotionAnimationSource::GetReport(vtkTable* report) const
{
  this->Impl->FillReport(report);
}

std::string vtkMotionAnimationSource::WriteFlight(const std::string& options)
{
  return this->Impl->WriteFiles(options);
}

int vtkMotionAnimationSource::GetSceneSeed() const
{
  return static_cast<int>(this->Impl->Read().Info.Seed);
}

std::string vtkMotionAnimationSource::RangeError() const
{
  const auto error =
    [](const char* name, int last, const char* first, const char* lastName, int found)
  {
    return found >= 0 && found <= last
             ? std::string()
             : std::string(name) + ": expected 0 (" + first + ") to " + std::to_string(last) +
                 " (" + lastName + "), found " + std::to_string(found);
  };
  const std::string quality = error("Quality", PAPER, "Preview", "Paper", this->Quality);
  return !quality.empty() ? quality
                          : error("StopAfter", AFTER_ALL, "Scene", "VortexFit", this->StopAfter);
}

int vtkMotionAnimationSource::FillOutputPortInformation(int port, vtkInformation* info)
{
  const waft::ChainOutput& given = waft::MotionPorts()[static_cast<std::size_t>(port)].Given;
  return waft::FillOutput(given.Stage, waft::PortOf(given), info);
}

vtkTypeBool vtkMotionAnimationSource::ProcessRequest(vtkInformation* request,
                                                     vtkInformationVector** inputs,
                                                     vtkInformationVector* outputs)
{
  return waft::GuardedRequest(
    this, request, outputs, waft::RangesOf<waft::TakeOptions, waft::SliceOptions>(*this),
    [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });
}

int vtkMotionAnimationSource::RequestInformation(vtkInformation*, vtkInformationVector**,
                                                 vtkInformationVector* outputs)
{
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    // The pipeline asks the other ranks, of several, for their pieces only then.
    outputs->GetInformationObject(port)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 0);
  }
  if (this->FileName.empty())
  {
    return waft::FailInformation(outputs); // RequestData asks for the name
  }
  if (this->Impl->Load())
  {
    for (const std::string& warning : this->Impl->Read().Warnings)
    {
      vtkWarningMacro(<< warning);
    }
  }
  if (!this->Impl->File.Error().empty())
  {
    return waft::FailInformation(outputs);
  }
  const waft::SceneInfo& info = this->Impl->Read().Info;
  waft::SetTimeSteps(info.Time, outputs);
  const auto setExtent = [&](int port, bool isMade, const std::array<int, 3>& points)
  {
    int extent[6] = { 0, -1, 0, -1, 0, -1 };
    for (std::size_t axis = 0; axis < 3 && isMade; ++axis)
    {
      extent[2 * axis + 1] = points[axis] - 1;
    }
    outputs->GetInformationObject(port)->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(),
                                             extent, 6);
  };
  const bool draws = this->Impl->Wants(waft::ChainStage::Assimilation);
  const bool optimises = this->Impl->Wants(waft::ChainStage::Spacetime);
  setExtent(waft::AirPort, draws,
            draws ? waft::AirLatticeDimensions(info.Bounds, this->Impl->Options().Air)
                  : std::array<int, 3>{ 0, 0, 0 });
  setExtent(waft::WindPort, optimises,
            waft::WindLatticeDimensions(info.Bounds, this->Impl->Options().Optimiser));
  return 1;
}

int vtkMotionAnimationSource::RequestData(vtkInformation* request, vtkInformationVector** inputs,
                                          vtkInformationVector* outputs)
{
  if (this->FileName.empty())
  {
    return waft::Fail(this, outputs, "FileName: expected a scene file, found no name");
  }
  if (!this->Impl->File.Error().empty())
  {
    return waft::Fail(this, outputs, this->Impl->File.Error());
  }
  if (const std::string error = this->RangeError(); !error.empty())
  {
    return waft::Fail(this, outputs, error);
  }
  if (waft::IsPieceOfOthers(request, outputs))
  {
    return waft::Empty(outputs);
  }
  return this->Impl->RequestData(request, inputs, outputs);
}

void vtkMotionAnimationSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::FlightOptions, waft::TakeOptions>(os, indent, *this);
}
