// SPDX-License-Identifier: BSD-3-Clause
// What is said once of each field of an options struct, and what follows from it. A struct states
// its fields in one template, beside the members whose initialisers are the defaults:
//
//   template <class Visitor, class... Holder>
//   static void Visit(Visitor&& visit, Holder&... of)
//   {
//     visit(OptionField{ "EditRadius", limits::UpTo(1000), "m", "..." }, of.EditRadius...);
//   }
//
// A holder is the struct itself or any class whose members have the same names: a stage of the
// pipeline that keeps its properties so.
#pragma once

#include "Base/Limits.h"
#include "Base/Result.h"
#include "Base/StateArchive.h"

#include <string>
#include <type_traits>

namespace waft
{

struct OptionField
{
  const char* Name;
  limits::Range Range; ///< Not read for texts.
  const char* Unit;    ///< "" for plain numbers.
  const char* Sentence;
  /// What a panel offers, where that is less than what may be.
  limits::Range Offered = Range;

  /// "NAME: expected a number from LOW to HIGH m, found VALUE" where the value is out of range.
  Result Check(double value) const
  {
    if (this->Range.Holds(value))
    {
      return Result::Ok();
    }
    const std::string unit = *this->Unit ? std::string(" ") + this->Unit : std::string();
    return Result::Error(std::string(this->Name) + ": expected " + this->Range.Text() + unit +
                         ", found " + NumberText(value, 10));
  }
};

/// A flag, which has no range to speak of.
inline OptionField FlagField(const char* name, const char* sentence)
{
  return { name, { 0, 1 }, "", sentence };
}
inline OptionField TextField(const char* name, const char* sentence)
{
  return { name, { 0, 0 }, "", sentence };
}

/// Fails on the first field out of its range.
template <class Options, class Holder>
Result ValidateFields(const Holder& holder)
{
  Result result = Result::Ok();
  const auto check = [&result](const OptionField& field, const auto& value)
  {
    if constexpr (!std::is_same_v<std::decay_t<decltype(value)>, std::string>)
    {
      result = result ? field.Check(static_cast<double>(value)) : result;
    }
  };
  Options::Visit(check, holder);
  return result;
}

/// Numbers of one kind become those of the other: an int of a pipeline's stage an enumerator.
template <class Options, class From, class To>
void CopyFields(const From& from, To& to)
{
  const auto copy = [](const OptionField&, const auto& value, auto& copied)
  { copied = static_cast<std::decay_t<decltype(copied)>>(value); };
  Options::Visit(copy, from, to);
}

/// A visitor that writes or reads each field.
inline auto ExchangeFieldsWith(StateArchive& stream)
{
  return [&stream](const OptionField&, auto& value)
  {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::string>)
    {
      stream.Text(value);
    }
    else
    {
      stream.Value(value);
    }
  };
}

} // namespace waft
