// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Model/TimeLevel.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <type_traits>

namespace waft
{

TimeLevel TimeLevel::Full(int numberOfFrames, int window)
{
  std::vector<int> frames(numberOfFrames);
  std::iota(frames.begin(), frames.end(), 0);
  return Make(std::move(frames), window);
}

TimeLevel TimeLevel::Make(std::vector<int> frames, int window)
{
  TimeLevel level;
  const int n = static_cast<int>(frames.size());
  level.Frames = std::move(frames);
  level.Steps.assign(n, 0.0);
  level.StepWeights.assign(n, 0.0);
  level.FrameWeights.assign(n, 1.0);
  level.SmoothWeights.assign(n, 1.0);
  for (int j = 1; j < n; ++j)
  {
    level.Steps[j] = level.Frames[j] - level.Frames[j - 1];
    level.StepWeights[j] = 1.0 / level.Steps[j];
  }
  level.Rows.resize(n);
  level.Columns.resize(n);
  const double meanStep = n > 1 ? double(level.Frames[n - 1] - level.Frames[0]) / (n - 1) : 1.0;
  const int w = std::max(1, static_cast<int>(std::lround(window / meanStep)));
  for (int j = 0; j < n; ++j)
  {
    const double before = j > 0 ? level.Steps[j] : level.Steps[std::min(1, n - 1)];
    const double after = j + 1 < n ? level.Steps[j + 1] : level.Steps[n - 1];
    const double span = 0.5 * (before + after);
    level.FrameWeights[j] = span;
    // The row measures a second difference (a first one at the ends) over the steps beside it.
    level.SmoothWeights[j] = span / std::max(1.0, before * before * after * after);
    if (w == 1 && j > 0 && j + 1 < n)
    {
      level.Rows[j] = { { j - 1, after / (before + after) }, { j + 1, before / (before + after) } };
      continue;
    }
    const int first = std::max(0, j - w);
    const int last = std::min(n - 1, j + w);
    for (int k = first; k <= last; ++k)
    {
      if (k != j)
      {
        level.Rows[j].push_back({ k, 1.0 / (last - first) });
      }
    }
  }
  for (int j = 0; j < n; ++j)
  {
    for (const Neighbour& neighbour : level.Rows[j])
    {
      level.Columns[neighbour.Frame].push_back({ j, neighbour.Coefficient });
    }
  }
  return level;
}

int TimeLevel::Reach() const
{
  int reach = 1;
  for (std::size_t j = 0; j < this->Rows.size(); ++j)
  {
    for (const Neighbour& neighbour : this->Rows[j])
    {
      reach = std::max(reach, std::abs(neighbour.Frame - static_cast<int>(j)));
    }
  }
  return reach;
}

std::size_t TimeLevel::PartBegin(std::size_t first) const
{
  const auto halo = static_cast<std::size_t>(2 * this->Reach());
  return first - std::min(first, halo);
}

TimeLevel TimeLevel::Part(std::size_t first, std::size_t last) const
{
  const std::size_t begin = this->PartBegin(first);
  const std::size_t end =
    std::min(this->NumberOfFrames(), last + 1 + static_cast<std::size_t>(2 * this->Reach()));
  const auto count = static_cast<int>(end - begin);
  const auto cut = [&](const auto& list)
  {
    using List = std::decay_t<decltype(list)>;
    return List(list.begin() + static_cast<std::ptrdiff_t>(begin),
                list.begin() + static_cast<std::ptrdiff_t>(end));
  };
  TimeLevel part;
  part.Frames = cut(this->Frames);
  part.Steps = cut(this->Steps);
  part.StepWeights = cut(this->StepWeights);
  part.FrameWeights = cut(this->FrameWeights);
  part.SmoothWeights = cut(this->SmoothWeights);
  part.Steps[0] = part.StepWeights[0] = 0.0;
  part.Rows = cut(this->Rows);
  part.Columns.resize(part.Rows.size());
  for (int j = 0; j < count; ++j)
  {
    bool isWhole = true;
    for (Neighbour& neighbour : part.Rows[j])
    {
      neighbour.Frame -= static_cast<int>(begin);
      isWhole = isWhole && neighbour.Frame >= 0 && neighbour.Frame < count;
    }
    if (!isWhole) // nothing free is in it
    {
      part.Rows[j].clear();
      part.SmoothWeights[j] = 0.0;
    }
    for (const Neighbour& neighbour : part.Rows[j])
    {
      part.Columns[neighbour.Frame].push_back({ j, neighbour.Coefficient });
    }
  }
  part.FirstFree = first - begin;
  part.LastFree = last - begin;
  return part;
}

SphFluid FluidOf(const SpacetimeModel& model, const TimeLevel& level)
{
  SphFluid fluid = model.Fluid;
  const double longest = *std::max_element(level.Steps.begin(), level.Steps.end());
  const double softening =
    std::min(1.0, fluid.SmoothingLength / (fluid.SoundSpeed * std::max(1.0, longest)));
  fluid.SoundSpeed *= softening;
  fluid.Viscosity /= softening;
  return fluid;
}

bool StepIsBound(const SpacetimeModel& model, const TimeLevel& level, std::size_t j,
                 std::size_t object)
{
  for (int frame = level.Frames[j - 1] + 1; frame <= level.Frames[j]; ++frame)
  {
    if (model.Flag(frame, object) & NoDynamics)
    {
      return true;
    }
  }
  return false;
}

bool StepIsGiven(const SpacetimeModel& model, const TimeLevel& level, std::size_t j,
                 std::size_t object)
{
  return (model.Flag(level.Frames[j - 1], object) & model.Flag(level.Frames[j], object) &
          FixedPosition) != 0;
}

bool StepHasLaw(const SpacetimeModel& model, const TimeLevel& level, std::size_t j,
                std::size_t object)
{
  return !StepIsBound(model, level, j, object) &&
         (model.Air.IsEmpty() || !StepIsGiven(model, level, j, object));
}

double SmoothnessWeight(const SpacetimeModel& model, const TimeLevel& level, std::size_t j,
                        long object)
{
  const SpacetimeWeights& weights = model.Weights;
  if (object < 0 || model.Air.IsEmpty())
  {
    return weights.CoherenceWeight * (1.0 - weights.SpatialShare) * level.SmoothWeights[j];
  }
  const auto flies = [&](std::size_t k)
  { return k > 0 && StepHasLaw(model, level, k, static_cast<std::size_t>(object)); };
  const auto& row = level.Rows[j];
  const bool inFlight = flies(j) && std::all_of(row.begin(), row.end(),
                                                [&](const TimeLevel::Neighbour& n) {
                                                  return flies(static_cast<std::size_t>(n.Frame));
                                                });
  return inFlight ? weights.VelocityWeight * weights.Control * level.SmoothWeights[j] : 0.0;
}

} // namespace waft
