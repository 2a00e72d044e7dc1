// SPDX-License-Identifier: BSD-3-Clause
// The normal equations of a body's drift about a path.
#pragma once

#include "Air/Drift/BandedMatrix.h"
#include "Air/Drift/DriftResiduals.h"

#include <algorithm>
#include <vector>

namespace waft
{

/// Unknowns are the places at the frames, three a frame; those of fixed frames do not change.
class DriftEquations
{
public:
  DriftEquations(const DriftProblem& problem, const AirSampler& air, const DriftWeights& weights);

  /// Looks at a path: the air along it, what it is too near to. What follows is about that path.
  void LookAt(const std::vector<Vec3>& x);
  double Cost() const;
  /// Gauss-Newton matrix and gradient; returns the cost.
  double Linearise();
  /// To these, of weight / 2 depth^2: the depth falls as the body moves along the normal.
  void AddPush(int frame, const Vec3& normal, double depth, double weight);

  /// Of the matrix with a damping on its diagonal; false where it is not positive definite.
  bool Factor(double damping);
  /// The gradient, turned round.
  std::vector<double> Descent() const;
  /// By the factors, in place.
  void Solve(std::vector<double>& b) const { this->Factors.Solve(b); }
  const BandedMatrix& Lower() const { return this->Matrix; }
  static std::size_t HalfBandOf(const DriftProblem& problem)
  {
    return 3 * static_cast<std::size_t>(DriftResiduals::ReachOf(problem)) + 2;
  }

  bool IsFixed(int frame) const
  {
    return this->Problem.IsFixed[static_cast<std::size_t>(frame)] != 0;
  }

private:
  bool IsInert() const { return this->Problem.ResponseTime > 0.0; }
  double AddFlight();
  void Add(const DriftResidual& residual, double weight);
  void AddGradient(std::size_t frame, const Vec3& gradient);
  void AddBlock(std::size_t row, std::size_t column, const Mat3& block);

  const DriftProblem& Problem;
  const DriftWeights& Weights;
  DriftResiduals Residuals;
  int Frames;
  double Step;
  BandedMatrix Matrix, Factors;
  std::vector<double> Gradients;
  std::vector<Vec3> Path;
  std::vector<DriftDepthAt> Depths;
  std::vector<Vec3> Controls; // by step, as the air's gradients; of an inert body both are empty
  std::vector<Mat3> AirGradients;
};

/// The damping of Levenberg's method, and when it ends. It begins near what a path of one slow
/// bend is held by, which more would keep from moving for the first steps, and follows how much of
/// what a step promised came true (Nielsen 1999): where contacts come and go, a fixed factor has
/// every second step fail.
class DriftDamping
{
public:
  explicit DriftDamping(const Timeline& time) : Value(1e-3 / time.Step()) {}

  double Value;

  /// After a step that did not lower the cost; false: none will.
  bool Raise()
  {
    this->Value *= this->Growth;
    this->Growth *= 2.0;
    return this->Value <= 1e9;
  }
  /// After one that did, by `gained` of the `promised`.
  void Lower(double gained, double promised)
  {
    const double missed = 1.0 - 2.0 * gained / promised;
    this->Value = std::max(1e-7, this->Value * std::max(0.2, 1.0 + missed * missed * missed));
    this->Growth = 2.0;
  }
  static bool IsConverged(double before, double cost) { return before - cost < 1e-4 * before; }

private:
  double Growth = 2.0;
};

/// By how much a step should lower the cost: one that solves equations with a damping, or is the
/// best in a subspace.
inline double PromiseOf(const std::vector<double>& step, const std::vector<double>& descent,
                        double damping)
{
  double promise = 0.0;
  for (std::size_t i = 0; i < step.size(); ++i)
  {
    promise += 0.5 * step[i] * (descent[i] + damping * step[i]);
  }
  return promise;
}

/// A path moved by a step in the unknowns.
inline void MoveBy(const std::vector<double>& step, std::vector<Vec3>& path)
{
  for (std::size_t f = 0; f < path.size(); ++f)
  {
    path[f] += Vec3(step[3 * f], step[3 * f + 1], step[3 * f + 2]);
  }
}

} // namespace waft
