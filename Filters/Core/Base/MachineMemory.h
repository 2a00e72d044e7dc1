// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unistd.h>

namespace waft
{

/// Bytes of memory that the machine has in all.
inline double MachineMemory()
{
  return static_cast<double>(::sysconf(_SC_PHYS_PAGES)) *
         static_cast<double>(::sysconf(_SC_PAGESIZE));
}

} // namespace waft
