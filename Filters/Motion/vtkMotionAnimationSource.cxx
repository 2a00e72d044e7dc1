// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMotionAnimationSource.h"

#include "Base/SliceOptions.h"
#include "Bridge/Data/AirData.h"
#include "Bridge/Data/SpacetimeData.h"
#include "Bridge/Files/EmbeddedDatabase.h"
#include "Bridge/Files/InstalledData.h"
#include "Bridge/Files/SceneFiles.h"
#include "Bridge/Files/ShapeColors.h"
#include "Bridge/Pipeline/MotionOutputs.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageInputs.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Chain/EditedScene.h"
#include "Chain/RunChain.h"
#include "Spacetime/Run/Spacetime.h"

#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTimeStamp.h>

#include <algorithm>
#include <array>
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
};

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
    WAFT_RETURN_IF_FAILED(waft::ReadEmbeddedDatabase(this->Database));
    this->HasDatabase = true;
  }
  const waft::Result result =
    waft::RunChain({ this->Read(), this->File.Wind(), this->Database }, this->Options(),
                   waft::SmpFor(), monitor, this->Made, &this->Memory);
  this->Rejoin();
  WAFT_RETURN_IF_FAILED(result);
  this->UntakenByAir = this->IsEdit() ? this->UntakenByAir : this->Made.Air.Warnings.size();
  for (const auto& [stage, seconds] : this->Made.Seconds) // what was kept has warned already
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
