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
// pipeline that keeps its properties so. A field is a number, a flag, a text, or several numbers:
// an array, a Box, which a stage keeps as an array, or a list of arrays, which it keeps alike.
#pragma once

#include "Base/Limits.h"
#include "Base/Result.h"
#include "Base/Types.h"

#include <string>
#include <type_traits>
#include <vector>

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
  /// The input of the stage that decides whether the option has an effect; "": it always has.
  const char* Input = "";
  bool ActsWhereJoined = true; ///< Else it acts only where that input is not joined.
  /// What it means that the option has the low end of its range, where that stands for none of it;
  /// "": it is a number as others.
  const char* Unset = "";

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

  /// The same of an option that has an effect only where an input of the stage is joined.
  OptionField With(const char* input) const
  {
    OptionField field = *this;
    field.Input = input;
    return field;
  }
  /// Only where it is not.
  OptionField Without(const char* input) const
  {
    OptionField field = this->With(input);
    field.ActsWhereJoined = false;
    return field;
  }

  /// The low end of its range stands for this. Whoever leaves an option out need not know the end.
  OptionField Or(const char* unset) const
  {
    OptionField field = *this;
    field.Unset = unset;
    return field;
  }

  /// The sentence, what stands for none of it, and when the option has no effect.
  std::string Text() const
  {
    std::string text = this->Sentence;
    if (*this->Unset)
    {
      text += " " + NumberText(this->Range.Low, 10) + ": " + this->Unset + ".";
    }
    if (*this->Input)
    {
      text += this->ActsWhereJoined ? " No effect unless " : " No effect where ";
      text += std::string(this->Input) + " is joined.";
    }
    return text;
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

template <class Value>
inline constexpr bool IsNumber = std::is_arithmetic_v<Value> || std::is_enum_v<Value>;

/// Calls use(number) for each number of a field in its order; those of a box are xmin, xmax, ymin,
/// ymax, zmin, zmax. A text has none.
template <class Value, class Use>
void EachNumber(Value& value, const Use& use)
{
  using Plain = std::remove_cv_t<Value>;
  if constexpr (IsNumber<Plain>)
  {
    use(value);
  }
  else if constexpr (std::is_same_v<Plain, Box>)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      use(value.Min[axis]);
      use(value.Max[axis]);
    }
  }
  else if constexpr (!std::is_same_v<Plain, std::string>)
  {
    for (auto& item : value)
    {
      EachNumber(item, use);
    }
  }
}

template <class Value>
std::vector<double> NumbersOf(const Value& value)
{
  std::vector<double> numbers;
  EachNumber(value, [&numbers](auto number) { numbers.push_back(static_cast<double>(number)); });
  return numbers;
}

/// Fails on the first field out of its range.
template <class Options, class Holder>
Result ValidateFields(const Holder& holder)
{
  Result result = Result::Ok();
  const auto check = [&result](const OptionField& field, const auto& value)
  {
    for (const double number : NumbersOf(value))
    {
      result = result ? field.Check(number) : result;
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
  {
    using Copied = std::decay_t<decltype(copied)>;
    if constexpr (std::is_same_v<Copied, std::decay_t<decltype(value)>> &&
                  !std::is_pointer_v<Copied>)
    {
      copied = value;
    }
    else if constexpr (IsNumber<Copied> || std::is_same_v<Copied, std::string>)
    {
      copied = static_cast<Copied>(value);
    }
    else
    {
      const std::vector<double> numbers = NumbersOf(value);
      auto next = numbers.begin();
      EachNumber(copied, [&next](auto& number)
                 { number = static_cast<std::decay_t<decltype(number)>>(*next++); });
    }
  };
  Options::Visit(copy, from, to);
}

} // namespace waft
