// SPDX-License-Identifier: BSD-3-Clause
// A scene as files: the text and what it cannot say in words.
#pragma once

#include "Base/Result.h"
#include "Bridge/Data/SceneBlocks.h"

#include <string>
#include <vector>

namespace waft
{

/// Writes a scene file (*.waft.json) and beside it what it cannot say in words: NAME.*.vtp,
/// NAME.wind.vti or NAME.wind.pvd with the folder NAME.wind. All of them or none, and nothing when
/// something cannot be written (FormatScene says what). Objects without any shape become discs.
///
/// A scene that stands at `fileName` is replaced, any other file there is an error. Files beside it
/// carry a mark with a digest of themselves: those that an earlier writing made, and nobody changed
/// since or names in the scene, are replaced. Where another one has such a name all of them are
/// called NAME-2.*, NAME-3.*, ..., and `remarks` says so.
Result WriteSceneFiles(const SceneContents& scene, const std::string& fileName,
                       std::vector<std::string>& remarks);

} // namespace waft
