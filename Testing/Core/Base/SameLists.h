// SPDX-License-Identifier: BSD-3-Clause
// Two lists whose items must be the same.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace waft
{
namespace test
{

template <class Fields, std::size_t... I>
void ExpectSameFields(const Fields& x, const Fields& y, std::index_sequence<I...>)
{
  (
    [&]
    {
      SCOPED_TRACE("field " + std::to_string(I));
      EXPECT_EQ(std::get<I>(x), std::get<I>(y));
    }(),
    ...);
}

/// As many of both, and each two at one index the same in all the fields that `fieldsOf` ties of an
/// item. A failure names the item by `what` and its index, and the index of the field.
template <class T, class FieldsOf>
void ExpectSameItems(const char* what, const std::vector<T>& a, const std::vector<T>& b,
                     const FieldsOf& fieldsOf)
{
  ASSERT_EQ(a.size(), b.size()) << what;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    SCOPED_TRACE(std::string(what) + " " + std::to_string(i));
    const auto x = fieldsOf(a[i]);
    const auto y = fieldsOf(b[i]);
    ExpectSameFields(x, y, std::make_index_sequence<std::tuple_size_v<decltype(fieldsOf(a[i]))>>());
  }
}

} // namespace test
} // namespace waft
