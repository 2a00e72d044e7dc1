// SPDX-License-Identifier: BSD-3-Clause
#include "Grid/SmokeSeries.h"

#include <algorithm>
#include <cstdlib>
#include <string>

namespace waft
{
namespace
{

constexpr int ShortestCheckpointInterval = 16;
/// Checkpoints take at most this part of the cache.
constexpr double CheckpointFraction = 0.25;

std::size_t SizeOf(const SmokeFrame& frame)
{
  const std::size_t vectors = frame.Velocity.size() + frame.Vorticity.size() +
                              frame.VortexForce.size() + frame.WindForce.size();
  return vectors * 3 * sizeof(float) +
         (frame.Density.size() + frame.Pressure.size()) * sizeof(float) + frame.Obstacle.size();
}

std::size_t SizeOf(const SmokeState& state)
{
  std::size_t size = 0;
  for (const std::vector<float>& array : state.Arrays)
  {
    size += array.size() * sizeof(float);
  }
  return size;
}

} // namespace

Result SmokeSeries::Begin(SmokeSeriesInput input)
{
  this->Input = std::move(input);
  this->Frames.clear();
  this->Checkpoints.clear();
  this->Computed = 0;
  if (Result started = this->Start(); !started)
  {
    return started;
  }
  SmokeFrame frame;
  this->Solver.Read(frame);
  const std::size_t state = SizeOf(this->Solver.Save());
  this->KeepsCheckpoints = state + SizeOf(frame) <= this->Input.CacheLimit;
  const double room = CheckpointFraction * static_cast<double>(this->Input.CacheLimit);
  const double count = std::max(room / static_cast<double>(state), 1.0);
  this->CheckpointInterval =
    std::max(ShortestCheckpointInterval,
             static_cast<int>(std::min(this->Input.NumberOfFrames / count + 1.0, 1e9)));
  return Result::Ok();
}

Result SmokeSeries::Start()
{
  if (Result begun = this->Solver.Begin(this->Input.Options, this->Input.Forces); !begun)
  {
    return begun;
  }
  return this->PlaceSolids(0);
}

Result SmokeSeries::PlaceSolids(int frame)
{
  if (!this->Input.Solids)
  {
    return Result::Ok();
  }
  std::vector<float> distances;
  std::vector<std::array<float, 3>> velocities;
  if (Result made = this->Input.Solids(frame, distances, velocities); !made)
  {
    return made;
  }
  return this->Solver.SetSolids(distances, velocities);
}

Result SmokeSeries::GoBackTo(int frame)
{
  auto checkpoint = this->Checkpoints.upper_bound(frame);
  if (checkpoint == this->Checkpoints.begin())
  {
    return this->Start();
  }
  --checkpoint;
  if (Result restored = this->Solver.Restore(checkpoint->second); !restored)
  {
    return restored;
  }
  return this->Input.SolidsMove ? this->PlaceSolids(checkpoint->first) : Result::Ok();
}

Result SmokeSeries::StepOnce(const ParallelFor& parallelFor, Monitor& monitor)
{
  const int next = this->Solver.Frame() + 1;
  if (this->Input.SolidsMove && next > 0)
  {
    if (Result placed = this->PlaceSolids(next); !placed)
    {
      return placed;
    }
  }
  const Result stepped = this->Solver.Step(parallelFor, monitor);
  if (stepped && !stepped.IsStopped() && this->KeepsCheckpoints &&
      next % this->CheckpointInterval == 0)
  {
    this->Checkpoints.emplace(next, this->Solver.Save());
  }
  return stepped;
}

std::size_t SmokeSeries::BytesKept() const
{
  std::size_t size = 0;
  for (const auto& [frame, fields] : this->Frames)
  {
    size += SizeOf(*fields);
  }
  for (const auto& [frame, state] : this->Checkpoints)
  {
    size += SizeOf(state);
  }
  return size;
}

void SmokeSeries::Evict(int center)
{
  std::size_t kept = this->BytesKept();
  while (kept > this->Input.CacheLimit && this->Frames.size() > 1)
  {
    const auto first = this->Frames.begin();
    const auto last = std::prev(this->Frames.end());
    const auto farthest =
      std::abs(first->first - center) > std::abs(last->first - center) ? first : last;
    kept -= SizeOf(*farthest->second);
    this->Frames.erase(farthest);
  }
}

Result SmokeSeries::At(int frame, const ParallelFor& parallelFor, Monitor& monitor,
                       std::shared_ptr<const SmokeFrame>& fields)
{
  fields.reset();
  if (frame < 0 || frame >= this->Input.NumberOfFrames)
  {
    return Result::Error("Frame " + std::to_string(frame) + " is not one of the " +
                         std::to_string(this->Input.NumberOfFrames));
  }
  if (const auto kept = this->Frames.find(frame); kept != this->Frames.end())
  {
    fields = kept->second;
    return Result::Ok();
  }
  if (this->Solver.Frame() >= frame)
  {
    if (Result back = this->GoBackTo(frame); !back)
    {
      return back;
    }
  }
  const double steps = std::max(frame - this->Solver.Frame(), 1);
  bool isRead = false;
  for (int done = 0; this->Solver.Frame() < frame || !isRead; ++done)
  {
    if (this->Solver.Frame() < frame)
    {
      PartMonitor part(monitor, done / steps, (done + 1.0) / steps);
      const Result stepped = this->StepOnce(parallelFor, part);
      if (!stepped || stepped.IsStopped())
      {
        return stepped;
      }
    }
    auto read = std::make_shared<SmokeFrame>();
    this->Solver.Read(*read);
    fields = read;
    isRead = true;
    ++this->Computed;
    this->Frames[this->Solver.Frame()] = fields;
    this->Evict(this->Solver.Frame());
  }
  return Result::Ok();
}

} // namespace waft
