// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMotionAnimationSource.h"

#include "Base/SliceOptions.h"
#include "Bridge/Data/AirData.h"
#include "Bridge/Data/SpacetimeData.h"
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
#include "Bridge/Run/FlyScene.h"
#include "Bridge/Run/StateStore.h"
#include "Chain/EditedScene.h"
#include "Chain/RunChain.h"
#include "Spacetime/Run/Spacetime.h"

#include <vtkCommand.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiProcessController.h>
#include <vtkObjectFactory.h>
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
  waft::FlightRequest Asked = Unasked();
  waft::FlightRecord Record;
  std::string Fault; // whose the last failure was; empty without one
  std::atomic<const char*> AtWork{ "" };
  vtkSmartPointer<vtkMultiProcessController> Controller;

  explicit Internals(vtkMotionAnimationSource* self) :
    MotionOutputs(self, waft::ColorsOfPoints), Self(self)
  {
  }
  ~Internals() override { this->Discard(); }

  class Progress;
  static waft::FlightRequest Unasked()
  {
    waft::FlightRequest request;
    request.EndsWhole = false;
    request.TakesKept = true;
    return request;
  }
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
  void FillReport(vtkTable* report) const
  {
    waft::JoinedReportToTable(this->Made.Report, this->Scene, report);
  }
  std::string Told() const;
  void KeepAir() const;
  waft::Result Save(const waft::FlightRequest& asked, bool isShown);
};

/// What FlyInto does for a source: its stages' names, and an event once there is something to keep.
class vtkMotionAnimationSource::Internals::Progress : public waft::FlightMonitor
{
public:
  Progress(Internals& own, waft::Monitor& monitor) : Own(own), Whole(monitor) {}
  bool Tick(double fraction, const std::string& text) override
  {
    return this->Whole.Tick(fraction, text);
  }
  bool Publishes() const override { return this->Whole.Publishes(); }
  void Begin(waft::ChainStage stage) override { this->Own.AtWork = waft::TraitsOf(stage).Word; }
  void Keep() override
  {
    if (this->Own.Asked.EndsWhole)
    {
      this->Own.Self->InvokeEvent(vtkCommand::UserEvent);
    }
  }
  void Write() override
  {
    this->Own.AtWork = "";
    this->Whole.Tick(1.0, "writing the results");
  }

private:
  Internals& Own;
  waft::Monitor& Whole;
};

std::string vtkMotionAnimationSource::Internals::Told() const
{
  waft::SceneJson told = waft::SceneJson::object();
  const auto wordOf = [](waft::ChainStage stage) { return waft::TraitsOf(stage).Word; };
  told["stages"] = { { wordOf(waft::ChainStage::Scene), waft::AsJson(this->Record.Reading) } };
  for (const auto& [stage, effort] : this->Made.Efforts)
  {
    told["stages"][wordOf(stage)] = waft::AsJson(effort);
  }
  told["fault"] = this->Fault;
  told["quality"] = waft::ToString(
    waft::FlownQuality(this->Read(), static_cast<waft::Quality>(this->Self->Quality)));
  told["seed"] = this->Record.Seed;
  told["key"] = this->Record.Key;
  told["editOf"] = this->Record.EditedState;
  told["isStopped"] = this->Record.IsStopped;
  told["stoppedIn"] = this->Made.IsStopped ? wordOf(this->Made.StoppedIn) : "";
  told["leftOut"] = this->Record.LeftOut(this->Asked, this->Made);
  told["movedBy"] = wordOf(this->Made.MovedBy());
  told["hasAir"] = !this->Made.Air.Air->Velocity.IsEmpty();
  told["warnings"] = this->Record.Warnings;
  return told.dump(-1, ' ', false, waft::SceneJson::error_handler_t::replace);
}

void vtkMotionAnimationSource::Internals::KeepAir() const
{
  if (this->IsComplete() && this->Memory.Air.IsFinished)
  {
    waft::StateStore().Make(this->Record.Key, [this](const std::string& path)
                            { return waft::WriteState(path, this->Memory.Air, waft::SmpFor()); });
  }
}

waft::Result vtkMotionAnimationSource::Internals::Save(const waft::FlightRequest& asked,
                                                       bool isShown)
{
  if (this->Made.Tracks.empty() || !this->IsComplete())
  {
    return waft::Result::Error(this->Self->FileName +
                               ": expected a flight that is over, found none: fly it first");
  }
  waft::FlightRequest request = asked;
  request.Scene = this->Self->FileName;
  request.Options = this->Options();
  return waft::SaveFlight(request, this->Read(), this->Made, this->Record, isShown);
}

void vtkMotionAnimationSource::Internals::Clear()
{
  this->MotionOutputs::Clear();
  this->Memory = waft::ChainMemory();
  this->Database = waft::MotionDatabase();
  this->HasDatabase = false;
}

/// True where the file was read now.
bool vtkMotionAnimationSource::Internals::Load()
{
  if (this->IsRead())
  {
    return false;
  }
  this->Discard(); // it works on the scene that there was
  const waft::Effort begin = waft::Effort::Now();
  this->File.Read(waft::NamedFile(this->Self->FileName), this->Self->Edits, waft::VtkSceneAssets());
  this->Scene = this->Read().Info;
  this->Record = waft::FlightRecord();
  this->Record.Reading = waft::Effort::Now().Since(begin);
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
  options.Optimiser.MemoryLimit = this->Self->MemoryLimit;
  options.Air.EditOf = this->Self->EditOf;
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
  waft::FlightRequest request = this->Asked;
  request.Scene = this->Self->FileName;
  request.Database = this->Self->Database;
  request.Options = this->Options();
  this->Asked.Output.clear(); // once
  this->Asked.Resumes = false;
  this->Record.Warnings = this->Read().Warnings;
  Progress progress(*this, monitor);
  const waft::Result result = waft::FlyInto(request,
                                            { this->Read(), this->File.Wind(), this->Database,
                                              this->Controller != nullptr ? &ranks : nullptr },
                                            progress, this->Made, &this->Memory, this->Record);
  this->AtWork = "";
  this->Rejoin();
  this->Fault = result ? "" : waft::ToString(result.Kind());
  WAFT_RETURN_IF_FAILED(result);
  this->UntakenByAir =
    this->IsEdit() && !this->Record.IsKept ? this->UntakenByAir : this->Made.Air.Warnings.size();
  this->Warnings.insert(this->Warnings.end(),
                        this->Record.Warnings.begin() +
                          static_cast<std::ptrdiff_t>(this->Read().Warnings.size()),
                        this->Record.Warnings.end()); // the scene's are told already
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

void vtkMotionAnimationSource::SetFlight(const std::string& request)
{
  this->Impl->Asked = waft::FlightRequestFromJson(request);
  if (!this->Impl->Asked.Output.empty())
  {
    this->Modified();
  }
}

void vtkMotionAnimationSource::SetController(vtkMultiProcessController* controller)
{
  this->Impl->Controller = controller; // likewise
}

std::string vtkMotionAnimationSource::GetFlight() const
{
  return this->Impl->Told();
}

void vtkMotionAnimationSource::HandOver(vtkAlgorithm* stage)
{
  if (auto* own = vtkKeptPolyDataAlgorithm::SafeDownCast(stage))
  {
    this->Impl->HandOver(own->Kept());
  }
}

void vtkMotionAnimationSource::GetReport(vtkTable* report) const
{
  this->Impl->FillReport(report);
}

std::string vtkMotionAnimationSource::SaveFlight(const std::string& request, int isShown)
{
  const waft::Result saved = this->Impl->Save(waft::FlightRequestFromJson(request), isShown != 0);
  this->Impl->Fault = saved ? "" : waft::ToString(saved.Kind());
  return saved.Message();
}

void vtkMotionAnimationSource::KeepFlight()
{
  this->Impl->KeepAir();
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
