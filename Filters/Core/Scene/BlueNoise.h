// SPDX-License-Identifier: BSD-3-Clause
// Points that are random and evenly spread.
#pragma once

#include "Base/Types.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace waft
{

/// Chooses `count` of the candidates by weighted sample elimination (Yuksel 2015): the candidate
/// that is most crowded goes first. `spacing` [m]: about the distance that the chosen points can
/// have. `taken`: points that stay and crowd their neighbours. Returns indices, in ascending order.
/// The same input gives the same choice.
std::vector<std::size_t> EliminateSamples(const std::vector<Vec3>& candidates, std::size_t count,
                                          double spacing, const std::vector<Vec3>& taken = {});

/// `count` points in the box, far from each other and from those taken, all of them admissible. The
/// box may be flat in
/// one or two directions. Fewer come back only when no admissible point was found at all (none) or
/// when the points found are fewer than `count`.
std::vector<Vec3> SpreadInBox(const Box& box, std::size_t count, std::uint64_t seed,
                              std::uint64_t stream,
                              const std::function<bool(const Vec3&)>& isAdmissible,
                              const std::vector<Vec3>& taken = {});

/// The distance of the densest packing of `count` points in a volume, area or length (dimensions 3,
/// 2, 1): no better spread exists.
double PackingDistance(double measure, int dimensions, std::size_t count);

} // namespace waft
