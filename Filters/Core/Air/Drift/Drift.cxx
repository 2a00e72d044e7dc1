// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Drift/Drift.h"

#include "Air/Drift/BandedMatrix.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace waft
{
namespace
{

constexpr int Reach = 4;           // frames that a residual may span, less one
constexpr double Converged = 1e-4; // relative fall of the cost in an iteration
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
    Vec3 c = (b - a) / this->Step - this->Drifting(k, 0.5 * (a + b), linear ? &gradient : nullptr);
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
    const auto add = [&](const Linear& residual, double weight)
    { cost += 0.5 * weight * residual.Value.squaredNorm(); };
    this->VisitFlight(x, false, add);
    this->VisitOthers(x, false, add);
    return cost;
  }

  /// Gauss-Newton matrix and gradient.
  double Linearise(const std::vector<Vec3>& x)
  {
    this->Normal.Clear();
    this->Gradient.assign(this->Normal.Size(), 0.0);
    double cost = 0.0;
    const auto add = [&](const Linear& residual, double weight)
    {
      cost += 0.5 * weight * residual.Value.squaredNorm();
      this->Add(residual, weight);
    };
    if (this->Problem.ResponseTime > 0.0)
    {
      this->VisitFlight(x, true, add);
    }
    else
    {
      cost += this->AddFlight(x);
    }
    this->VisitOthers(x, true, add);
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
  // The velocity that the air, settling and the ground effect give at x in a step.
  Vec3 Drifting(int k, const Vec3& x, Mat3* gradient) const
  {
    Vec3 slope;
    const double factor = this->Problem.Ground.Factor(x, k + 0.5, gradient ? &slope : nullptr);
    Vec3 u = this->Air.Between(k, x, gradient);
    u.z() -= factor * this->Problem.SettlingSpeed;
    if (gradient)
    {
      gradient->row(2) -= this->Problem.SettlingSpeed * slope.transpose();
    }
    return u;
  }

  // Controls and their changes, with their weights.
  template <class Add>
  void VisitFlight(const std::vector<Vec3>& x, bool derivatives, const Add& add)
  {
    const std::vector<double>& flight = this->Problem.Flight;
    Linear now, before, change;
    for (int k = 0; k + 1 < this->Frames; ++k)
    {
      const double fraction = flight[static_cast<std::size_t>(k)];
      if (fraction <= 0.0)
      {
        continue;
      }
      now.Value = this->Control(x, k, derivatives ? &now : nullptr);
      add(now, fraction * this->Step);
      if (k > 0 && flight[static_cast<std::size_t>(k) - 1] > 0.0)
      {
        const double both = std::min(fraction, flight[static_cast<std::size_t>(k) - 1]);
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
  }

  // The same without inertia. With c_k = J_k x and G_k the air's gradient, J_k is -1/dt - G_k / 2
  // at frame k and 1/dt - G_k / 2 at the next: all blocks of J' W J, whose weights W couple
  // neighbours in time, come from G_k' G_k and G_k' G_(k-1). Returns the cost.
  double AddFlight(const std::vector<Vec3>& x)
  {
    const auto steps = static_cast<std::size_t>(this->Frames - 1);
    const std::vector<double>& flight = this->Problem.Flight;
    this->Controls.resize(steps);
    this->Gradients.resize(steps);
    for (std::size_t k = 0; k < steps; ++k)
    {
      if (flight[k] > 0.0)
      {
        const Vec3 middle = 0.5 * (x[k] + x[k + 1]);
        this->Controls[k] = (x[k + 1] - x[k]) / this->Step -
                            this->Drifting(static_cast<int>(k), middle, &this->Gradients[k]);
      }
    }
    const double h = 1.0 / this->Step;
    const Mat3 square = h * h * Mat3::Identity();
    // Of the difference of the controls of steps k - 1 and k.
    const auto coupling = [&](std::size_t k)
    {
      const bool has = k > 0 && k < steps;
      return has ? h * this->Weights.Smoothness * std::min(flight[k - 1], flight[k]) : 0.0;
    };
    double cost = 0.0;
    for (std::size_t k = 0; k < steps; ++k)
    {
      if (flight[k] <= 0.0)
      {
        continue;
      }
      const double before = coupling(k);
      const double after = coupling(k + 1);
      const double own = this->Step * flight[k] + before + after;
      const Vec3& c = this->Controls[k];
      const Mat3& g = this->Gradients[k];
      Vec3 pull = own * c;
      cost += 0.5 * this->Step * flight[k] * c.squaredNorm();
      if (after > 0.0)
      {
        pull -= after * this->Controls[k + 1];
        cost += 0.5 * after * (this->Controls[k + 1] - c).squaredNorm();
      }
      const Mat3 quarter = 0.25 * (g.transpose() * g);
      const Mat3 sum = 0.5 * h * (g + g.transpose());
      const Mat3 difference = 0.5 * h * (g.transpose() - g);
      this->AddBlock(k, k, own * (square + sum + quarter));
      this->AddBlock(k + 1, k, own * (difference - square + quarter));
      this->AddBlock(k + 1, k + 1, own * (square - sum + quarter));
      if (before > 0.0)
      {
        pull -= before * this->Controls[k - 1];
        const Mat3& last = this->Gradients[k - 1];
        const Mat3 both = 0.25 * (g.transpose() * last);
        const Mat3 more = 0.5 * h * (last + g.transpose());
        const Mat3 less = 0.5 * h * (last - g.transpose());
        const Mat3 middle = less - square + both;
        this->AddBlock(k, k - 1, -before * (square + more + both));
        this->AddBlock(k, k, -before * (middle + middle.transpose()));
        this->AddBlock(k + 1, k - 1, -before * (both - square - less));
        this->AddBlock(k + 1, k, -before * (square - more + both));
      }
      const Vec3 turned = -0.5 * (g.transpose() * pull);
      this->AddGradient(k, turned - h * pull);
      this->AddGradient(k + 1, turned + h * pull);
    }
    return cost;
  }

  // Accelerations where the control is free, rows and barriers.
  template <class Add>
  void VisitOthers(const std::vector<Vec3>& x, bool derivatives, const Add& add)
  {
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
      this->AddGradient(static_cast<std::size_t>(fi), left * residual.Value);
      for (int j = 0; j <= i; ++j)
      {
        this->AddBlock(static_cast<std::size_t>(fi), static_cast<std::size_t>(residual.First + j),
                       left * residual.Blocks[j]);
      }
    }
  }

  void AddGradient(std::size_t frame, const Vec3& gradient)
  {
    if (!this->Problem.IsFixed[frame])
    {
      for (std::size_t c = 0; c < 3; ++c)
      {
        this->Gradient[3 * frame + c] += gradient[static_cast<int>(c)];
      }
    }
  }

  // To the lower half: row >= column, both frames.
  void AddBlock(std::size_t row, std::size_t column, const Mat3& block)
  {
    if (this->Problem.IsFixed[row] || this->Problem.IsFixed[column])
    {
      return;
    }
    for (std::size_t r = 0; r < 3; ++r)
    {
      for (std::size_t c = 0; c < (row == column ? r + 1 : 3); ++c)
      {
        this->Normal.At(3 * row + r, 3 * column + c) +=
          block(static_cast<int>(r), static_cast<int>(c));
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
  std::vector<Vec3> Controls; // by step, as the air's gradients
  std::vector<Mat3> Gradients;
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

bool IsFreeStep(const DriftProblem& problem, const std::vector<Vec3>& path, int step)
{
  const auto k = static_cast<std::size_t>(step);
  return problem.Flight[k] >= 1.0 &&
         !problem.Ground.Brakes(0.5 * (path[k] + path[k + 1]), step + 0.5);
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
