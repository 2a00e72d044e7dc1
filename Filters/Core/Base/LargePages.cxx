// SPDX-License-Identifier: BSD-3-Clause
#include "Base/LargePages.h"

#include <cstdint>
#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace waft
{

void PreferLargePages(void* data, std::size_t bytes)
{
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  constexpr std::uintptr_t Large = std::uintptr_t(1) << 21;
  const auto begin = (reinterpret_cast<std::uintptr_t>(data) + Large - 1) / Large * Large;
  const auto end = (reinterpret_cast<std::uintptr_t>(data) + bytes) / Large * Large;
  if (begin < end)
  {
    (void)madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
  }
#else
  (void)data;
  (void)bytes;
#endif
}

} // namespace waft
