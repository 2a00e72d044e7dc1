// SPDX-License-Identifier: BSD-3-Clause
// The fields of a scene file, once: the reader refuses what is not here, and the published schema
// is tested against it.
#pragma once

#include <string>
#include <vector>

namespace waft
{

/// The fields that one kind of JSON object may have. Name is the schema's definition of that kind
/// ("scene" is its root).
struct SceneFieldTable
{
  std::string Name;
  std::vector<std::string> Fields;
};

const std::vector<SceneFieldTable>& SceneFieldTables();

/// The table of a name; an empty one when there is none.
const SceneFieldTable& SceneFieldsOf(const std::string& name);

} // namespace waft
