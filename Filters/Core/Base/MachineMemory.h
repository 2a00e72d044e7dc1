// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib> // says whether the C library is glibc
#include <unistd.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace waft
{

/// Bytes of memory that the machine has in all.
inline double MachineMemory()
{
  return static_cast<double>(::sysconf(_SC_PHYS_PAGES)) *
         static_cast<double>(::sysconf(_SC_PAGESIZE));
}

/// What was let go of goes back to the system: of large runs the C library keeps most for itself.
inline void GiveMemoryBack()
{
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

/// Gives memory back when it ends: the first member of who holds a lot, so that it ends last.
struct GivesMemoryBack
{
  GivesMemoryBack() = default;
  GivesMemoryBack(const GivesMemoryBack&) = delete;
  GivesMemoryBack& operator=(const GivesMemoryBack&) = delete;
  ~GivesMemoryBack() { GiveMemoryBack(); }
};

} // namespace waft
