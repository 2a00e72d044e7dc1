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

bool HasConverged(const std::vector<double>& energies, double tolerance)
{
  const std::size_t now = energies.size() - 1;
  if (now < ToleranceWindow)
  {
    return false;
  }
  const double before = energies[now - ToleranceWindow];
  return before - energies[now] < tolerance * before;
}

} // namespace

Lbfgs::Lbfgs(std::size_t frames, std::size_t frameSize, const ParallelFor& parallel, int history) :
  Space(frames, frameSize, parallel), Capacity(static_cast<std::size_t>(std::max(1, history)))
{
  const std::size_t n = this->Space.Size();
  for (auto* v : { &this->Trial, &this->TrialGradient, &this->Step, &this->Work })
  {
    v->assign(n, 0.0f);
  }
}

// Step = -P H P g by the two-loop recursion with H0 = gamma P M^-1 P.
void Lbfgs::Direction(const TimelinePreconditioner& preconditioner,
                      const HardConstraints& constraints, const LbfgsMemory& memory)
{
  const std::size_t count = memory.Pairs.S.size();
  std::vector<double> alpha(count);
  this->Work = memory.Gradient;
  constraints.ProjectTangent(this->Work);
  double product = count > 0 ? this->Space.Dot(memory.Pairs.S[count - 1], this->Work) : 0.0;
  for (std::size_t k = count; k-- > 0;)
  {
    alpha[k] = memory.Pairs.Rho[k] * product;
    const StateVector& next = k > 0 ? memory.Pairs.S[k - 1] : this->Work;
    product = this->Space.AddDot(-alpha[k], memory.Pairs.Y[k], this->Work, next);
  }
  constraints.ProjectTangent(this->Work);
  preconditioner.Solve(this->Work, this->Step);
  constraints.ProjectTangent(preconditioner, this->Step);
  this->Space.Scale(memory.Gamma, this->Step);
  product = count > 0 ? this->Space.Dot(memory.Pairs.Y[0], this->Step) : 0.0;
  for (std::size_t k = 0; k < count; ++k)
  {
    const StateVector& next = k + 1 < count ? memory.Pairs.Y[k + 1] : this->Step;
    product = this->Space.AddDot(alpha[k] - memory.Pairs.Rho[k] * product, memory.Pairs.S[k],
                                 this->Step, next);
  }
  constraints.ProjectTangent(preconditioner, this->Step);
  this->Space.Scale(-1.0, this->Step);
}

bool Lbfgs::LineSearch(SpacetimeObjective& objective, const TimelinePreconditioner& preconditioner,
                       const HardConstraints& constraints, Monitor* monitor,
                       const StateVector& state, LbfgsMemory& memory, bool& stopped)
{
  SpacetimeTerms& terms = memory.Terms;
  const double slope = this->Space.Dot(memory.Gradient, this->Step);
  if (!(slope < 0.0))
  {
    return false;
  }
  double alpha = 1.0;
  for (int trial = 0; trial < LineSearchTrials; ++trial)
  {
    this->Space.Combine(state, alpha, this->Step, this->Trial);
    constraints.Project(preconditioner, this->Trial);
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
                     const HardConstraints& constraints, const StateVector& state,
                     LbfgsMemory& memory)
{
  StateVector s, y;
  if (memory.Pairs.S.size() == this->Capacity)
  {
    s = std::move(memory.Pairs.S.front());
    y = std::move(memory.Pairs.Y.front());
    memory.Pairs.S.erase(memory.Pairs.S.begin());
    memory.Pairs.Y.erase(memory.Pairs.Y.begin());
    memory.Pairs.Rho.erase(memory.Pairs.Rho.begin());
  }
  s.resize(state.size());
  y.resize(state.size());
  this->Space.Combine(this->Trial, -1.0, state, s);
  this->Space.Combine(this->TrialGradient, -1.0, memory.Gradient, y);
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
  memory.Gamma = yMy > 0.0 ? sy / yMy : 1.0;
  memory.Pairs.S.push_back(std::move(s));
  memory.Pairs.Y.push_back(std::move(y));
  memory.Pairs.Rho.push_back(1.0 / sy);
}

LbfgsEnd Lbfgs::Minimise(SpacetimeObjective& objective,
                         const TimelinePreconditioner& preconditioner, HardConstraints& constraints,
                         const LbfgsOptions& options, const Observer& observer, Monitor* monitor,
                         LbfgsMemory& memory, StateVector& state)
{
  SpacetimeTerms& terms = memory.Terms;
  memory.Gradient.resize(this->Space.Size(), 0.0f);
  constraints.Project(preconditioner, state);
  if (!objective.Evaluate(state, &memory.Gradient, terms, monitor))
  {
    return LbfgsEnd::Stopped;
  }
  memory.Energies = { terms.E };
  if (!observer(0, terms))
  {
    return LbfgsEnd::Stopped;
  }
  while (!HasConverged(memory.Energies, options.Tolerance))
  {
    const int iteration = static_cast<int>(memory.Energies.size());
    if (iteration > options.MaximumNumberOfIterations)
    {
      return LbfgsEnd::Iterations;
    }
    constraints.FindActive(state, memory.Gradient);
    bool stopped = false;
    this->Direction(preconditioner, constraints, memory);
    bool lower =
      this->LineSearch(objective, preconditioner, constraints, monitor, state, memory, stopped);
    if (!lower && !stopped && !memory.Pairs.S.empty())
    {
      memory.Pairs = CurvaturePairs();
      this->Direction(preconditioner, constraints, memory);
      lower =
        this->LineSearch(objective, preconditioner, constraints, monitor, state, memory, stopped);
    }
    if (stopped)
    {
      return LbfgsEnd::Stopped;
    }
    if (!lower)
    {
      return LbfgsEnd::NoDescent;
    }
    this->Remember(preconditioner, constraints, state, memory);
    std::swap(state, this->Trial);
    std::swap(memory.Gradient, this->TrialGradient);
    memory.Energies.push_back(terms.E);
    if (!observer(iteration, terms))
    {
      return LbfgsEnd::Stopped;
    }
  }
  return LbfgsEnd::Converged;
}

} // namespace waft
