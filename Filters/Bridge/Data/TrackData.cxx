// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/TrackData.h"

#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/Arrays.h"
#include "Bridge/Data/SceneData.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <type_traits>

namespace waft
{
namespace
{

// Appends a list of one value a sample, or as many fallbacks.
template <class T>
void Append(const std::vector<T>& values, std::size_t count, const T& fallback, std::vector<T>& all)
{
  if (values.size() == count)
  {
    all.insert(all.end(), values.begin(), values.end());
  }
  else
  {
    all.insert(all.end(), count, fallback);
  }
}

template <class T>
std::vector<T> Pick(const std::vector<T>& all, vtkIdList* ids)
{
  std::vector<T> values;
  if (!all.empty())
  {
    values.reserve(static_cast<std::size_t>(ids->GetNumberOfIds()));
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      values.push_back(all[static_cast<std::size_t>(ids->GetId(i))]);
    }
  }
  return values;
}

// Absent arrays leave the list empty.
Result ReadOptional(const ArraySource& source, const char* name, std::vector<Vec3>& values)
{
  values.clear();
  return source.Data->GetAbstractArray(name) ? ReadVectors(source, name, values) : Result::Ok();
}

Result ReadOptional(const ArraySource& source, const char* name, std::vector<int>& values)
{
  values.clear();
  return source.Data->GetAbstractArray(name) ? ReadInts(source, name, values) : Result::Ok();
}

} // namespace

void TracksToPolyData(const std::vector<Track>& tracks, const SceneInfo& info, vtkPolyData* data)
{
  const Vec3 zero = Vec3::Zero();
  std::vector<Vec3> positions, velocities, vortex, wind, forces, air, sph, residual, slips, spins;
  std::vector<Quat> orientations;
  std::vector<int> frames, vortexIds, objectIds;
  std::vector<double> times;
  std::vector<ForceType> types;
  bool hasForces = false;
  bool hasAir = false;
  bool hasSph = false;
  bool hasResidual = false;
  bool hasSlip = false;
  vtkNew<vtkCellArray> lines;
  for (const Track& track : tracks)
  {
    const std::size_t count = track.Positions.size();
    lines->InsertNextCell(static_cast<int>(count));
    for (std::size_t k = 0; k < count; ++k)
    {
      lines->InsertCellPoint(static_cast<vtkIdType>(positions.size() + k));
      frames.push_back(static_cast<int>(k));
      times.push_back(info.Time.Time(static_cast<double>(k)));
    }
    const std::vector<Vec3> v = CentralVelocities(track.Positions, info.Time.Step());
    positions.insert(positions.end(), track.Positions.begin(), track.Positions.end());
    velocities.insert(velocities.end(), v.begin(), v.end());
    Append(track.ForceTypes, count, ForceType::None, types);
    Append(track.VortexIds, count, -1, vortexIds);
    Append(track.VortexAccelerations, count, zero, vortex);
    Append(track.WindAccelerations, count, zero, wind);
    Append(track.Forces, count, zero, forces);
    Append(track.AirVelocities, count, zero, air);
    Append(track.SphVelocities, count, zero, sph);
    Append(track.Residuals, count, zero, residual);
    Append(track.Slips, count, zero, slips);
    Append(track.Orientations, count, Quat(Quat::Identity()), orientations);
    Append(track.AngularVelocities, count, zero, spins);
    hasForces = hasForces || !track.Forces.empty();
    hasAir = hasAir || !track.AirVelocities.empty();
    hasSph = hasSph || !track.SphVelocities.empty();
    hasResidual = hasResidual || !track.Residuals.empty();
    hasSlip = hasSlip || !track.Slips.empty();
    objectIds.push_back(track.ObjectId);
  }
  std::vector<unsigned char> typeBytes;
  for (const ForceType type : types)
  {
    typeBytes.push_back(static_cast<unsigned char>(type));
  }

  data->Initialize();
  vtkNew<vtkPoints> points;
  SetPoints(points, positions);
  data->SetPoints(points);
  data->SetLines(lines);
  vtkPointData* arrays = data->GetPointData();
  AddInts(arrays, names::Frame, frames);
  AddDoubles(arrays, names::Time, times);
  AddVectors(arrays, names::Velocity, velocities);
  AddBytes(arrays, names::ForceType, typeBytes);
  AddInts(arrays, names::VortexId, vortexIds);
  AddVectors(arrays, names::VortexAcceleration, vortex);
  AddVectors(arrays, names::WindAcceleration, wind);
  if (hasForces)
  {
    AddVectors(arrays, names::Force, forces);
  }
  if (hasAir)
  {
    AddVectors(arrays, names::AirVelocity, air);
  }
  if (hasSph)
  {
    AddVectors(arrays, names::SPHVelocity, sph);
  }
  if (hasResidual)
  {
    AddVectors(arrays, names::Residual, residual);
  }
  if (hasSlip)
  {
    AddVectors(arrays, names::Slip, slips);
    AddQuaternions(arrays, names::Orientation, orientations);
    AddVectors(arrays, names::AngularVelocity, spins);
  }
  AddInts(data->GetCellData(), names::ObjectId, objectIds);
  SceneInfoToFieldData(info, data);
}

Result TracksFromPolyData(vtkPolyData* data, std::vector<Track>& tracks, const std::string& input)
{
  WAFT_RETURN_IF_FAILED(CheckCells(data, input));
  if (data->GetNumberOfCells() == 0)
  {
    return Result::Error(input +
                         ": no objects: expected at least one line, the path of an object, found " +
                         (data->GetNumberOfPoints() == 0 ? "empty data" : "points alone"));
  }
  const ArraySource points{ data->GetPointData(), input, data->GetNumberOfPoints(), true };
  const ArraySource cells{ data->GetCellData(), input, data->GetNumberOfCells() };
  std::vector<Vec3> positions, vortex, wind, forces, air, sph, residual, slips, spins;
  std::vector<Quat> orientations;
  std::vector<int> ids, types, vortexIds;
  WAFT_RETURN_IF_FAILED(ReadPoints(data->GetPoints(), input, positions));
  WAFT_RETURN_IF_FAILED(ReadInts(cells, names::ObjectId, ids));
  WAFT_RETURN_IF_FAILED(ReadOptional(points, names::ForceType, types));
  WAFT_RETURN_IF_FAILED(ReadOptional(points, names::VortexId, vortexIds));
  WAFT_RETURN_IF_FAILED(ReadOptional(points, names::VortexAcceleration, vortex));
  WAFT_RETURN_IF_FAILED(ReadOptional(points, names::WindAcceleration, wind));
  WAFT_RETURN_IF_FAILED(ReadOptional(points, names::Force, forces));
  WAFT_RETURN_IF_FAILED(ReadOptional(points, names::AirVelocity, air));
  WAFT_RETURN_IF_FAILED(ReadOptional(points, names::SPHVelocity, sph));
  WAFT_RETURN_IF_FAILED(ReadOptional(points, names::Residual, residual));
  WAFT_RETURN_IF_FAILED(ReadOptional(points, names::Slip, slips));
  if (!slips.empty())
  {
    WAFT_RETURN_IF_FAILED(ReadQuaternions(points, names::Orientation, orientations));
    WAFT_RETURN_IF_FAILED(ReadVectors(points, names::AngularVelocity, spins));
  }
  std::vector<ForceType> forceTypes;
  for (const int type : types)
  {
    forceTypes.push_back(static_cast<ForceType>(std::clamp(type, 0, 2)));
  }

  std::vector<Track> read;
  vtkNew<vtkIdList> line;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    data->GetCellPoints(cell, line);
    Track track;
    track.ObjectId = ids[static_cast<std::size_t>(cell)];
    track.Positions = Pick(positions, line);
    track.ForceTypes = Pick(forceTypes, line);
    track.VortexIds = Pick(vortexIds, line);
    track.VortexAccelerations = Pick(vortex, line);
    track.WindAccelerations = Pick(wind, line);
    track.Forces = Pick(forces, line);
    track.AirVelocities = Pick(air, line);
    track.SphVelocities = Pick(sph, line);
    track.Residuals = Pick(residual, line);
    track.Slips = Pick(slips, line);
    track.Orientations = Pick(orientations, line);
    track.AngularVelocities = Pick(spins, line);
    read.push_back(std::move(track));
  }
  tracks = std::move(read);
  return Result::Ok();
}

} // namespace waft
