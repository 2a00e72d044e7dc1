// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Drift/DriftResiduals.h"

namespace waft
{

int DriftResiduals::ReachOf(const DriftProblem& problem)
{
  int reach = problem.ResponseTime > 0.0 ? DriftResidual::Reach : 2;
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

Vec3 DriftResiduals::Control(const std::vector<Vec3>& x, int k, DriftResidual* linear) const
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
  return law.Velocity(u, factor);
}

} // namespace waft
