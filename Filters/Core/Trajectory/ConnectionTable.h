// SPDX-License-Identifier: BSD-3-Clause
// Which top-level segments may follow which (Shi et al. 2005, Eq. 1).
#pragma once

#include "Base/Monitor.h"
#include "Base/Parallel.h"
#include "Base/Result.h"
#include "Trajectory/Alignment.h"
#include "Trajectory/MotionDatabase.h"

namespace waft
{

struct ConnectionOptions
{
  RotationFreedom Freedom = RotationFreedom::YawAndTilt;
  double MaxTilt = DefaultMaxTilt; // rad
  /// Pairs whose cost is above it do not connect.
  double NotConnectible = 0.15;

  Result Validate() const;
};

/// Fills database.Connections from the medoids of its TopNodes: the last Window samples of the one
/// before against the first Window samples of the one after.
Result BuildConnectionTable(const ConnectionOptions& options, const ParallelFor& parallelFor,
                            Monitor& monitor, MotionDatabase& database);

} // namespace waft
