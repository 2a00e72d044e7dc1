// SPDX-License-Identifier: BSD-3-Clause
// What drove the segments of a path, moved with them into the scene.
#pragma once

#include "Base/ForceFields.h"
#include "Base/Motion.h"
#include "Planning/SegmentLibrary.h"

#include <vector>

namespace waft
{

/// A segment as it stands in the scene.
struct SegmentUse
{
  int Segment = 0;
  Placement Transform;
  double FirstTime = 0.0;      // of the segment's first sample [s]
  double RetimingFactor = 1.0; // its own frames per frame of the scene

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Segment...);
    visit(of.Transform...);
    visit(of.FirstTime...);
    visit(of.RetimingFactor...);
  }
};

/// Which sample of which use an object follows at a frame; Use -1: none.
struct UseSample
{
  int Use = -1;
  int Sample = 0;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Use...);
    visit(of.Sample...);
  }
};

/// Fills the track's annotation (ForceTypes, VortexIds, VortexAccelerations, WindAccelerations) and
/// appends to `vortices` those of the segments used, carried through the same rigid motions and
/// retiming, with ids from vortices.size() on.
void Annotate(const SegmentLibrary& library, const std::vector<SegmentUse>& uses,
              const std::vector<UseSample>& samples, double framesPerSecond, Track& track,
              std::vector<Vortex>& vortices);

} // namespace waft
