// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Base/FieldSeries.h"
#include "Base/Types.h"

namespace waft
{
namespace test
{

/// The same all over a box and at all times.
inline FieldSeries EvenWind(const Box& box, FieldMeaning meaning, const std::array<float, 3>& value)
{
  FieldSeries wind;
  wind.Meaning = meaning;
  wind.Dimensions = { 2, 2, 2 };
  wind.Origin = box.Min;
  wind.Spacing = box.Size();
  wind.Times = { 0.0 };
  wind.Values = { std::vector<std::array<float, 3>>(8, value) };
  return wind;
}

} // namespace test
} // namespace waft
