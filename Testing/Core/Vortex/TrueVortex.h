// SPDX-License-Identifier: BSD-3-Clause
// Vortices that tests know, to be found again.
#pragma once

#include "Base/ForceFields.h"
#include "Base/Random.h"

namespace waft
{
namespace test
{

/// One for each seed, upright within 30 degrees, in the middle of a volume of 4 m.
inline Vortex Truth(int seed)
{
  Random random(static_cast<std::uint64_t>(seed), 77);
  Vortex v;
  const Vec3 center = random.InBox({ Vec3(-0.8, -0.8, 1.4), Vec3(0.8, 0.8, 2.6) });
  const Vec3 axis = (Vec3::UnitZ() + 0.5 * random.Direction()).normalized();
  const double half = random.Uniform(0.8, 1.4);
  v.VortexId = 4;
  v.P1 = center - half * axis;
  v.P2 = center + half * axis;
  v.Strength = random.Uniform(3.0, 8.0);
  v.CenterTime = random.Uniform(3.5, 5.5);
  v.Duration = random.Uniform(1.2, 2.2);
  v.CoreRadius = random.Uniform(0.2, 0.4);
  return v;
}

} // namespace test
} // namespace waft
