// SPDX-License-Identifier: BSD-3-Clause
// The last word on clearance: what uniting flights pushed into something is eased out again.
#pragma once

#include "Constraints/Warp.h"
#include "Planning/ClearanceField.h"

#include <vector>

namespace waft
{

struct ClearPathOptions
{
  double Tolerance = 0.0005; // m, by which the swept centre may miss the clearance
  double MostStep = 1e30;    // m: longer steps count as shortfall, by what they are longer
  double FrameStep = 1.0;    // s
};

struct PathShortfall
{
  double Depth = 0.0; // most that the swept centre lacks of its clearance [m]
  int Frame = -1;     // where, -1: nowhere

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Depth...);
    visit(of.Frame...);
  }
};

/// Eases `united` out of what it comes too near to, by soft marks in the warp that made it, so that
/// the correction is as smooth as the redistribution. Of what comes out, `united` and `separate`,
/// all one position a frame with the same fixed frames, returns the one that falls short least.
std::vector<Vec3> ClearPath(const ClearanceField& field, WarpProblem warp,
                            const ClearPathOptions& options, const std::vector<Vec3>& united,
                            const std::vector<Vec3>& separate, PathShortfall& shortfall);

} // namespace waft
