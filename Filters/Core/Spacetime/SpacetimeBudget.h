// SPDX-License-Identifier: BSD-3-Clause
// The memory that a run takes, and windows of frames that take less.
#pragma once

#include "Spacetime/Spacetime.h"
#include "Spacetime/SpacetimeModel.h"

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

  SpacetimeBudget(const SpacetimeModel& model, const SpacetimeOptions& options);

  /// Bytes of a run that solves so many frames at once.
  double Of(std::size_t frames) const
  {
    return this->Base + std::max(this->Exported, this->PerFrame * double(frames));
  }
  /// Free frames of a window within the MemoryLimit; all when they fit, or without a limit.
  std::size_t WindowOf(std::size_t frames, double limit) const;
  /// An error that says how much is needed.
  Result Validate(const SpacetimeOptions& options) const;
};

} // namespace waft
