// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/LandingCushion.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

constexpr double LandingCushionTime = 0.15; // s
constexpr double LongestApproach = 0.2;     // s: what is low before hovers by itself
constexpr double CoreFraction = 0.02;       // c / b: below, the root is too steep for a step

} // namespace

LandingCushion::LandingCushion(const ObstacleSet& obstacles,
                               const std::vector<LandingWindow>& landings, double restHeight,
                               double settlingSpeed) :
  Obstacles(&obstacles),
  RestHeight(restHeight), Height(2.0 / M_PI * LandingCushionTime * settlingSpeed)
{
  for (const LandingWindow& landing : landings)
  {
    // A landing's window begins a second before its touch-down.
    const double last = landing.Frame;
    this->Approaches.push_back(
      { landing.ObstacleId, last - LongestApproach * (last - landing.First), last });
  }
}

double LandingCushion::Factor(const Vec3& x, double frame, Vec3* gradient) const
{
  if (gradient != nullptr)
  {
    gradient->setZero();
  }
  const auto approach =
    std::find_if(this->Approaches.begin(), this->Approaches.end(),
                 [&](const Approach& a) { return frame >= a.First && frame <= a.Last; });
  if (approach == this->Approaches.end() || this->Height <= 0.0)
  {
    return 1.0;
  }
  SurfaceHit hit;
  const double height =
    this->Obstacles->SignedDistanceTo(approach->ObstacleId, x, frame, hit) - this->RestHeight;
  if (height >= this->Height)
  {
    return 1.0;
  }
  const double core = CoreFraction * this->Height;
  const double r = (std::max(0.0, height) + core) / (this->Height + core);
  const double factor = std::sqrt(2.0 * r - r * r);
  if (gradient != nullptr && height > 0.0)
  {
    *gradient = (1.0 - r) / factor / (this->Height + core) * hit.Normal;
  }
  return factor;
}

} // namespace waft
