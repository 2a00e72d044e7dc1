// SPDX-License-Identifier: BSD-3-Clause
// Random forces that stir a closed air as the airs of the databases are stirred.
#pragma once

#include "Air/Field/AirSimulation.h"
#include "Air/Field/AirStatistics.h"
#include "Air/Field/WarmUp.h"
#include "Constraints/MotionProblem.h"

#include <cstdint>

namespace waft
{

/// Random forces, and how their air comes to its first frame.
struct ForceDraw
{
  SmokeForces Forces; // the problem's own among them, but for its field of wind; in frames' time
  WarmUp Begin;
};

/// Of a few draws, each warmed up on a coarse grid, the one in whose closed box bodies move most as
/// they do in open boxes, where air comes and goes (wanted). coarse: its forces are not looked at.
/// law: of a typical body. The same on any number of threads.
Result DrawForces(const MotionProblem& problem, std::uint64_t seed, const AirScene& coarse,
                  const BodyLaw& law, const ParallelFor& parallel, PartMonitor& monitor,
                  ForceDraw& draw, AirStatistics& wanted);

} // namespace waft
