// SPDX-License-Identifier: BSD-3-Clause
// A run of the smoke solver whose frames may be asked for in any order.
#pragma once

#include "Grid/SmokeSolver.h"

#include <functional>
#include <map>
#include <memory>

namespace waft
{

/// The solids as they stand at a frame, for SmokeSolver::SetSolids.
using SolidsAtFrame = std::function<Result(int frame, std::vector<float>& distances,
                                           std::vector<std::array<float, 3>>& velocities)>;

struct SmokeSeriesInput
{
  SmokeOptions Options;
  SmokeForces Forces;
  SolidsAtFrame Solids; // empty: none
  bool SolidsMove = false;
  int NumberOfFrames = 300;
  std::size_t CacheLimit = std::size_t(2048) << 20; // bytes of frames and checkpoints kept
};

/// Computes frames when they are first asked for and keeps those nearest to the last one asked for,
/// as many as CacheLimit holds; the others are computed again from checkpoints, to the same bits.
/// One frame is kept whatever the limit, without checkpoints when there is no room beside it.
class SmokeSeries
{
public:
  Result Begin(SmokeSeriesInput input);
  /// The fields at a frame, 0 <= frame < NumberOfFrames. Stopped by the monitor, `fields` is the
  /// last frame that was reached, or null.
  Result At(int frame, const ParallelFor& parallelFor, Monitor& monitor,
            std::shared_ptr<const SmokeFrame>& fields);
  /// Bytes of frames and checkpoints kept at present.
  std::size_t BytesKept() const;
  /// Frames that were computed since Begin, those computed again included.
  int FramesComputed() const { return this->Computed; }

private:
  Result Start();
  Result PlaceSolids(int frame);
  Result GoBackTo(int frame);
  Result StepOnce(const ParallelFor& parallelFor, Monitor& monitor);
  void Evict(int center);

  SmokeSeriesInput Input;
  SmokeSolver Solver;
  std::map<int, std::shared_ptr<const SmokeFrame>> Frames;
  std::map<int, SmokeState> Checkpoints;
  bool KeepsCheckpoints = true;
  int CheckpointInterval = 16;
  int Computed = 0;
};

} // namespace waft
