// SPDX-License-Identifier: BSD-3-Clause
// What a run takes, knows and leaves, as streams: to files and to other ranks.
#pragma once

#include "Base/StateArchive.h"
#include "Spacetime/Model/SpacetimeOptions.h"
#include "Spacetime/Scene/SpacetimeInput.h"
#include "Spacetime/Scene/SpacetimeOutput.h"

namespace waft
{

void Serialise(StateArchive& stream, SpacetimeOptions& options);
void Serialise(StateArchive& stream, SpacetimeInput& input);
void Serialise(StateArchive& stream, SpacetimeOutput& output);

} // namespace waft
