// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/SceneData.h"

#include "Bridge/ArrayNames.h"
#include "Bridge/Arrays.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkLongLongArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTable.h>

#include <cmath>
#include <set>

namespace waft
{
namespace
{

void SetVertices(vtkPolyData* data, const std::vector<Vec3>& positions)
{
  vtkNew<vtkPoints> points;
  SetPoints(points, positions);
  vtkNew<vtkCellArray> vertices;
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    vertices->InsertNextCell(1, &i);
  }
  data->SetPoints(points);
  data->SetVerts(vertices);
}

double FieldValue(vtkFieldData* fields, const char* name, double fallback)
{
  vtkDataArray* array = fields->GetArray(name);
  return array && array->GetNumberOfTuples() > 0 ? array->GetComponent(0, 0) : fallback;
}

} // namespace

void SceneInfoToFieldData(const SceneInfo& info, vtkDataObject* data)
{
  vtkFieldData* fields = data->GetFieldData();
  const Vec3& low = info.Bounds.Min;
  const Vec3& high = info.Bounds.Max;
  AddDoubles(fields, names::Bounds, { low.x(), high.x(), low.y(), high.y(), low.z(), high.z() });
  AddInts(fields, names::NumberOfFrames, { info.Time.NumberOfFrames });
  AddDoubles(fields, names::FramesPerSecond, { info.Time.FramesPerSecond });
  AddDoubles(fields, names::AirDensity, { info.AirDensity });
  vtkNew<vtkLongLongArray> seed;
  seed->SetName(names::Seed);
  seed->InsertNextValue(static_cast<long long>(info.Seed));
  fields->AddArray(seed);
}

Result SceneInfoFromFieldData(vtkDataObject* data, SceneInfo& info)
{
  vtkFieldData* fields = data->GetFieldData();
  if (vtkDataArray* bounds = fields->GetArray(names::Bounds))
  {
    if (bounds->GetNumberOfValues() != 6)
    {
      return Result::Error("field data `Bounds`: expected 6 numbers, found " +
                           std::to_string(bounds->GetNumberOfValues()));
    }
    double b[6];
    for (int i = 0; i < 6; ++i)
    {
      b[i] = bounds->GetVariantValue(i).ToDouble();
    }
    info.Bounds = Box{ Vec3(b[0], b[2], b[4]), Vec3(b[1], b[3], b[5]) };
  }
  info.Time.NumberOfFrames =
    static_cast<int>(FieldValue(fields, names::NumberOfFrames, info.Time.NumberOfFrames));
  info.Time.FramesPerSecond = FieldValue(fields, names::FramesPerSecond, info.Time.FramesPerSecond);
  info.AirDensity = FieldValue(fields, names::AirDensity, info.AirDensity);
  info.Seed =
    static_cast<std::uint64_t>(FieldValue(fields, names::Seed, static_cast<double>(info.Seed)));
  if (!(info.Bounds.Size().minCoeff() > 0.0) || !info.Bounds.Size().allFinite())
  {
    return Result::Error("field data `Bounds`: expected min < max along each axis");
  }
  if (info.Time.NumberOfFrames < 1)
  {
    return Result::Error("field data `NumberOfFrames`: expected at least 1");
  }
  if (!(info.Time.FramesPerSecond > 0.0) || !std::isfinite(info.Time.FramesPerSecond))
  {
    return Result::Error("field data `FramesPerSecond`: expected a positive number");
  }
  return Result::Ok();
}

void ObjectsToPolyData(const std::vector<MotionObject>& objects, const SceneInfo& info,
                       vtkPolyData* data)
{
  std::vector<Vec3> positions, velocities, angularVelocities;
  std::vector<Quat> orientations;
  std::vector<int> ids, shapes, classes;
  std::vector<double> masses, settling, clearance, rest;
  for (const MotionObject& object : objects)
  {
    positions.push_back(object.Position);
    velocities.push_back(object.Velocity);
    angularVelocities.push_back(object.AngularVelocity);
    orientations.push_back(object.Orientation);
    ids.push_back(object.ObjectId);
    shapes.push_back(object.ShapeId);
    classes.push_back(object.ClassId);
    masses.push_back(object.Mass);
    settling.push_back(object.SettlingSpeed);
    clearance.push_back(object.ClearanceRadius);
    rest.push_back(object.RestHeight);
  }
  data->Initialize();
  SetVertices(data, positions);
  vtkPointData* arrays = data->GetPointData();
  AddInts(arrays, names::ObjectId, ids);
  AddInts(arrays, names::ShapeId, shapes);
  AddDoubles(arrays, names::Mass, masses);
  AddVectors(arrays, names::Velocity, velocities);
  AddQuaternions(arrays, names::Orientation, orientations);
  AddVectors(arrays, names::AngularVelocity, angularVelocities);
  AddDoubles(arrays, names::SettlingSpeed, settling);
  AddInts(arrays, names::ClassId, classes);
  AddDoubles(arrays, names::ClearanceRadius, clearance);
  AddDoubles(arrays, names::RestHeight, rest);
  SceneInfoToFieldData(info, data);
}

Result ObjectsFromPolyData(vtkPolyData* data, std::vector<MotionObject>& objects)
{
  const ArrayPlace place{ data->GetPointData(), "Objects", data->GetNumberOfPoints() };
  const MotionObject fallback;
  const Vec3 zero = Vec3::Zero();
  std::vector<Vec3> positions, velocities, angularVelocities;
  std::vector<Quat> orientations;
  std::vector<int> ids, shapes, classes;
  std::vector<double> masses, settling, clearance, rest;
  WAFT_RETURN_IF_FAILED(ReadPoints(data->GetPoints(), "Objects", positions));
  WAFT_RETURN_IF_FAILED(ReadInts(place, names::ObjectId, ids));
  WAFT_RETURN_IF_FAILED(ReadInts(place, names::ShapeId, shapes, &fallback.ShapeId));
  WAFT_RETURN_IF_FAILED(ReadInts(place, names::ClassId, classes, &fallback.ClassId));
  WAFT_RETURN_IF_FAILED(ReadDoubles(place, names::Mass, masses, &fallback.Mass));
  WAFT_RETURN_IF_FAILED(ReadVectors(place, names::Velocity, velocities, &zero));
  WAFT_RETURN_IF_FAILED(
    ReadQuaternions(place, names::Orientation, orientations, &fallback.Orientation));
  WAFT_RETURN_IF_FAILED(ReadVectors(place, names::AngularVelocity, angularVelocities, &zero));
  WAFT_RETURN_IF_FAILED(
    ReadDoubles(place, names::SettlingSpeed, settling, &fallback.SettlingSpeed));
  WAFT_RETURN_IF_FAILED(
    ReadDoubles(place, names::ClearanceRadius, clearance, &fallback.ClearanceRadius));
  WAFT_RETURN_IF_FAILED(ReadDoubles(place, names::RestHeight, rest, &fallback.RestHeight));
  objects.clear();
  std::set<int> seen;
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    if (!seen.insert(ids[i]).second)
    {
      return Result::Error("Objects: array `ObjectId`: " + std::to_string(ids[i]) +
                           " stands twice, ids must differ");
    }
    MotionObject object;
    object.ObjectId = ids[i];
    object.ShapeId = shapes[i];
    object.ClassId = classes[i];
    object.Mass = masses[i];
    object.Position = positions[i];
    object.Velocity = velocities[i];
    object.Orientation = orientations[i];
    object.AngularVelocity = angularVelocities[i];
    object.SettlingSpeed = settling[i];
    object.ClearanceRadius = clearance[i];
    object.RestHeight = rest[i];
    objects.push_back(object);
  }
  return Result::Ok();
}

void ConstraintsToPolyData(const std::vector<Constraint>& constraints, const SceneInfo& info,
                           vtkPolyData* data)
{
  std::vector<Vec3> places;
  std::vector<int> objects, frames, untils, rows, targets, groups, classes, statuses;
  std::vector<unsigned char> kinds;
  std::vector<double> radii;
  vtkNew<vtkDoubleArray> values;
  values->SetName(names::Value);
  values->SetNumberOfComponents(4);
  for (const Constraint& row : constraints)
  {
    const bool isPlace = row.Kind == ConstraintKind::Position || row.Kind == ConstraintKind::Rest;
    places.push_back(isPlace ? row.Value : Vec3(Vec3::Zero()));
    objects.push_back(row.ObjectId);
    frames.push_back(row.Frame);
    untils.push_back(row.Until);
    rows.push_back(row.Row);
    targets.push_back(row.Target);
    groups.push_back(row.Group);
    classes.push_back(row.ClassId);
    statuses.push_back(static_cast<int>(row.Status));
    kinds.push_back(static_cast<unsigned char>(row.Kind));
    radii.push_back(row.Radius);
    if (row.Kind == ConstraintKind::Orientation)
    {
      const Quat& q = row.Orientation;
      values->InsertNextTuple4(q.w(), q.x(), q.y(), q.z());
    }
    else
    {
      values->InsertNextTuple4(row.Value.x(), row.Value.y(), row.Value.z(), 0.0);
    }
  }
  data->Initialize();
  SetVertices(data, places);
  vtkPointData* arrays = data->GetPointData();
  AddInts(arrays, names::ObjectId, objects);
  AddInts(arrays, names::Frame, frames);
  AddBytes(arrays, names::Kind, kinds);
  arrays->AddArray(values);
  AddDoubles(arrays, names::Radius, radii);
  AddInts(arrays, names::Until, untils);
  AddInts(arrays, names::Row, rows);
  AddInts(arrays, names::Target, targets);
  AddInts(arrays, names::Group, groups);
  AddInts(arrays, names::ClassId, classes);
  AddInts(arrays, names::Status, statuses);
  SceneInfoToFieldData(info, data);
}

Result ConstraintsFromPolyData(vtkPolyData* data, const Timeline& time,
                               std::vector<Constraint>& constraints)
{
  const ArrayPlace place{ data->GetPointData(), "Constraints", data->GetNumberOfPoints() };
  std::vector<int> objects, frames, kinds, untils, rows, targets, groups, classes, statuses;
  std::vector<double> radii;
  std::vector<Quat> values;
  const int last = time.NumberOfFrames - 1;
  const int zero = 0;
  const int none = -1;
  const double exact = 0.0;
  WAFT_RETURN_IF_FAILED(ReadInts(place, names::ObjectId, objects));
  WAFT_RETURN_IF_FAILED(ReadInts(place, names::Frame, frames));
  WAFT_RETURN_IF_FAILED(ReadInts(place, names::Kind, kinds));
  WAFT_RETURN_IF_FAILED(ReadQuaternions(place, names::Value, values));
  WAFT_RETURN_IF_FAILED(ReadDoubles(place, names::Radius, radii, &exact));
  WAFT_RETURN_IF_FAILED(ReadInts(place, names::Until, untils, &last));
  WAFT_RETURN_IF_FAILED(ReadInts(place, names::Row, rows, &none));
  WAFT_RETURN_IF_FAILED(ReadInts(place, names::Target, targets, &zero));
  WAFT_RETURN_IF_FAILED(ReadInts(place, names::Group, groups, &none));
  WAFT_RETURN_IF_FAILED(ReadInts(place, names::ClassId, classes, &none));
  WAFT_RETURN_IF_FAILED(ReadInts(place, names::Status, statuses, &zero));
  constraints.clear();
  for (std::size_t i = 0; i < objects.size(); ++i)
  {
    const std::string vertex = "Constraints: vertex " + std::to_string(i);
    if (kinds[i] < 0 || kinds[i] > static_cast<int>(ConstraintKind::Rest))
    {
      return Result::Error(vertex + ": array `Kind`: expected 0 to 4, found " +
                           std::to_string(kinds[i]));
    }
    if (frames[i] < 0 || frames[i] > last)
    {
      return Result::Error(vertex + ": array `Frame`: expected 0 to " + std::to_string(last) +
                           ", found " + std::to_string(frames[i]));
    }
    if (radii[i] < 0.0)
    {
      return Result::Error(vertex + ": array `Radius`: expected 0 or more, found " +
                           std::to_string(radii[i]));
    }
    Constraint row;
    row.ObjectId = objects[i];
    row.Frame = frames[i];
    row.Kind = static_cast<ConstraintKind>(kinds[i]);
    // Value has four components; a quaternion is read as (w, x, y, z).
    const Quat& v = values[i];
    if (row.Kind == ConstraintKind::Orientation)
    {
      if (v.norm() == 0.0)
      {
        return Result::Error(vertex + ": array `Value`: expected a quaternion, found zeros");
      }
      row.Orientation = v.normalized();
    }
    else
    {
      row.Value = Vec3(v.w(), v.x(), v.y());
    }
    row.Radius = radii[i];
    row.Until =
      row.Kind == ConstraintKind::Rest ? std::clamp(untils[i], row.Frame, last) : untils[i];
    row.Row = rows[i] < 0 ? static_cast<int>(i) : rows[i];
    row.Target = targets[i];
    row.Group = groups[i];
    row.ClassId = classes[i];
    row.Status = static_cast<ConstraintStatus>(std::clamp(statuses[i], 0, 3));
    constraints.push_back(row);
  }
  return Result::Ok();
}

void ReportToTable(const std::vector<ReportRow>& report, const SceneInfo& info, vtkTable* table)
{
  std::vector<int> rows, targets, objects, frames;
  std::vector<std::string> kinds, statuses, messages;
  std::vector<double> residuals;
  for (const ReportRow& line : report)
  {
    rows.push_back(line.Row);
    targets.push_back(line.Target);
    objects.push_back(line.ObjectId);
    frames.push_back(line.Frame);
    kinds.emplace_back(ToString(line.Kind));
    residuals.push_back(line.Residual);
    statuses.emplace_back(ToString(line.Status));
    messages.push_back(line.Message);
  }
  table->Initialize();
  vtkFieldData* columns = table->GetRowData();
  AddInts(columns, names::Row, rows);
  AddInts(columns, names::Target, targets);
  AddInts(columns, names::ObjectId, objects);
  AddInts(columns, names::Frame, frames);
  AddStrings(columns, names::Kind, kinds);
  AddDoubles(columns, names::Residual, residuals);
  AddStrings(columns, names::Status, statuses);
  AddStrings(columns, names::Message, messages);
  SceneInfoToFieldData(info, table);
}

void VorticesToPolyData(const std::vector<Vortex>& vortices, const SceneInfo& info,
                        vtkPolyData* data)
{
  std::vector<Vec3> poles;
  std::vector<int> ids, counts;
  std::vector<double> strengths, times, durations, cores, confidences;
  vtkNew<vtkCellArray> lines;
  for (const Vortex& vortex : vortices)
  {
    const vtkIdType first = static_cast<vtkIdType>(poles.size());
    const vtkIdType line[2] = { first, first + 1 };
    lines->InsertNextCell(2, line);
    poles.push_back(vortex.P1);
    poles.push_back(vortex.P2);
    ids.push_back(vortex.VortexId);
    strengths.push_back(vortex.Strength);
    times.push_back(vortex.CenterTime);
    durations.push_back(vortex.Duration);
    cores.push_back(vortex.CoreRadius);
    confidences.push_back(vortex.Confidence);
    counts.push_back(vortex.ObjectCount);
  }
  data->Initialize();
  vtkNew<vtkPoints> points;
  SetPoints(points, poles);
  data->SetPoints(points);
  data->SetLines(lines);
  vtkCellData* arrays = data->GetCellData();
  AddInts(arrays, names::VortexId, ids);
  AddDoubles(arrays, names::Strength, strengths);
  AddDoubles(arrays, names::CenterTime, times);
  AddDoubles(arrays, names::Duration, durations);
  AddDoubles(arrays, names::CoreRadius, cores);
  AddDoubles(arrays, names::Confidence, confidences);
  AddInts(arrays, names::ObjectCount, counts);
  SceneInfoToFieldData(info, data);
}

Result VorticesFromPolyData(vtkPolyData* data, std::vector<Vortex>& vortices)
{
  const vtkIdType count = data->GetNumberOfCells();
  const ArrayPlace place{ data->GetCellData(), "Vortices", count };
  const int none = -1;
  const int zero = 0;
  const double certain = 1.0;
  std::vector<Vec3> points;
  std::vector<int> ids, counts;
  std::vector<double> strengths, times, durations, cores, confidences;
  vortices.clear();
  if (count == 0)
  {
    return Result::Ok();
  }
  WAFT_RETURN_IF_FAILED(ReadPoints(data->GetPoints(), "Vortices", points));
  WAFT_RETURN_IF_FAILED(ReadInts(place, names::VortexId, ids, &none));
  WAFT_RETURN_IF_FAILED(ReadDoubles(place, names::Strength, strengths));
  WAFT_RETURN_IF_FAILED(ReadDoubles(place, names::CenterTime, times));
  WAFT_RETURN_IF_FAILED(ReadDoubles(place, names::Duration, durations));
  WAFT_RETURN_IF_FAILED(ReadDoubles(place, names::CoreRadius, cores));
  WAFT_RETURN_IF_FAILED(ReadDoubles(place, names::Confidence, confidences, &certain));
  WAFT_RETURN_IF_FAILED(ReadInts(place, names::ObjectCount, counts, &zero));
  std::vector<Vortex> read;
  vtkNew<vtkIdList> ends;
  for (vtkIdType i = 0; i < count; ++i)
  {
    const std::string cell = "Vortices: cell " + std::to_string(i);
    data->GetCellPoints(i, ends);
    if (ends->GetNumberOfIds() != 2)
    {
      return Result::Error(cell + ": expected a line of 2 points, pole to pole, found " +
                           std::to_string(ends->GetNumberOfIds()));
    }
    const auto k = static_cast<std::size_t>(i);
    Vortex vortex;
    vortex.VortexId = ids[k] < 0 ? static_cast<int>(i) : ids[k];
    vortex.P1 = points[static_cast<std::size_t>(ends->GetId(0))];
    vortex.P2 = points[static_cast<std::size_t>(ends->GetId(1))];
    vortex.Strength = strengths[k];
    vortex.CenterTime = times[k];
    vortex.Duration = durations[k];
    vortex.CoreRadius = cores[k];
    vortex.Confidence = confidences[k];
    vortex.ObjectCount = counts[k];
    if (!(vortex.Duration > 0.0) || vortex.CoreRadius < 0.0 || vortex.P1 == vortex.P2)
    {
      return Result::Error(
        cell + ": expected two different poles, a positive Duration and a CoreRadius of 0 or more");
    }
    read.push_back(vortex);
  }
  vortices = std::move(read);
  return Result::Ok();
}

} // namespace waft
