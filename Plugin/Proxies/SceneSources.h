// SPDX-License-Identifier: BSD-3-Clause
// What a session has of a scene.
#pragma once

#include "StageChain.h"

namespace waft
{

/// The sources that give something of a scene: that of a file, and others as they were made.
class SceneSources
{
public:
  explicit SceneSources(vtkSMSessionProxyManager* session);

  /// By the names that the table of the chain has of a scene's outputs.
  const std::vector<SourcePort>& All(const std::string& output) const;
  /// What keeps them from flying, as a sentence; empty where nothing does.
  std::string Refusal() const;

private:
  void Take(vtkSMSourceProxy* source);

  std::map<std::string, std::vector<SourcePort>> Ports;
};

/// The name in the pipeline browser.
std::string NameOf(vtkSMProxy* source);

} // namespace waft
