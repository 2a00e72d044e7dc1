// SPDX-License-Identifier: BSD-3-Clause
// The JSON schema (draft-07) of scene files.
#pragma once

#include <string>

namespace waft
{

/// What SceneFields.h has, as a schema for editors, validators and the Python package.
std::string SceneSchemaText();

} // namespace waft
