// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/SceneData.h"

#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/Columns.h"
#include "Bridge/Data/Leavings.h"

#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkLongLongArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <cmath>
#include <set>

namespace waft
{
void SceneInfoToFieldData(const SceneInfo& info, vtkDataObject* data)
{
  vtkFieldData* fields = data->GetFieldData();
  const Vec3& low = info.Bounds.Min;
  const Vec3& high = info.Bounds.Max;
  AddDoubles(fields, names::Bounds, { low.x(), high.x(), low.y(), high.y(), low.z(), high.z() });
  AddInts(fields, names::NumberOfFrames, { info.Time.NumberOfFrames });
  AddDoubles(fields, names::FramesPerSecond, { info.Time.FramesPerSecond });
  AddDoubles(fields, names::AirDensity, { info.AirDensity });
  if (info.IsOpen())
  {
    AddInts(fields, names::Open, { info.Open.begin(), info.Open.end() });
  }
  if (!info.Breeze.isZero())
  {
    AddDoubles(fields, names::Breeze, { info.Breeze.x(), info.Breeze.y(), info.Breeze.z() });
  }
  if (info.Loops != 0)
  {
    AddInts(fields, names::Loops, { info.Loops });
  }
  vtkNew<vtkLongLongArray> seed;
  seed->SetName(names::Seed);
  seed->InsertNextValue(static_cast<long long>(info.Seed));
  fields->AddArray(seed);
}

Result SceneInfoFromFieldData(vtkDataObject* data, SceneInfo& info)
{
  return SceneInfoFromFieldData(data->GetFieldData(), info);
}

Result SceneInfoFromFieldData(vtkFieldData* fields, SceneInfo& info)
{
  if (fields->GetAbstractArray(names::Bounds))
  {
    vtkDataArray* bounds = fields->GetArray(names::Bounds);
    if (!bounds || bounds->GetNumberOfValues() != 6)
    {
      return Result::Error("field data `Bounds`: expected 6 numbers, found " +
                           (bounds ? std::to_string(bounds->GetNumberOfValues()) : "text"));
    }
    double b[6];
    for (int i = 0; i < 6; ++i)
    {
      b[i] = bounds->GetVariantValue(i).ToDouble();
    }
    info.Bounds = Box{ Vec3(b[0], b[2], b[4]), Vec3(b[1], b[3], b[5]) };
  }
  if (vtkDataArray* open = fields->GetArray(names::Open))
  {
    if (open->GetNumberOfValues() != 3)
    {
      return Result::Error("field data `Open`: expected 3 numbers, found " +
                           std::to_string(open->GetNumberOfValues()));
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      info.Open[static_cast<std::size_t>(axis)] = open->GetVariantValue(axis).ToInt() != 0 ? 1 : 0;
    }
  }
  if (vtkDataArray* breeze = fields->GetArray(names::Breeze))
  {
    if (breeze->GetNumberOfValues() != 3)
    {
      return Result::Error("field data `Breeze`: expected 3 numbers, found " +
                           std::to_string(breeze->GetNumberOfValues()));
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      info.Breeze[axis] = breeze->GetVariantValue(axis).ToDouble();
    }
  }
  if (vtkDataArray* loops = fields->GetArray(names::Loops))
  {
    info.Loops = loops->GetNumberOfValues() > 0 && loops->GetVariantValue(0).ToInt() != 0 ? 1 : 0;
  }
  const std::string owner = "field data";
  double frames = info.Time.NumberOfFrames;
  auto seed = static_cast<double>(info.Seed);
  if (!(info.Bounds.Size().minCoeff() > 0.0) || !limits::Coordinate.HoldsAll(info.Bounds.Min) ||
      !limits::Coordinate.HoldsAll(info.Bounds.Max))
  {
    return Result::Error("field data `Bounds`: expected min < max along each axis, within 1e6 m");
  }
  WAFT_RETURN_IF_FAILED(
    ReadNumber(fields, owner, names::NumberOfFrames, limits::UpTo(limits::Frames.High), frames));
  WAFT_RETURN_IF_FAILED(ReadNumber(fields, owner, names::FramesPerSecond, limits::FramesPerSecond,
                                   info.Time.FramesPerSecond));
  WAFT_RETURN_IF_FAILED(ReadNumber(fields, owner, names::AirDensity,
                                   limits::UpTo(limits::Density.High), info.AirDensity));
  WAFT_RETURN_IF_FAILED(ReadNumber(fields, owner, names::Seed, limits::Seed, seed));
  if (frames < 1.0)
  {
    return Result::Error("field data `NumberOfFrames`: expected at least 1");
  }
  info.Time.NumberOfFrames = static_cast<int>(frames);
  info.Seed = static_cast<std::uint64_t>(seed);
  return Result::Ok();
}

void AuthoredToFieldData(const std::string& part, vtkDataObject* data)
{
  if (!part.empty())
  {
    AddStrings(data->GetFieldData(), names::Authored, { part });
  }
}

std::string AuthoredFromFieldData(vtkDataObject* data)
{
  return data == nullptr ? std::string() : FirstString(data->GetFieldData(), names::Authored);
}

void ObjectsToPolyData(const std::vector<MotionObject>& objects, const SceneInfo& info,
                       vtkPolyData* data, bool hasOwnIds)
{
  data->Initialize();
  SetVertices(data, Column(objects, &MotionObject::Position));
  vtkPointData* arrays = data->GetPointData();
  AddColumn(arrays, names::ObjectId, objects, &MotionObject::ObjectId);
  AddBytes(arrays, names::ObjectIdGiven,
           std::vector<unsigned char>(objects.size(), hasOwnIds ? 1 : 0));
  AddColumn(arrays, names::ShapeId, objects, &MotionObject::ShapeId);
  AddColumn(arrays, names::Mass, objects, &MotionObject::Mass);
  AddColumn(arrays, names::Velocity, objects, &MotionObject::Velocity);
  AddColumn(arrays, names::VelocityGiven, objects,
            [](const MotionObject& object)
            { return static_cast<unsigned char>(object.VelocityGiven); });
  AddColumn(arrays, names::Orientation, objects, &MotionObject::Orientation);
  AddColumn(arrays, names::OrientationGiven, objects,
            [](const MotionObject& object)
            { return static_cast<unsigned char>(object.OrientationGiven); });
  AddColumn(arrays, names::AngularVelocity, objects, &MotionObject::AngularVelocity);
  AddColumn(arrays, names::SettlingSpeed, objects, &MotionObject::SettlingSpeed);
  AddColumn(arrays, names::ClassId, objects, &MotionObject::ClassId);
  AddColumn(arrays, names::ClearanceRadius, objects, &MotionObject::ClearanceRadius);
  AddColumn(arrays, names::RestHeight, objects, &MotionObject::RestHeight);
  AddColumn(arrays, names::Release, objects, &MotionObject::Release);
  AddColumn(arrays, names::Appears, objects,
            [](const MotionObject& object) { return static_cast<unsigned char>(object.Appears); });
  AddLeavings(objects, arrays);
  AddColumn(arrays, names::On, objects, &MotionObject::On);
  SceneInfoToFieldData(info, data);
}

namespace
{

Result NumberObjects(const ArraySource& source, std::vector<MotionObject>& objects)
{
  const int isGiven = 1;
  std::vector<int> given;
  WAFT_RETURN_IF_FAILED(ReadInts(source, names::ObjectIdGiven, given, &isGiven));
  std::set<int> taken;
  for (std::size_t i = 0; i < objects.size(); ++i)
  {
    if (given[i] != 0)
    {
      taken.insert(objects[i].ObjectId);
    }
  }
  int next = 0;
  for (std::size_t i = 0; i < objects.size(); ++i)
  {
    if (given[i] == 0)
    {
      while (taken.count(next) > 0)
      {
        ++next;
      }
      objects[i].ObjectId = next++;
    }
  }
  return Result::Ok();
}

} // namespace

Result ObjectsFromPolyData(vtkPolyData* data, std::vector<MotionObject>& objects)
{
  if (data->GetNumberOfPoints() == 0)
  {
    return Result::Error("Objects: no objects: expected at least one point");
  }
  const ArraySource source{ data->GetPointData(), "Objects", data->GetNumberOfPoints() };
  std::vector<Vec3> positions;
  WAFT_RETURN_IF_FAILED(ReadPoints(data->GetPoints(), "Objects", positions));
  MotionObject fallback;
  fallback.OrientationGiven = data->GetPointData()->HasArray(names::Orientation) ? 1 : 0;
  std::vector<MotionObject> read(positions.size(), fallback);
  WAFT_RETURN_IF_FAILED(ReadColumn(source, names::ObjectId, read, &MotionObject::ObjectId));
  const auto readOptional = [&](const char* name, auto member)
  { return ReadOptionalColumn(source, name, read, member); };
  WAFT_RETURN_IF_FAILED(readOptional(names::ShapeId, &MotionObject::ShapeId));
  WAFT_RETURN_IF_FAILED(readOptional(names::ClassId, &MotionObject::ClassId));
  WAFT_RETURN_IF_FAILED(readOptional(names::Mass, &MotionObject::Mass));
  WAFT_RETURN_IF_FAILED(readOptional(names::Velocity, &MotionObject::Velocity));
  WAFT_RETURN_IF_FAILED(readOptional(names::VelocityGiven, &MotionObject::VelocityGiven));
  WAFT_RETURN_IF_FAILED(readOptional(names::Orientation, &MotionObject::Orientation));
  WAFT_RETURN_IF_FAILED(readOptional(names::OrientationGiven, &MotionObject::OrientationGiven));
  WAFT_RETURN_IF_FAILED(readOptional(names::AngularVelocity, &MotionObject::AngularVelocity));
  WAFT_RETURN_IF_FAILED(readOptional(names::SettlingSpeed, &MotionObject::SettlingSpeed));
  WAFT_RETURN_IF_FAILED(readOptional(names::ClearanceRadius, &MotionObject::ClearanceRadius));
  WAFT_RETURN_IF_FAILED(readOptional(names::RestHeight, &MotionObject::RestHeight));
  WAFT_RETURN_IF_FAILED(readOptional(names::Release, &MotionObject::Release));
  WAFT_RETURN_IF_FAILED(readOptional(names::Appears, &MotionObject::Appears));
  WAFT_RETURN_IF_FAILED(ReadLeavings(source, read));
  WAFT_RETURN_IF_FAILED(readOptional(names::On, &MotionObject::On));
  WAFT_RETURN_IF_FAILED(NumberObjects(source, read));
  std::set<int> seen;
  for (std::size_t i = 0; i < read.size(); ++i)
  {
    if (!seen.insert(read[i].ObjectId).second)
    {
      return Result::Error("Objects: array `ObjectId`: " + std::to_string(read[i].ObjectId) +
                           " stands twice, ids must differ");
    }
    read[i].Position = positions[i];
  }
  objects = std::move(read);
  return Result::Ok();
}

} // namespace waft
