// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Drift/DriftEquations.h"

#include <algorithm>

namespace waft
{

DriftEquations::DriftEquations(const DriftProblem& problem, const AirSampler& air,
                               const DriftWeights& weights) :
  Problem(problem),
  Weights(weights), Residuals(problem, air, weights),
  Frames(static_cast<int>(problem.IsFixed.size())), Step(problem.Time.Step()),
  Matrix(3 * problem.IsFixed.size(), HalfBandOf(problem)), Factors(0, 0)
{
}

void DriftEquations::LookAt(const std::vector<Vec3>& x)
{
  this->Path = x;
  this->Residuals.FindDepths(x, this->Depths);
  if (this->IsInert())
  {
    return;
  }
  const auto steps = static_cast<std::size_t>(this->Frames - 1);
  this->Controls.resize(steps);
  this->AirGradients.resize(steps);
  for (std::size_t k = 0; k < steps; ++k)
  {
    if (this->Problem.Flight[k] > 0.0)
    {
      const Vec3 middle = 0.5 * (x[k] + x[k + 1]);
      this->Controls[k] =
        (x[k + 1] - x[k]) / this->Step -
        this->Residuals.Drifting(static_cast<int>(k), middle, &this->AirGradients[k]);
    }
  }
}

double DriftEquations::Cost() const
{
  double cost = 0.0;
  const auto add = [&](const DriftResidual& residual, double weight)
  { cost += 0.5 * weight * residual.Value.squaredNorm(); };
  this->Residuals.VisitFlight(
    [this](int k, DriftResidual*)
    {
      return this->IsInert() ? this->Residuals.Control(this->Path, k, nullptr)
                             : this->Controls[static_cast<std::size_t>(k)];
    },
    false, add);
  this->Residuals.VisitOthers(this->Path, this->Depths, false, add);
  return cost;
}

double DriftEquations::Linearise()
{
  this->Matrix.Clear();
  this->Gradients.assign(this->Matrix.Size(), 0.0);
  double cost = 0.0;
  const auto add = [&](const DriftResidual& residual, double weight)
  {
    cost += 0.5 * weight * residual.Value.squaredNorm();
    this->Add(residual, weight);
  };
  if (this->IsInert())
  {
    this->Residuals.VisitFlight([this](int k, DriftResidual* linear)
                                { return this->Residuals.Control(this->Path, k, linear); },
                                true, add);
  }
  else
  {
    cost += this->AddFlight();
  }
  this->Residuals.VisitOthers(this->Path, this->Depths, true, add);
  return cost;
}

void DriftEquations::AddPush(int frame, const Vec3& normal, double depth, double weight)
{
  if (this->IsFixed(frame))
  {
    return;
  }
  const auto at = static_cast<std::size_t>(frame);
  this->AddGradient(at, -weight * depth * normal);
  this->AddBlock(at, at, weight * normal * normal.transpose());
}

bool DriftEquations::Factor(double damping)
{
  this->Factors = this->Matrix;
  for (int f = 0; f < this->Frames; ++f)
  {
    for (int c = 0; c < 3; ++c)
    {
      const std::size_t i = 3 * static_cast<std::size_t>(f) + static_cast<std::size_t>(c);
      double& diagonal = this->Factors.At(i, i);
      diagonal = this->IsFixed(f) ? 1.0 : diagonal + damping;
    }
  }
  return this->Factors.Factor();
}

std::vector<double> DriftEquations::Descent() const
{
  std::vector<double> descent(this->Gradients.size());
  std::transform(this->Gradients.begin(), this->Gradients.end(), descent.begin(),
                 [](double slope) { return -slope; });
  return descent;
}

// Controls and their changes, without inertia. With c_k = J_k x and G_k the air's gradient, J_k
// is -1/dt - G_k / 2 at frame k and 1/dt - G_k / 2 at the next: all blocks of J' W J, whose
// weights W couple neighbours in time, come from G_k' G_k and G_k' G_(k-1). Returns the cost.
double DriftEquations::AddFlight()
{
  const auto steps = static_cast<std::size_t>(this->Frames - 1);
  const std::vector<double>& flight = this->Problem.Flight;
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
    const Mat3& g = this->AirGradients[k];
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
      const Mat3& last = this->AirGradients[k - 1];
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

void DriftEquations::Add(const DriftResidual& residual, double weight)
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

void DriftEquations::AddGradient(std::size_t frame, const Vec3& gradient)
{
  if (!this->Problem.IsFixed[frame])
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      this->Gradients[3 * frame + c] += gradient[static_cast<int>(c)];
    }
  }
}

// To the lower half: row >= column, both frames.
void DriftEquations::AddBlock(std::size_t row, std::size_t column, const Mat3& block)
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

} // namespace waft
