// SPDX-License-Identifier: BSD-3-Clause
// Flight without a goal: a chain of database segments that stays in the volume and clear of
// obstacles.
#pragma once

#include "Planning/SpanSearch.h"

namespace waft
{

/// Grows one chain of at least task.Frames frames from task.Start, depth first with backtracking:
/// random connectible successors. The goal is not used.
/// Returns the longest chain found within the limit of attempts; its last piece is cut so that the
/// chain lasts at most task.Frames; empty when not even a first piece fits.
std::vector<Piece> FlyFree(const SegmentLibrary& library, const ClearanceField& field,
                           const SpanTask& task, double margin, int maximumNumberOfBranches,
                           Random random);

} // namespace waft
