// SPDX-License-Identifier: BSD-3-Clause
// Which objects come near to each other, and how far apart they keep there.
#pragma once

#include "Air/Drift/BodyProblem.h"
#include "Base/Parallel.h"
#include "Base/Pose.h"
#include "Constraints/KeptDistances.h"

#include <cstdint>
#include <vector>

namespace waft
{

/// Two bodies, A before B, near to each other at a frame.
struct DriftContact
{
  int Frame = 0;
  std::uint32_t A = 0, B = 0; // there are millions in a heap
  double Kept = 0.0;          // how far apart they keep there [m]

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Frame...);
    visit(of.A...);
    visit(of.B...);
    visit(of.Kept...);
  }
};

/// Thin bodies of known poses are as wide as they reach along the line between them: each is an
/// ellipsoid about its mesh.
struct PosedExtents
{
  std::vector<Vec3> HalfAxes;                    // m, by body, along its own axes
  const std::vector<PoseTrack>* Poses = nullptr; // by body; one without any is a ball

  /// How far apart the two have to be at a frame, along a unit vector; 1e30 where a pose is
  /// unknown.
  double Needed(std::size_t a, std::size_t b, std::size_t frame, const Vec3& line) const;
};

/// What bodies keep, by what holds them as their touch-downs and lift-offs are set.
KeptDistances KeptBy(const std::vector<BodyProblem>& bodies, double framesPerSecond);

/// All pairs that are nearer to each other than they keep, or farther by up to `margin` of what
/// they need; in the order of frames, of A and of B. extents: what poses leave of what they keep.
std::vector<DriftContact> FindContacts(const KeptDistances& kept,
                                       const std::vector<std::vector<Vec3>>& paths, double margin,
                                       const ParallelFor& parallel,
                                       const PosedExtents& extents = PosedExtents());

} // namespace waft
