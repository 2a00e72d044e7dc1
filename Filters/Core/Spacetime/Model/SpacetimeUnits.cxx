// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Model/SpacetimeUnits.h"

#include <algorithm>

namespace waft
{
namespace
{

constexpr double LeastCore = 1.5; // of a vortex [dx]: the gas cannot follow a finer one

} // namespace

Vortex ToModel(const SpacetimeUnits& units, const Vortex& vortex)
{
  Vortex v = vortex;
  v.P1 = units.FromWorld(vortex.P1);
  v.P2 = units.FromWorld(vortex.P2);
  v.Strength = vortex.Strength / (units.AccelerationUnit() * units.Spacing);
  v.CenterTime = vortex.CenterTime / units.FrameStep;
  v.Duration = vortex.Duration / units.FrameStep;
  v.CoreRadius = std::max(vortex.CoreRadius / units.Spacing, LeastCore);
  return v;
}

Vortex ToWorld(const SpacetimeUnits& units, const Vortex& vortex)
{
  Vortex v = vortex;
  v.P1 = units.ToWorld(vortex.P1);
  v.P2 = units.ToWorld(vortex.P2);
  v.Strength = vortex.Strength * units.AccelerationUnit() * units.Spacing;
  v.CenterTime = vortex.CenterTime * units.FrameStep;
  v.Duration = vortex.Duration * units.FrameStep;
  v.CoreRadius = vortex.CoreRadius * units.Spacing;
  return v;
}

} // namespace waft
