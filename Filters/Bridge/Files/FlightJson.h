// SPDX-License-Identifier: BSD-3-Clause
// What is told of a flight as JSON.
#pragma once

#include "Base/Monitor.h"
#include "Base/Types.h"
#include "Chain/Motion.h"
#include "Scene/Scene.h"

#include <string>

class vtkPolyData;
class vtkTable;

namespace waft
{

/// What of report.json follows from a motion: `time`, `energy`, `dynamics`, `forces`,
/// `fieldsExplained`, `fit`, `settled`, `agreement`, `free`. poses and convergence: as they are
/// written.
std::string MotionAsJson(const SceneInfo& info, const Motion& motion, vtkPolyData* poses,
                         vtkTable* convergence);

/// WriteFlight by programs that know no C++: options and what comes of it as JSON, by the names of
/// the fields: `report` and `warnings`, or `error`.
std::string WriteFlightAsJson(const Scene& scene, const Motion& motion, const std::string& options,
                              Monitor& monitor);
/// What a motion came to; see vtkMotionAnimationSource::GetFlight.
std::string FlightAsJson(const Motion& motion);

} // namespace waft
