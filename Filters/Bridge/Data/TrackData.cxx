// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/TrackData.h"

#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/Arrays.h"
#include "Bridge/Data/LineValues.h"
#include "Bridge/Data/SceneData.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <type_traits>
#include <utility>

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
  std::size_t samples = 0;
  for (const Track& track : tracks)
  {
    samples += track.Positions.size();
  }
  // Array by array, so that but one of them is there twice.
  const auto joined = [&](auto member, const auto& fallback)
  {
    std::vector<std::decay_t<decltype(fallback)>> all;
    all.reserve(samples);
    for (const Track& track : tracks)
    {
      Append(track.*member, track.Positions.size(), fallback, all);
    }
    return all;
  };
  const auto has = [&](auto member)
  {
    return std::any_of(tracks.begin(), tracks.end(),
                       [&](const Track& track) { return !(track.*member).empty(); });
  };
  std::vector<Vec3> velocities;
  std::vector<int> frames, objectIds;
  std::vector<double> times;
  velocities.reserve(samples);
  frames.reserve(samples);
  times.reserve(samples);
  vtkNew<vtkCellArray> lines;
  for (const Track& track : tracks)
  {
    const std::size_t count = track.Positions.size();
    lines->InsertNextCell(static_cast<int>(count));
    for (std::size_t k = 0; k < count; ++k)
    {
      lines->InsertCellPoint(static_cast<vtkIdType>(frames.size()));
      frames.push_back(static_cast<int>(k));
      times.push_back(info.Time.Time(static_cast<double>(k)));
    }
    const std::vector<Vec3> v = CentralVelocities(track.Positions, info.Time.Step());
    velocities.insert(velocities.end(), v.begin(), v.end());
    objectIds.push_back(track.ObjectId);
  }

  data->Initialize();
  vtkNew<vtkPoints> points;
  SetPoints(points, joined(&Track::Positions, zero));
  data->SetPoints(points);
  data->SetLines(lines);
  vtkPointData* arrays = data->GetPointData();
  AddInts(arrays, names::Frame, std::exchange(frames, {}));
  AddDoubles(arrays, names::Time, std::exchange(times, {}));
  AddVectors(arrays, names::Velocity, std::exchange(velocities, {}));
  std::vector<unsigned char> typeBytes;
  for (const ForceType type : joined(&Track::ForceTypes, ForceType::None))
  {
    typeBytes.push_back(static_cast<unsigned char>(type));
  }
  AddBytes(arrays, names::ForceType, typeBytes);
  AddInts(arrays, names::VortexId, joined(&Track::VortexIds, -1));
  AddVectors(arrays, names::VortexAcceleration, joined(&Track::VortexAccelerations, zero));
  AddVectors(arrays, names::WindAcceleration, joined(&Track::WindAccelerations, zero));
  const std::pair<const char*, std::vector<Vec3> Track::*> optional[] = {
    { names::Force, &Track::Forces },
    { names::AirVelocity, &Track::AirVelocities },
    { names::SPHVelocity, &Track::SphVelocities },
    { names::Residual, &Track::Residuals },
  };
  for (const auto& [name, member] : optional)
  {
    if (has(member))
    {
      AddVectors(arrays, name, joined(member, zero));
    }
  }
  if (has(&Track::Slips))
  {
    AddVectors(arrays, names::Slip, joined(&Track::Slips, zero));
    AddQuaternions(arrays, names::Orientation,
                   joined(&Track::Orientations, Quat(Quat::Identity())));
    AddVectors(arrays, names::AngularVelocity, joined(&Track::AngularVelocities, zero));
  }
  AddInts(data->GetCellData(), names::ObjectId, objectIds);
  SceneInfoToFieldData(info, data);
}

Result PathsFromPolyData(vtkPolyData* data, std::vector<Track>& tracks, const std::string& input)
{
  WAFT_RETURN_IF_FAILED(CheckCells(data, input));
  if (data->GetNumberOfCells() == 0)
  {
    return Result::Error(input +
                         ": no objects: expected at least one line, the path of an object, found " +
                         (data->GetNumberOfPoints() == 0 ? "empty data" : "points alone"));
  }
  const ArraySource cells{ data->GetCellData(), input, data->GetNumberOfCells() };
  std::vector<Track> read(static_cast<std::size_t>(data->GetNumberOfCells()));
  {
    std::vector<Vec3> positions;
    WAFT_RETURN_IF_FAILED(ReadPoints(data->GetPoints(), input, positions));
    TakeByLine(data, positions, &Track::Positions, read);
  }
  std::vector<int> ids;
  WAFT_RETURN_IF_FAILED(ReadInts(cells, names::ObjectId, ids));
  for (std::size_t cell = 0; cell < read.size(); ++cell)
  {
    read[cell].ObjectId = ids[cell];
  }
  tracks = std::move(read);
  return Result::Ok();
}

Result TracksFromPolyData(vtkPolyData* data, std::vector<Track>& tracks, const std::string& input)
{
  std::vector<Track> read;
  WAFT_RETURN_IF_FAILED(PathsFromPolyData(data, read, input));
  const ArraySource points{ data->GetPointData(), input, data->GetNumberOfPoints(), true };
  // Array by array, so that but one of them is there twice.
  const auto take = [&](const auto& all, auto member) { TakeByLine(data, all, member, read); };
  std::vector<int> types, vortexIds;
  WAFT_RETURN_IF_FAILED(ReadOptional(points, names::ForceType, types));
  std::vector<ForceType> forceTypes;
  for (const int type : types)
  {
    forceTypes.push_back(static_cast<ForceType>(std::clamp(type, 0, 2)));
  }
  take(forceTypes, &Track::ForceTypes);
  WAFT_RETURN_IF_FAILED(ReadOptional(points, names::VortexId, vortexIds));
  take(vortexIds, &Track::VortexIds);
  const std::pair<const char*, std::vector<Vec3> Track::*> vectors[] = {
    { names::VortexAcceleration, &Track::VortexAccelerations },
    { names::WindAcceleration, &Track::WindAccelerations },
    { names::Force, &Track::Forces },
    { names::AirVelocity, &Track::AirVelocities },
    { names::SPHVelocity, &Track::SphVelocities },
    { names::Residual, &Track::Residuals },
  };
  for (const auto& [name, member] : vectors)
  {
    std::vector<Vec3> all;
    WAFT_RETURN_IF_FAILED(ReadOptional(points, name, all));
    take(all, member);
  }
  std::vector<Vec3> slips;
  WAFT_RETURN_IF_FAILED(ReadOptional(points, names::Slip, slips));
  take(slips, &Track::Slips);
  if (!slips.empty())
  {
    std::vector<Quat> orientations;
    WAFT_RETURN_IF_FAILED(ReadQuaternions(points, names::Orientation, orientations));
    take(orientations, &Track::Orientations);
    std::vector<Vec3> spins;
    WAFT_RETURN_IF_FAILED(ReadVectors(points, names::AngularVelocity, spins));
    take(spins, &Track::AngularVelocities);
  }
  tracks = std::move(read);
  return Result::Ok();
}

} // namespace waft
