// SPDX-License-Identifier: BSD-3-Clause
// What an artist wrote, kept beside what it makes. Private to this library (it shows the JSON
// library).
#pragma once

#include "Scene/Scene.h"
#include "Scene/SceneNode.h"

#include <filesystem>
#include <functional>
#include <string>

namespace waft
{

/// Where a file is that a scene names: in `folder`, else, where the scene's file is a link, beside
/// what that leads to. Without either, where it is missing.
std::filesystem::path FileOfScene(const std::string& scene, const std::string& folder,
                                  const std::string& name);

/// Sets Authored of a scene and of its shapes from the file `name` that they were read from. Each
/// part is a scene file itself, with the version and the sections that it is about; names of files
/// are resolved as FileOfScene does.
void KeepAuthored(const SceneJson& root, const std::string& name, const std::string& folder,
                  Scene& scene);

/// A part from its text; an empty object where the text is none.
SceneJson AuthoredPart(const std::string& text);

/// A section of a part, "objects" say; an empty list where there is none.
SceneJson AuthoredList(const std::string& text, const char* section);

/// Names anew the files that an entry of a section names.
void RenameFiles(SceneJson& entry, const std::function<std::string(const std::string&)>& rename);

} // namespace waft
