// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Model/FrameView.h"

#include "Spacetime/Model/LevelTransfer.h"

#include <algorithm>
#include <utility>

namespace waft
{

FrameView::FrameView(const SpacetimeModel& model, TimeLevel level) :
  Model(model),
  What(level.NumberOfFrames() < static_cast<std::size_t>(model.NumberOfFrames) ? Kind::Coarse
                                                                               : Kind::All),
  Times(std::move(level))
{
}

FrameView::FrameView(const SpacetimeModel& model, const TimeLevel& level, std::size_t first,
                     std::size_t last) :
  Model(model),
  What(Kind::Span), Begin(level.PartBegin(first)), Times(level.Part(first, last))
{
}

StateVector FrameView::Take(StateVector& whole) const
{
  if (this->What == Kind::All)
  {
    return std::exchange(whole, StateVector());
  }
  if (this->What == Kind::Coarse)
  {
    StateVector part = Restrict(this->Model, this->Times, whole);
    whole = StateVector();
    return part;
  }
  const std::size_t size = this->Model.FrameSize();
  const float* begin = whole.data() + this->Begin * size;
  return StateVector(begin, begin + this->Times.NumberOfFrames() * size);
}

void FrameView::Merge(StateVector part, StateVector& whole) const
{
  const std::size_t size = this->Model.FrameSize();
  switch (this->What)
  {
    case Kind::All:
      whole = std::move(part);
      break;
    case Kind::Coarse:
      whole.resize(static_cast<std::size_t>(this->Model.NumberOfFrames) * size);
      Prolong(this->Model, this->Times, part, whole);
      break;
    case Kind::Span:
      std::copy(part.begin(), part.end(), whole.data() + this->Begin * size);
      break;
  }
}

} // namespace waft
