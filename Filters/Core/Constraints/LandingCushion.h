// SPDX-License-Identifier: BSD-3-Clause
// The layer of air in which a body that drifts comes to rest on a surface.
#pragma once

#include "Constraints/Rest.h"

#include <vector>

namespace waft
{

/// What settles on a surface has to press the air from under it. That is finer than any lattice, so
/// it is a law: of the velocity with which a body settles, a factor is left at the height h above
/// the centre's rest on the surface that it is about to land on,
///   f = sqrt(2 r - r^2),  r = (h + c) / (b + c) from 0 to 1,  c = b / 50,
/// which is the slowing of a spring that takes the speed over the height b. In still air a body
/// passes b in LandingCushionTime, so that b = 2 / pi LandingCushionTime settling.
class LandingCushion
{
public:
  LandingCushion() = default; // there is none: the factor is 1
  /// obstacles must outlive it; restHeight [m], settlingSpeed [m/s].
  LandingCushion(const ObstacleSet& obstacles, const std::vector<LandingWindow>& landings,
                 double restHeight, double settlingSpeed);

  /// At a place [m] and frame, which may lie between two; gradient, unless null: by x [1/m].
  double Factor(const Vec3& x, double frame, Vec3* gradient = nullptr) const;

private:
  struct Approach // the last of the way to a touch-down
  {
    int ObstacleId = -1;
    double First = 0.0, Last = 0.0; // frames
  };

  const ObstacleSet* Obstacles = nullptr;
  std::vector<Approach> Approaches; // in order of Last
  double RestHeight = 0.0;
  double Height = 0.0; // b [m]
};

} // namespace waft
