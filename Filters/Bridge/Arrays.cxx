// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Arrays.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>

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

// The array with its shape and its numbers checked; null without an error when it is absent and may
// be.
Result Find(const ArrayPlace& place, const char* name, int components, bool isOptional,
            vtkDataArray*& array)
{
  array = place.Data->GetArray(name);
  const std::string what = place.Owner + ": array `" + name + "`";
  if (!array)
  {
    return isOptional ? Result::Ok() : Result::Error(what + " is missing");
  }
  if (array->GetNumberOfComponents() != components)
  {
    return Result::Error(what + ": expected " + std::to_string(components) + " components, found " +
                         std::to_string(array->GetNumberOfComponents()));
  }
  if (array->GetNumberOfTuples() != place.Tuples)
  {
    return Result::Error(what + ": expected " + std::to_string(place.Tuples) + " entries, found " +
                         std::to_string(array->GetNumberOfTuples()));
  }
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < components; ++c)
    {
      if (!std::isfinite(array->GetComponent(i, c)))
      {
        return Result::Error(what + ": entry " + std::to_string(i) + " is not a finite number");
      }
    }
  }
  return Result::Ok();
}

template <class ValueT, class Convert>
Result Read(const ArrayPlace& place, const char* name, int components, std::vector<ValueT>& values,
            const ValueT* fallback, Convert convert)
{
  vtkDataArray* array = nullptr;
  if (Result found = Find(place, name, components, fallback != nullptr, array); !found)
  {
    return found;
  }
  values.clear();
  values.reserve(static_cast<std::size_t>(place.Tuples));
  for (vtkIdType i = 0; i < place.Tuples; ++i)
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

double FieldNumber(vtkFieldData* data, const char* name, double fallback)
{
  vtkDataArray* array = data->GetArray(name);
  return array && array->GetNumberOfTuples() > 0 ? array->GetComponent(0, 0) : fallback;
}

Result ReadDoubles(const ArrayPlace& place, const char* name, std::vector<double>& values,
                   const double* fallback)
{
  return Read(place, name, 1, values, fallback,
              [](vtkDataArray* array, vtkIdType i) { return array->GetComponent(i, 0); });
}

Result ReadInts(const ArrayPlace& place, const char* name, std::vector<int>& values,
                const int* fallback)
{
  return Read(place, name, 1, values, fallback,
              [](vtkDataArray* array, vtkIdType i)
              { return static_cast<int>(array->GetComponent(i, 0)); });
}

Result ReadVectors(const ArrayPlace& place, const char* name, std::vector<Vec3>& values,
                   const Vec3* fallback)
{
  return Read(place, name, 3, values, fallback,
              [](vtkDataArray* array, vtkIdType i)
              {
                Vec3 v;
                array->GetTuple(i, v.data());
                return v;
              });
}

Result ReadQuaternions(const ArrayPlace& place, const char* name, std::vector<Quat>& values,
                       const Quat* fallback)
{
  return Read(place, name, 4, values, fallback,
              [](vtkDataArray* array, vtkIdType i)
              {
                double q[4];
                array->GetTuple(i, q);
                return Quat(q[0], q[1], q[2], q[3]);
              });
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
  }
  return Result::Ok();
}

} // namespace waft
