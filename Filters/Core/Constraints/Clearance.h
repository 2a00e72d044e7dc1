// SPDX-License-Identifier: BSD-3-Clause
// What a path must keep clear of: walls, ground and obstacles, landing excepted.
#pragma once

#include "Base/Types.h"
#include "Constraints/ClearanceRule.h"
#include "Obstacles/ObstacleSet.h"

#include <vector>

namespace waft
{

/// A stretch of frames next to a rest, in which the surface that is landed on does not count; the
/// centre only stays above the plane in which it will lie.
struct ContactStretch
{
  int Constraint = -1; // the row that asks for the rest
  double FirstFrame = 0.0;
  double LastFrame = 0.0;
  int Surface = -1;            // ObstacleId, -1: the floor of the volume
  Vec3 Centre = Vec3::Zero();  // where the centre lies at rest [m]
  Vec3 Normal = Vec3::UnitZ(); // of the surface there; the centre stays on this side of it
};

/// Near a mark that itself lies closer to something than the radius, only the mark's own clearance
/// can be asked for.
struct TightMark
{
  Vec3 Position = Vec3::Zero();
  double Distance = 0.0; // its clearance [m]
};

struct ClearanceField
{
  const ObstacleSet* Obstacles = nullptr;
  Box Bounds;
  ClearanceRule Rule;
  std::vector<ContactStretch> Contacts;
  std::vector<TightMark> TightMarks;

  const ContactStretch* ContactAt(double frame) const;
  /// Distance to the nearest thing that counts at this frame [m]; negative inside. During
  /// a contact the plane of rest counts, shifted so that the radius is what is asked for. At most
  /// `limit`.
  double Distance(const Vec3& x, double frame, double limit = 1e30) const;
  /// The same with the unit direction away from that thing.
  double Distance(const Vec3& x, double frame, Vec3& away) const;
  /// What is asked for at x [m]: the radius, less next to tight marks.
  double Required(const Vec3& x) const;
  /// First sample at which the polyline comes nearer than required + margin to anything, or -1.
  /// Sample k is at frame firstFrame + k * framesPerSample.
  int FirstHit(const std::vector<Vec3>& samples, int first, int last, double firstFrame,
               double framesPerSample, double margin) const;
  /// Least slack (distance minus what is required) of the straight piece a-b at a number of points
  /// [m].
  double Slack(const Vec3& a, double frameA, const Vec3& b, double frameB, int points) const;
};

} // namespace waft
