// SPDX-License-Identifier: BSD-3-Clause
// The memory that a run takes, and windows of frames that take less.
#pragma once

#include "Base/MachineMemory.h"
#include "Spacetime/Model/SpacetimeModel.h"
#include "Spacetime/Model/SpacetimeOptions.h"

#include <algorithm>
#include <cstddef>

namespace waft
{

struct SpacetimeBudget
{
  double Base = 0.0;     // bytes that any run takes while it solves
  double Exported = 0.0; // bytes of what it gives, when nothing is solved any more
  double PerFrame = 0.0; // bytes of each frame that is solved at once
  std::size_t Halo = 0;  // frames beside a window that count as well
  std::size_t Asked = 0; // frames of a window at most; 0: all

  SpacetimeBudget(const SpacetimeModel& model, const SpacetimeOptions& options);

  /// Bytes of a run that solves so many frames at once.
  double Of(std::size_t frames) const
  {
    return this->Base + std::max(this->Exported, this->PerFrame * double(frames));
  }
  /// Free frames of a window: all or the WindowLength where these fit within the MemoryLimit, or
  /// without a limit; else as many as do.
  std::size_t WindowOf(std::size_t frames, double limit) const;
  /// Fails when the WindowLength is too short, and when so many frames, or the windows that are
  /// asked for, take more than the MemoryLimit or, without one, more than `machine`
  /// [bytes]: a system ends what asks for more. The error says how much it takes.
  Result Validate(std::size_t frames, const SpacetimeOptions& options,
                  double machine = MachineMemory()) const;
};

/// Whether there is room for a run, by the sizes of its scene alone, before anything is planned:
/// for layers of gas in the volume above the ground, and in memory.
Result CheckRoom(const Box& volume, int frames, std::size_t objects,
                 const SpacetimeOptions& options);

} // namespace waft
