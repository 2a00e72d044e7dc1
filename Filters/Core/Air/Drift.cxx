// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Drift.h"

#include "Air/BandedMatrix.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace waft
{
namespace
{

constexpr int Reach = 4;           // frames that a residual may span, less one
constexpr double Converged = 1e-6; // relative fall of the cost in an iteration
constexpr double LeastDamping = 1e-7;
constexpr double MostDamping = 1e9;

// A residual that is linear about the path: value + sum of Blocks (x - path) over its frames.
struct Linear
{
  int First = 0; // frame of the first block
  int Count = 0;
  Vec3 Value = Vec3::Zero();
  std::array<Mat3, Reach + 1> Blocks;
};

class DriftSolver
{
public:
  DriftSolver(const DriftProblem& problem, const AirSampler& air, const DriftWeights& weights) :
    Problem(problem), Air(air), Weights(weights), Frames(static_cast<int>(problem.IsFixed.size())),
    Step(problem.Time.Step()), Normal(3 * problem.IsFixed.size(), 3 * ReachOf(problem) + 2)
  {
  }

  /// Frames that a residual of the problem spans, less one.
  static int ReachOf(const DriftProblem& problem)
  {
    int reach = problem.ResponseTime > 0.0 ? Reach : 2;
    for (const DriftRow& row : problem.Rows)
    {
      reach = std::max(reach, row.Terms.back().first - row.Terms.front().first);
    }
    return reach;
  }

  /// The control of a step; with its derivatives where `linear`.
  Vec3 Control(const std::vector<Vec3>& x, int k, Linear* linear) const
  {
    const Vec3& a = x[static_cast<std::size_t>(k)];
    const Vec3& b = x[static_cast<std::size_t>(k) + 1];
    Mat3 gradient;
    const Vec3 u = this->Air.Between(k, 0.5 * (a + b), gradient);
    Vec3 c = (b - a) / this->Step - u + this->Problem.SettlingSpeed * Vec3::UnitZ();
    const bool inert = this->Problem.ResponseTime > 0.0 && k > 0 && k + 2 < this->Frames;
    const double inertia = this->Problem.ResponseTime / (2.0 * this->Step * this->Step);
    if (inert)
    {
      c +=
        inertia * (x[static_cast<std::size_t>(k) + 2] - b - a + x[static_cast<std::size_t>(k) - 1]);
    }
    if (linear)
    {
      linear->First = inert ? k - 1 : k;
      linear->Count = inert ? 4 : 2;
      linear->Value = c;
      const Mat3 one = Mat3::Identity();
      const int at = inert ? 1 : 0;
      linear->Blocks[at] = -one / this->Step - 0.5 * gradient;
      linear->Blocks[at + 1] = one / this->Step - 0.5 * gradient;
      if (inert)
      {
        linear->Blocks[0] = inertia * one;
        linear->Blocks[1] -= inertia * one;
        linear->Blocks[2] -= inertia * one;
        linear->Blocks[3] = inertia * one;
      }
    }
    return c;
  }

  double Cost(const std::vector<Vec3>& x)
  {
    double cost = 0.0;
    this->Visit(x, false,
                [&](const Linear& residual, double weight)
                { cost += 0.5 * weight * residual.Value.squaredNorm(); });
    return cost;
  }

  /// Gauss-Newton matrix and gradient.
  double Linearise(const std::vector<Vec3>& x)
  {
    this->Normal.Clear();
    this->Gradient.assign(this->Normal.Size(), 0.0);
    double cost = 0.0;
    this->Visit(x, true,
                [&](const Linear& residual, double weight)
                {
                  cost += 0.5 * weight * residual.Value.squaredNorm();
                  this->Add(residual, weight);
                });
    return cost;
  }

  bool TakeStep(const std::vector<Vec3>& x, double damping, std::vector<Vec3>& moved)
  {
    BandedMatrix matrix = this->Normal;
    std::vector<double> step(this->Gradient.size());
    for (int f = 0; f < this->Frames; ++f)
    {
      for (int c = 0; c < 3; ++c)
      {
        const std::size_t i = 3 * static_cast<std::size_t>(f) + static_cast<std::size_t>(c);
        if (this->Problem.IsFixed[static_cast<std::size_t>(f)])
        {
          matrix.At(i, i) = 1.0;
        }
        else
        {
          matrix.At(i, i) += damping;
        }
        step[i] = -this->Gradient[i];
      }
    }
    if (!matrix.Factor())
    {
      return false;
    }
    matrix.Solve(step);
    moved = x;
    for (std::size_t f = 0; f < moved.size(); ++f)
    {
      if (!this->Problem.IsFixed[f])
      {
        moved[f] += Vec3(step[3 * f], step[3 * f + 1], step[3 * f + 2]);
      }
    }
    return true;
  }

private:
  // All residuals with their weights: controls, their changes, accelerations where the control is
  // free, rows and barriers.
  template <class Add>
  void Visit(const std::vector<Vec3>& x, bool derivatives, const Add& add)
  {
    const std::vector<double>& flight = this->Problem.Flight;
    Linear now, before, change;
    for (int k = 0; k + 1 < this->Frames; ++k)
    {
      const double share = flight[static_cast<std::size_t>(k)];
      if (share <= 0.0)
      {
        continue;
      }
      now.Value = this->Control(x, k, derivatives ? &now : nullptr);
      add(now, share * this->Step);
      if (k > 0 && flight[static_cast<std::size_t>(k) - 1] > 0.0)
      {
        const double both = std::min(share, flight[static_cast<std::size_t>(k) - 1]);
        change.Value = (now.Value - before.Value) / this->Step;
        if (derivatives)
        {
          change.First = before.First;
          change.Count = now.First + now.Count - before.First;
          std::fill_n(change.Blocks.begin(), change.Count, Mat3::Zero());
          for (int i = 0; i < before.Count; ++i)
          {
            change.Blocks[i] -= before.Blocks[i] / this->Step;
          }
          for (int i = 0; i < now.Count; ++i)
          {
            change.Blocks[now.First - before.First + i] += now.Blocks[i] / this->Step;
          }
        }
        add(change, both * this->Weights.Smoothness * this->Step);
      }
      std::swap(now, before);
    }
    this->VisitBraking(x, derivatives, add);
    this->VisitRows(x, derivatives, add);
    this->VisitBarriers(x, derivatives, add);
  }

  template <class Add>
  void VisitBraking(const std::vector<Vec3>& x, bool derivatives, const Add& add)
  {
    const double scale = 1.0 / (this->Step * this->Step);
    Linear bend;
    for (int f = 1; f + 1 < this->Frames; ++f)
    {
      const auto at = static_cast<std::size_t>(f);
      const double free = 1.0 - std::min(this->Problem.Flight[at - 1], this->Problem.Flight[at]);
      if (free <= 0.0 || (this->IsFixed(f - 1) && this->IsFixed(f) && this->IsFixed(f + 1)))
      {
        continue;
      }
      bend.Value = scale * (x[at - 1] - 2.0 * x[at] + x[at + 1]);
      if (derivatives)
      {
        bend.First = f - 1;
        bend.Count = 3;
        bend.Blocks[0] = bend.Blocks[2] = scale * Mat3::Identity();
        bend.Blocks[1] = -2.0 * scale * Mat3::Identity();
      }
      add(bend, free * this->Weights.Braking * this->Step);
    }
  }

  template <class Add>
  void VisitRows(const std::vector<Vec3>& x, bool derivatives, const Add& add)
  {
    Linear linear;
    for (const DriftRow& row : this->Problem.Rows)
    {
      Vec3 missed = -row.Value;
      for (const auto& [frame, weight] : row.Terms)
      {
        missed += weight * x[static_cast<std::size_t>(frame)];
      }
      const double size = missed.norm();
      if (size <= row.Radius)
      {
        continue;
      }
      const Vec3 normal = missed / size;
      const Mat3 along = row.Radius > 0.0 ? Mat3(normal * normal.transpose()) : Mat3::Identity();
      linear.Value = (1.0 - row.Radius / size) * missed;
      if (derivatives)
      {
        linear.First = row.Terms.front().first;
        linear.Count = row.Terms.back().first - linear.First + 1;
        std::fill_n(linear.Blocks.begin(), linear.Count, Mat3::Zero());
        for (const auto& [frame, weight] : row.Terms)
        {
          linear.Blocks[frame - linear.First] = weight * along;
        }
      }
      add(linear, this->Weights.Row);
    }
  }

  template <class Add>
  void VisitBarriers(const std::vector<Vec3>& x, bool derivatives, const Add& add)
  {
    if (!this->Problem.TooNear)
    {
      return;
    }
    Linear linear;
    for (int f = 0; f < this->Frames; ++f)
    {
      if (this->IsFixed(f))
      {
        continue;
      }
      this->Depths.clear();
      this->Problem.TooNear(f, x[static_cast<std::size_t>(f)], this->Depths);
      for (const DriftDepth& depth : this->Depths)
      {
        linear.Value = depth.Depth * depth.Normal;
        if (derivatives)
        {
          linear.First = f;
          linear.Count = 1;
          linear.Blocks[0] = -depth.Normal * depth.Normal.transpose();
        }
        add(linear, this->Weights.Barrier);
      }
    }
  }

  void Add(const Linear& residual, double weight)
  {
    for (int i = 0; i < residual.Count; ++i)
    {
      const int fi = residual.First + i;
      if (this->IsFixed(fi))
      {
        continue;
      }
      const Mat3 left = weight * residual.Blocks[i].transpose();
      const Vec3 gradient = left * residual.Value;
      const std::size_t row = 3 * static_cast<std::size_t>(fi);
      for (int c = 0; c < 3; ++c)
      {
        this->Gradient[row + static_cast<std::size_t>(c)] += gradient[c];
      }
      for (int j = 0; j <= i; ++j)
      {
        const int fj = residual.First + j;
        if (this->IsFixed(fj))
        {
          continue;
        }
        const Mat3 block = left * residual.Blocks[j];
        const std::size_t column = 3 * static_cast<std::size_t>(fj);
        for (int r = 0; r < 3; ++r)
        {
          for (int c = 0; c < (i == j ? r + 1 : 3); ++c)
          {
            this->Normal.At(row + static_cast<std::size_t>(r),
                            column + static_cast<std::size_t>(c)) += block(r, c);
          }
        }
      }
    }
  }

  bool IsFixed(int frame) const
  {
    return this->Problem.IsFixed[static_cast<std::size_t>(frame)] != 0;
  }

  const DriftProblem& Problem;
  const AirSampler& Air;
  const DriftWeights& Weights;
  int Frames;
  double Step;
  BandedMatrix Normal;
  std::vector<double> Gradient;
  std::vector<DriftDepth> Depths;
};

} // namespace

std::vector<Vec3> DriftControls(const DriftProblem& problem, const AirSampler& air,
                                const std::vector<Vec3>& path)
{
  const DriftWeights weights;
  const DriftSolver solver(problem, air, weights);
  std::vector<Vec3> controls;
  for (int k = 0; k + 1 < static_cast<int>(path.size()); ++k)
  {
    controls.push_back(solver.Control(path, k, nullptr));
  }
  return controls;
}

DriftOutcome SolveDrift(const DriftProblem& problem, const AirSampler& air,
                        const DriftWeights& weights, int maximumIterations, std::vector<Vec3>& path)
{
  for (std::size_t f = 0; f < path.size(); ++f)
  {
    path[f] = problem.IsFixed[f] ? problem.Fixed[f] : path[f];
  }
  DriftSolver solver(problem, air, weights);
  DriftOutcome outcome;
  std::vector<Vec3> trial;
  double damping = 1.0 / problem.Time.Step();
  outcome.Cost = solver.Linearise(path);
  bool done = false;
  while (!done && outcome.Iterations < maximumIterations)
  {
    ++outcome.Iterations;
    const double cost = solver.TakeStep(path, damping, trial) ? solver.Cost(trial) : 1e300;
    if (!(cost < outcome.Cost))
    {
      damping *= 8.0;
      done = damping > MostDamping;
      continue;
    }
    done = outcome.Cost - cost < Converged * outcome.Cost;
    damping = std::max(LeastDamping, damping / 5.0);
    path = trial;
    outcome.Cost = done ? cost : solver.Linearise(path);
  }
  double sum = 0.0;
  int count = 0;
  const std::vector<Vec3> controls = DriftControls(problem, air, path);
  for (std::size_t k = 0; k < controls.size(); ++k)
  {
    if (problem.Flight[k] >= 1.0)
    {
      sum += controls[k].squaredNorm();
      ++count;
    }
  }
  outcome.Control = count > 0 ? std::sqrt(sum / count) : 0.0;
  return outcome;
}

} // namespace waft
