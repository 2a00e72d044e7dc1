// SPDX-License-Identifier: BSD-3-Clause
// The properties of a stage that are fields of an options struct of Core. The stage keeps them in
// members of the same names and makes the struct a friend.
#pragma once

#include "Bridge/Pipeline/PropertyCheck.h"

#include <vtkIndent.h>

#include <ostream>
#include <string>
#include <type_traits>
#include <vector>

namespace waft
{

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
