// SPDX-License-Identifier: BSD-3-Clause
// A value of a scene file and its place. Private to this library (it shows the JSON library).
#pragma once

#include "Base/Types.h"

#include <nlohmann/json.hpp>

#include <limits>
#include <string>
#include <vector>

namespace waft
{

using SceneJson = nlohmann::ordered_json; // shapes keep the order of the file

/// Thrown inside this library only; ParseScene turns it into a Result.
struct SceneError
{
  std::string Message; // "/json/pointer: expected ..., found ..."
};

class SceneNode
{
public:
  SceneNode(const SceneJson& value, std::string pointer);

  const std::string& Pointer() const { return this->Place; }
  /// Throws "pointer: expected `expected`, found <this value>".
  [[noreturn]] void Fail(const std::string& expected) const;
  /// Throws "pointer: message".
  [[noreturn]] void FailWith(const std::string& message) const;

  bool IsString() const { return this->Value.is_string(); }
  bool IsArray() const { return this->Value.is_array(); }
  bool Has(const std::string& field) const;
  /// The field; one that is missing fails, with what it should have been.
  SceneNode At(const std::string& field, const std::string& expected) const;
  /// An element of a list.
  SceneNode Item(std::size_t i) const;
  /// Number of elements of a list; anything else fails.
  std::size_t Size(const std::string& expected = "a list") const;
  /// Names of the fields, comments left out.
  std::vector<std::string> Fields() const;
  /// Fails unless this is an object whose fields are all in the table of this name.
  void CheckFields(const std::string& table) const;

  double Number(double low = -std::numeric_limits<double>::infinity(),
                double high = std::numeric_limits<double>::infinity()) const;
  double Positive() const;
  double NonNegative() const;
  std::int64_t Integer(std::int64_t low, std::int64_t high, const std::string& what) const;
  bool Boolean() const;
  std::string Text() const;
  Vec3 Vector() const;
  Quat Rotation() const;

private:
  std::vector<double> Numbers(std::size_t count, const std::string& expected) const;

  const SceneJson& Value;
  std::string Place;
};

} // namespace waft
