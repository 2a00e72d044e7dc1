// SPDX-License-Identifier: BSD-3-Clause
#include "vtkConstraintSource.h"

#include "Bridge/ConstraintData.h"
#include "Bridge/PrintValues.h"
#include "Bridge/StageExecution.h"

#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <cmath>
#include <string>

vtkStandardNewMacro(vtkConstraintSource);

vtkConstraintSource::vtkConstraintSource()
{
  this->SetNumberOfInputPorts(0);
}

void vtkConstraintSource::SetNumberOfWaypoints(int count)
{
  if (count > waft::limits::Frames.High)
  {
    vtkErrorMacro("NumberOfWaypoints: expected at most "
                  << static_cast<int>(waft::limits::Frames.High) << ", found " << count);
    return;
  }
  const auto size = static_cast<std::size_t>(std::max(0, count));
  if (size != this->Waypoints.size())
  {
    this->Waypoints.resize(size, { 0.0, 0.0, 0.0 });
    this->Modified();
  }
}

void vtkConstraintSource::SetWaypoint(int index, double x, double y, double z)
{
  const std::array<double, 3> place{ x, y, z };
  if (index < 0)
  {
    return;
  }
  if (index >= this->GetNumberOfWaypoints())
  {
    this->SetNumberOfWaypoints(std::min(index, VTK_INT_MAX - 1) + 1);
  }
  if (index >= this->GetNumberOfWaypoints())
  {
    return; // it was refused
  }
  if (this->Waypoints[static_cast<std::size_t>(index)] != place)
  {
    this->Waypoints[static_cast<std::size_t>(index)] = place;
    this->Modified();
  }
}

void vtkConstraintSource::GetWaypoint(int index, double place[3]) const
{
  const bool isThere = index >= 0 && index < this->GetNumberOfWaypoints();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    place[axis] = isThere ? this->Waypoints[static_cast<std::size_t>(index)][axis] : 0.0;
  }
}

vtkTypeBool vtkConstraintSource::ProcessRequest(vtkInformation* request,
                                                vtkInformationVector** inputs,
                                                vtkInformationVector* outputs)
{
  return waft::GuardedRequest(
    this, request, outputs,
    { { "Value", this->Value, waft::limits::Coordinate },
      { "Orientation", this->Orientation, waft::limits::Direction },
      { "Waypoints", this->Waypoints, waft::limits::Coordinate },
      { "Radius", this->Radius, waft::limits::Distance },
      { "Bounds", this->Bounds, waft::limits::Coordinate },
      { "NumberOfFrames", this->NumberOfFrames,
        waft::limits::Range{ 1, waft::limits::Frames.High } },
      { "FramesPerSecond", this->FramesPerSecond, waft::limits::FramesPerSecond } },
    [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });
}

int vtkConstraintSource::RequestInformation(vtkInformation*, vtkInformationVector**,
                                            vtkInformationVector* outputs)
{
  waft::SetTimeSteps(waft::Timeline{ this->NumberOfFrames, this->FramesPerSecond }, outputs);
  return 1;
}

int vtkConstraintSource::RequestData(vtkInformation*, vtkInformationVector**,
                                     vtkInformationVector* outputs)
{
  waft::SceneInfo info;
  const double* b = this->Bounds;
  info.Bounds = waft::Box{ waft::Vec3(b[0], b[2], b[4]), waft::Vec3(b[1], b[3], b[5]) };
  info.Time = waft::Timeline{ this->NumberOfFrames, this->FramesPerSecond };
  const int last = this->NumberOfFrames - 1;
  const int lastFrame = this->LastFrame < 0 ? last : this->LastFrame;
  const int count = this->UseWaypoints ? this->GetNumberOfWaypoints() : 0;
  if (this->UseWaypoints && count == 0)
  {
    return waft::Fail(this, outputs, "Waypoints: expected at least one, since UseWaypoints is on");
  }
  if (!(info.Time.FramesPerSecond > 0.0))
  {
    return waft::Fail(this, outputs, "FramesPerSecond: expected more than 0");
  }
  if (this->Frame > last || (count > 1 && lastFrame > last))
  {
    return waft::Fail(this, outputs,
                      "Frame or LastFrame: expected at most " + std::to_string(last) +
                        ", the last of NumberOfFrames");
  }
  if (count > 1 && lastFrame - this->Frame < count - 1)
  {
    return waft::Fail(this, outputs,
                      "LastFrame: expected at least " + std::to_string(this->Frame + count - 1) +
                        ", a frame for each of " + std::to_string(count) + " waypoints");
  }
  const waft::ConstraintTraits& kind =
    waft::TraitsOf(static_cast<waft::ConstraintKind>(this->Kind));
  if (count > 0 && !kind.IsPlace)
  {
    return waft::Fail(this, outputs, "Kind: expected position or rest, since there are waypoints");
  }
  waft::Constraint row;
  row.Kind = kind.Kind;
  row.ObjectId = this->ObjectId;
  row.Frame = this->Frame;
  const int until = this->Until < 0 ? last : this->Until;
  row.Until = kind.Lasts ? until : this->Frame;
  row.Value = waft::Vec3(this->Value);
  const double* q = this->Orientation;
  row.Orientation = waft::Quat(q[0], q[1], q[2], q[3]);
  row.Radius = this->Radius;
  row.Row = -1;
  if (waft::IsAttitude(kind.Kind) && !(row.Orientation.norm() > 0.0))
  {
    return waft::Fail(this, outputs, "Orientation: expected a quaternion that is not zero");
  }
  std::vector<waft::Constraint> rows(static_cast<std::size_t>(std::max(1, count)), row);
  for (int k = 0; k < count; ++k)
  {
    waft::Constraint& own = rows[static_cast<std::size_t>(k)];
    own.Value = waft::Vec3(this->Waypoints[static_cast<std::size_t>(k)].data());
    const double share = count > 1 ? static_cast<double>(k) / (count - 1) : 0.0;
    own.Frame = this->Frame + static_cast<int>(std::lround(share * (lastFrame - this->Frame)));
    own.Until = waft::LastFrame(own);
  }
  waft::ConstraintsToPolyData(rows, info, vtkPolyData::GetData(outputs));
  waft::RequestedTime(outputs, 0, info.Time);
  return 1;
}

void vtkConstraintSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ObjectId: " << this->ObjectId << "\n";
  os << indent << "Kind: " << this->Kind << "\n";
  os << indent << "Frame: " << this->Frame << "\n";
  os << indent << "LastFrame: " << this->LastFrame << "\n";
  os << indent << "Until: " << this->Until << "\n";
  waft::PrintValues(os, indent, "Value", this->Value, 3);
  waft::PrintValues(os, indent, "Orientation", this->Orientation, 4);
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "UseWaypoints: " << this->UseWaypoints << "\n";
  for (const std::array<double, 3>& waypoint : this->Waypoints)
  {
    waft::PrintValues(os, indent, "Waypoint", waypoint.data(), 3);
  }
  waft::PrintValues(os, indent, "Bounds", this->Bounds, 6);
  os << indent << "NumberOfFrames: " << this->NumberOfFrames << "\n";
  os << indent << "FramesPerSecond: " << this->FramesPerSecond << "\n";
}
