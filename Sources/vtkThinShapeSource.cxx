// SPDX-License-Identifier: BSD-3-Clause
#include "vtkThinShapeSource.h"

#include "Bridge/PrintValues.h"
#include "Bridge/ShapeData.h"
#include "Bridge/StageExecution.h"
#include "Shapes/FlatSheet.h"

#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>

#include <utility>

vtkThinShapeSource::vtkThinShapeSource()
{
  this->SetNumberOfInputPorts(0);
}

void vtkThinShapeSource::TakeBending(waft::Bending& bending) const
{
  bending.Length = this->Length;
  bending.Curl = this->Curl;
  bending.Camber = this->Camber;
  bending.Twist = this->Twist;
}

vtkTypeBool vtkThinShapeSource::ProcessRequest(vtkInformation* request,
                                               vtkInformationVector** inputs,
                                               vtkInformationVector* outputs)
{
  return waft::GuardedRequest(
    this, request, outputs,
    { { "Length", this->Length, waft::limits::Length },
      { "Curl", this->Curl, waft::limits::Finite },
      { "Camber", this->Camber, waft::limits::Finite },
      { "Twist", this->Twist, waft::limits::Finite },
      { "AreaDensity", this->AreaDensity, waft::limits::AreaDensity },
      { "Thickness", this->Thickness, waft::limits::Length },
      { "DragCoefficient", this->DragCoefficient, waft::limits::Coefficient },
      { "SettlingSpeed", this->SettlingSpeed, waft::limits::UpTo(waft::limits::Speed.High) },
      { "Bounds", this->Bounds, waft::limits::Coordinate },
      { "NumberOfFrames", this->NumberOfFrames,
        waft::limits::Range{ 1, waft::limits::Frames.High } },
      { "FramesPerSecond", this->FramesPerSecond, waft::limits::FramesPerSecond } },
    [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });
}

int vtkThinShapeSource::RequestInformation(vtkInformation*, vtkInformationVector**,
                                           vtkInformationVector* outputs)
{
  waft::SetTimeSteps(waft::Timeline{ this->NumberOfFrames, this->FramesPerSecond }, outputs);
  return 1;
}

int vtkThinShapeSource::RequestData(vtkInformation*, vtkInformationVector**,
                                    vtkInformationVector* outputs)
{
  waft::SceneInfo info;
  const double* b = this->Bounds;
  info.Bounds = waft::Box{ waft::Vec3(b[0], b[2], b[4]), waft::Vec3(b[1], b[3], b[5]) };
  info.Time = waft::Timeline{ this->NumberOfFrames, this->FramesPerSecond };
  if (!(this->AreaDensity > 0.0) || !(this->Thickness >= 0.0) || !(this->DragCoefficient > 0.0) ||
      !(this->SettlingSpeed > 0.0) || !(this->FramesPerSecond > 0.0))
  {
    return waft::Fail(this, outputs,
                      "expected a positive AreaDensity, DragCoefficient, SettlingSpeed and "
                      "FramesPerSecond and a Thickness of 0 or more");
  }
  waft::Shape shape;
  shape.AreaDensity = this->AreaDensity;
  shape.Thickness = this->Thickness;
  shape.DragCoefficient = this->DragCoefficient;
  shape.SettlingSpeed = this->SettlingSpeed;
  if (waft::Result made = this->MakeShape(shape); !made)
  {
    return waft::Fail(this, outputs, made.Message());
  }
  waft::ShapesToMultiBlock({ std::move(shape) }, info, vtkMultiBlockDataSet::GetData(outputs));
  waft::RequestedTime(outputs, 0, info.Time);
  return 1;
}

void vtkThinShapeSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Length: " << this->Length << "\n";
  os << indent << "Curl: " << this->Curl << "\n";
  os << indent << "Camber: " << this->Camber << "\n";
  os << indent << "Twist: " << this->Twist << "\n";
  os << indent << "AreaDensity: " << this->AreaDensity << "\n";
  os << indent << "Thickness: " << this->Thickness << "\n";
  os << indent << "DragCoefficient: " << this->DragCoefficient << "\n";
  os << indent << "SettlingSpeed: " << this->SettlingSpeed << "\n";
  waft::PrintValues(os, indent, "Bounds", this->Bounds, 6);
  os << indent << "NumberOfFrames: " << this->NumberOfFrames << "\n";
  os << indent << "FramesPerSecond: " << this->FramesPerSecond << "\n";
}
