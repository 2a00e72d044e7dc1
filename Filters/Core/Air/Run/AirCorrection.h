// SPDX-License-Identifier: BSD-3-Clause
// What a round does: the wind that the controls have in common, and the air with its force.
#pragma once

#include "Air/Run/AirState.h"
#include "Base/SharedWork.h"

namespace waft
{

/// The air without and then with the wind that the controls have in common, in which the objects
/// drift. plain: the air without.
Result FindWind(const AirContext& run, const HalfSeries& plain, AirState& state,
                AssimilationOutput& output);

inline constexpr const char* WindKind = "wind";
/// Fits the wind that the controls have in common with rank 0, which does so for FindWind.
Result ServeWind(ReadingStream& inputs, Communicator& ranks, const ParallelFor& parallel);

/// Towards the air with the wind correction, by what its motion asks for beside what drives it now;
/// then the objects drift in it.
Result SimulateAgain(const AirContext& run, HalfSeries plain, AirState& state,
                     AssimilationOutput& output);

} // namespace waft
