// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/FieldCollectors.h"

#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/Arrays.h"
#include "Bridge/Data/Blocks.h"
#include "Bridge/Data/ImageLattice.h"
#include "Bridge/Data/SceneData.h"
#include "Obstacles/SolidParts.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace waft
{
namespace
{

// The solids that the surface consists of, numbered in the order of their first triangles.
std::vector<ObstacleMesh> SplitBySolid(const TriangleMesh& whole)
{
  int count = 0;
  const std::vector<int> solidOf = SolidOfTriangles(whole, count);
  std::vector<ObstacleMesh> obstacles(static_cast<std::size_t>(count));
  if (count <= 1)
  {
    // Points without a triangle are reported where the obstacle is built.
    obstacles.resize(whole.Points.empty() ? 0 : 1);
    for (ObstacleMesh& obstacle : obstacles)
    {
      obstacle.Mesh = whole;
    }
    return obstacles;
  }
  std::vector<std::map<int, int>> local(obstacles.size()); // a point may be of several
  for (std::size_t t = 0; t < whole.Triangles.size(); ++t)
  {
    for (const int corner : whole.Triangles[t])
    {
      local[static_cast<std::size_t>(solidOf[t])].emplace(corner, 0);
    }
  }
  for (std::size_t at = 0; at < obstacles.size(); ++at)
  {
    obstacles[at].ObstacleId = static_cast<int>(at);
    for (auto& [corner, index] : local[at]) // in their order in the whole
    {
      index = static_cast<int>(obstacles[at].Mesh.Points.size());
      obstacles[at].Mesh.Points.push_back(whole.Points[static_cast<std::size_t>(corner)]);
    }
  }
  for (std::size_t t = 0; t < whole.Triangles.size(); ++t)
  {
    const auto at = static_cast<std::size_t>(solidOf[t]);
    std::array<int, 3> triangle{};
    std::transform(whole.Triangles[t].begin(), whole.Triangles[t].end(), triangle.begin(),
                   [&](int corner) { return local[at].at(corner); });
    obstacles[at].Mesh.Triangles.push_back(triangle);
  }
  return obstacles;
}

// The surface split by ObstacleId, ids increasing, or by its solids where it has no ids. Points are
// renumbered per obstacle.
Result SplitObstacles(vtkPolyData* data, std::vector<ObstacleMesh>& obstacles)
{
  TriangleMesh whole;
  WAFT_RETURN_IF_FAILED(MeshFromPolyData(data, "Obstacles", whole));
  if (data->GetPointData()->GetAbstractArray(names::ObstacleId) == nullptr)
  {
    obstacles = SplitBySolid(whole);
    return Result::Ok();
  }
  const ArraySource source{ data->GetPointData(), "Obstacles", data->GetNumberOfPoints() };
  std::vector<int> ids;
  WAFT_RETURN_IF_FAILED(ReadInts(source, names::ObstacleId, ids));
  std::map<int, ObstacleMesh> byId;
  std::vector<int> local(whole.Points.size(), -1);
  for (std::size_t i = 0; i < whole.Points.size(); ++i)
  {
    ObstacleMesh& obstacle = byId[ids[i]];
    obstacle.ObstacleId = ids[i];
    local[i] = static_cast<int>(obstacle.Mesh.Points.size());
    obstacle.Mesh.Points.push_back(whole.Points[i]);
  }
  for (const auto& t : whole.Triangles)
  {
    const int id = ids[static_cast<std::size_t>(t[0])];
    for (const int corner : t)
    {
      if (ids[static_cast<std::size_t>(corner)] != id)
      {
        return Result::Error("Obstacles: array `ObstacleId`: a triangle joins obstacles " +
                             std::to_string(id) + " and " +
                             std::to_string(ids[static_cast<std::size_t>(corner)]));
      }
    }
    byId[id].Mesh.Triangles.push_back({ local[static_cast<std::size_t>(t[0])],
                                        local[static_cast<std::size_t>(t[1])],
                                        local[static_cast<std::size_t>(t[2])] });
  }
  obstacles.clear();
  for (auto& entry : byId)
  {
    obstacles.push_back(std::move(entry.second));
  }
  return Result::Ok();
}

// Adds the obstacles of another block.
void PutBeside(std::vector<ObstacleMesh> others, std::vector<ObstacleMesh>& all)
{
  std::set<int> taken;
  for (const ObstacleMesh& obstacle : all)
  {
    taken.insert(obstacle.ObstacleId);
  }
  const std::set<int> before = taken;
  for (const ObstacleMesh& other : others)
  {
    taken.insert(other.ObstacleId);
  }
  int free = 0;
  for (ObstacleMesh& other : others)
  {
    if (before.count(other.ObstacleId) > 0)
    {
      while (!taken.insert(free).second)
      {
        ++free;
      }
      other.ObstacleId = free;
    }
    all.push_back(std::move(other));
  }
}

// A step that is not later than the last one: the same again when other inputs have more steps.
Result SeenAlready(const std::string& owner, double time, double last)
{
  return time == last
           ? Result::Ok()
           : Result::Error(owner + ": expected time steps that increase, found " +
                           std::to_string(time) + " s after " + std::to_string(last) + " s");
}

// How an obstacle stands away from where it stood first; fails when it turned or deformed.
Result Displacement(const ObstacleMesh& first, const ObstacleMesh& now, double time, Vec3& offset)
{
  const std::string what = "Obstacles: obstacle " + std::to_string(first.ObstacleId) + " at time " +
                           std::to_string(time) + " s: ";
  if (now.ObstacleId != first.ObstacleId || now.Mesh.Points.size() != first.Mesh.Points.size())
  {
    return Result::Error(what + "expected the same points at every time step");
  }
  double size = 0.0;
  offset = now.Mesh.Points[0] - first.Mesh.Points[0];
  for (std::size_t i = 0; i < first.Mesh.Points.size(); ++i)
  {
    size = std::max(size, (first.Mesh.Points[i] - first.Mesh.Points[0]).norm());
    const double error = (now.Mesh.Points[i] - first.Mesh.Points[i] - offset).norm();
    if (error > 1e-5 * (size + offset.norm()) + 1e-9)
    {
      return Result::Error(what + "it may move, not turn or deform (point " + std::to_string(i) +
                           " is off by " + std::to_string(error) + " m)");
    }
  }
  return Result::Ok();
}

} // namespace

Result MeshFromPolyData(vtkPolyData* data, const std::string& owner, TriangleMesh& mesh)
{
  mesh = TriangleMesh();
  WAFT_RETURN_IF_FAILED(ReadPoints(data->GetPoints(), owner, mesh.Points));
  WAFT_RETURN_IF_FAILED(CheckCells(data, owner));
  if (data->GetNumberOfStrips() > 0)
  {
    return Result::Error(owner + ": expected triangles or polygons, found triangle strips");
  }
  vtkNew<vtkIdList> ids;
  vtkCellArray* polygons = data->GetPolys();
  for (vtkIdType cell = 0; polygons && cell < polygons->GetNumberOfCells(); ++cell)
  {
    polygons->GetCellAtId(cell, ids);
    for (vtkIdType corner = 2; corner < ids->GetNumberOfIds(); ++corner)
    {
      mesh.Triangles.push_back({ static_cast<int>(ids->GetId(0)),
                                 static_cast<int>(ids->GetId(corner - 1)),
                                 static_cast<int>(ids->GetId(corner)) });
    }
  }
  return Result::Ok();
}

void ObstaclesToPolyData(const std::vector<ObstacleMesh>& obstacles, double frame,
                         const SceneInfo& info, vtkPolyData* data)
{
  std::vector<int> ids;
  vtkNew<vtkCellArray> triangles;
  for (const ObstacleMesh& obstacle : obstacles)
  {
    const auto first = static_cast<vtkIdType>(ids.size());
    ids.insert(ids.end(), obstacle.Mesh.Points.size(), obstacle.ObstacleId);
    for (const auto& t : obstacle.Mesh.Triangles)
    {
      const vtkIdType corners[3] = { first + t[0], first + t[1], first + t[2] };
      triangles->InsertNextCell(3, corners);
    }
  }
  data->Initialize();
  data->SetPolys(triangles);
  AddInts(data->GetPointData(), names::ObstacleId, ids);
  SceneInfoToFieldData(info, data);
  MoveObstacles(obstacles, frame, data);
}

void MoveObstacles(const std::vector<ObstacleMesh>& obstacles, double frame, vtkPolyData* data)
{
  std::vector<Vec3> positions;
  for (const ObstacleMesh& obstacle : obstacles)
  {
    const Vec3 offset = obstacle.Offset(frame);
    for (const Vec3& point : obstacle.Mesh.Points)
    {
      positions.push_back(point + offset);
    }
  }
  vtkNew<vtkPoints> points;
  SetPoints(points, positions);
  data->SetPoints(points);
}

Result ObstacleCollector::Add(vtkDataObject* data, double time, const Timeline& line)
{
  std::vector<vtkPolyData*> surfaces;
  WAFT_RETURN_IF_FAILED(SurfacesOf(data, "Obstacles", surfaces));
  std::vector<vtkMTimeType> change = PointChanges(surfaces);
  if (std::all_of(change.begin(), change.end(), [](vtkMTimeType time) { return time == 0; }))
  {
    return Result::Ok();
  }
  if (!this->Steps.empty() && time <= this->LastTime)
  {
    return SeenAlready("Obstacles", time, this->LastTime);
  }
  const int frame = static_cast<int>(std::lround(time * line.FramesPerSecond));
  this->LastTime = time;
  if (!this->Steps.empty() && change == this->LastChange)
  {
    this->Frames.push_back(frame);
    this->Steps.push_back(this->Steps.back());
    return Result::Ok();
  }
  std::vector<ObstacleMesh> now;
  for (vtkPolyData* surface : surfaces)
  {
    std::vector<ObstacleMesh> own;
    WAFT_RETURN_IF_FAILED(SplitObstacles(surface, own));
    PutBeside(std::move(own), now);
  }
  if (this->Steps.empty())
  {
    this->Obstacles = now;
  }
  if (now.size() != this->Obstacles.size())
  {
    return Result::Error("Obstacles: expected the same obstacles at every time step, found " +
                         std::to_string(now.size()) + " instead of " +
                         std::to_string(this->Obstacles.size()));
  }
  std::vector<Vec3> offsets(now.size(), Vec3::Zero());
  for (std::size_t i = 0; i < now.size(); ++i)
  {
    WAFT_RETURN_IF_FAILED(Displacement(this->Obstacles[i], now[i], time, offsets[i]));
  }
  this->Frames.push_back(frame);
  this->Steps.push_back(std::move(offsets));
  this->LastChange = std::move(change);
  return Result::Ok();
}

std::vector<ObstacleMesh> ObstacleCollector::Take()
{
  const int last = this->Frames.empty() ? 0 : this->Frames.back();
  for (std::size_t i = 0; i < this->Obstacles.size(); ++i)
  {
    bool isMoving = false;
    for (const auto& step : this->Steps)
    {
      isMoving = isMoving || step[i].norm() > 1e-9;
    }
    std::size_t next = 0;
    for (int frame = 0; isMoving && frame <= last; ++frame)
    {
      while (next + 1 < this->Frames.size() && this->Frames[next] < frame)
      {
        ++next;
      }
      const std::size_t before = next > 0 && this->Frames[next] > frame ? next - 1 : next;
      const double span = this->Frames[next] - this->Frames[before];
      const double f = span > 0.0 ? (frame - this->Frames[before]) / span : 0.0;
      this->Obstacles[i].Offsets.push_back((1.0 - f) * this->Steps[before][i] +
                                           f * this->Steps[next][i]);
    }
  }
  std::vector<ObstacleMesh> obstacles = std::move(this->Obstacles);
  *this = ObstacleCollector();
  return obstacles;
}

Result FieldCollector::Add(vtkImageData* data, double time)
{
  const std::string name = this->Role == FieldRole::Air ? "Air" : "Wind";
  if (this->HasLattice && time <= this->LastTime)
  {
    return SeenAlready(name, time, this->LastTime);
  }
  FieldArrays field;
  if (const Result found = FindField(data, this->Role, this->Array, field); !found)
  {
    return Result::Error(name + ": " + found.Message());
  }
  const SeriesLattice& lattice = field.Lattice;
  if (!this->HasLattice)
  {
    this->Series = FieldSeries(lattice);
    this->HasLattice = true;
  }
  if (lattice.Dimensions != this->Series.Dimensions || lattice.Origin != this->Series.Origin ||
      lattice.Spacing != this->Series.Spacing || lattice.Meaning != this->Series.Meaning)
  {
    return Result::Error(name + ": expected the same lattice and array at every time step");
  }
  std::vector<std::array<float, 3>> step(lattice.NumberOfPoints());
  const limits::Range range =
    lattice.Meaning == FieldMeaning::Acceleration ? limits::Acceleration : limits::Velocity;
  for (std::size_t i = 0; i < step.size(); ++i)
  {
    for (int c = 0; c < 3; ++c)
    {
      const double value = field.Value(static_cast<vtkIdType>(i), c);
      if (!range.Holds(value))
      {
        return Result::Error(name + ": array `" + field.Name + "`: point " + std::to_string(i) +
                             ": expected " + range.Text() + ", found " + NumberText(value));
      }
      step[i][static_cast<std::size_t>(c)] = static_cast<float>(value);
    }
  }
  this->LastTime = time;
  this->Series.Times.push_back(time);
  this->Series.Values.push_back(std::move(step));
  return Result::Ok();
}

FieldSeries FieldCollector::Take()
{
  FieldSeries series(static_cast<const SeriesLattice&>(this->Series));
  series.Values = std::move(this->Series.Values);
  this->Series.Times.clear();
  this->Series.Values.clear();
  return series;
}

void FieldSeriesToImage(const FieldSeries& series, double time, const SceneInfo& info,
                        vtkImageData* data)
{
  data->Initialize();
  if (series.NumberOfPoints() == 0)
  {
    SceneInfoToFieldData(info, data);
    return;
  }
  LatticeToImage(series, data);
  vtkNew<vtkFloatArray> values;
  values->SetName(series.Meaning == FieldMeaning::Acceleration ? names::Wind : names::Velocity);
  values->SetNumberOfComponents(3);
  const FieldSeries::Field now = series.At(time);
  values->SetNumberOfTuples(static_cast<vtkIdType>(now.size()));
  std::copy_n(now.data()->data(), 3 * now.size(), values->GetPointer(0));
  data->GetPointData()->AddArray(values);
  SceneInfoToFieldData(info, data);
}

} // namespace waft
