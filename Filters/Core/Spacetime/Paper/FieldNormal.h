// SPDX-License-Identifier: BSD-3-Clause
// The fields' part of E as a quadratic function of strengths and wind, and its exact minimum.
#pragma once

#include "Base/Parallel.h"
#include "Spacetime/Energy/SpacetimeObjective.h"
#include "Spacetime/Paper/FieldPenalty.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <functional>
#include <vector>

namespace waft
{

/// Which of the fields' coefficients are solved for.
struct FieldChoice
{
  bool Vortices = true;
  bool Wind = true;
  /// Vortices that are not solved for act as they are; else the rest is solved for as if they were
  /// not there.
  bool VorticesAct = true;
  /// Bodies that count; empty: all.
  std::function<bool(std::size_t body)> Counts;
};

/// Least squares over all steps of a level in which rv counts, gas and objects, in double:
///   sum w s^2 / 2 |rv / s + f_now(x) - f(x)|^2 + FieldCost(f)
/// with s the step, w the weight of its rv, f linear in the vortices' strengths and in the wind's
/// potential (ClosedCurl). Unknowns are bound to two knots of time at most, so the wind's matrix is
/// block tridiagonal; the strengths stand beside it.
class FieldNormal
{
public:
  FieldNormal(const SpacetimeModel& model, const AirFields& fields, const FieldChoice& choice);

  /// Takes in the steps of the objective, which must just have been evaluated at `state`. False:
  /// the monitor stopped it.
  bool Gather(const SpacetimeObjective& objective, const StateVector& state,
              const ParallelFor& parallel, Monitor* monitor = nullptr);
  /// Sets strengths and wind to those of the minimum, likewise.
  bool Solve(AirFields& fields, Monitor* monitor = nullptr) const;
  /// Of the sum above at fields of these shapes: its gradient by each unknown over the root of that
  /// unknown's second derivative, the length of all of them over the root of 2 `energy`.
  double ScaledGradient(const AirFields& fields, double energy) const;
  /// Ids of vortices whose own field is less than that fraction of all that the fields explain.
  std::vector<int> Idle(const AirFields& fields, double fraction) const;
  /// The sum above, less what does not depend on the fields.
  double Cost(const AirFields& fields) const;

private:
  using Sparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  struct Span; // what the frames between two knots add
  void Gather(const SpacetimeObjective& objective, const StateVector& state, std::size_t begin,
              std::size_t end, Span& span) const;
  void Add(int knot, const Span& span);
  /// Half the gradient: by the wind's coefficients of all knots, and by the strengths.
  void Gradient(const Eigen::VectorXd& wind, const Eigen::VectorXd& strengths,
                Eigen::VectorXd& byWind, Eigen::VectorXd& byStrength) const;
  Eigen::VectorXd CoefficientsOf(const AirFields& fields) const;
  Eigen::VectorXd StrengthsOf(const AirFields& fields) const;
  void SetWind(const Eigen::VectorXd& coefficients, SplineWind& wind) const;

  FieldChoice Choice;
  SplineWind Lattice;
  int Knots = 0;                // 0: the wind is not solved for
  std::vector<Vortex> Vortices; // of strength 1; empty: they are not solved for
  Sparse Curl;
  std::vector<NodeMatrix> Diagonal; // by knot, of one component's coefficients
  std::vector<NodeMatrix> Upper;    // of a knot and the next
  Eigen::MatrixXd Beside;           // coefficients of all knots x strengths
  Eigen::MatrixXd OfVortices;       // strengths x strengths
  Eigen::VectorXd Right, RightOfVortices;
};

/// What a solve for the wind holds at once.
double FieldBytes(const SpacetimeModel& model);

} // namespace waft
