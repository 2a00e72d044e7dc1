// SPDX-License-Identifier: BSD-3-Clause
// What a search keeps clear of: walls, ground and obstacles, landing excepted.
#pragma once

#include "Base/Types.h"
#include "Constraints/ResolveClearance.h"

#include <vector>

namespace waft
{

/// The clearance of a path that is still sought, quick to ask for: during a landing the plane in
/// which the body will lie stands for the surface.
struct ClearanceField
{
  const ObstacleSet* Obstacles = nullptr;
  Box Bounds;
  ClearanceRule Rule;
  std::vector<LandingWindow> Landings;
  std::vector<TightMark> TightMarks;
  /// Where frames are those of a flight that brakes or launches, by such frames from the first one
  /// on, the scene's, at which moving obstacles are looked at; empty: they are the scene's.
  std::vector<double> SceneFrames;
  int FirstFrame = 0;

  double SceneFrame(double frame) const;
  /// The rest that begins at a frame will not be reached: its surface is one like others.
  void ForgetLanding(int frame);
  const LandingWindow* LandingAt(double frame) const;
  /// Distance to the nearest thing that counts at this frame [m]; negative inside. During
  /// a landing the plane of rest counts, shifted so that the radius is what is asked for. At most
  /// `limit`.
  double Distance(const Vec3& x, double frame, double limit = 1e30) const;
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
