// SPDX-License-Identifier: BSD-3-Clause
// From the sources of a scene that was made by hand to bodies that fly.
#ifndef SceneFlight_h
#define SceneFlight_h

#include "vtkWaftProxiesModule.h"

#include <string>
#include <utility>
#include <vector>

class vtkSMSessionProxyManager;
class vtkSMSourceProxy;

namespace waft
{

struct SceneFlight
{
  std::string Refusal;                 // a sentence on what is missing; nothing was changed then
  std::vector<vtkSMSourceProxy*> Made; // stages that were not there before
  vtkSMSourceProxy* Plans = nullptr;   // the planner
  vtkSMSourceProxy* Bodies = nullptr;  // the stage whose ports are meshes (0) and poses (1)
  std::pair<vtkSMSourceProxy*, unsigned int> Marks; // as the flight meets them
  std::vector<vtkSMSourceProxy*> Drawn;             // sources that bodies and marks stand for
};

/// Joins all objects, constraints, obstacles, shapes, vortices and winds of a session, in the order
/// in which they were made, to the stages of a quality (of waft::Quality). Objects without a body
/// are leaves, where there is no shape at all. Where stages fly some of these sources already, the
/// others are joined to them; only `isChosen` puts another quality on them.
VTKWAFTPROXIES_EXPORT SceneFlight FlySources(vtkSMSessionProxyManager* session, int quality,
                                             bool isChosen);

/// Writes the scene that stages fly, of which `bodies` is the last, as a scene file. False where it
/// could not be written, which was said.
VTKWAFTPROXIES_EXPORT bool SaveFlownScene(vtkSMSourceProxy* bodies, const std::string& file);

} // namespace waft

#endif
