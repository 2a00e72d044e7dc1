// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Pipeline/FieldSweep.h"

#include <vtkDataObject.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkStreamingDemandDrivenPipeline.h>

using Sddp = vtkStreamingDemandDrivenPipeline;

namespace waft
{
namespace
{

std::vector<int> PortsThatAre(std::initializer_list<int> ports)
{
  std::vector<int> found;
  for (const int port : ports)
  {
    if (port != FieldSweep::NoPort)
    {
      found.push_back(port);
    }
  }
  return found;
}

// The input of a port, null when there is no such port or nothing is connected to it.
vtkInformation* InputOf(vtkInformationVector** inputs, int port)
{
  return port != FieldSweep::NoPort && inputs[port]->GetNumberOfInformationObjects() > 0
           ? inputs[port]->GetInformationObject(0)
           : nullptr;
}

Result AddImage(vtkInformation* input, FieldCollector& fields)
{
  vtkImageData* data = input != nullptr ? vtkImageData::GetData(input) : nullptr;
  return data != nullptr && data->GetNumberOfPoints() > 0
           ? fields.Add(data, TimeSweep::DataTime(input))
           : Result::Ok();
}

} // namespace

FieldSweep::FieldSweep(int obstaclesPort, int windPort, int airPort) :
  ObstaclesPort(obstaclesPort), WindPort(windPort), AirPort(airPort),
  Sweep(PortsThatAre({ obstaclesPort, windPort, airPort }))
{
}

void FieldSweep::RequestSteps(vtkAlgorithm* stage, vtkInformation* request,
                              vtkInformationVector** inputs, vtkInformationVector* outputs,
                              bool isCurrent)
{
  if (this->Keeps && this->Sweep.IsFirst())
  {
    this->Signature = InputSignature(inputs[this->ObstaclesPort]);
    this->IsKept = !this->KeptSignature.empty() && this->Signature == this->KeptSignature;
  }
  this->Sweep.RequestSteps(stage, request, inputs, outputs, isCurrent || this->IsKept);
  for (const int port : { this->WindPort, this->AirPort })
  {
    vtkInformation* image = InputOf(inputs, port);
    if (image != nullptr && image->Has(Sddp::WHOLE_EXTENT()))
    {
      // The pipeline would ask for the extent of the image that the stage gives.
      image->Set(Sddp::UPDATE_EXTENT(), image->Get(Sddp::WHOLE_EXTENT()), 6);
    }
  }
}

bool FieldSweep::Leave(vtkInformation* request)
{
  this->MustSweep = false;
  return !this->IsKept && this->Sweep.Leave(request);
}

bool FieldSweep::Continue(vtkInformation* request)
{
  if (!this->IsKept && !this->MustSweep)
  {
    return this->Sweep.Continue(request);
  }
  if (this->MustSweep)
  {
    this->MustSweep = false;
    request->Set(Sddp::CONTINUE_EXECUTING(), 1);
    return true;
  }
  return false;
}

std::vector<ObstacleMesh> FieldSweep::TakeObstacles()
{
  if (this->Keeps)
  {
    this->KeptSignature = this->Signature;
    this->KeptRate = this->Rate;
  }
  return this->Obstacles.Take();
}

Result FieldSweep::Take(vtkInformationVector** inputs, const Timeline& line)
{
  this->Rate = line.FramesPerSecond;
  if (this->IsKept && this->Rate != this->KeptRate)
  {
    // Frames are others: all steps are to be seen again.
    this->KeptSignature.clear();
    this->IsKept = false;
    this->MustSweep = true;
  }
  if (this->IsKept || this->MustSweep)
  {
    return Result::Ok();
  }
  if (this->Sweep.IsFirst())
  {
    this->Obstacles = ObstacleCollector();
    this->Wind = FieldCollector();
    this->Air = FieldCollector(FieldRole::Air);
  }
  if (!this->Sweep.HasNewStep())
  {
    return Result::Ok();
  }
  if (vtkInformation* input = InputOf(inputs, this->ObstaclesPort))
  {
    if (vtkDataObject* data = vtkDataObject::GetData(input))
    {
      WAFT_RETURN_IF_FAILED(this->Obstacles.Add(data, TimeSweep::DataTime(input), line));
    }
  }
  WAFT_RETURN_IF_FAILED(AddImage(InputOf(inputs, this->WindPort), this->Wind));
  return AddImage(InputOf(inputs, this->AirPort), this->Air);
}

} // namespace waft
