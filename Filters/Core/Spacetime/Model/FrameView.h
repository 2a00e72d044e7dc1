// SPDX-License-Identifier: BSD-3-Clause
// A part of a motion that is solved by itself.
#pragma once

#include "Spacetime/Model/StateVector.h"
#include "Spacetime/Model/TimeLevel.h"

#include <cstddef>

namespace waft
{

/// Some of the frames of a vector, which a level of time stands for: all of them, every few, or a
/// span with those beside it that E reaches.
class FrameView
{
public:
  /// level: of all frames, or a coarse one (then the vector is of all frames).
  FrameView(const SpacetimeModel& model, TimeLevel level);
  /// level: that of the vector. first, last: level frames that are free.
  FrameView(const SpacetimeModel& model, const TimeLevel& level, std::size_t first,
            std::size_t last);

  const TimeLevel& Level() const { return this->Times; }
  /// The view's frames out of a vector. What Merge makes anew in any case leaves the vector.
  StateVector Take(StateVector& whole) const;
  /// Puts them back.
  void Merge(StateVector part, StateVector& whole) const;

private:
  enum class Kind
  {
    All,
    Coarse,
    Span
  };
  const SpacetimeModel& Model;
  Kind What;
  std::size_t Begin = 0; // of a span
  TimeLevel Times;
};

} // namespace waft
