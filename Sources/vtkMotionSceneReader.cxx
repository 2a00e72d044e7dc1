// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMotionSceneReader.h"

#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/ShapeData.h"
#include "Bridge/Data/VortexData.h"
#include "Bridge/Files/InstalledData.h"
#include "Bridge/Files/SceneFiles.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageInputs.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Chain/ChainScene.h"
#include "Scene/Scene.h"
#include "Scene/SceneFileOptions.h"
#include "Scene/SceneWind.h"

#include <vtkAlgorithm.h>
#include <vtkDemandDrivenPipeline.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>

vtkStandardNewMacro(vtkMotionSceneReader);

struct vtkMotionSceneReader::Contents
{
  waft::Scene Scene;
  waft::SceneWind Wind;
  waft::StageCache Cache;
  std::string Error;
  bool IsMoving = false; // an obstacle does
  // What does not change in time, filled once: later stages ask for every frame.
  vtkNew<vtkPolyData> KeptObjects, KeptConstraints, KeptObstacles, KeptVortices;
  vtkNew<vtkMultiBlockDataSet> KeptShapes;

  void Load(const std::string& file)
  {
    this->Scene = {};
    this->Wind = {};
    this->Error =
      waft::ReadSceneAndWind(file, waft::VtkSceneAssets(), this->Scene, this->Wind).Message();
    this->Keep();
  }

  void Keep()
  {
    const waft::SceneInfo& info = this->Scene.Info;
    this->IsMoving = std::any_of(this->Scene.Obstacles.begin(), this->Scene.Obstacles.end(),
                                 [](const waft::ObstacleMesh& o) { return o.IsMoving(); });
    waft::ObjectsToPolyData(this->Scene.Objects, info, this->KeptObjects);
    waft::AddArrivals(this->Scene.Constraints, {}, this->KeptObjects);
    waft::ConstraintsToPolyData(this->Scene.Constraints, info, this->KeptConstraints);
    waft::ObstaclesToPolyData(this->Scene.Obstacles, 0.0, info, this->KeptObstacles);
    waft::VorticesToPolyData(this->Scene.Vortices, info, this->KeptVortices);
    waft::ShapesToMultiBlock(this->Scene.Shapes, info, this->KeptShapes);
    const waft::AuthoredScene& authored = this->Scene.Authored;
    waft::AuthoredToFieldData(authored.Objects, this->KeptObjects);
    waft::AuthoredToFieldData(authored.Constraints, this->KeptConstraints);
    waft::AuthoredToFieldData(authored.Obstacles, this->KeptObstacles);
  }
};

vtkMotionSceneReader::vtkMotionSceneReader() : Read(new Contents)
{
  waft::TakeDefaults<waft::SceneReadOptions>(*this);
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(WIND + 1);
}

vtkMotionSceneReader::~vtkMotionSceneReader() = default;

void vtkMotionSceneReader::SetFileName(const std::string& name)
{
  this->FileName = name;
  this->Modified();
}

int vtkMotionSceneReader::GetSceneSeed() const
{
  return static_cast<int>(this->Read->Scene.Info.Seed);
}

int vtkMotionSceneReader::FillOutputPortInformation(int port, vtkInformation* info)
{
  return waft::FillOutput(waft::ChainStage::Scene, port, info);
}

vtkTypeBool vtkMotionSceneReader::ProcessRequest(vtkInformation* request,
                                                 vtkInformationVector** inputs,
                                                 vtkInformationVector* outputs)
{
  return waft::GuardedRequest(this, request, outputs, waft::RangesOf<waft::SceneReadOptions>(*this),
                              [&] { return this->Process(request, inputs, outputs); });
}

int vtkMotionSceneReader::Process(vtkInformation* request, vtkInformationVector** inputs,
                                  vtkInformationVector* outputs)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_INFORMATION()))
  {
    return this->RequestInformation(outputs);
  }
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
  {
    return this->RequestData(request, outputs);
  }
  return this->Superclass::ProcessRequest(request, inputs, outputs);
}

int vtkMotionSceneReader::RequestInformation(vtkInformationVector* outputs)
{
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    // The pipeline asks the other ranks, of several, for their pieces only then.
    outputs->GetInformationObject(port)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(),
                                             this->OnEveryRank);
  }
  int extent[6] = { 0, -1, 0, -1, 0, -1 };
  vtkInformation* wind = outputs->GetInformationObject(WIND);
  wind->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  if (this->FileName.empty())
  {
    return waft::FailInformation(outputs); // RequestData asks for the name
  }
  if (!this->Read->Cache.IsCurrent(this, nullptr))
  {
    this->Read->Load(waft::NamedFile(this->FileName));
    this->Read->Cache.MarkCurrent(this, nullptr);
    for (const std::string& warning : this->Read->Scene.Warnings)
    {
      vtkWarningMacro(<< warning);
    }
  }
  if (!this->Read->Error.empty())
  {
    return waft::FailInformation(outputs);
  }
  waft::SetTimeSteps(this->Read->Scene.Info.Time, outputs);
  waft::SetStandsStill(outputs->GetInformationObject(OBSTACLES), !this->Read->IsMoving);
  waft::SetStandsStill(wind, this->Read->Wind.IsEmpty());
  this->Read->Wind.WholeExtent(extent);
  wind->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  return 1;
}

int vtkMotionSceneReader::RequestData(vtkInformation* request, vtkInformationVector* outputs)
{
  if (this->FileName.empty())
  {
    return waft::Fail(this, outputs, "FileName: expected a scene file, found no name");
  }
  if (!this->Read->Error.empty())
  {
    return waft::Fail(this, outputs, this->Read->Error);
  }
  if (!this->OnEveryRank && waft::IsPieceOfOthers(request, outputs))
  {
    return waft::Empty(outputs);
  }
  const Contents& read = *this->Read;
  const waft::SceneInfo& info = read.Scene.Info;
  const double time = waft::RequestedTimeOfAll(request, outputs, info.Time);
  vtkPolyData::GetData(outputs, OBJECTS)->ShallowCopy(read.KeptObjects);
  vtkPolyData::GetData(outputs, CONSTRAINTS)->ShallowCopy(read.KeptConstraints);
  vtkPolyData::GetData(outputs, OBSTACLES)->ShallowCopy(read.KeptObstacles);
  vtkPolyData::GetData(outputs, VORTICES)->ShallowCopy(read.KeptVortices);
  vtkMultiBlockDataSet::GetData(outputs, SHAPES)->ShallowCopy(read.KeptShapes);
  if (read.IsMoving)
  {
    waft::MoveObstacles(read.Scene.Obstacles, time * info.Time.FramesPerSecond,
                        vtkPolyData::GetData(outputs, OBSTACLES));
  }
  vtkImageData* wind = vtkImageData::GetData(outputs, WIND);
  waft::FieldSeriesToImage(read.Wind.At(time), time, info, wind);
  waft::AuthoredToFieldData(read.Scene.Authored.Winds, wind);
  (void)waft::RequestedTimeOfAll(request, outputs, info.Time); // filling has cleared the stamps
  return 1;
}

void vtkMotionSceneReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::SceneReadOptions>(os, indent, *this);
}
