// SPDX-License-Identifier: BSD-3-Clause
// The properties of a stage that are fields of options structs of Core. The stage declares each by
// a line of WaftProperty.h, which keeps it in a member of the same name, and makes the structs
// friends.
#pragma once

#include "Bridge/Pipeline/PropertyCheck.h"

#include <vtkIndent.h>

#include <cassert>
#include <cmath>
#include <ostream>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace waft
{

/// For the constructor of a stage.
template <class... Options, class Stage>
void TakeDefaults(Stage& stage)
{
  (CopyFields<Options>(Options(), stage), ...);
}

/// What a setter keeps of a number: one in the range of its option. An end that is there to keep
/// out nonsense does not hold it: the stage refuses such a number by RangesOf. NaN stays.
template <class... Options>
double InRange(std::string_view property, double value)
{
  [[maybe_unused]] bool isKnown = false;
  const auto keep = [&](const OptionField& field)
  {
    const double low = field.Range.Low, high = field.Range.High;
    if (field.Name == property)
    {
      isKnown = true;
      value = value < low && std::abs(low) < limits::Nonsense     ? low
              : value > high && std::abs(high) < limits::Nonsense ? high
                                                                  : value;
    }
  };
  (Options::Visit(keep), ...);
  assert(isKnown);
  return value;
}

template <class Options, class Stage>
Options OptionsOf(const Stage& stage)
{
  Options options;
  CopyFields<Options>(stage, options);
  return options;
}

/// For GuardedRequest: setters that clamp let NaN through.
template <class... Options, class Stage>
std::vector<PropertyRange> RangesOf(const Stage& stage)
{
  std::vector<PropertyRange> ranges;
  const auto add = [&ranges](const OptionField& field, const auto& value)
  { ranges.emplace_back(field, NumbersOf(value)); };
  (Options::Visit(add, stage), ...);
  return ranges;
}

/// One line a field, with its unit.
template <class... Options, class Stage>
void PrintFields(std::ostream& os, vtkIndent indent, const Stage& stage)
{
  const auto print = [&](const OptionField& field, const auto& value)
  {
    os << indent << field.Name << ":";
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::string>)
    {
      os << " " << value;
    }
    EachNumber(value, [&os](auto number) { os << " " << number; });
    os << (*field.Unit ? " " : "") << field.Unit << "\n";
  };
  (Options::Visit(print, stage), ...);
}

} // namespace waft
