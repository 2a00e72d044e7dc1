// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace waft
{

/// Asks the system to back memory that nobody has written yet by large pages, where it has them:
/// what streams through many megabytes then waits less for addresses. A hint, without effect on
/// contents.
void PreferLargePages(void* data, std::size_t bytes);

/// As v.assign(count, T()), in large pages.
template <class T>
void AssignInLargePages(std::vector<T>& v, std::size_t count)
{
  v.clear();
  if (v.capacity() < count)
  {
    v.reserve(count);
    PreferLargePages(v.data(), count * sizeof(T));
  }
  v.resize(count);
}

} // namespace waft
