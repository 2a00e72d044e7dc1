// SPDX-License-Identifier: BSD-3-Clause
// Random forces that stir a closed air as the airs of the databases are stirred.
#pragma once

#include "Air/Field/AirSimulation.h"
#include "Air/Field/AirStatistics.h"
#include "Constraints/MotionProblem.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace waft
{

/// Random forces, and how bodies move in the coarse air that they make.
struct ForceDraw
{
  std::uint64_t Seed = 0;
  double Scale = 1.0;
  double Misfit = 1e300;
  SmokeForces Forces; // the problem's own among them
  AirStatistics Found;
};

/// Draws by coarse simulations, those first in whose closed box bodies move most as they do in the
/// open boxes of the databases (wanted), each scaled to be as strong. coarse: its forces are not
/// looked at. law: of a typical body. The same on any number of threads.
Result DrawForces(const MotionProblem& problem, std::uint64_t seed, const AirScene& coarse,
                  const BodyLaw& law, const ParallelFor& parallel, PartMonitor& monitor,
                  std::vector<ForceDraw>& draws, AirStatistics& wanted);

/// As many airs as `count`, each on one thread: that of sceneOf(k) goes to use(k, air), in any
/// order.
Result SimulateSideBySide(std::size_t count, const std::function<AirScene(std::size_t)>& sceneOf,
                          const std::function<void(std::size_t, HalfSeries&)>& use,
                          const ParallelFor& parallel, PartMonitor& monitor);

} // namespace waft
