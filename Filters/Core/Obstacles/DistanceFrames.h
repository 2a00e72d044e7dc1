// SPDX-License-Identifier: BSD-3-Clause
// The signed distance to obstacles on a lattice, frame after frame, by OpenVDB level sets.
#pragma once

#include "Base/Mesh.h"
#include "Base/Result.h"
#include "Obstacles/DistanceLattice.h"

#include <memory>
#include <vector>

namespace waft
{

/// Surfaces are repaired once, and obstacles that stand still are computed once; a frame then costs
/// the lattice's points near those that move.
class DistanceFrames
{
public:
  DistanceFrames();
  ~DistanceFrames();

  /// Takes the Dimensions, Origin, Spacing and Band of lattice. Errors: a lattice without points,
  /// spacing or band that is not positive, an obstacle that ObstacleSet would refuse (cutting
  /// itself excepted: it is not looked for here). Runs on one thread.
  Result Build(const std::vector<ObstacleMesh>& obstacles, const DistanceLattice& lattice);

  /// The signed distance [m] at each point to the nearest obstacle as they stand at a frame, where
  /// within Band, else Band with the sign; `nearest`, where asked for: the index in Build's list of
  /// the obstacle that is nearest, -1 beyond Band of all. May run from many threads at once.
  Result At(double frame, std::vector<float>& distances, std::vector<int>* nearest = nullptr) const;

private:
  struct Internals;
  std::unique_ptr<Internals> Impl;
};

/// Fills lattice.Values from its Dimensions, Origin, Spacing and Band for one frame. On failure
/// lattice.Values is empty.
Result ComputeDistanceLattice(const std::vector<ObstacleMesh>& obstacles, double frame,
                              DistanceLattice& lattice);

} // namespace waft
