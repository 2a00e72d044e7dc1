// SPDX-License-Identifier: BSD-3-Clause
// Projected, preconditioned L-BFGS: every accepted iterate is feasible and E never grows.
#pragma once

#include "Base/Monitor.h"
#include "Spacetime/Energy/SpacetimeObjective.h"
#include "Spacetime/Solver/HardConstraints.h"
#include "Spacetime/Solver/TimelinePreconditioner.h"

#include <functional>
#include <vector>

namespace waft
{

struct LbfgsOptions
{
  int MaximumNumberOfIterations = 100;
  /// Stop when E falls by less than this fraction in 20 iterations; 0: never.
  double Tolerance = 1e-2;
};

enum class LbfgsEnd
{
  Converged,
  Iterations,
  NoDescent, // the line search found nothing lower
  Stopped    // the monitor or the observer asked to stop
};

struct CurvaturePairs // the oldest first
{
  std::vector<StateVector> S, Y;
  std::vector<double> Rho; // 1 / s.y
};

/// What the iterations after the present one depend on, besides the state and the objective's
/// lists. The pairs are kept from stage to stage of a level, since leash and fields change E's
/// curvature little: forgotten, they leave E some percent higher.
struct LbfgsMemory
{
  CurvaturePairs Pairs;
  StateVector Gradient;
  double Gamma = 1.0;
  SpacetimeTerms Terms;         // of the present iterate
  std::vector<double> Energies; // of all iterates of the last call of Minimise
};

/// The solver with its work space, of vectors of so many frames.
class Lbfgs
{
public:
  Lbfgs(std::size_t frames, std::size_t frameSize, const ParallelFor& parallel, int history);

  /// Called after each accepted iterate; returns false to stop.
  using Observer = std::function<bool(int iteration, const SpacetimeTerms& terms)>;

  /// Minimises from `state`, which always holds the best feasible iterate. Iteration 0 is the
  /// projected start. Stopped by the monitor, the memory is as after the last iterate.
  LbfgsEnd Minimise(SpacetimeObjective& objective, const TimelinePreconditioner& preconditioner,
                    HardConstraints& constraints, const LbfgsOptions& options,
                    const Observer& observer, Monitor* monitor, LbfgsMemory& memory,
                    StateVector& state);

private:
  void Direction(const TimelinePreconditioner& preconditioner, const HardConstraints& constraints,
                 const LbfgsMemory& memory);
  bool LineSearch(SpacetimeObjective& objective, const TimelinePreconditioner& preconditioner,
                  const HardConstraints& constraints, Monitor* monitor, const StateVector& state,
                  LbfgsMemory& memory, bool& stopped);
  void Remember(const TimelinePreconditioner& preconditioner, const HardConstraints& constraints,
                const StateVector& state, LbfgsMemory& memory);

  VectorSpace Space;
  std::size_t Capacity;
  StateVector Trial, TrialGradient, Step, Work;
};

} // namespace waft
