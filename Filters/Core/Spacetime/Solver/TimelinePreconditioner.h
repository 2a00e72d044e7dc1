// SPDX-License-Identifier: BSD-3-Clause
// The part of E's curvature that couples a body with itself along time: banded, the same for every
// free body, and what makes the solver fast.
#pragma once

#include "Base/Parallel.h"
#include "Spacetime/Model/StateVector.h"
#include "Spacetime/Model/TimeLevel.h"

#include <vector>

namespace waft
{

/// M over (x0, v0, x1, v1, ...) of one body and component: the rows rx, rv (without accelerations),
/// rt, a diagonal for rs and a little damping, of objects a fraction of both; Cholesky in bands.
/// Gas shares one factor, each object has its own, where fixed unknowns and steps that are no free
/// flight are left out.
class TimelinePreconditioner
{
public:
  static constexpr double UsualDamping = 1e-3;
  TimelinePreconditioner(const SpacetimeModel& model, const TimeLevel& level,
                         const ParallelFor& parallel, double damping = UsualDamping);

  /// out = M^-1 in; fixed unknowns give zero.
  void Solve(const StateVector& in, StateVector& out) const;
  /// M^-1 e for an object, e one at its place at level frame j: what its place and its velocity do,
  /// two values a level frame, the same in each component.
  std::vector<float> ColumnOf(std::size_t object, std::size_t j) const;

private:
  struct Band
  {
    int HalfWidth = 0;
    std::vector<float> Lower; // [row * HalfWidth + k]: L(row, row - 1 - k), already by the diagonal
    std::vector<float> Inverse; // 1 / D(row)
  };
  Band Factor(long object) const; // -1: gas
  /// Bodies side by side, in one component: what is solved at once.
  struct Columns
  {
    const Band* Factor = nullptr;
    std::size_t First = 0, Count = 0; // bodies
    int Component = 0;
  };
  std::size_t NumberOfColumns() const;
  Columns ColumnsAt(std::size_t k) const;
  /// in(i), out(i): where the columns' values of unknown i stand.
  template <class In, class Out>
  void SolveColumns(const Columns& columns, const In& in, const Out& out) const;

  const SpacetimeModel& Model;
  const TimeLevel& Level;
  ParallelFor Parallel;
  double Damping;
  Band Gas;
  std::vector<Band> Objects;
};

} // namespace waft
