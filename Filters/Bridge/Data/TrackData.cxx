// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/TrackData.h"

#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/Arrays.h"
#include "Bridge/Data/Columns.h"
#include "Bridge/Data/LineValues.h"
#include "Bridge/Data/SceneData.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
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

struct VectorAnnotation
{
  const char* Name;
  std::vector<Vec3> Track::*Member;
  bool IsAlways; // written, as none, where no track has it
};

// In the order of the arrays.
constexpr VectorAnnotation Annotations[] = {
  { names::VortexAcceleration, &Track::VortexAccelerations, true },
  { names::WindAcceleration, &Track::WindAccelerations, true },
  { names::Force, &Track::Forces, false },
  { names::AirVelocity, &Track::AirVelocities, false },
  { names::SPHVelocity, &Track::SphVelocities, false },
  { names::Residual, &Track::Residuals, false },
};

/// Whether the points are those of the first line, then those of the next one, and so on.
bool IsInOrder(vtkPolyData* data)
{
  vtkIdType next = 0;
  vtkNew<vtkIdList> line;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    data->GetCellPoints(cell, line);
    for (const vtkIdType id : *line)
    {
      if (id != next++)
      {
        return false;
      }
    }
  }
  return next == data->GetNumberOfPoints();
}

/// Puts an array aside that is one of TracksToPolyData. Whatever is not is for who reads it.
bool IsLeft(const ArraySource& points, const char* name, int type, int components,
            vtkPointData* left)
{
  vtkDataArray* array = points.Data->GetArray(name);
  if (array == nullptr || array->GetDataType() != type || !CheckNumbers(points, name, components) ||
      (type == VTK_UNSIGNED_CHAR && array->GetRange()[1] > static_cast<double>(ForceType::Vortex)))
  {
    return false;
  }
  left->AddArray(array);
  return true;
}

/// left: arrays that are as an output of tracks has them go there unread; or null.
Result ReadTracks(vtkPolyData* data, const std::string& input, vtkPointData* left,
                  std::vector<Track>& tracks)
{
  std::vector<Track> read;
  WAFT_RETURN_IF_FAILED(PathsFromPolyData(data, read, input));
  const ArraySource points{ data->GetPointData(), input, data->GetNumberOfPoints(), true };
  const bool leaves = left != nullptr && IsInOrder(data);
  // Array by array, so that but one of them is there twice.
  const auto take = [&](const auto& all, auto member) { TakeByLine(data, all, member, read); };
  if (!leaves || !IsLeft(points, names::ForceType, VTK_UNSIGNED_CHAR, 1, left))
  {
    std::vector<int> types;
    WAFT_RETURN_IF_FAILED(ReadOptional(points, names::ForceType, types));
    std::vector<ForceType> forceTypes;
    for (const int type : types)
    {
      forceTypes.push_back(static_cast<ForceType>(std::clamp(type, 0, 2)));
    }
    take(forceTypes, &Track::ForceTypes);
  }
  if (!leaves || !IsLeft(points, names::VortexId, VTK_INT, 1, left))
  {
    std::vector<int> vortexIds;
    WAFT_RETURN_IF_FAILED(ReadOptional(points, names::VortexId, vortexIds));
    take(vortexIds, &Track::VortexIds);
  }
  for (const VectorAnnotation& one : Annotations)
  {
    const bool isNeeded = one.Member == &Track::AirVelocities; // of who turns bodies
    if (!leaves || isNeeded || !IsLeft(points, one.Name, VTK_DOUBLE, 3, left))
    {
      std::vector<Vec3> all;
      WAFT_RETURN_IF_FAILED(ReadOptional(points, one.Name, all));
      take(all, one.Member);
    }
  }
  std::vector<Vec3> slips;
  WAFT_RETURN_IF_FAILED(ReadOptional(points, names::Slip, slips));
  take(slips, &Track::Slips);
  if (!slips.empty())
  {
    slips = std::vector<Vec3>();
    std::vector<Quat> orientations;
    WAFT_RETURN_IF_FAILED(ReadQuaternions(points, names::Orientation, orientations));
    take(orientations, &Track::Orientations);
    orientations = std::vector<Quat>();
    std::vector<Vec3> spins;
    WAFT_RETURN_IF_FAILED(ReadVectors(points, names::AngularVelocity, spins));
    take(spins, &Track::AngularVelocities);
  }
  tracks = std::move(read);
  return Result::Ok();
}

} // namespace

void TracksToPolyData(const std::vector<Track>& tracks, const SceneInfo& info, vtkPolyData* data,
                      vtkPointData* left)
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
  std::vector<unsigned char> present;
  std::vector<double> times;
  velocities.reserve(samples);
  frames.reserve(samples);
  present.reserve(samples);
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
      present.push_back(track.IsPresent(k) ? 1 : 0);
      times.push_back(info.Time.Time(static_cast<double>(k)));
    }
    const std::vector<Vec3> v = CentralVelocities(track, info.Time.Step());
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
  AddBytes(arrays, names::Present, present);
  const auto isLeft = [&](const char* name)
  {
    vtkDataArray* array = left != nullptr ? left->GetArray(name) : nullptr;
    arrays->AddArray(array); // nothing is done with none
    return array != nullptr;
  };
  if (!isLeft(names::ForceType))
  {
    std::vector<unsigned char> typeBytes;
    for (const ForceType type : joined(&Track::ForceTypes, ForceType::None))
    {
      typeBytes.push_back(static_cast<unsigned char>(type));
    }
    AddBytes(arrays, names::ForceType, typeBytes);
  }
  if (!isLeft(names::VortexId))
  {
    AddInts(arrays, names::VortexId, joined(&Track::VortexIds, -1));
  }
  for (const VectorAnnotation& one : Annotations)
  {
    if (!isLeft(one.Name) && (one.IsAlways || has(one.Member)))
    {
      AddVectors(arrays, one.Name, joined(one.Member, zero));
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
  AddColumn(data->GetCellData(), names::Release, tracks, &Track::Release);
  AddColumn(data->GetCellData(), names::Leave, tracks, &Track::Leave);
  AddColumn(data->GetCellData(), names::Fade, tracks, &Track::Fade);
  AddColumn(data->GetCellData(), names::LoopTo, tracks, &Track::LoopTo);
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
  WAFT_RETURN_IF_FAILED(ReadOptionalColumn(cells, names::Release, read, &Track::Release));
  WAFT_RETURN_IF_FAILED(ReadOptionalColumn(cells, names::Fade, read, &Track::Fade));
  WAFT_RETURN_IF_FAILED(ReadOptionalColumn(cells, names::LoopTo, read, &Track::LoopTo));
  const ArraySource points{ data->GetPointData(), input, data->GetNumberOfPoints(), true };
  std::vector<int> present;
  WAFT_RETURN_IF_FAILED(ReadOptional(points, names::Present, present));
  if (!present.empty())
  {
    vtkNew<vtkIdList> line;
    for (std::size_t cell = 0; cell < read.size(); ++cell)
    {
      data->GetCellPoints(static_cast<vtkIdType>(cell), line);
      int& first = read[cell].FirstPresent;
      while (first < line->GetNumberOfIds() &&
             present[static_cast<std::size_t>(line->GetId(first))] == 0)
      {
        ++first;
      }
      int last = static_cast<int>(line->GetNumberOfIds());
      while (last > first && present[static_cast<std::size_t>(line->GetId(last - 1))] == 0)
      {
        --last;
      }
      read[cell].Leave = last < line->GetNumberOfIds() ? last : -1;
    }
  }
  tracks = std::move(read);
  return Result::Ok();
}

Result TracksFromPolyData(vtkPolyData* data, std::vector<Track>& tracks, const std::string& input)
{
  return ReadTracks(data, input, nullptr, tracks);
}

Result FlightsFromPolyData(vtkPolyData* data, std::vector<Track>& tracks, vtkPointData* left)
{
  left->Initialize();
  return ReadTracks(data, "Tracks", left, tracks);
}

} // namespace waft
