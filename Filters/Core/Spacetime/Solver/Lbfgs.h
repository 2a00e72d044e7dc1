// SPDX-License-Identifier: BSD-3-Clause
// Projected, preconditioned L-BFGS: every accepted iterate is feasible and E never grows.
#pragma once

#include "Base/Monitor.h"
#include "Base/StateArchive.h"
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
  double Tolerance = 1e-2; // stop when E falls by less than this share in 20 iterations; 0: never
  bool GoesOn = false;     // from what Exchange read, instead of from a new start
};

enum class LbfgsEnd
{
  Converged,
  Iterations,
  NoDescent, // the line search found nothing lower
  Stopped    // the monitor or the observer asked to stop
};

/// The solver's vectors and its memory of curvature, kept from stage to stage: leash and fields
/// change E's curvature little.
/// Of several ranks each has the vectors of its share of the frames; whatever is decided hangs on
/// sums that all of them know.
class Lbfgs
{
public:
  Lbfgs(const FramePartition& partition, std::size_t frameSize, const ParallelFor& parallel,
        int history);

  /// Called after each accepted iterate; returns false to stop.
  using Observer = std::function<bool(int iteration, const SpacetimeTerms& terms)>;

  /// Minimises from `state`, which always holds the best feasible iterate. Iteration 0 is the
  /// projected start. Stopped by the monitor, all that Exchange writes is as after the last
  /// iterate.
  LbfgsEnd Minimize(SpacetimeObjective& objective, const TimelinePreconditioner& preconditioner,
                    HardConstraints& constraints, const LbfgsOptions& options,
                    const Observer& observer, Monitor* monitor, StateVector& state);

  /// From an observer, or once stopped: writes what the iterations after this one depend on,
  /// besides the state and the objective's lists. Reading: the next Minimize may go on from there.
  void Exchange(StateArchive& stream);
  /// Of the last call of Minimize, or of the one that Exchange read.
  int NumberOfIterations() const
  {
    return this->Energies.empty() ? 0 : static_cast<int>(this->Energies.size()) - 1;
  }

private:
  bool HasConverged(double tolerance) const;
  void Direction(const TimelinePreconditioner& preconditioner, const HardConstraints& constraints);
  bool LineSearch(SpacetimeObjective& objective, const TimelinePreconditioner& preconditioner,
                  const HardConstraints& constraints, Monitor* monitor, const StateVector& state,
                  SpacetimeTerms& terms, bool& stopped);
  void Remember(const TimelinePreconditioner& preconditioner, const HardConstraints& constraints,
                const StateVector& state);

  void Project(const TimelinePreconditioner& preconditioner, const HardConstraints& constraints,
               StateVector& state) const;

  FramePartition Partition;
  std::size_t FrameSize;
  VectorSpace Space;
  std::size_t Capacity;
  StateVector Gradient, Trial, TrialGradient, Step, Work;
  struct History // a ring, the oldest first
  {
    std::vector<StateVector> S, Y;
    std::vector<double> Rho; // 1 / s.y
  };
  History Pairs;
  double Gamma = 1.0;
  SpacetimeTerms Terms;         // of the present iterate
  std::vector<double> Energies; // of all iterates of this call of Minimize
};

} // namespace waft
