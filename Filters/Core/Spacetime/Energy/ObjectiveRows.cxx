// SPDX-License-Identifier: BSD-3-Clause
// The objective's rows between ranks, and what is read out of them.
#include "Spacetime/Energy/SpacetimeObjective.h"

#include <algorithm>

namespace waft
{

void SpacetimeObjective::ReceiveRows()
{
  const std::size_t row = this->Problem.Stride() * sizeof(float);
  const std::size_t frames = this->Times.NumberOfFrames();
  const auto reach = static_cast<std::size_t>(this->Times.Reach());
  const auto own = [&](int r) { return this->Ranks.OwnOf(r); };
  // The rows rx and rv of a step are the work of who owns the frame that it comes from.
  this->Ranks.Move(
    { this->Residuals.data(), this->RowsBegin, 9 * row, 0, 6 * row },
    [&](int r)
    {
      const FrameRange range = own(r);
      return FrameRange{ std::min(frames, range.Begin + 1), std::min(frames, range.End + 1) };
    },
    own);
  this->Ranks.Move({ this->Residuals.data(), this->RowsBegin, 9 * row, 6 * row, 3 * row }, own,
                   [&](int r)
                   {
                     const FrameRange range = own(r);
                     return FrameRange{ range.Begin - std::min(range.Begin, reach),
                                        std::min(frames, range.End + reach) };
                   });
}

void SpacetimeObjective::VelocityResidual(std::size_t j, std::size_t body, double rv[3]) const
{
  const double weight = this->Problem.VelocityWeight(body) * this->Times.StepWeights[j];
  for (int c = 0; c < 3; ++c)
  {
    rv[c] = weight > 0.0 ? this->Row(j, 1, c)[body] / weight : 0.0;
  }
}

std::vector<float> SpacetimeObjective::ObjectRows() const
{
  const SpacetimeModel& model = this->Problem;
  const std::size_t no = model.NumberOfObjects;
  const std::size_t frames = this->Times.NumberOfFrames();
  // By the frame that a step comes from, which has the step's owner.
  std::vector<float> rows(frames * no * 6, 0.0f);
  const FrameRange& own = this->Ranks.Own();
  for (std::size_t j = own.Begin; j < own.End && j + 1 < frames; ++j)
  {
    for (std::size_t o = 0; o < no; ++o)
    {
      for (int k = 0; k < 6; ++k)
      {
        rows[(j * no + o) * 6 + k] = this->Row(j + 1, k / 3, k % 3)[model.NumberOfGas + o];
      }
    }
  }
  this->Ranks.Gather(rows, no * 6);
  std::rotate(rows.begin(), rows.end() - static_cast<std::ptrdiff_t>(no * 6), rows.end());
  return rows;
}

void SpacetimeObjective::ObjectResiduals(std::vector<double>& ex, std::vector<double>& ev,
                                         std::vector<int>& steps) const
{
  const SpacetimeModel& model = this->Problem;
  const std::vector<float> rows = this->ObjectRows();
  ex.assign(model.NumberOfObjects, 0.0);
  ev.assign(model.NumberOfObjects, 0.0);
  steps.assign(model.NumberOfObjects, 0);
  for (std::size_t j = 1; j < this->Times.NumberOfFrames(); ++j)
  {
    for (std::size_t o = 0; o < model.NumberOfObjects; ++o)
    {
      if (this->Bound[j * model.NumberOfObjects + o])
      {
        continue;
      }
      const std::size_t i = model.NumberOfGas + o;
      const double stepWeight = this->Times.StepWeights[j];
      const double weightX = model.BodyWeight(i) * model.Weights.ObjectPosition *
                             model.Weights.PositionWeight * stepWeight;
      const double weightV = model.VelocityWeight(i) * stepWeight;
      for (int c = 0; c < 3; ++c)
      {
        const float* row = rows.data() + (j * model.NumberOfObjects + o) * 6;
        const double rx = row[c] / std::max(1e-12, weightX);
        const double rv = row[3 + c] / std::max(1e-12, weightV);
        ex[o] += 0.5 * rx * rx;
        ev[o] += 0.5 * rv * rv;
      }
      ++steps[o];
    }
  }
}

void SpacetimeObjective::MarkLists()
{
  this->Marked.clear();
  for (const NeighborList& list : this->Lists)
  {
    this->Marked.push_back(list.Course());
  }
}

void SpacetimeObjective::RewindLists()
{
  for (std::size_t k = 0; k < this->Marked.size(); ++k)
  {
    this->Lists[k].Restore(this->Marked[k]);
  }
}

void SpacetimeObjective::SerialiseLists(StateArchive& stream)
{
  for (std::size_t j = 0; j < this->Times.NumberOfFrames() && this->KeepsLists; ++j)
  {
    const bool isOwn = this->Ranks.Own().Contains(j);
    NeighborList other;
    NeighborList& list = isOwn ? this->Lists[j - this->Ranks.Own().Begin] : other;
    if (this->Ranks.IsAlone() || stream.IsReading())
    {
      list.Serialise(stream);
      continue;
    }
    MemoryStream written;
    if (isOwn)
    {
      list.Serialise(written);
    }
    this->Ranks.BringToFirst(j, written.Content);
    stream.Raw(written.Content.data(), written.Content.size());
  }
}

} // namespace waft
