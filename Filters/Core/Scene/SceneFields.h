// SPDX-License-Identifier: BSD-3-Clause
// The fields of a scene file and what their numbers may be, once: the reader refuses what is not
// here, and the published schema is tested against it.
#pragma once

#include "Base/Limits.h"

#include <optional>
#include <string>
#include <vector>

namespace waft
{

struct SceneField
{
  SceneField(const char* name, std::optional<limits::Range> range = std::nullopt) :
    Name(name), Range(range)
  {
  }

  std::string Name;
  /// Of its number, or of every number in it where it is a list; none of a text or an object.
  std::optional<limits::Range> Range;
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
