// SPDX-License-Identifier: BSD-3-Clause
// Arrays of an output that are those of its input: there once, however long the motion.
#pragma once

#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>

#include <cstring>

namespace waft
{

/// Puts arrays of `from` in the place of arrays of `to` that have the same name and the same bytes.
inline void ShareEqualArrays(vtkDataSetAttributes* from, vtkDataSetAttributes* to)
{
  for (int i = 0; i < to->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* own = to->GetArray(i);
    vtkDataArray* other = own != nullptr ? from->GetArray(own->GetName()) : nullptr;
    if (other != nullptr && other->GetDataType() == own->GetDataType() &&
        other->HasStandardMemoryLayout() && own->HasStandardMemoryLayout() &&
        other->GetNumberOfComponents() == own->GetNumberOfComponents() &&
        other->GetNumberOfTuples() == own->GetNumberOfTuples() &&
        std::memcmp(other->GetVoidPointer(0), own->GetVoidPointer(0),
                    static_cast<std::size_t>(own->GetNumberOfValues()) *
                      static_cast<std::size_t>(own->GetDataTypeSize())) == 0)
    {
      to->AddArray(other);
    }
  }
}

} // namespace waft
