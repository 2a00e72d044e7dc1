// SPDX-License-Identifier: BSD-3-Clause
// What PrintSelf of several stages prints alike.
#pragma once

#include <vtkIndent.h>

#include <ostream>

namespace waft
{

/// One line: the name of a property of several numbers, and these.
inline void PrintValues(std::ostream& os, vtkIndent indent, const char* name, const double* values,
                        int count)
{
  os << indent << name << ":";
  for (int i = 0; i < count; ++i)
  {
    os << " " << values[i];
  }
  os << "\n";
}

} // namespace waft
