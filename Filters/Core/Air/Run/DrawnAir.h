// SPDX-License-Identifier: BSD-3-Clause
// The air of a run before any mark is looked at, kept for runs with other marks.
#pragma once

#include "Air/Field/AirStatistics.h"
#include "Air/Run/AirState.h"

#include <string>

namespace waft
{

struct DrawnAir
{
  SmokeForces Forces; // but for the field of wind, which is the input's
  HalfSeries Air;
  AirStatistics Wanted; // of bodies in it
  std::string WarmUp;   // in words

  /// All but the Air, whose bytes are packed.
  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Forces.Vortices...);
    visit(of.Forces.Winds...);
    visit(of.Wanted...);
    visit(of.WarmUp...);
  }
};

/// Tells apart what a run draws: volume, frames, seed, obstacles, winds, vortices, grids and the
/// law of a typical body.
std::uint64_t KeyOfDrawnAir(const AirContext& run, const AirScene& scene, const BodyLaw& law);
/// False where there is none of this key, or it is damaged.
bool FindDrawnAir(const AirContext& run, std::uint64_t key, DrawnAir& drawn);
/// Nothing needs it: where it cannot be written there is none.
void KeepDrawnAir(const AirContext& run, std::uint64_t key, const DrawnAir& drawn);

} // namespace waft
