// SPDX-License-Identifier: BSD-3-Clause
// Which top-level segments may follow which (Shi et al. 2005, Eq. 1).
#pragma once

#include "Base/Monitor.h"
#include "Base/OptionFields.h"
#include "Base/Parallel.h"
#include "Base/Result.h"
#include "Trajectory/Alignment.h"
#include "Trajectory/MotionDatabase.h"

#include <cmath>

namespace waft
{

struct ConnectionOptions : RotationRange
{
  /// Pairs whose cost is above it do not connect.
  double NotConnectible = 0.15;

  Result Validate() const { return ValidateFields<ConnectionOptions>(*this); }

  template <class Visitor, class... Holder>
  static void VisitThreshold(Visitor&& visit, Holder&... of)
  {
    visit(OptionField{ "NotConnectible", limits::Above(0, 1e9), "",
                       "Pairs of representatives whose residual, over the chord of the window, is "
                       "above this do not follow each other." },
          of.NotConnectible...);
  }

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    RotationRange::Visit(visit, of...);
    VisitThreshold(visit, of...);
  }
};

/// Fills database.Connections from the medoids of its TopNodes: the last Window samples of the one
/// before against the first Window samples of the one after.
Result BuildConnectionTable(const ConnectionOptions& options, const ParallelFor& parallelFor,
                            Monitor& monitor, MotionDatabase& database);

} // namespace waft
