// SPDX-License-Identifier: BSD-3-Clause
#include "vtkObjectSource.h"

#include "Bridge/PrintValues.h"
#include "Bridge/SceneData.h"
#include "Bridge/StageExecution.h"

#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

vtkStandardNewMacro(vtkObjectSource);

vtkObjectSource::vtkObjectSource()
{
  this->SetNumberOfInputPorts(0);
}

vtkTypeBool vtkObjectSource::ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                                            vtkInformationVector* outputs)
{
  return waft::GuardedRequest(
    this, request, outputs,
    { { "Position", this->Position, waft::limits::Coordinate },
      { "Velocity", this->Velocity, waft::limits::Velocity },
      { "Orientation", this->Orientation, waft::limits::Direction },
      { "AngularVelocity", this->AngularVelocity, waft::limits::Spin },
      { "Mass", this->Mass, waft::limits::Mass },
      { "SettlingSpeed", this->SettlingSpeed, waft::limits::UpTo(waft::limits::Speed.High) },
      { "ClearanceRadius", this->ClearanceRadius, waft::limits::Distance },
      { "RestHeight", this->RestHeight, waft::limits::Distance },
      { "Bounds", this->Bounds, waft::limits::Coordinate },
      { "NumberOfFrames", this->NumberOfFrames,
        waft::limits::Range{ 1, waft::limits::Frames.High } },
      { "FramesPerSecond", this->FramesPerSecond, waft::limits::FramesPerSecond },
      { "AirDensity", this->AirDensity, waft::limits::Density } },
    [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });
}

int vtkObjectSource::RequestInformation(vtkInformation*, vtkInformationVector**,
                                        vtkInformationVector* outputs)
{
  waft::SetTimeSteps(waft::Timeline{ this->NumberOfFrames, this->FramesPerSecond }, outputs);
  return 1;
}

int vtkObjectSource::RequestData(vtkInformation*, vtkInformationVector**,
                                 vtkInformationVector* outputs)
{
  waft::SceneInfo info;
  const double* b = this->Bounds;
  info.Bounds = waft::Box{ waft::Vec3(b[0], b[2], b[4]), waft::Vec3(b[1], b[3], b[5]) };
  info.Time = waft::Timeline{ this->NumberOfFrames, this->FramesPerSecond };
  info.AirDensity = this->AirDensity;

  waft::MotionObject object;
  object.ObjectId = this->ObjectId;
  object.ShapeId = this->ShapeId;
  object.ClassId = this->ClassId;
  object.Mass = this->Mass;
  object.Position = waft::Vec3(this->Position);
  object.Velocity = waft::Vec3(this->Velocity);
  object.VelocityGiven = object.Velocity.isZero() ? 0 : 1;
  const double* q = this->Orientation;
  object.Orientation = waft::Quat(q[0], q[1], q[2], q[3]);
  if (!(object.Orientation.norm() > 0.0))
  {
    return waft::Fail(this, outputs, "Orientation: expected a quaternion that is not zero");
  }
  object.Orientation.normalize();
  object.AngularVelocity = waft::Vec3(this->AngularVelocity);
  object.SettlingSpeed = this->SettlingSpeed;
  object.ClearanceRadius = this->ClearanceRadius;
  object.RestHeight = this->RestHeight;
  if (!(object.Mass > 0.0) || !(object.SettlingSpeed >= 0.0) || !(info.Time.FramesPerSecond > 0.0))
  {
    return waft::Fail(
      this, outputs,
      "expected a positive Mass and FramesPerSecond and a SettlingSpeed of 0 or more");
  }
  vtkPolyData* output = vtkPolyData::GetData(outputs);
  waft::ObjectsToPolyData({ object }, info, output);
  waft::RequestedTime(outputs, 0, info.Time);
  return 1;
}

void vtkObjectSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintValues(os, indent, "Position", this->Position, 3);
  waft::PrintValues(os, indent, "Velocity", this->Velocity, 3);
  waft::PrintValues(os, indent, "Orientation", this->Orientation, 4);
  waft::PrintValues(os, indent, "AngularVelocity", this->AngularVelocity, 3);
  waft::PrintValues(os, indent, "Bounds", this->Bounds, 6);
  os << indent << "ObjectId: " << this->ObjectId << "\n";
  os << indent << "ShapeId: " << this->ShapeId << "\n";
  os << indent << "ClassId: " << this->ClassId << "\n";
  os << indent << "Mass: " << this->Mass << "\n";
  os << indent << "SettlingSpeed: " << this->SettlingSpeed << "\n";
  os << indent << "ClearanceRadius: " << this->ClearanceRadius << "\n";
  os << indent << "RestHeight: " << this->RestHeight << "\n";
  os << indent << "NumberOfFrames: " << this->NumberOfFrames << "\n";
  os << indent << "FramesPerSecond: " << this->FramesPerSecond << "\n";
  os << indent << "AirDensity: " << this->AirDensity << "\n";
}
