// SPDX-License-Identifier: BSD-3-Clause
// Data structs that name their members once, in a template Visit as those of options do but without
// a name and a range, and the digest that follows from it.
#pragma once

#include "Base/Digest.h"
#include "Base/Types.h"

#include <Eigen/Core>

#include <type_traits>
#include <vector>

namespace waft
{

/// A visitor that adds each member to a digest: numbers, points, rotations, matrices, structs with
/// a Visit, and lists of these with their lengths.
class MemberDigest
{
public:
  explicit MemberDigest(Digest& digest) : Sums(digest) {}

  template <class Value>
  void operator()(const Value& value) const
  {
    if constexpr (std::is_arithmetic_v<Value> || std::is_enum_v<Value>)
    {
      this->Sums.Add(value);
    }
    else if constexpr (std::is_same_v<Value, Quat>)
    {
      this->Sums.AddMatrix(value.coeffs());
    }
    else if constexpr (std::is_base_of_v<Eigen::EigenBase<Value>, Value>)
    {
      this->Sums.AddMatrix(value);
    }
    else
    {
      Value::Visit(*this, value);
    }
  }
  template <class Item>
  void operator()(const std::vector<Item>& items) const
  {
    if constexpr (std::is_arithmetic_v<Item> || std::is_enum_v<Item>)
    {
      this->Sums.AddList(items);
    }
    else
    {
      this->Sums.Add(items.size());
      for (const Item& item : items)
      {
        (*this)(item);
      }
    }
  }

private:
  Digest& Sums;
};

} // namespace waft
