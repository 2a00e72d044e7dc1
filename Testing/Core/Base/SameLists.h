// SPDX-License-Identifier: BSD-3-Clause
// Two lists whose items must be the same.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace waft
{
namespace test
{

/// As many of both, and same(x, y) of each two in one place; a failure in there names the item by
/// `what` and its place.
template <class T, class Same>
void ExpectSameItems(const char* what, const std::vector<T>& a, const std::vector<T>& b,
                     const Same& same)
{
  ASSERT_EQ(a.size(), b.size()) << what;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    SCOPED_TRACE(std::string(what) + " " + std::to_string(i));
    same(a[i], b[i]);
  }
}

} // namespace test
} // namespace waft
