// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Drift/Drift.h"

#include "Air/Drift/BandedMatrix.h"
#include "Air/Drift/DriftResiduals.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

constexpr double Converged = 1e-4; // relative fall of the cost in an iteration
constexpr double LeastDamping = 1e-7;
constexpr double MostDamping = 1e9;

// The normal equations of a problem about a path, and a step by them.
class NormalEquations
{
public:
  NormalEquations(const DriftProblem& problem, const AirSampler& air, const DriftWeights& weights) :
    Problem(problem), Weights(weights), Residuals(problem, air, weights),
    Frames(static_cast<int>(problem.IsFixed.size())), Step(problem.Time.Step()),
    Matrix(3 * problem.IsFixed.size(), 3 * DriftResiduals::ReachOf(problem) + 2)
  {
  }

  double Cost(const std::vector<Vec3>& x)
  {
    double cost = 0.0;
    const auto add = [&](const DriftResidual& residual, double weight)
    { cost += 0.5 * weight * residual.Value.squaredNorm(); };
    this->Residuals.VisitFlight(x, false, add);
    this->Residuals.VisitOthers(x, false, add);
    return cost;
  }

  /// Gauss-Newton matrix and gradient.
  double Linearise(const std::vector<Vec3>& x)
  {
    this->Matrix.Clear();
    this->Gradient.assign(this->Matrix.Size(), 0.0);
    double cost = 0.0;
    const auto add = [&](const DriftResidual& residual, double weight)
    {
      cost += 0.5 * weight * residual.Value.squaredNorm();
      this->Add(residual, weight);
    };
    if (this->Problem.ResponseTime > 0.0)
    {
      this->Residuals.VisitFlight(x, true, add);
    }
    else
    {
      cost += this->AddFlight(x);
    }
    this->Residuals.VisitOthers(x, true, add);
    return cost;
  }

  bool TakeStep(const std::vector<Vec3>& x, double damping, std::vector<Vec3>& moved)
  {
    BandedMatrix matrix = this->Matrix;
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
  // Controls and their changes, without inertia. With c_k = J_k x and G_k the air's gradient, J_k
  // is -1/dt - G_k / 2 at frame k and 1/dt - G_k / 2 at the next: all blocks of J' W J, whose
  // weights W couple neighbours in time, come from G_k' G_k and G_k' G_(k-1). Returns the cost.
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
        this->Controls[k] =
          (x[k + 1] - x[k]) / this->Step -
          this->Residuals.Drifting(static_cast<int>(k), middle, &this->Gradients[k]);
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

  void Add(const DriftResidual& residual, double weight)
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
        this->Matrix.At(3 * row + r, 3 * column + c) +=
          block(static_cast<int>(r), static_cast<int>(c));
      }
    }
  }

  bool IsFixed(int frame) const
  {
    return this->Problem.IsFixed[static_cast<std::size_t>(frame)] != 0;
  }

  const DriftProblem& Problem;
  const DriftWeights& Weights;
  DriftResiduals Residuals;
  int Frames;
  double Step;
  BandedMatrix Matrix;
  std::vector<double> Gradient;
  std::vector<Vec3> Controls; // by step, as the air's gradients
  std::vector<Mat3> Gradients;
};

} // namespace

std::vector<Vec3> DriftControls(const DriftProblem& problem, const AirSampler& air,
                                const std::vector<Vec3>& path)
{
  const DriftWeights weights;
  const DriftResiduals residuals(problem, air, weights);
  std::vector<Vec3> controls;
  for (int k = 0; k + 1 < static_cast<int>(path.size()); ++k)
  {
    controls.push_back(residuals.Control(path, k, nullptr));
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
  NormalEquations equations(problem, air, weights);
  DriftOutcome outcome;
  std::vector<Vec3> trial;
  double damping = 1.0 / problem.Time.Step();
  outcome.Cost = equations.Linearise(path);
  bool done = false;
  while (!done && outcome.Iterations < maximumIterations)
  {
    ++outcome.Iterations;
    const double cost = equations.TakeStep(path, damping, trial) ? equations.Cost(trial) : 1e300;
    if (!(cost < outcome.Cost))
    {
      damping *= 8.0;
      done = damping > MostDamping;
      continue;
    }
    done = outcome.Cost - cost < Converged * outcome.Cost;
    damping = std::max(LeastDamping, damping / 5.0);
    path = trial;
    outcome.Cost = done ? cost : equations.Linearise(path);
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
