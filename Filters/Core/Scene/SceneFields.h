// SPDX-License-Identifier: BSD-3-Clause
// The fields of a scene file and what their numbers may be, once: the reader refuses what is not
// here, and the published schema is tested against it.
#pragma once

#include "Base/Limits.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace waft
{

/// How many there may be of what a scene lists: as many as a look at the scene (`waft check`) takes
/// 10 s and 1 GB for.
struct SceneLists
{
  static constexpr std::size_t Shapes = 1000;
  static constexpr std::size_t Entries = 10000; ///< Of objects, and of constraints.
  static constexpr std::size_t Objects = 20000; ///< Of all entries together.
  static constexpr std::size_t Rows = 100000;   ///< Of all constraints together.
  static constexpr std::size_t Obstacles = 1000;
  static constexpr std::size_t Keys = 10000;      ///< Of the motion of an obstacle.
  static constexpr std::size_t Places = 10000000; ///< Of all obstacles that move, one a frame each.
  static constexpr std::size_t Winds = 1000;
  static constexpr std::size_t Vortices = 10000;
  static constexpr std::size_t Colors = 100;     ///< Of the classes of a picture.
  static constexpr std::size_t Bytes = 32000000; ///< Of the file.
};

struct SceneField
{
  static constexpr std::size_t NoList = static_cast<std::size_t>(-1);

  SceneField(const char* name, std::optional<limits::Range> range = std::nullopt,
             std::size_t most = NoList) :
    Name(name),
    Range(range), Most(most)
  {
  }
  SceneField(const char* name, std::size_t most) : SceneField(name, std::nullopt, most) {}

  std::string Name;
  /// Of its number, or of every number in it where it is a list; none of a text or an object.
  std::optional<limits::Range> Range;
  /// Of the entries in it, where it is a list or an object of named entries.
  std::size_t Most;
};

/// The fields that one kind of JSON object may have. Name is the schema's definition of that kind
/// ("scene" is its root).
struct SceneFieldTable
{
  /// Null where the kind has no such field.
  const SceneField* Find(const std::string& field) const;

  std::string Name;
  std::vector<SceneField> Fields;
};

const std::vector<SceneFieldTable>& SceneFieldTables();

/// The table of a name; an empty one when there is none.
const SceneFieldTable& SceneFieldsOf(const std::string& name);

} // namespace waft
