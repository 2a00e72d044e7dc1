// SPDX-License-Identifier: BSD-3-Clause
// What drives each point of a traced trajectory: a vortex, a wind or nothing.
#pragma once

#include "Base/ForceFields.h"
#include "Base/Motion.h"
#include "Base/OptionFields.h"
#include "Base/Result.h"

#include <vector>

namespace waft
{

struct AnnotationOptions
{
  /// A point is of type vortex when |f_vortex| > VortexShare (|f_vortex| + |f_wind|), 0..1.
  double VortexShare = 0.5;
  /// A force below this drives nothing [m/s^2].
  double ForceFloor = 0.05;
  /// Runs of one cause shorter than this take the cause of the run before them [s].
  double ShortestRun = 0.3;

  Result Validate() const { return ValidateFields<AnnotationOptions>(*this); }

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(OptionField{ "VortexShare",
                       { 0, 1 },
                       "",
                       "A point is driven by a vortex when the vortices' force is more than this "
                       "fraction of the sum of the magnitudes of both." },
          of.VortexShare...);
    visit(OptionField{ "ForceFloor", limits::Factor, "m/s^2",
                       "An acceleration below this drives nothing, in metres per second squared." },
          of.ForceFloor...);
    visit(OptionField{ "ShortestRun", limits::Factor, "s",
                       "Stretches of one cause that are shorter than this take the cause before "
                       "them, in seconds." },
          of.ShortestRun...);
  }
};

/// The cause of a point from the accelerations [m/s^2] found there.
ForceType ClassifyForce(const Vec3& vortexForce, const Vec3& windForce,
                        const AnnotationOptions& options);

/// The VortexId of the vortex that acts most strongly at x and time; -1 when there is none.
int DominantVortex(const std::vector<Vortex>& vortices, const Vec3& x, double time);

/// Fills ForceTypes and VortexIds from Positions, VortexAccelerations and WindAccelerations (all
/// as long as Positions). A run is a stretch of one force type and, where it is vortex, of one
/// vortex. The first sample is at `startTime` [s].
void AnnotateTrack(const std::vector<Vortex>& vortices, double startTime, double framesPerSecond,
                   const AnnotationOptions& options, Track& track);

} // namespace waft
