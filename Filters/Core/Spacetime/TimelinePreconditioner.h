// SPDX-License-Identifier: BSD-3-Clause
// The part of E's curvature that couples a body with itself along time: banded, the same for every
// free body, and what makes the solver fast.
#pragma once

#include "Base/Parallel.h"
#include "Spacetime/SpacetimeModel.h"
#include "Spacetime/StateVector.h"

#include <vector>

namespace waft
{

/// M over (x0, v0, x1, v1, ...) of one body and component: the rows rx, rv (without accelerations),
/// rt, a diagonal for rs and a little damping, of objects a share of both; Cholesky in bands. Gas
/// shares one factor, each object has its own, where fixed unknowns and steps that are no free
/// flight are left out.
class TimelinePreconditioner
{
public:
  TimelinePreconditioner(const SpacetimeModel& model, const TimeLevel& level,
                         const ParallelFor& parallel, double damping = 1e-3);

  /// out = M^-1 in; fixed unknowns give zero.
  void Solve(const StateVector& in, StateVector& out) const;

private:
  struct Band
  {
    int HalfWidth = 0;
    std::vector<float> Lower; // [row * HalfWidth + k]: L(row, row - 1 - k), already by the diagonal
    std::vector<float> Inverse; // 1 / D(row)
  };
  Band Factor(long object) const; // -1: gas
  void SolveColumns(const Band& band, std::size_t first, std::size_t count, int c,
                    const StateVector& in, StateVector& out) const;

  const SpacetimeModel& Model;
  const TimeLevel& Level;
  ParallelFor Parallel;
  double Damping;
  Band Gas;
  std::vector<Band> Objects;
};

} // namespace waft
