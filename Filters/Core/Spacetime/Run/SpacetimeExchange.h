// SPDX-License-Identifier: BSD-3-Clause
// What a run takes, knows and leaves, as streams: to files and to other ranks.
#pragma once

#include "Base/StateArchive.h"
#include "Spacetime/Run/SpacetimeWarmStart.h"

namespace waft
{

void Exchange(StateArchive& stream, SpacetimeOptions& options);
void Exchange(StateArchive& stream, SpacetimeInput& input);
void Exchange(StateArchive& stream, SpacetimeWarmStart& memory);

} // namespace waft
