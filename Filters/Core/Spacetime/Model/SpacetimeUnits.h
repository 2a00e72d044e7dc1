// SPDX-License-Identifier: BSD-3-Clause
// Metres and seconds to spacings and frames, and back.
#pragma once

#include "Base/ForceFields.h"
#include "Base/Types.h"

namespace waft
{

struct SpacetimeUnits
{
  Vec3 Origin = Vec3::Zero(); // corner of the gas' box [m]
  double Spacing = 1.0;       // dx [m]
  double FrameStep = 1.0;     // s

  Vec3 ToWorld(const Vec3& x) const { return this->Origin + this->Spacing * x; }
  Vec3 FromWorld(const Vec3& x) const { return (x - this->Origin) / this->Spacing; }
  double AccelerationUnit() const { return this->Spacing / (this->FrameStep * this->FrameStep); }
};

/// A vortex in dx and frames, and back.
Vortex ToModel(const SpacetimeUnits& units, const Vortex& vortex);
Vortex ToWorld(const SpacetimeUnits& units, const Vortex& vortex);

} // namespace waft
