// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRotationRefineFilter.h"

#include "Bridge/FieldCollectors.h"
#include "Bridge/PoseData.h"
#include "Bridge/SceneData.h"
#include "Bridge/ShapeData.h"
#include "Bridge/StageExecution.h"
#include "Bridge/TrackData.h"
#include "Rotation/RotationRefine.h"

#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <cmath>

vtkStandardNewMacro(vtkRotationRefineFilter);

namespace
{

enum InputPort
{
  TracksPort,
  ObjectsPort,
  ShapesPort,
  ObstaclesPort,
  WindPort,
  ConstraintsPort,
  NumberOfInputs
};

} // namespace

struct vtkRotationRefineFilter::Internals
{
  waft::StageCache Cache;
  waft::TimeSweep Sweep{ { ObstaclesPort, WindPort } };
  waft::ObstacleCollector Obstacles;
  waft::FieldCollector Wind;
  waft::SceneInfo Info;
  std::vector<waft::Track> Tracks;
  waft::RotationOutput Rotation;
  waft::PosedMeshes Meshes;
  vtkNew<vtkPolyData> Poses;

  waft::Result Gather(vtkInformationVector** inputs, bool isFirst);
  waft::Result Run(vtkInformationVector** inputs, const waft::RotationOptions& options,
                   waft::Monitor& monitor);
};

waft::Result vtkRotationRefineFilter::Internals::Gather(vtkInformationVector** inputs, bool isFirst)
{
  if (isFirst)
  {
    this->Info = waft::SceneInfo();
    WAFT_RETURN_IF_FAILED(
      waft::SceneInfoFromFieldData(vtkPolyData::GetData(inputs[TracksPort]), this->Info));
    this->Obstacles = waft::ObstacleCollector();
    this->Wind = waft::FieldCollector();
  }
  vtkPolyData* obstacles = vtkPolyData::GetData(inputs[ObstaclesPort]);
  if (obstacles != nullptr && obstacles->GetNumberOfPoints() > 0)
  {
    const double time = waft::TimeSweep::DataTime(inputs[ObstaclesPort]->GetInformationObject(0));
    WAFT_RETURN_IF_FAILED(this->Obstacles.Add(obstacles, time, this->Info.Time));
  }
  vtkImageData* wind = vtkImageData::GetData(inputs[WindPort]);
  if (wind != nullptr && wind->GetNumberOfPoints() > 0)
  {
    const double time = waft::TimeSweep::DataTime(inputs[WindPort]->GetInformationObject(0));
    WAFT_RETURN_IF_FAILED(this->Wind.Add(wind, time));
  }
  return waft::Result::Ok();
}

waft::Result vtkRotationRefineFilter::Internals::Run(vtkInformationVector** inputs,
                                                     const waft::RotationOptions& options,
                                                     waft::Monitor& monitor)
{
  waft::RotationInput input;
  input.Scene = this->Info;
  WAFT_RETURN_IF_FAILED(
    waft::TracksFromPolyData(vtkPolyData::GetData(inputs[TracksPort]), input.Tracks));
  WAFT_RETURN_IF_FAILED(
    waft::ObjectsFromPolyData(vtkPolyData::GetData(inputs[ObjectsPort]), input.Objects));
  WAFT_RETURN_IF_FAILED(
    waft::ShapesFromMultiBlock(vtkMultiBlockDataSet::GetData(inputs[ShapesPort]), input.Shapes));
  vtkPolyData* rows = vtkPolyData::GetData(inputs[ConstraintsPort]);
  if (rows != nullptr && rows->GetNumberOfPoints() > 0)
  {
    WAFT_RETURN_IF_FAILED(waft::ConstraintsFromPolyData(rows, this->Info.Time, input.Constraints));
  }
  waft::ObstacleSet obstacles;
  WAFT_RETURN_IF_FAILED(obstacles.Build(this->Obstacles.Take()));
  input.Obstacles = &obstacles;
  const waft::FieldSeries wind = this->Wind.Take();
  input.Wind = &wind;
  WAFT_RETURN_IF_FAILED(this->Meshes.Build(input.Shapes, input.Objects, input.Tracks, this->Info));
  const waft::Result result =
    waft::RunRotationRefine(input, options, waft::SmpFor(), monitor, this->Rotation);
  this->Tracks = std::move(input.Tracks);
  if (result && !result.IsStopped())
  {
    waft::PosesToPolyData(this->Tracks, this->Rotation.Poses, this->Info, this->Poses);
  }
  return result;
}

vtkRotationRefineFilter::vtkRotationRefineFilter() : Impl(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(NumberOfInputs);
  this->SetNumberOfOutputPorts(2);
}

vtkRotationRefineFilter::~vtkRotationRefineFilter() = default;

int vtkRotationRefineFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(),
            port == ShapesPort ? "vtkMultiBlockDataSet"
                               : (port == WindPort ? "vtkImageData" : "vtkPolyData"));
  if (port >= ObstaclesPort)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkRotationRefineFilter::RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                                                vtkInformationVector* outputs)
{
  waft::PassTimeSteps(this, inputs, outputs);
  return 1;
}

int vtkRotationRefineFilter::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputs,
                                                 vtkInformationVector*)
{
  this->Impl->Sweep.RequestSteps(this, inputs, this->Impl->Cache.IsCurrent(this, inputs));
  return 1;
}

int vtkRotationRefineFilter::RequestData(vtkInformation* request, vtkInformationVector** inputs,
                                         vtkInformationVector* outputs)
{
  Internals& impl = *this->Impl;
  if (!impl.Cache.IsCurrent(this, inputs))
  {
    waft::Result result = impl.Gather(inputs, impl.Sweep.IsFirst());
    if (result && impl.Sweep.Continue(request))
    {
      return 1;
    }
    impl.Sweep.Reset(request);
    impl.Cache.Forget();
    waft::RotationOptions options;
    options.Model = static_cast<waft::AirModel>(this->Model);
    options.Damping = this->Damping;
    options.Lift = this->Lift;
    options.PressureShift = this->PressureShift;
    options.Follow = this->Follow;
    options.Variation = this->Variation;
    options.LandingTime = this->LandingTime;
    options.TurningTime = this->TurningTime;
    options.RasterSize = this->RasterSize;
    options.Seed = static_cast<std::uint64_t>(this->Seed);
    waft::StageMonitor monitor(this);
    result = result ? impl.Run(inputs, options, monitor) : result;
    if (!result)
    {
      return waft::Fail(this, outputs, result.Message());
    }
    if (result.IsStopped())
    {
      for (int port = 0; port < 2; ++port)
      {
        vtkPolyData::GetData(outputs, port)->Initialize();
      }
      return 1;
    }
    impl.Cache.MarkCurrent(this, inputs);
    for (const std::string& warning : impl.Rotation.Warnings)
    {
      vtkWarningMacro(<< warning);
    }
  }
  const double time = waft::RequestedTimeOfAll(request, outputs, impl.Info.Time);
  const int frame = static_cast<int>(std::lround(time * impl.Info.Time.FramesPerSecond));
  vtkPolyData::GetData(outputs, 1)->ShallowCopy(impl.Poses);
  impl.Meshes.Fill(impl.Tracks, impl.Rotation.Poses, frame, vtkPolyData::GetData(outputs, 0));
  waft::RequestedTimeOfAll(request, outputs, impl.Info.Time); // stamps what was filled
  return 1;
}

void vtkRotationRefineFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Model: " << this->Model << "\n";
  os << indent << "Damping: " << this->Damping << "\n";
  os << indent << "Lift: " << this->Lift << "\n";
  os << indent << "PressureShift: " << this->PressureShift << "\n";
  os << indent << "Follow: " << this->Follow << "\n";
  os << indent << "Variation: " << this->Variation << "\n";
  os << indent << "LandingTime: " << this->LandingTime << "\n";
  os << indent << "TurningTime: " << this->TurningTime << "\n";
  os << indent << "RasterSize: " << this->RasterSize << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
}
