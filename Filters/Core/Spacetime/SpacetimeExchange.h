// SPDX-License-Identifier: BSD-3-Clause
// What a run takes, knows and leaves, as streams: to files and to other ranks.
#pragma once

#include "Base/StateStream.h"
#include "Spacetime/SpacetimeMemory.h"

namespace waft
{

void Exchange(StateStream& stream, Vortex& vortex);
void Exchange(StateStream& stream, SplineWind& wind);
void Exchange(StateStream& stream, SpacetimeOptions& options);
void Exchange(StateStream& stream, SpacetimeInput& input);
void Exchange(StateStream& stream, SpacetimeMemory& memory);

} // namespace waft
