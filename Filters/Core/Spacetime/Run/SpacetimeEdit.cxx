// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Run/SpacetimeEdit.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace waft
{
namespace
{

constexpr double Missed = 1e-3;      // [dx]: a place asked for is not where the object is
constexpr double SoftDuration = 0.5; // s over which frames come along, without an EditDuration

Vec3 Position(const SpacetimeModel& model, const StateVector& state, int frame, std::size_t body)
{
  const std::size_t stride = model.Stride();
  const float* p = state.data() + frame * model.FrameSize() + body;
  return VectorAt(p, stride);
}

/// shifts: by frame, of one object [dx].
void Shift(const SpacetimeModel& model, std::size_t object, const std::vector<Vec3>& shifts,
           StateVector& state)
{
  const std::size_t stride = model.Stride();
  for (int frame = 0; frame < model.NumberOfFrames; ++frame)
  {
    const Vec3 change = frame > 0 ? Vec3(shifts[frame] - shifts[frame - 1]) : Vec3::Zero();
    float* p = state.data() + frame * model.FrameSize() + model.NumberOfGas + object;
    for (int c = 0; c < 3; ++c)
    {
      p[c * stride] += static_cast<float>(shifts[frame][c]);
      p[(3 + c) * stride] += static_cast<float>(change[c]);
    }
  }
}

} // namespace

EditRegion FindEditRegion(const SpacetimeWarmStart& before, const ProblemDigest& now,
                          const SpacetimeOptions& options, const SpacetimeSetup& setup,
                          const StateVector& state)
{
  const SpacetimeModel& model = setup.Model;
  const std::size_t no = model.NumberOfObjects;
  EditRegion region;
  std::vector<char> changed(no, 0);
  int first = model.NumberOfFrames, last = -1;
  for (std::size_t index = 0; index < now.Requests.size(); ++index)
  {
    if (now.Requests[index] != before.Digest.Requests[index])
    {
      const auto frame = static_cast<int>(index / no);
      changed[index % no] = 1;
      first = std::min(first, frame);
      last = std::max(last, frame);
    }
  }
  if (last < 0)
  {
    return region;
  }
  const auto span = static_cast<int>(std::ceil(options.EditDuration / setup.FrameStep));
  region.First = std::max(0, first - span);
  region.Last = std::min(model.NumberOfFrames - 1, last + span);
  region.Movable.assign(model.NumberOfBodies(), 0);
  const double radius = options.EditRadius / setup.Spacing;
  for (std::size_t o = 0; o < no; ++o)
  {
    if (!changed[o])
    {
      continue;
    }
    region.Movable[model.NumberOfGas + o] = 1;
    for (int frame = region.First; frame <= region.Last; ++frame)
    {
      for (const StateVector* motion : { &before.State.Motion, &state })
      {
        const Vec3 at = Position(model, *motion, frame, model.NumberOfGas + o);
        for (std::size_t i = 0; i < region.Movable.size(); ++i)
        {
          if (!region.Movable[i] &&
              (Position(model, *motion, frame, i) - at).squaredNorm() < radius * radius)
          {
            region.Movable[i] = 1;
          }
        }
      }
    }
  }
  return region;
}

void MoveToPlan(const SpacetimeWarmStart& before, const SpacetimeOptions& options,
                const SpacetimeSetup& setup, StateVector& state)
{
  const SpacetimeModel& model = setup.Model;
  const std::size_t no = model.NumberOfObjects;
  const double span =
    (options.EditDuration > 0.0 ? options.EditDuration : SoftDuration) / setup.FrameStep;
  for (std::size_t o = 0; o < no; ++o)
  {
    std::vector<Vec3> shifts(model.NumberOfFrames, Vec3::Zero());
    bool moves = false;
    for (int frame = 0; frame < model.NumberOfFrames; ++frame)
    {
      const std::size_t index = static_cast<std::size_t>(frame) * no + o;
      shifts[frame] = setup.Table.Planned[index] - before.Planned[index];
      moves = moves || !shifts[frame].isZero(0.0);
    }
    if (moves)
    {
      Shift(model, o, shifts, state);
    }
    for (int frame = 0; frame < model.NumberOfFrames; ++frame)
    {
      const std::size_t index = static_cast<std::size_t>(frame) * no + o;
      if (!(model.Flags[index] & FixedPosition))
      {
        continue;
      }
      const Vec3 miss =
        setup.Table.FixedPositions[index] - Position(model, state, frame, model.NumberOfGas + o);
      if (miss.norm() < Missed)
      {
        continue;
      }
      for (int k = 0; k < model.NumberOfFrames; ++k)
      {
        const double away = std::min(1.0, std::abs(k - frame) / span);
        shifts[k] = 0.5 * (1.0 + std::cos(M_PI * away)) * miss;
      }
      Shift(model, o, shifts, state);
    }
  }
}

} // namespace waft
