// SPDX-License-Identifier: BSD-3-Clause
// A scene file that is edited by hand while it is open.
#pragma once

#include "Base/Result.h"
#include "Scene/Scene.h"
#include "Scene/SceneAssets.h"
#include "Scene/SceneWind.h"

#include <string>

namespace waft
{

class EditedScene
{
public:
  /// The scene of a file with the edits (EditSceneText). What ReadScene and EditSceneText fail of
  /// is the Error; what was read before stays then.
  void Read(const std::string& file, const std::string& edits, const SceneAssets& assets);
  /// Writes the text with the edits over the file, whole or not at all. Fails, and leaves the file
  /// alone, where nothing could be read last, and where the file is another one since.
  Result Save();
  /// Writes the text with the edits to another file, whole or not at all; the scene stays that of
  /// its own. Fails where it could not be read there, as a scene that names files beside it.
  Result SaveAs(const std::string& file, const SceneAssets& assets) const;

  const Scene& Parts() const { return this->Whole; }
  const SceneWind& Wind() const { return this->Blowing; }
  /// Why nothing could be read; empty where something was.
  const std::string& Error() const { return this->Fault; }
  /// What can be moved (DescribeHandles); empty where nothing was read.
  std::string Handles() const;

private:
  Result CheckText() const;

  Scene Whole;
  SceneWind Blowing;
  std::string File;
  std::string Text, Edited; // of the file, and with the edits
  std::string Fault;
};

} // namespace waft
