// SPDX-License-Identifier: BSD-3-Clause
// JSON to text and back. Private to this library (it shows the JSON library).
#pragma once

#include "Scene/SceneNode.h"

#include <string>

namespace waft
{

/// Throws SceneError where the text is no JSON, too deep, or says a field twice: "NAME: line 3,
/// column 7: expected ...".
SceneJson ParseText(const std::string& text, const std::string& name);

/// JSON with two blanks an indent; lists of numbers, or of lists of three, stay on a line.
std::string PrettyText(const SceneJson& json);

/// All on one line, a blank after each comma and colon.
std::string OneLine(const SceneJson& json);

} // namespace waft
