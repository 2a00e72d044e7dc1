// SPDX-License-Identifier: BSD-3-Clause
// A value of a scene file and its place. Private to this library (it shows the JSON library).
#pragma once

#include "Base/Types.h"
#include "Scene/SceneFields.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace waft
{

using SceneJson = nlohmann::ordered_json; // shapes keep the order of the file

/// Whether a parser is to leave out what it meets: the library copies and frees values by
/// recursion, so that a text of a million brackets would end the process. No field is so deep.
inline bool IsTooDeep(int depth, SceneJson::parse_event_t event)
{
  using Event = SceneJson::parse_event_t;
  constexpr int most = 64;
  const bool opens = event == Event::object_start || event == Event::array_start;
  return depth > most || (depth == most && opens);
}

/// Thrown inside this library only; ParseScene turns it into a Result.
struct SceneError
{
  std::string Message; // "/json/pointer: expected ..., found ..."
};

/// A name as messages show it: a long one by its beginning, so that the rest of a sentence is read.
std::string Shortened(const std::string& text, std::size_t longest = 60);
inline std::string ShortenedPath(const std::string& path)
{
  return Shortened(path, 300);
}

/// A field's name as a token of a JSON pointer (RFC 6901), a long one shortened.
std::string PointerToken(const std::string& field);

class SceneNode
{
public:
  /// `range`: of the numbers in this value, from the table of fields; null where it has none.
  /// `most`: of the entries in it.
  SceneNode(const SceneJson& value, std::string pointer, const limits::Range* range = nullptr,
            std::size_t most = SceneField::NoList);

  const std::string& Pointer() const { return this->Address; }
  const SceneJson& Json() const { return this->Value; }
  /// Throws "pointer: expected `expected`, found <this value>".
  [[noreturn]] void Fail(const std::string& expected) const;
  /// Throws "pointer: message".
  [[noreturn]] void FailWith(const std::string& message) const;

  /// Reads a field where it is there, as its table has it; returns whether it is. what: of whole
  /// numbers, for messages.
  template <class Value, class... Words>
  bool Take(const char* field, Value& value, const Words&... what) const
  {
    const bool isThere = this->Has(field);
    if (isThere)
    {
      this->At(field, "").To(value, what...);
    }
    return isThere;
  }

  bool IsString() const { return this->Value.is_string(); }
  bool IsArray() const { return this->Value.is_array(); }
  bool Has(const std::string& field) const;
  /// The field; one that is missing fails, with what it should have been.
  SceneNode At(const std::string& field, const std::string& expected) const;
  /// An element of a list.
  SceneNode Item(std::size_t i) const;
  /// Number of elements of a list, of which there are not too many; anything else fails.
  std::size_t Size(const std::string& expected = "a list") const;
  /// Names of the fields, of which there are not too many; comments left out.
  std::vector<std::string> Fields() const;
  /// Fails unless this is an object whose fields are all in the table of this name. From here on
  /// its fields know the ranges that the table gives them.
  void CheckFields(const std::string& table) const;

  /// A number in the range of its field.
  double Number() const;
  /// An integer in the range of its field.
  std::int64_t Integer(const std::string& what) const;
  /// An integer in a range that hangs on the rest of the scene.
  std::int64_t Integer(std::int64_t low, std::int64_t high, const std::string& what) const;
  bool Boolean() const;
  /// A text of one line: it may become a name in any file (Base/Characters.h says what it lacks).
  std::string Text() const;
  /// A text to be drawn, which may have line breaks.
  std::string Lines() const;
  Vec3 Vector() const;
  /// Made unit; one that is unit stays as it was written.
  Vec3 Direction() const;
  Quat Rotation() const;

private:
  void To(double& value) const { value = this->Number(); }
  void To(bool& value) const { value = this->Boolean(); }
  void To(std::string& value) const { value = this->Text(); }
  void To(Vec3& value) const { value = this->Vector(); }
  void To(Quat& value) const { value = this->Rotation(); }
  template <class Whole>
  void To(Whole& value, const char* what) const
  {
    value = static_cast<Whole>(this->Integer(what));
  }

  void RefuseControls(const std::string& text) const;
  std::vector<double> Numbers(std::size_t count, const std::string& expected) const;

  const limits::Range* RangeOf(const std::string& field) const;
  std::size_t MostOf(const std::string& field) const;
  void CheckNumberOf(const char* entries, std::size_t count) const;

  const SceneJson& Value;
  std::string Address;
  const limits::Range* Range;
  std::size_t Most;
  mutable const SceneFieldTable* Table = nullptr; // once the fields were checked
};

} // namespace waft
