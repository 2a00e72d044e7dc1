// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/Arrays.h"

#include "Bridge/Data/ArrayNames.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>
#include <limits>
#include <map>

namespace waft
{
namespace
{

template <class ArrayT, class ValueT>
void AddScalars(vtkFieldData* data, const char* name, const std::vector<ValueT>& values)
{
  vtkNew<ArrayT> array;
  array->SetName(name);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    array->SetValue(static_cast<vtkIdType>(i), values[i]);
  }
  data->AddArray(array);
}

// What the numbers of an array of this name may be.
limits::Range RangeOf(const ArraySource& source, const std::string& name)
{
  if (source.IsComputed)
  {
    return limits::Around0(std::numeric_limits<float>::max());
  }
  static const std::map<std::string, limits::Range> ranges = {
    { names::Velocity, limits::Velocity },
    { names::AngularVelocity, limits::Spin },
    { names::Mass, limits::UpTo(limits::Mass.High) },
    { names::SettlingSpeed, limits::UpTo(limits::Speed.High) },
    { names::ClearanceRadius, limits::Distance },
    { names::RestHeight, limits::Distance },
    { names::Value, limits::Coordinate },
    { names::Strength, limits::VortexStrength },
    { names::CenterTime, limits::Time },
    { names::Duration, limits::Duration },
    { names::CoreRadius, limits::Distance },
  };
  const auto found = ranges.find(name);
  return found == ranges.end() ? limits::Around0(limits::Factor.High) : found->second;
}

std::string ArrayText(const std::string& owner, const char* name)
{
  return owner + ": array `" + name + "`";
}

Result CheckNumber(const std::string& what, double number, const limits::Range& range)
{
  if (!std::isfinite(number))
  {
    return Result::Error(what + " is not a finite number");
  }
  return range.Holds(number) ? Result::Ok()
                             : Result::Error(what + ": expected " + range.Text() + ", found " +
                                             NumberText(number, 10));
}

// Numbers of the array of this name; null without an error when there is no array at all.
Result FindNumbers(vtkFieldData* data, const std::string& what, const char* name,
                   vtkDataArray*& array)
{
  array = data->GetArray(name);
  const bool isOther = array == nullptr && data->GetAbstractArray(name) != nullptr;
  return isOther ? Result::Error(what + ": expected numbers, found text") : Result::Ok();
}

// The array with its shape and its numbers checked; null without an error when it is absent and may
// be.
Result Find(const ArraySource& source, const char* name, int components, bool isOptional,
            const limits::Range& range, vtkDataArray*& array)
{
  const std::string what = ArrayText(source.Owner, name);
  WAFT_RETURN_IF_FAILED(FindNumbers(source.Data, what, name, array));
  if (!array)
  {
    return isOptional ? Result::Ok() : Result::Error(what + " is missing");
  }
  if (array->GetNumberOfComponents() != components)
  {
    return Result::Error(what + ": expected " + std::to_string(components) + " components, found " +
                         std::to_string(array->GetNumberOfComponents()));
  }
  if (array->GetNumberOfTuples() != source.Tuples)
  {
    return Result::Error(what + ": expected " + std::to_string(source.Tuples) + " entries, found " +
                         std::to_string(array->GetNumberOfTuples()));
  }
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < components; ++c)
    {
      const double number = array->GetComponent(i, c);
      if (!range.Holds(number))
      {
        return CheckNumber(what + ": entry " + std::to_string(i), number, range);
      }
    }
  }
  return Result::Ok();
}

template <class ValueT, class Convert>
Result Read(const ArraySource& source, const char* name, int components,
            std::vector<ValueT>& values, const ValueT* fallback, Convert convert,
            const limits::Range& range)
{
  vtkDataArray* array = nullptr;
  WAFT_RETURN_IF_FAILED(Find(source, name, components, fallback != nullptr, range, array));
  values.clear();
  values.reserve(static_cast<std::size_t>(source.Tuples));
  for (vtkIdType i = 0; i < source.Tuples; ++i)
  {
    values.push_back(array ? convert(array, i) : *fallback);
  }
  return Result::Ok();
}

} // namespace

void AddDoubles(vtkFieldData* data, const char* name, const std::vector<double>& values)
{
  AddScalars<vtkDoubleArray>(data, name, values);
}

void AddInts(vtkFieldData* data, const char* name, const std::vector<int>& values)
{
  AddScalars<vtkIntArray>(data, name, values);
}

void AddBytes(vtkFieldData* data, const char* name, const std::vector<unsigned char>& values)
{
  AddScalars<vtkUnsignedCharArray>(data, name, values);
}

void AddStrings(vtkFieldData* data, const char* name, const std::vector<std::string>& values)
{
  AddScalars<vtkStringArray>(data, name, values);
}

std::string FirstString(vtkFieldData* data, const char* name)
{
  auto* texts = vtkStringArray::SafeDownCast(data->GetAbstractArray(name));
  return texts && texts->GetNumberOfValues() > 0 ? texts->GetValue(0) : std::string();
}

void AddVectors(vtkFieldData* data, const char* name, const std::vector<Vec3>& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    array->SetTuple(static_cast<vtkIdType>(i), values[i].data());
  }
  data->AddArray(array);
}

void AddQuaternions(vtkFieldData* data, const char* name, const std::vector<Quat>& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(4);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const Quat& q = values[i];
    array->SetTuple4(static_cast<vtkIdType>(i), q.w(), q.x(), q.y(), q.z());
  }
  data->AddArray(array);
}

void SetPoints(vtkPoints* points, const std::vector<Vec3>& values)
{
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    points->SetPoint(static_cast<vtkIdType>(i), values[i].data());
  }
}

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

Result ReadNumber(vtkFieldData* data, const std::string& owner, const char* name,
                  const limits::Range& range, double& value)
{
  const std::string what = owner + " `" + name + "`";
  vtkDataArray* array = nullptr;
  WAFT_RETURN_IF_FAILED(FindNumbers(data, what, name, array));
  if (!array || array->GetNumberOfTuples() == 0)
  {
    return Result::Ok();
  }
  const double number = array->GetComponent(0, 0);
  WAFT_RETURN_IF_FAILED(CheckNumber(what, number, range));
  value = number;
  return Result::Ok();
}

Result CheckNumbers(const ArraySource& source, const char* name, int components)
{
  vtkDataArray* array = nullptr;
  return Find(source, name, components, false, RangeOf(source, name), array);
}

Result ReadDoubles(const ArraySource& source, const char* name, std::vector<double>& values,
                   const double* fallback)
{
  return Read(
    source, name, 1, values, fallback,
    [](vtkDataArray* array, vtkIdType i) { return array->GetComponent(i, 0); },
    RangeOf(source, name));
}

Result ReadInts(const ArraySource& source, const char* name, std::vector<int>& values,
                const int* fallback)
{
  constexpr limits::Range range = { std::numeric_limits<int>::min(),
                                    std::numeric_limits<int>::max() };
  vtkDataArray* array = source.Data->GetArray(name);
  for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
  {
    const double number = array->GetComponent(i, 0);
    if (range.Holds(number) && number != std::floor(number))
    {
      return Result::Error(ArrayText(source.Owner, name) + ": entry " + std::to_string(i) +
                           ": expected a whole number, found " + NumberText(number, 10));
    }
  }
  return Read(
    source, name, 1, values, fallback,
    [](vtkDataArray* array, vtkIdType i) { return static_cast<int>(array->GetComponent(i, 0)); },
    range);
}

Result ReadVectors(const ArraySource& source, const char* name, std::vector<Vec3>& values,
                   const Vec3* fallback)
{
  return Read(
    source, name, 3, values, fallback,
    [](vtkDataArray* array, vtkIdType i)
    {
      Vec3 v;
      array->GetTuple(i, v.data());
      return v;
    },
    RangeOf(source, name));
}

Result ReadQuaternions(const ArraySource& source, const char* name, std::vector<Quat>& values,
                       const Quat* fallback)
{
  return Read(
    source, name, 4, values, fallback,
    [](vtkDataArray* array, vtkIdType i)
    {
      double q[4];
      array->GetTuple(i, q);
      return Quat(q[0], q[1], q[2], q[3]);
    },
    RangeOf(source, name));
}

Result ReadPoints(vtkPoints* points, const std::string& owner, std::vector<Vec3>& values)
{
  values.clear();
  const vtkIdType count = points ? points->GetNumberOfPoints() : 0;
  values.resize(static_cast<std::size_t>(count));
  for (vtkIdType i = 0; i < count; ++i)
  {
    Vec3& value = values[static_cast<std::size_t>(i)];
    points->GetPoint(i, value.data());
    if (!value.allFinite())
    {
      return Result::Error(owner + ": point " + std::to_string(i) + " is not finite");
    }
    if (!limits::Coordinate.HoldsAll(value))
    {
      return Result::Error(owner + ": point " + std::to_string(i) +
                           ": expected coordinates within 1e6 m, found " + PointText(value));
    }
  }
  return Result::Ok();
}

Result CheckCells(vtkPolyData* data, const std::string& owner)
{
  const vtkIdType points = data->GetNumberOfPoints();
  vtkIdType before = 0;
  vtkNew<vtkIdList> ids;
  for (vtkCellArray* cells :
       { data->GetVerts(), data->GetLines(), data->GetPolys(), data->GetStrips() })
  {
    if (!cells->IsValid())
    {
      return Result::Error(owner + ": expected cells whose lists of points are whole");
    }
    for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
    {
      cells->GetCellAtId(cell, ids);
      for (const vtkIdType id : *ids)
      {
        if (id < 0 || id >= points)
        {
          return Result::Error(owner + ": cell " + std::to_string(before + cell) +
                               ": expected indices of " + std::to_string(points) +
                               " points, found " + std::to_string(id));
        }
      }
    }
    before += cells->GetNumberOfCells();
  }
  return Result::Ok();
}

} // namespace waft
