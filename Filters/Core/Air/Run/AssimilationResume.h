// SPDX-License-Identifier: BSD-3-Clause
// Where a run goes on from: a checkpoint of one that was ended, or a finished one that is edited.
#pragma once

#include "Air/Run/AirState.h"
#include "Store/CheckpointFile.h"

namespace waft
{

CheckpointFile CheckpointOf(const AirContext& run, AssimilationOutput& output);
/// Of a run that is not stopped.
void KeepCheckpoint(const AirContext& run, const AirState& state, const AssimilationOutput& output,
                    CheckpointFile& checkpoint);
/// False where there is none that fits.
bool Resume(AirContext& run, CheckpointFile& checkpoint, AirState& state,
            AssimilationOutput& output);

/// The air and what did not change from the last run (memory, or null), or from EditOf; only the
/// rest is to drift. False where there is nothing that fits.
bool TakeEdit(AirContext& run, const AssimilationState* memory, AirState& state,
              AssimilationOutput& output);
/// A finished run, for the next: to memory, unless it is null, and StateFile.
void Leave(const AirContext& run, const AirState& state, AssimilationOutput& output,
           AssimilationState* memory);

} // namespace waft
