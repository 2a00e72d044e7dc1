// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Drift/DriftResiduals.h"

#include <cmath>

namespace waft
{

int DriftResiduals::ReachOf(const DriftProblem& problem)
{
  int reach = problem.ResponseTime > 0.0 ? 3 : 2;
  for (const DriftRow& row : problem.Rows)
  {
    reach = std::max(reach, row.Terms.back().first - row.Terms.front().first);
  }
  return reach;
}

void DriftResiduals::FindDepths(const std::vector<Vec3>& x, std::vector<DriftDepthAt>& depths)
{
  depths.clear();
  for (int f = 0; this->Problem.TooNear && f < this->Frames; ++f)
  {
    if (this->IsFixed(f))
    {
      continue;
    }
    this->Found.clear();
    this->Problem.TooNear(f, x[static_cast<std::size_t>(f)], this->Found);
    for (const DriftDepth& depth : this->Found)
    {
      depths.push_back({ f, depth });
    }
  }
}

DriftResiduals::DriftResiduals(const DriftProblem& problem, const AirSampler& air,
                               const DriftWeights& weights) :
  Problem(problem),
  Air(air), Weights(weights), Frames(static_cast<int>(problem.IsFixed.size())),
  Step(problem.Time.Step())
{
  if (problem.ResponseTime > 0.0)
  {
    const double steps = problem.ResponseTime / this->Step;
    this->Decay = std::exp(-1.0 / steps);
    this->Before = steps * (1.0 - this->Decay) - this->Decay;
  }
}

Vec3 DriftResiduals::Control(const std::vector<Vec3>& x, int k, DriftResidual* linear) const
{
  const auto at = static_cast<std::size_t>(k);
  const bool inert = this->Decay > 0.0 && k > 0;
  const auto part = [&](std::size_t step, Mat3& gradient, Vec3& drifting)
  {
    drifting = this->Drifting(static_cast<int>(step), 0.5 * (x[step] + x[step + 1]),
                              linear ? &gradient : nullptr);
    return Vec3((x[step + 1] - x[step]) / this->Step);
  };
  Mat3 gradient;
  Vec3 drifting;
  const Vec3 velocity = part(at, gradient, drifting);
  Vec3 c = velocity - drifting;
  const Mat3 one = Mat3::Identity() / this->Step;
  if (!inert)
  {
    if (linear)
    {
      linear->First = k;
      linear->Count = 2;
      linear->Value = c;
      linear->Blocks[0] = -one - 0.5 * gradient;
      linear->Blocks[1] = one - 0.5 * gradient;
    }
    return c;
  }
  const double scale = 1.0 / (1.0 - this->Decay);
  const double kept = scale * this->Decay, before = scale * this->Before, now = 1.0 - before;
  Mat3 lastGradient;
  Vec3 lastDrifting;
  const Vec3 lastVelocity = part(at - 1, lastGradient, lastDrifting);
  c = scale * velocity - kept * lastVelocity - before * lastDrifting - now * drifting;
  if (linear)
  {
    linear->First = k - 1;
    linear->Count = 3;
    linear->Value = c;
    linear->Blocks[0] = kept * one - 0.5 * before * lastGradient;
    linear->Blocks[1] = -(kept + scale) * one - 0.5 * before * lastGradient - 0.5 * now * gradient;
    linear->Blocks[2] = scale * one - 0.5 * now * gradient;
  }
  return c;
}

BodyLaw DriftResiduals::LawIn(int k) const
{
  BodyLaw law = this->Problem.Law;
  if (!this->Problem.Slips.empty())
  {
    law.Slip = -this->Problem.Slips[static_cast<std::size_t>(k)];
  }
  return law;
}

Vec3 DriftResiduals::Drifting(int k, const Vec3& x, Mat3* gradient) const
{
  const BodyLaw law = this->LawIn(k);
  Vec3 slope;
  const double factor = this->Problem.Ground.Factor(x, k + 0.5, gradient ? &slope : nullptr);
  const Vec3 u = this->Air.Between(k, x, gradient);
  if (gradient)
  {
    *gradient = law.VelocityGradient(*gradient, slope);
  }
  return law.Velocity(u, factor) + this->Problem.Ground.Carried(x, k + 0.5, gradient);
}

} // namespace waft
