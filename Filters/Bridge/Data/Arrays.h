// SPDX-License-Identifier: BSD-3-Clause
// Small helpers to write and read named arrays.
#pragma once

#include "Base/Limits.h"
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

/// The first text of an array; an empty one when there is no such array.
std::string FirstString(vtkFieldData* data, const char* name);

/// Points of double precision.
void SetPoints(vtkPoints* points, const std::vector<Vec3>& values);
/// Points of double precision, each with a vertex.
void SetVertices(vtkPolyData* data, const std::vector<Vec3>& positions);

/// The first number of an array of field data; `value` stays when there is no such array. Fails on
/// one without numbers and on a number out of range; owner: "field data", "Shapes: block leaf".
Result ReadNumber(vtkFieldData* data, const std::string& owner, const char* name,
                  const limits::Range& range, double& value);

/// What is read, for messages: "Tracks: point data array".
struct ArraySource
{
  vtkFieldData* Data;
  std::string Owner;
  vtkIdType Tuples; // expected
  /// Numbers that a stage found, like forces along tracks: large bodies and strong winds give large
  /// ones, so that they are only asked to be finite, in the single precision that files have. What
  /// somebody chose has the range of its name.
  bool IsComputed = false;
};

/// What the following check before they read: an array that is there, so many components and tuples
/// of numbers.
Result CheckNumbers(const ArraySource& source, const char* name, int components);

/// Read an array of one component (three, four); the message names owner and array, what was
/// expected and the first entry that is out of the range of its name (a whole number for ints).
/// With a fallback an absent array is filled with it.
Result ReadDoubles(const ArraySource& source, const char* name, std::vector<double>& values,
                   const double* fallback = nullptr);
Result ReadInts(const ArraySource& source, const char* name, std::vector<int>& values,
                const int* fallback = nullptr);
Result ReadVectors(const ArraySource& source, const char* name, std::vector<Vec3>& values,
                   const Vec3* fallback = nullptr);
Result ReadQuaternions(const ArraySource& source, const char* name, std::vector<Quat>& values,
                       const Quat* fallback = nullptr);
/// Fails on a coordinate that is none (limits::Coordinate).
Result ReadPoints(vtkPoints* points, const std::string& owner, std::vector<Vec3>& values);
/// Fails on cells that are not of points that are there: VTK and its filters do not look.
Result CheckCells(vtkPolyData* data, const std::string& owner);

} // namespace waft
