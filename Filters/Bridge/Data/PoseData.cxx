// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/PoseData.h"

#include "Base/MeshNormals.h"
#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/Arrays.h"
#include "Bridge/Data/LineValues.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/ShapeData.h"
#include "Bridge/Data/TrackData.h"
#include "Rotation/Agreement.h"
#include "Rotation/RotationRefine.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

namespace waft
{

void PosesToPolyData(const std::vector<Track>& tracks, const std::vector<PoseTrack>& poses,
                     const SceneInfo& info, vtkPolyData* data, vtkPointData* left)
{
  TracksToPolyData(tracks, info, data, left);
  // Array by array, so that but one of them is there twice.
  const auto joined = [&](auto member)
  {
    std::decay_t<decltype(PoseTrack().*member)> all;
    all.reserve(static_cast<std::size_t>(data->GetNumberOfPoints()));
    for (const PoseTrack& pose : poses)
    {
      all.insert(all.end(), (pose.*member).begin(), (pose.*member).end());
    }
    return all;
  };
  AddQuaternions(data->GetPointData(), names::Orientation, joined(&PoseTrack::Orientations));
  AddVectors(data->GetPointData(), names::AngularVelocity, joined(&PoseTrack::AngularVelocities));
  AddVectors(data->GetPointData(), names::Torque, joined(&PoseTrack::Torques));
}

namespace
{
const double DegreesPerRadian = 180.0 / std::acos(-1.0);

std::array<double, 2> DegreesOf(std::array<double, 2> radians)
{
  return { radians[0] * DegreesPerRadian, radians[1] * DegreesPerRadian };
}

void AddPairs(const std::vector<std::array<double, 2>>& pairs, vtkFieldData* data)
{
  vtkNew<vtkDoubleArray> values;
  values->SetName(names::Agreement);
  values->SetNumberOfComponents(2);
  for (const std::array<double, 2>& pair : pairs)
  {
    values->InsertNextTuple(pair.data());
  }
  data->AddArray(values);
}

void AddAgreement(const std::vector<std::vector<double>>& away, vtkPolyData* data)
{
  std::vector<double> all;
  std::vector<std::array<double, 2>> lines;
  for (const std::vector<double>& line : away)
  {
    lines.push_back(DegreesOf(AgreementOf(line)));
    all.insert(all.end(), line.begin(), line.end());
  }
  if (!all.empty())
  {
    AddPairs(lines, data->GetCellData());
    AddPairs({ DegreesOf(AgreementOf(std::move(all))) }, data->GetFieldData());
  }
}

void AddBodyFactors(const std::vector<BodyFactors>& factors, vtkPolyData* data)
{
  const std::pair<const char*, double BodyFactors::*> arrays[] = {
    { names::DragCoefficient, &BodyFactors::Drag },
    { names::Lift, &BodyFactors::Lift },
    { names::RotationalLift, &BodyFactors::RotationalLift },
    { names::PressureShift, &BodyFactors::PressureShift },
    { names::Spin, &BodyFactors::Spin },
    { names::SlippingMass, &BodyFactors::SlippingMass },
    { names::BroadsideSpeed, &BodyFactors::BroadsideSpeed },
    { names::Damping, &BodyFactors::Damping },
    { names::Follow, &BodyFactors::Follow },
    { names::Pace, &BodyFactors::Pace },
  };
  for (const auto& [name, member] : arrays)
  {
    std::vector<double> values;
    for (const BodyFactors& body : factors)
    {
      values.push_back(body.*member);
    }
    AddDoubles(data->GetCellData(), name, values);
  }
}

} // namespace

void AddTurning(const RotationOutput& rotation, vtkPolyData* data)
{
  AddAgreement(rotation.Away, data);
  AddBodyFactors(rotation.Factors, data);
  AddDoubles(data->GetFieldData(), names::TurningLimit,
             { rotation.TurningLimit * DegreesPerRadian });
}

Result PosesFromPolyData(vtkPolyData* data, std::vector<Track>& tracks,
                         std::vector<PoseTrack>& poses)
{
  std::vector<Track> paths;
  WAFT_RETURN_IF_FAILED(PathsFromPolyData(data, paths, "Poses"));
  std::vector<PoseTrack> read;
  for (const Track& path : paths)
  {
    read.emplace_back();
    read.back().ObjectId = path.ObjectId;
  }
  const ArraySource points{ data->GetPointData(), "Poses", data->GetNumberOfPoints(), true };
  {
    std::vector<Quat> orientations;
    WAFT_RETURN_IF_FAILED(ReadQuaternions(points, names::Orientation, orientations));
    TakeByLine(data, orientations, &PoseTrack::Orientations, read);
  }
  const Vec3 zero = Vec3::Zero();
  std::vector<Vec3> spins;
  WAFT_RETURN_IF_FAILED(ReadVectors(points, names::AngularVelocity, spins, &zero));
  TakeByLine(data, spins, &PoseTrack::AngularVelocities, read);
  tracks = std::move(paths);
  poses = std::move(read);
  return Result::Ok();
}

ShapesOfTracks::ShapesOfTracks(std::string input, const std::vector<MotionObject>& objects,
                               std::size_t numberOfShapes) :
  Input(std::move(input)),
  NumberOfShapes(static_cast<int>(numberOfShapes))
{
  for (const MotionObject& object : objects)
  {
    this->OfObject[object.ObjectId] = object.ShapeId;
  }
}

Result ShapesOfTracks::Find(int objectId, int& shapeId) const
{
  const std::string wanted = this->Input + ": object " + std::to_string(objectId) +
                             ": expected an object of this id and its shape, found ";
  const auto found = this->OfObject.find(objectId);
  if (found == this->OfObject.end())
  {
    return Result::Error(wanted + "no such object in Objects");
  }
  if (found->second < 0 || found->second >= this->NumberOfShapes)
  {
    return Result::Error(wanted + "its ShapeId " + std::to_string(found->second) +
                         ", where Shapes has 0 to " + std::to_string(this->NumberOfShapes - 1));
  }
  shapeId = found->second;
  return Result::Ok();
}

namespace
{

/// heights: of the slab's bottom and top [m].
bool IsGround(const TriangleMesh& mesh, const Box& volume, double (&heights)[2])
{
  if (mesh.Points.empty())
  {
    return false;
  }
  Box own{ mesh.Points.front(), mesh.Points.front() };
  for (const Vec3& point : mesh.Points)
  {
    own.Min = own.Min.cwiseMin(point);
    own.Max = own.Max.cwiseMax(point);
  }
  heights[0] = own.Min.z();
  heights[1] = own.Max.z();
  return own.Min.x() <= volume.Min.x() && own.Max.x() >= volume.Max.x() &&
         own.Min.y() <= volume.Min.y() && own.Max.y() >= volume.Max.y() &&
         own.Max.z() < volume.Max.z() &&
         std::all_of(mesh.Points.begin(), mesh.Points.end(),
                     [&](const Vec3& point)
                     { return point.z() == heights[0] || point.z() == heights[1]; });
}

/// [m/s] at a frame.
double SpeedAt(const std::vector<Vec3>& positions, std::size_t frame, double framesPerSecond)
{
  const std::size_t before = frame > 0 ? frame - 1 : 0;
  const std::size_t after = std::min(frame + 1, positions.size() - 1);
  return after == before ? 0.0
                         : (positions[after] - positions[before]).norm() * framesPerSecond /
                             static_cast<double>(after - before);
}

} // namespace

PosedMeshes::PosedMeshes() = default;
PosedMeshes::~PosedMeshes() = default;

Result PosedMeshes::Build(const std::vector<Shape>& shapes,
                          const std::vector<std::vector<std::array<double, 3>>>& colors,
                          const std::vector<MotionObject>& objects,
                          const std::vector<Track>& tracks, const SceneInfo& info)
{
  const ShapesOfTracks shapeOf("Tracks", objects, shapes.size());
  this->Bodies.clear();
  bool textured = false;
  for (const Shape& shape : shapes)
  {
    this->Bodies.push_back({ shape.Mesh.Points, SmoothNormals(shape.Mesh) });
    textured = textured || !shape.TextureCoordinates.empty();
  }
  this->BodyOfTrack.clear();
  vtkNew<vtkCellArray> triangles;
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetName("TextureCoordinates");
  coordinates->SetNumberOfComponents(2);
  vtkNew<vtkUnsignedCharArray> skin;
  skin->SetName(names::Color);
  skin->SetNumberOfComponents(3);
  std::vector<int> pointObjects, pointShapes, cellObjects, cellShapes;
  for (const Track& track : tracks)
  {
    int shapeId = 0;
    WAFT_RETURN_IF_FAILED(shapeOf.Find(track.ObjectId, shapeId));
    const Shape& shape = shapes[static_cast<std::size_t>(shapeId)];
    this->BodyOfTrack.push_back(static_cast<std::size_t>(shapeId));
    const auto first = static_cast<vtkIdType>(pointObjects.size());
    for (const auto& t : shape.Mesh.Triangles)
    {
      const vtkIdType ids[3] = { first + t[0], first + t[1], first + t[2] };
      triangles->InsertNextCell(3, ids);
    }
    pointObjects.insert(pointObjects.end(), shape.Mesh.Points.size(), track.ObjectId);
    pointShapes.insert(pointShapes.end(), shape.Mesh.Points.size(), shapeId);
    cellObjects.insert(cellObjects.end(), shape.Mesh.Triangles.size(), track.ObjectId);
    cellShapes.insert(cellShapes.end(), shape.Mesh.Triangles.size(), shapeId);
    for (std::size_t i = 0; i < shape.Mesh.Points.size(); ++i)
    {
      const bool has = i < shape.TextureCoordinates.size();
      coordinates->InsertNextTuple2(has ? shape.TextureCoordinates[i][0] : 0.0,
                                    has ? shape.TextureCoordinates[i][1] : 0.0);
    }
    for (const auto& color : colors[static_cast<std::size_t>(shapeId)])
    {
      const auto byte = [](double part) { return std::round(255.0 * std::clamp(part, 0.0, 1.0)); };
      skin->InsertNextTuple3(byte(color[0]), byte(color[1]), byte(color[2]));
    }
  }
  this->Template->Initialize();
  this->Template->SetPolys(triangles);
  AddInts(this->Template->GetPointData(), names::ObjectId, pointObjects);
  AddInts(this->Template->GetPointData(), names::ShapeId, pointShapes);
  this->Template->GetPointData()->AddArray(skin);
  AddInts(this->Template->GetCellData(), names::ObjectId, cellObjects);
  AddInts(this->Template->GetCellData(), names::ShapeId, cellShapes);
  if (textured)
  {
    this->Template->GetPointData()->SetTCoords(coordinates);
  }
  this->FramesPerSecond = info.Time.FramesPerSecond;
  SceneInfoToFieldData(info, this->Template);
  LooksToFieldData(shapes, this->Template->GetFieldData());
  return Result::Ok();
}

void PosedMeshes::SetSettled(const std::vector<int>& frames)
{
  std::vector<int> ofPoints;
  for (std::size_t t = 0; t < this->BodyOfTrack.size(); ++t)
  {
    ofPoints.insert(ofPoints.end(), this->Bodies[this->BodyOfTrack[t]].Points.size(), frames[t]);
  }
  AddInts(this->Template->GetPointData(), names::Settled, ofPoints);
}

void PosedMeshes::SetGround(const std::vector<ObstacleMesh>& obstacles, const Box& volume)
{
  for (const ObstacleMesh& obstacle : obstacles)
  {
    double heights[2];
    if (IsGround(obstacle.Mesh, volume, heights))
    {
      AddDoubles(this->Template->GetFieldData(), names::Ground, { heights[1] });
    }
  }
}

void PosedMeshes::Fill(const std::vector<Track>& tracks, const std::vector<PoseTrack>& poses,
                       int frame, vtkPolyData* data) const
{
  data->ShallowCopy(this->Template);
  vtkNew<vtkDoubleArray> coordinates;
  vtkNew<vtkFloatArray> normals, speeds;
  const vtkIdType count = this->Template->GetPointData()->GetNumberOfTuples();
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(count);
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(count);
  speeds->SetName(names::Speed);
  speeds->SetNumberOfTuples(count);
  float* speed = speeds->GetPointer(0);
  double* coordinate = coordinates->GetPointer(0);
  float* normal = normals->GetPointer(0);
  for (std::size_t t = 0; t < tracks.size(); ++t)
  {
    const Body& body = this->Bodies[this->BodyOfTrack[t]];
    const int last = static_cast<int>(tracks[t].Positions.size()) - 1;
    const auto k = static_cast<std::size_t>(std::clamp(frame, 0, last));
    const Mat3 turn = poses[t].Orientations[k].toRotationMatrix();
    const double size = tracks[t].SizeAt(k); // nothing is seen of a point
    speed = std::fill_n(speed, body.Points.size(),
                        static_cast<float>(SpeedAt(tracks[t].Positions, k, this->FramesPerSecond)));
    for (std::size_t i = 0; i < body.Points.size(); ++i)
    {
      const Vec3 x = tracks[t].Positions[k] + size * (turn * body.Points[i]);
      const Vec3 n = turn * body.Normals[i];
      for (int c = 0; c < 3; ++c)
      {
        *coordinate++ = x[c];
        *normal++ = static_cast<float>(n[c]);
      }
    }
  }
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetData(coordinates);
  data->SetPoints(points);
  data->GetPointData()->SetNormals(normals);
  data->GetPointData()->AddArray(speeds);
}

} // namespace waft
