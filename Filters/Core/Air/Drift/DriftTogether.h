// SPDX-License-Identifier: BSD-3-Clause
// The paths of bodies that touch, found as one problem in a given air.
#pragma once

#include "Air/Drift/Drift.h"
#include "Air/Drift/DriftContacts.h"
#include "Base/Communicator.h"
#include "Base/Monitor.h"
#include "Base/Parallel.h"

#include <memory>
#include <vector>

namespace waft
{

/// One of the bodies: its problem, if it may move.
struct TogetherBody
{
  std::unique_ptr<DriftProblem> Problem;
  DriftWeights Weights;
};

/// Moves the paths of all that have a problem to a local minimum of the sum of their costs, those
/// of SolveDrift, and of weight / 2 sum of depth^2 over the contacts, depth being how much nearer
/// two are than they keep: Levenberg's method on all unknowns of all bodies at once, its steps by
/// conjugate gradients preconditioned by each body's own equations. Where all ranks call it with
/// the same each has the equations of a part of the bodies, and the first one's monitor is asked.
/// The same bits on any number of threads and ranks. False: stopped, the paths being the best so
/// far.
bool SolveTogether(const std::vector<TogetherBody>& bodies,
                   const std::vector<DriftContact>& contacts, const AirSampler& air, double weight,
                   int maximumIterations, const ParallelFor& parallel, Communicator& ranks,
                   Monitor& monitor, std::vector<std::vector<Vec3>>& paths);

/// What that leaves, by body and frame: how much nearer a body is to another than they keep [m].
std::vector<std::vector<double>> ContactResidue(const std::vector<DriftContact>& contacts,
                                                const std::vector<std::vector<Vec3>>& paths);

} // namespace waft
