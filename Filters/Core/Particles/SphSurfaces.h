// SPDX-License-Identifier: BSD-3-Clause
// The density that walls and obstacles stand for, with its derivatives, in double precision.
#pragma once

#include "Base/Types.h"
#include "Particles/ObstacleField.h"
#include "Particles/SphFluid.h"

namespace waft
{

class RestDensity;

/// What bounds the gas at a frame: a closed box from the origin to Size (dx), obstacles, and what
/// the lattice at rest lacks beside them.
struct SphVolume
{
  Vec3 Size;
  const RestDensity* Rest = nullptr;
  const ObstacleField* Obstacles = nullptr;
  int Frame = 0;

  SphVolume(const Vec3& size) : Size(size) {}
};

/// A density [rho0] with its derivatives by the position [dx].
struct SurfaceDensityPart
{
  double Value = 0.0;
  Vec3 Gradient = Vec3::Zero();
  Mat3 Hessian = Mat3::Zero();

  /// One more surface, whose distance is d with this gradient and Hessian: 1 - Value is multiplied
  /// by the kernel's mass on this side of it.
  void Add(const SphFluid& fluid, double d, const Vec3& normal, const Mat3& curvature);
};

/// Kernel mass beyond the walls and obstacles, and the rest density's field.
SurfaceDensityPart SurfaceDensity(const SphFluid& fluid, const SphVolume& volume, const Vec3& x);

} // namespace waft
