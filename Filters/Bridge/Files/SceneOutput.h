// SPDX-License-Identifier: BSD-3-Clause
// A scene as files: the text and what it cannot say in words.
#pragma once

#include "Base/Result.h"
#include "Bridge/Data/SceneBlocks.h"

#include <string>

namespace waft
{

/// Writes a scene file (*.waft.json) and beside it what it cannot say in words: NAME.*.vtp,
/// NAME.wind.vti or NAME.wind.pvd with the folder NAME.wind. All of them or none, and nothing when
/// something cannot be written (FormatScene says what). Objects without any shape become discs.
Result WriteSceneFiles(const SceneContents& scene, const std::string& fileName);

} // namespace waft
