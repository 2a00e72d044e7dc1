// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/FieldCollectors.h"

#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/Arrays.h"
#include "Bridge/Data/Blocks.h"
#include "Bridge/Data/ImageLattice.h"
#include "Bridge/Data/SceneData.h"
#include "Obstacles/SolidParts.h"

#include <vtkAbstractArray.h>
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
#include <numeric>
#include <set>
#include <utility>

namespace waft
{
namespace
{

// Places of all obstacles that room is made for before they come; what stands still needs none.
constexpr std::size_t MostRoom = 20000000;

// An obstacle of a surface, and which of its points it has.
struct Piece
{
  ObstacleMesh Obstacle;
  std::vector<std::size_t> Points;

  void AddPoint(const TriangleMesh& whole, std::size_t point)
  {
    this->Points.push_back(point);
    this->Obstacle.Mesh.Points.push_back(whole.Points[point]);
  }
};

// The solids that the surface consists of, numbered in the order of their first triangles.
std::vector<Piece> SplitBySolid(const TriangleMesh& whole)
{
  int count = 0;
  const std::vector<int> solidOf = SolidOfTriangles(whole, count);
  std::vector<Piece> pieces(static_cast<std::size_t>(count));
  if (count <= 1)
  {
    // Points without a triangle are reported where the obstacle is built.
    pieces.resize(whole.Points.empty() ? 0 : 1);
    for (Piece& piece : pieces)
    {
      piece.Obstacle.Mesh = whole;
      piece.Points.resize(whole.Points.size());
      std::iota(piece.Points.begin(), piece.Points.end(), std::size_t(0));
    }
    return pieces;
  }
  std::vector<std::map<int, int>> local(pieces.size()); // a point may be of several
  for (std::size_t t = 0; t < whole.Triangles.size(); ++t)
  {
    for (const int corner : whole.Triangles[t])
    {
      local[static_cast<std::size_t>(solidOf[t])].emplace(corner, 0);
    }
  }
  for (std::size_t at = 0; at < pieces.size(); ++at)
  {
    pieces[at].Obstacle.ObstacleId = static_cast<int>(at);
    for (auto& [corner, index] : local[at]) // in their order in the whole
    {
      index = static_cast<int>(pieces[at].Points.size());
      pieces[at].AddPoint(whole, static_cast<std::size_t>(corner));
    }
  }
  for (std::size_t t = 0; t < whole.Triangles.size(); ++t)
  {
    const auto at = static_cast<std::size_t>(solidOf[t]);
    std::array<int, 3> triangle{};
    std::transform(whole.Triangles[t].begin(), whole.Triangles[t].end(), triangle.begin(),
                   [&](int corner) { return local[at].at(corner); });
    pieces[at].Obstacle.Mesh.Triangles.push_back(triangle);
  }
  return pieces;
}

// The surface split by ObstacleId, ids increasing, or by its solids where it has no ids. Points are
// renumbered per obstacle.
Result SplitObstacles(vtkPolyData* data, std::vector<Piece>& pieces)
{
  TriangleMesh whole;
  WAFT_RETURN_IF_FAILED(MeshFromPolyData(data, "Obstacles", whole));
  if (data->GetPointData()->GetAbstractArray(names::ObstacleId) == nullptr)
  {
    pieces = SplitBySolid(whole);
    return Result::Ok();
  }
  const ArraySource source{ data->GetPointData(), "Obstacles", data->GetNumberOfPoints() };
  std::vector<int> ids;
  WAFT_RETURN_IF_FAILED(ReadInts(source, names::ObstacleId, ids));
  std::map<int, Piece> byId;
  std::vector<int> local(whole.Points.size(), -1);
  for (std::size_t i = 0; i < whole.Points.size(); ++i)
  {
    Piece& piece = byId[ids[i]];
    piece.Obstacle.ObstacleId = ids[i];
    local[i] = static_cast<int>(piece.Points.size());
    piece.AddPoint(whole, i);
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
    byId[id].Obstacle.Mesh.Triangles.push_back({ local[static_cast<std::size_t>(t[0])],
                                                 local[static_cast<std::size_t>(t[1])],
                                                 local[static_cast<std::size_t>(t[2])] });
  }
  for (auto& entry : byId)
  {
    pieces.push_back(std::move(entry.second));
  }
  return Result::Ok();
}

// Adds the obstacles of another block.
void PutBeside(std::vector<Piece> others, std::vector<Piece>& all)
{
  std::set<int> taken;
  for (const Piece& piece : all)
  {
    taken.insert(piece.Obstacle.ObstacleId);
  }
  const std::set<int> before = taken;
  for (const Piece& other : others)
  {
    taken.insert(other.Obstacle.ObstacleId);
  }
  int free = 0;
  for (Piece& other : others)
  {
    if (before.count(other.Obstacle.ObstacleId) > 0)
    {
      while (!taken.insert(free).second)
      {
        ++free;
      }
      other.Obstacle.ObstacleId = free;
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

std::string AtTime(const ObstacleMesh& obstacle, double time)
{
  return "Obstacles: obstacle " + std::to_string(obstacle.ObstacleId) + " at time " +
         std::to_string(time) + " s: ";
}

// How an obstacle stands away from where it stood first, its points being `points` of `now`; fails
// when it turned or deformed.
Result Displacement(const ObstacleMesh& first, const std::vector<std::size_t>& points,
                    const std::vector<Vec3>& now, double time, Vec3& offset)
{
  double size = 0.0;
  offset = now[points[0]] - first.Mesh.Points[0];
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    size = std::max(size, (first.Mesh.Points[i] - first.Mesh.Points[0]).norm());
    const double error = (now[points[i]] - first.Mesh.Points[i] - offset).norm();
    if (error > 1e-5 * (size + offset.norm()) + 1e-9)
    {
      return Result::Error(AtTime(first, time) + "it may move, not turn or deform (point " +
                           std::to_string(i) + " is off by " + std::to_string(error) + " m)");
    }
  }
  return Result::Ok();
}

// When what says which points are of which obstacle changed last.
std::vector<vtkMTimeType> LayoutChanges(const std::vector<vtkPolyData*>& surfaces)
{
  std::vector<vtkMTimeType> changes;
  for (vtkPolyData* surface : surfaces)
  {
    vtkAbstractArray* ids = surface->GetPointData()->GetAbstractArray(names::ObstacleId);
    changes.push_back(static_cast<vtkMTimeType>(surface->GetNumberOfPoints()));
    changes.push_back(surface->GetPolys()->GetMTime());
    changes.push_back(surface->GetStrips()->GetMTime());
    changes.push_back(ids == nullptr ? 0 : ids->GetMTime());
  }
  return changes;
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
  if (!this->Frames.empty() && time <= this->LastTime)
  {
    return SeenAlready("Obstacles", time, this->LastTime);
  }
  const int frame = static_cast<int>(std::lround(time * line.FramesPerSecond));
  this->LastTime = time;
  if (!this->Frames.empty() && change == this->LastChange)
  {
    for (ObstacleMesh& obstacle : this->Obstacles)
    {
      obstacle.Offsets.push_back(obstacle.Offsets.back());
    }
    this->Frames.push_back(frame);
    return Result::Ok();
  }
  std::vector<vtkMTimeType> layout = LayoutChanges(surfaces);
  if (this->Frames.empty() || layout != this->LastLayout)
  {
    WAFT_RETURN_IF_FAILED(this->Split(surfaces, time));
  }
  WAFT_RETURN_IF_FAILED(this->Move(surfaces, time, line));
  this->Frames.push_back(frame);
  this->LastChange = std::move(change);
  this->LastLayout = std::move(layout);
  return Result::Ok();
}

Result ObstacleCollector::Split(const std::vector<vtkPolyData*>& surfaces, double time)
{
  std::vector<Piece> now;
  std::size_t before = 0; // points of earlier surfaces
  for (vtkPolyData* surface : surfaces)
  {
    std::vector<Piece> own;
    WAFT_RETURN_IF_FAILED(SplitObstacles(surface, own));
    for (Piece& piece : own)
    {
      for (std::size_t& point : piece.Points)
      {
        point += before;
      }
    }
    PutBeside(std::move(own), now);
    before += static_cast<std::size_t>(surface->GetNumberOfPoints());
  }
  if (!this->Frames.empty() && now.size() != this->Obstacles.size())
  {
    return Result::Error("Obstacles: expected the same obstacles at every time step, found " +
                         std::to_string(now.size()) + " instead of " +
                         std::to_string(this->Obstacles.size()));
  }
  this->PointsOf.resize(now.size());
  for (std::size_t i = 0; i < now.size(); ++i)
  {
    if (this->Frames.empty())
    {
      this->Obstacles.push_back(std::move(now[i].Obstacle));
    }
    else if (now[i].Obstacle.ObstacleId != this->Obstacles[i].ObstacleId ||
             now[i].Points.size() != this->Obstacles[i].Mesh.Points.size())
    {
      return Result::Error(AtTime(this->Obstacles[i], time) +
                           "expected the same points at every time step");
    }
    this->PointsOf[i] = std::move(now[i].Points);
  }
  return Result::Ok();
}

Result ObstacleCollector::Move(const std::vector<vtkPolyData*>& surfaces, double time,
                               const Timeline& line)
{
  std::vector<Vec3> all;
  for (vtkPolyData* surface : surfaces)
  {
    std::vector<Vec3> own;
    WAFT_RETURN_IF_FAILED(ReadPoints(surface->GetPoints(), "Obstacles", own));
    all.insert(all.end(), own.begin(), own.end());
  }
  const std::size_t frames =
    this->Frames.empty() ? 1 : static_cast<std::size_t>(line.NumberOfFrames);
  const std::size_t room =
    std::min(frames, MostRoom / std::max(this->Obstacles.size(), std::size_t(1)));
  for (std::size_t i = 0; i < this->Obstacles.size(); ++i)
  {
    ObstacleMesh& obstacle = this->Obstacles[i];
    Vec3 offset = Vec3::Zero();
    obstacle.Offsets.reserve(room);
    WAFT_RETURN_IF_FAILED(Displacement(obstacle, this->PointsOf[i], all, time, offset));
    obstacle.Offsets.push_back(offset);
  }
  return Result::Ok();
}

std::vector<ObstacleMesh> ObstacleCollector::Take()
{
  const int last = this->Frames.empty() ? 0 : this->Frames.back();
  const bool isEachFrame = !this->Frames.empty() && this->Frames.front() == 0 &&
                           this->Frames.size() == std::size_t(last) + 1;
  for (ObstacleMesh& obstacle : this->Obstacles)
  {
    const bool isMoving = std::any_of(obstacle.Offsets.begin(), obstacle.Offsets.end(),
                                      [](const Vec3& step) { return step.norm() > 1e-9; });
    if (isMoving && isEachFrame)
    {
      continue;
    }
    const std::vector<Vec3> steps = std::exchange(obstacle.Offsets, {});
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
      obstacle.Offsets.push_back((1.0 - f) * steps[before] + f * steps[next]);
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
  const bool isCopied = field.CopyTo(step);
  for (std::size_t i = 0; i < step.size(); ++i)
  {
    for (int c = 0; c < 3; ++c)
    {
      const double value = isCopied ? static_cast<double>(step[i][static_cast<std::size_t>(c)])
                                    : field.Value(static_cast<vtkIdType>(i), c);
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
