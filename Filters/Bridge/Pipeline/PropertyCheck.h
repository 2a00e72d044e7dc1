// SPDX-License-Identifier: BSD-3-Clause
// What the properties of a stage may be, looked at before it works: setters take any number, and
// those that clamp let NaN through.
#pragma once

#include "Base/OptionFields.h"
#include "Base/Result.h"

#include <utility>
#include <vector>

namespace waft
{

/// A property of one or more numbers and their range.
struct PropertyRange
{
  PropertyRange(const OptionField& field, std::vector<double> values) :
    Name(field.Name), Values(std::move(values)), Range(field.Range), Unit(field.Unit)
  {
  }
  PropertyRange(const char* name, double value, const limits::Range& range) :
    Name(name), Values{ value }, Range(range)
  {
  }

  const char* Name;
  std::vector<double> Values;
  limits::Range Range;
  const char* Unit = "";
};

/// Fails on the first property out of its range: "FramesPerSecond: expected a number from ...".
Result CheckProperties(const std::vector<PropertyRange>& properties);

} // namespace waft
