// SPDX-License-Identifier: BSD-3-Clause
// The way that the trees of a span are led along.
#pragma once

#include "Planning/SpanPlan.h"

#include <vector>

namespace waft
{

/// Sets the task's Way to the guide, or where that or the straight one is blocked to a way around;
/// false when the map shows none.
bool FindWay(const ClearanceField& field, const SpanPlanOptions& options,
             const std::vector<Vec3>& guide, SpanTask& task);

} // namespace waft
