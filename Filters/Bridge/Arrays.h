// SPDX-License-Identifier: BSD-3-Clause
// Small helpers to write and read named arrays.
#pragma once

#include "Base/Result.h"
#include "Base/Types.h"

#include <vtkFieldData.h>
#include <vtkType.h>

#include <string>
#include <vector>

class vtkDataArray;
class vtkPoints;
class vtkPolyData;

namespace waft
{

void AddDoubles(vtkFieldData* data, const char* name, const std::vector<double>& values);
void AddInts(vtkFieldData* data, const char* name, const std::vector<int>& values);
void AddBytes(vtkFieldData* data, const char* name, const std::vector<unsigned char>& values);
void AddStrings(vtkFieldData* data, const char* name, const std::vector<std::string>& values);
void AddVectors(vtkFieldData* data, const char* name, const std::vector<Vec3>& values);
/// Four components a tuple, (w, x, y, z).
void AddQuaternions(vtkFieldData* data, const char* name, const std::vector<Quat>& values);

/// Points of double precision.
void SetPoints(vtkPoints* points, const std::vector<Vec3>& values);
/// Points of double precision, each with a vertex.
void SetVertices(vtkPolyData* data, const std::vector<Vec3>& positions);

/// The first number of an array; the fallback when there is none.
double FieldNumber(vtkFieldData* data, const char* name, double fallback);

/// What is read, for messages: "Tracks: point data array".
struct ArrayPlace
{
  vtkFieldData* Data;
  std::string Owner;
  vtkIdType Tuples; // expected
};

/// Read an array of one component (three, four); the message names owner and array, what was
/// expected and the first entry that is not finite. With a fallback an absent array is filled with
/// it.
Result ReadDoubles(const ArrayPlace& place, const char* name, std::vector<double>& values,
                   const double* fallback = nullptr);
Result ReadInts(const ArrayPlace& place, const char* name, std::vector<int>& values,
                const int* fallback = nullptr);
Result ReadVectors(const ArrayPlace& place, const char* name, std::vector<Vec3>& values,
                   const Vec3* fallback = nullptr);
Result ReadQuaternions(const ArrayPlace& place, const char* name, std::vector<Quat>& values,
                       const Quat* fallback = nullptr);
Result ReadPoints(vtkPoints* points, const std::string& owner, std::vector<Vec3>& values);

} // namespace waft
