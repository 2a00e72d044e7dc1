// SPDX-License-Identifier: BSD-3-Clause
// Rows of a struct as named arrays, one a member.
#pragma once

#include "Bridge/Data/Arrays.h"

#include <functional>
#include <type_traits>
#include <vector>

namespace waft
{

inline void AddArray(vtkFieldData* data, const char* name, const std::vector<double>& values)
{
  AddDoubles(data, name, values);
}

inline void AddArray(vtkFieldData* data, const char* name, const std::vector<int>& values)
{
  AddInts(data, name, values);
}

inline void AddArray(vtkFieldData* data, const char* name, const std::vector<unsigned char>& values)
{
  AddBytes(data, name, values);
}

inline void AddArray(vtkFieldData* data, const char* name, const std::vector<std::string>& values)
{
  AddStrings(data, name, values);
}

inline void AddArray(vtkFieldData* data, const char* name, const std::vector<Vec3>& values)
{
  AddVectors(data, name, values);
}

inline void AddArray(vtkFieldData* data, const char* name, const std::vector<Quat>& values)
{
  AddQuaternions(data, name, values);
}

/// What `value`, a member or a function of a row, gives of each row.
template <class Row, class Value>
auto Column(const std::vector<Row>& rows, const Value& value)
{
  std::vector<std::decay_t<std::invoke_result_t<const Value&, const Row&>>> values;
  values.reserve(rows.size());
  for (const Row& row : rows)
  {
    values.push_back(std::invoke(value, row));
  }
  return values;
}

/// The same as an array of one entry a row. The type of what `value` gives says which: int,
/// double, unsigned char, std::string, Vec3 or Quat.
template <class Row, class Value>
void AddColumn(vtkFieldData* data, const char* name, const std::vector<Row>& rows,
               const Value& value)
{
  AddArray(data, name, Column(rows, value));
}

inline Result ReadArray(const ArraySource& source, const char* name, std::vector<double>& values)
{
  return ReadDoubles(source, name, values);
}

inline Result ReadArray(const ArraySource& source, const char* name, std::vector<int>& values)
{
  return ReadInts(source, name, values);
}

inline Result ReadArray(const ArraySource& source, const char* name, std::vector<Vec3>& values)
{
  return ReadVectors(source, name, values);
}

inline Result ReadArray(const ArraySource& source, const char* name, std::vector<Quat>& values)
{
  return ReadQuaternions(source, name, values);
}

/// Reads an array into a member of the rows, of which there are as many as the place has entries.
/// Fails as the reading of the array does.
template <class Row, class Value>
Result ReadColumn(const ArraySource& source, const char* name, std::vector<Row>& rows,
                  Value Row::*member)
{
  std::vector<Value> values;
  if (Result read = ReadArray(source, name, values); !read)
  {
    return read;
  }
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    rows[i].*member = values[i];
  }
  return Result::Ok();
}

/// The same; when the array is absent the rows stay as they are.
template <class Row, class Value>
Result ReadOptionalColumn(const ArraySource& source, const char* name, std::vector<Row>& rows,
                          Value Row::*member)
{
  return source.Data->GetAbstractArray(name) ? ReadColumn(source, name, rows, member)
                                             : Result::Ok();
}

} // namespace waft
