// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/SceneNode.h"

#include "Base/Characters.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace waft
{

namespace
{

constexpr std::size_t LongestShown = 60; // of a name or value in a message [bytes]
constexpr const char* WithoutControls =
  "without control characters and marks that turn the direction of writing";

// Short values as they are; long ones by their kind (nothing is walked deeply: a file may nest its
// lists a million times).
std::string Describe(const SceneJson& value)
{
  const auto isFlat = [](const SceneJson& v)
  {
    return !v.is_structured() ||
           (v.size() <= LongestShown &&
            std::none_of(v.begin(), v.end(), [](const SceneJson& w) { return w.is_structured(); }));
  };
  const bool isShallow =
    !value.is_structured() ||
    (value.size() <= LongestShown && std::all_of(value.begin(), value.end(), isFlat));
  const std::string text =
    isShallow ? value.dump(-1, ' ', false, SceneJson::error_handler_t::replace) : std::string();
  if (isShallow && text.size() <= LongestShown)
  {
    return text;
  }
  if (value.is_object())
  {
    return "an object";
  }
  if (value.is_array())
  {
    return "a list of " + std::to_string(value.size());
  }
  return Shortened(text);
}

// What was expected of a number that is not in its range: the bound that it breaks in the words
// that say why, the whole range where only the table knows.
std::string ExpectedNumber(const limits::Range& range, double number)
{
  if (std::isfinite(number) && number > range.High)
  {
    return range.Text();
  }
  if (range.Low > 0.0 && !(number > 0.0))
  {
    return "a number above 0";
  }
  if (range.Low == 0.0 && range.High > 1.0)
  {
    return "a number of at least 0";
  }
  return range.Low < 0.0 && !std::isfinite(number) ? "a finite number" : range.Text();
}

} // namespace

std::string Shortened(const std::string& text, std::size_t longest)
{
  if (text.size() <= longest)
  {
    return text;
  }
  std::size_t end = longest;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) // within a letter
  {
    --end;
  }
  return text.substr(0, end) + "...";
}

std::string PointerToken(const std::string& field)
{
  std::string token;
  for (const char c : Shortened(field))
  {
    token += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  }
  return token;
}

SceneNode::SceneNode(const SceneJson& value, std::string pointer, const limits::Range* range,
                     std::size_t most) :
  Value(value),
  Address(std::move(pointer)), Range(range), Most(most)
{
}

void SceneNode::Fail(const std::string& expected) const
{
  this->FailWith("expected " + expected + ", found " + Describe(this->Value));
}

void SceneNode::FailWith(const std::string& message) const
{
  throw SceneError{ (this->Address.empty() ? std::string("/") : this->Address) + ": " + message };
}

bool SceneNode::Has(const std::string& field) const
{
  return this->Value.is_object() && this->Value.contains(field);
}

SceneNode SceneNode::At(const std::string& field, const std::string& expected) const
{
  if (!this->Value.is_object())
  {
    this->Fail("an object");
  }
  const auto found = this->Value.find(field);
  if (found == this->Value.end())
  {
    throw SceneError{ this->Address + "/" + PointerToken(field) + ": expected " + expected +
                      ", found nothing" };
  }
  return { *found, this->Address + "/" + PointerToken(field), this->RangeOf(field),
           this->MostOf(field) };
}

// Fields whose names the artist chooses have the range of what holds them.
const limits::Range* SceneNode::RangeOf(const std::string& field) const
{
  if (this->Table == nullptr)
  {
    return this->Range;
  }
  const SceneField* known = this->Table->Find(field);
  return known != nullptr && known->Range ? &*known->Range : nullptr;
}

std::size_t SceneNode::MostOf(const std::string& field) const
{
  const SceneField* known = this->Table == nullptr ? nullptr : this->Table->Find(field);
  return known == nullptr ? SceneField::NoList : known->Most;
}

void SceneNode::CheckNumberOf(const char* entries, std::size_t count) const
{
  if (count > this->Most)
  {
    this->FailWith("expected at most " + std::to_string(this->Most) + " " + entries + ", found " +
                   std::to_string(count));
  }
}

SceneNode SceneNode::Item(std::size_t i) const
{
  return { this->Value[i], this->Address + "/" + std::to_string(i), this->Range };
}

std::size_t SceneNode::Size(const std::string& expected) const
{
  if (!this->Value.is_array())
  {
    this->Fail(expected);
  }
  this->CheckNumberOf("entries", this->Value.size());
  return this->Value.size();
}

std::vector<std::string> SceneNode::Fields() const
{
  if (!this->Value.is_object())
  {
    this->Fail("an object");
  }
  std::vector<std::string> fields;
  for (const auto& item : this->Value.items())
  {
    const std::string control = FirstControl(item.key());
    if (!control.empty())
    {
      throw SceneError{ this->Address + "/" + PointerToken(item.key()) + ": " + "expected a name " +
                        WithoutControls + ", found " + control };
    }
    if (item.key().empty() || item.key().front() != '_')
    {
      fields.push_back(item.key());
    }
  }
  this->CheckNumberOf("fields", fields.size());
  return fields;
}

void SceneNode::CheckFields(const std::string& table) const
{
  this->Table = &SceneFieldsOf(table);
  for (const std::string& field : this->Fields())
  {
    if (this->Table->Find(field) == nullptr)
    {
      std::string list;
      for (const SceneField& known : this->Table->Fields)
      {
        list += (list.empty() ? "" : ", ") + known.Name;
      }
      throw SceneError{ this->Address + "/" + PointerToken(field) +
                        ": expected one of the fields " + list + ", found the unknown field \"" +
                        Shortened(field) + "\"" };
    }
  }
}

double SceneNode::Number() const
{
  const double number = this->Value.is_number() ? this->Value.get<double>() : NAN;
  constexpr limits::Range any = limits::Around0(std::numeric_limits<double>::max());
  const limits::Range range = this->Range == nullptr ? any : *this->Range;
  if (!range.Holds(number))
  {
    this->Fail(ExpectedNumber(range, number));
  }
  return number;
}

std::int64_t SceneNode::Integer(const std::string& what) const
{
  return this->Integer(static_cast<std::int64_t>(this->Range->Low),
                       static_cast<std::int64_t>(this->Range->High), what);
}

std::int64_t SceneNode::Integer(std::int64_t low, std::int64_t high, const std::string& what) const
{
  // 3.0 is an integer in JSON's own sense (draft-07 of the schema says so too).
  const double number = this->Value.is_number() ? this->Value.get<double>() : NAN;
  if (!(number == std::floor(number)) || number < static_cast<double>(low) ||
      number > static_cast<double>(high))
  {
    this->Fail(what + " (an integer from " + std::to_string(low) + " to " + std::to_string(high) +
               ")");
  }
  return this->Value.is_number_integer() ? this->Value.get<std::int64_t>()
                                         : static_cast<std::int64_t>(number);
}

bool SceneNode::Boolean() const
{
  if (!this->Value.is_boolean())
  {
    this->Fail("true or false");
  }
  return this->Value.get<bool>();
}

void SceneNode::RefuseControls(const std::string& text) const
{
  const std::string control = FirstControl(text);
  if (!control.empty())
  {
    this->FailWith(std::string("expected a text ") + WithoutControls + ", found " + control);
  }
}

std::string SceneNode::Text() const
{
  if (!this->Value.is_string())
  {
    this->Fail("a text");
  }
  std::string text = this->Value.get<std::string>();
  this->RefuseControls(text);
  return text;
}

std::string SceneNode::Lines() const
{
  if (!this->Value.is_string())
  {
    this->Fail("a text");
  }
  std::string text = this->Value.get<std::string>();
  std::string line;
  std::remove_copy(text.begin(), text.end(), std::back_inserter(line), '\n');
  this->RefuseControls(line);
  return text;
}

std::vector<double> SceneNode::Numbers(std::size_t count, const std::string& expected) const
{
  if (!this->Value.is_array() || this->Value.size() != count)
  {
    this->Fail(expected);
  }
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count; ++i)
  {
    numbers.push_back(this->Item(i).Number());
  }
  return numbers;
}

Vec3 SceneNode::Vector() const
{
  const std::vector<double> v = this->Numbers(3, "a vector [x, y, z]");
  return { v[0], v[1], v[2] };
}

Vec3 SceneNode::Direction() const
{
  const Vec3 direction = this->Vector();
  const double length = direction.norm();
  if (!(length > 1e-12))
  {
    this->Fail("a direction that is not zero");
  }
  return std::abs(length - 1.0) > 1e-15 ? direction.normalized() : direction;
}

Quat SceneNode::Rotation() const
{
  const std::vector<double> q = this->Numbers(4, "a quaternion [w, x, y, z]");
  const Quat rotation(q[0], q[1], q[2], q[3]);
  const double length = rotation.norm();
  if (!(length > 1e-12) || !std::isfinite(length))
  {
    this->Fail("a quaternion [w, x, y, z] that is not zero");
  }
  // One that is unit to the last digits stays as it was written.
  return std::abs(length - 1.0) < 1e-15 ? rotation : rotation.normalized();
}

} // namespace waft
