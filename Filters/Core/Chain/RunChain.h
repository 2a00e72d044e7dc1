// SPDX-License-Identifier: BSD-3-Clause
// From a scene to bodies that fly: all stages, in one call.
//
//   Scene scene;  SceneWind wind;  MotionDatabase database;
//   ReadSceneAndWind("feather.waft.json", BuiltinAssets(), scene, wind);
//   Motion motion;
//   RunChain({ scene, wind, database }, ChainOptions::At(Quality::Preview), SerialFor(), monitor,
//            motion);
#pragma once

#include "Air/Run/AssimilationState.h"
#include "Base/Communicator.h"
#include "Base/Monitor.h"
#include "Base/Parallel.h"
#include "Base/Result.h"
#include "Chain/ChainOptions.h"
#include "Chain/ChainScene.h"
#include "Chain/Motion.h"
#include "Planning/PlanCache.h"
#include "Trajectory/MotionDatabase.h"

#include <cstdint>
#include <functional>
#include <map>
#include <string>

namespace waft
{

struct ChainInputs
{
  const Scene& TheScene;
  const SceneWind& Wind;
  const MotionDatabase& Database;
  /// Those besides rank 0 are in Serve meanwhile (Base/SharedWork.h); null: rank 0 alone.
  Communicator* Ranks = nullptr;
  DrawnAirs Drawn = {};
  /// Called before a stage works.
  std::function<void(ChainStage stage)> Begins = {};
  /// Called when a stage has worked, but for one that was stopped while it planned; a failure ends
  /// the run.
  std::function<Result(ChainStage stage)> Ended = {};
};

/// What runs leave for the next ones: outputs whose inputs and options are the same are not made
/// again, and stages go on from what they know where only some of it changed.
struct ChainMemory
{
  std::map<ChainStage, std::uint64_t> Keys; // digests of what the outputs in a Motion were made of
  PlanCache Plans;
  AssimilationState Air;
};

/// Runs the stages of a quality up to StopAfter. motion: empty, or what the last run with the same
/// memory left. The same bits on any number of threads. Fails as the stages do, and before anything
/// is planned where the optimiser would have no room for the scene; the error leaves in motion what
/// is done already. Stopped, by the monitor or at the TimeLimit, no stage begins but the rotation:
/// the motion so far is turned, and IsStopped says so. For a monitor that publishes, motion
/// is written as the stages go.
Result RunChain(const ChainInputs& inputs, const ChainOptions& options, const ParallelFor& parallel,
                Monitor& monitor, Motion& motion, ChainMemory* memory = nullptr);

/// Tells runs apart: two of one digest are the same motion. What changes nothing of it (limits of
/// time and memory, files of states) is not in it, nor are the database and the air that EditOf
/// names.
std::string DigestOfRun(const Scene& scene, const SceneWind& wind, const ChainOptions& options);

} // namespace waft
