// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Solver/Lbfgs.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace waft
{
namespace
{

constexpr double Armijo = 1e-4;
constexpr int LineSearchTrials = 10;
constexpr std::size_t ToleranceWindow = 20; // iterations

} // namespace

Lbfgs::Lbfgs(const FramePartition& partition, std::size_t frameSize, const ParallelFor& parallel,
             int history) :
  Partition(partition),
  FrameSize(frameSize), Space(partition, frameSize, parallel),
  Capacity(static_cast<std::size_t>(std::max(1, history)))
{
  const std::size_t n = this->Space.Size();
  for (auto* v : { &this->Gradient, &this->Trial, &this->TrialGradient, &this->Step, &this->Work })
  {
    v->assign(n, 0.0f);
  }
}

// The frames beside the own ones are then as E needs them.
void Lbfgs::Project(const TimelinePreconditioner& preconditioner,
                    const HardConstraints& constraints, StateVector& state) const
{
  constraints.Project(preconditioner, state);
  this->Partition.FillHalo(state, this->FrameSize);
}

// Step = -P H P g by the two-loop recursion with H0 = gamma P M^-1 P.
void Lbfgs::Direction(const TimelinePreconditioner& preconditioner,
                      const HardConstraints& constraints)
{
  const std::size_t count = this->Pairs.S.size();
  std::vector<double> alpha(count);
  this->Work = this->Gradient;
  constraints.ProjectTangent(this->Work);
  double product = count > 0 ? this->Space.Dot(this->Pairs.S[count - 1], this->Work) : 0.0;
  for (std::size_t k = count; k-- > 0;)
  {
    alpha[k] = this->Pairs.Rho[k] * product;
    const StateVector& next = k > 0 ? this->Pairs.S[k - 1] : this->Work;
    product = this->Space.AddDot(-alpha[k], this->Pairs.Y[k], this->Work, next);
  }
  constraints.ProjectTangent(this->Work);
  preconditioner.Solve(this->Work, this->Step);
  constraints.ProjectTangent(preconditioner, this->Step);
  this->Space.Scale(this->Gamma, this->Step);
  product = count > 0 ? this->Space.Dot(this->Pairs.Y[0], this->Step) : 0.0;
  for (std::size_t k = 0; k < count; ++k)
  {
    const StateVector& next = k + 1 < count ? this->Pairs.Y[k + 1] : this->Step;
    product = this->Space.AddDot(alpha[k] - this->Pairs.Rho[k] * product, this->Pairs.S[k],
                                 this->Step, next);
  }
  constraints.ProjectTangent(preconditioner, this->Step);
  this->Space.Scale(-1.0, this->Step);
}

bool Lbfgs::LineSearch(SpacetimeObjective& objective, const TimelinePreconditioner& preconditioner,
                       const HardConstraints& constraints, Monitor* monitor,
                       const StateVector& state, SpacetimeTerms& terms, bool& stopped)
{
  const double slope = this->Space.Dot(this->Gradient, this->Step);
  if (!(slope < 0.0))
  {
    return false;
  }
  double alpha = 1.0;
  for (int trial = 0; trial < LineSearchTrials; ++trial)
  {
    this->Space.Combine(state, alpha, this->Step, this->Trial);
    this->Project(preconditioner, constraints, this->Trial);
    SpacetimeTerms next;
    if (!objective.Evaluate(this->Trial, &this->TrialGradient, next, monitor))
    {
      stopped = true;
      return false;
    }
    if (std::isfinite(next.E) && next.E <= terms.E + Armijo * alpha * slope)
    {
      terms = next;
      return true;
    }
    const double curve = next.E - terms.E - alpha * slope;
    const double best =
      std::isfinite(next.E) && curve > 0.0 ? -slope * alpha * alpha / (2.0 * curve) : 0.1 * alpha;
    alpha = std::clamp(best, 0.1 * alpha, 0.5 * alpha);
  }
  return false;
}

void Lbfgs::Remember(const TimelinePreconditioner& preconditioner,
                     const HardConstraints& constraints, const StateVector& state)
{
  StateVector s, y;
  if (this->Pairs.S.size() == this->Capacity)
  {
    s = std::move(this->Pairs.S.front());
    y = std::move(this->Pairs.Y.front());
    this->Pairs.S.erase(this->Pairs.S.begin());
    this->Pairs.Y.erase(this->Pairs.Y.begin());
    this->Pairs.Rho.erase(this->Pairs.Rho.begin());
  }
  s.resize(state.size());
  y.resize(state.size());
  this->Space.Combine(this->Trial, -1.0, state, s);
  this->Space.Combine(this->TrialGradient, -1.0, this->Gradient, y);
  const double sy = this->Space.Dot(s, y);
  const double bound = 1e-9 * std::sqrt(this->Space.Dot(s, s)) * std::sqrt(this->Space.Dot(y, y));
  if (!(sy > bound))
  {
    return;
  }
  this->Work = y;
  constraints.ProjectTangent(this->Work);
  preconditioner.Solve(this->Work, this->Step);
  constraints.ProjectTangent(preconditioner, this->Step);
  const double yMy = this->Space.Dot(this->Work, this->Step);
  this->Gamma = yMy > 0.0 ? sy / yMy : 1.0;
  this->Pairs.S.push_back(std::move(s));
  this->Pairs.Y.push_back(std::move(y));
  this->Pairs.Rho.push_back(1.0 / sy);
}

bool Lbfgs::HasConverged(double tolerance) const
{
  const std::size_t now = this->Energies.size() - 1;
  if (now < ToleranceWindow)
  {
    return false;
  }
  const double before = this->Energies[now - ToleranceWindow];
  return before - this->Energies[now] < tolerance * before;
}

void Lbfgs::Exchange(StateArchive& stream)
{
  const auto vector = [this](StateArchive& s, StateVector& v)
  { this->Partition.Exchange(s, v, this->FrameSize); };
  stream.List(this->Pairs.S, vector);
  stream.List(this->Pairs.Y, vector);
  stream.List(this->Pairs.Rho);
  vector(stream, this->Gradient);
  stream.List(this->Energies);
  stream.Value(this->Gamma);
  waft::Exchange(stream, this->Terms);
}

LbfgsEnd Lbfgs::Minimize(SpacetimeObjective& objective,
                         const TimelinePreconditioner& preconditioner, HardConstraints& constraints,
                         const LbfgsOptions& options, const Observer& observer, Monitor* monitor,
                         StateVector& state)
{
  SpacetimeTerms& terms = this->Terms;
  if (!options.GoesOn)
  {
    this->Project(preconditioner, constraints, state);
    this->Energies.clear();
  }
  if (this->Energies.empty())
  {
    if (!objective.Evaluate(state, &this->Gradient, terms, monitor))
    {
      return LbfgsEnd::Stopped;
    }
    this->Energies.push_back(terms.E);
    if (!observer(0, terms))
    {
      return LbfgsEnd::Stopped;
    }
  }
  while (!this->HasConverged(options.Tolerance))
  {
    const int iteration = static_cast<int>(this->Energies.size());
    if (iteration > options.MaximumNumberOfIterations)
    {
      return LbfgsEnd::Iterations;
    }
    constraints.FindActive(state, this->Gradient);
    bool stopped = false;
    this->Direction(preconditioner, constraints);
    bool lower =
      this->LineSearch(objective, preconditioner, constraints, monitor, state, terms, stopped);
    if (!lower && !stopped && !this->Pairs.S.empty())
    {
      History before = std::exchange(this->Pairs, History());
      this->Direction(preconditioner, constraints);
      lower =
        this->LineSearch(objective, preconditioner, constraints, monitor, state, terms, stopped);
      if (stopped)
      {
        this->Pairs = std::move(before);
      }
    }
    if (stopped)
    {
      return LbfgsEnd::Stopped;
    }
    if (!lower)
    {
      return LbfgsEnd::NoDescent;
    }
    this->Remember(preconditioner, constraints, state);
    std::swap(state, this->Trial);
    std::swap(this->Gradient, this->TrialGradient);
    this->Energies.push_back(terms.E);
    if (!observer(iteration, terms))
    {
      return LbfgsEnd::Stopped;
    }
  }
  return LbfgsEnd::Converged;
}

} // namespace waft
