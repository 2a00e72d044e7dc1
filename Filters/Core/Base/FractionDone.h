// SPDX-License-Identifier: BSD-3-Clause
// What a monitor is told of work that is counted.
#pragma once

#include <cstddef>

namespace waft
{

/// The fraction of so many things that is done.
inline double FractionDone(std::size_t done, std::size_t all)
{
  return static_cast<double>(done) / static_cast<double>(all);
}

} // namespace waft
