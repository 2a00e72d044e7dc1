// SPDX-License-Identifier: BSD-3-Clause
// The plans of all objects of one run: what is known of them before, and the flights that are not.
#pragma once

#include "Base/SharedWork.h"
#include "Planning/PlanCache.h"

#include <atomic>
#include <cstddef>
#include <mutex>
#include <string>
#include <vector>

namespace waft
{

/// Each list has one entry an object, in their order.
struct ScenePlans
{
  std::vector<std::vector<int>> OwnRows; // indices of its rows that count, in order
  std::vector<std::string> Keys;         // what its plan depends on; empty without a memory
  std::vector<unsigned char> IsKnown;    // its plan is one of an earlier run
  std::vector<std::atomic<bool>> IsDone; // its plan is whole
  std::vector<ObjectPlan> Plans;
};

/// Of all search trees no more than some first branches are given out. Those of objects that come
/// after so many are dropped as soon as that is known: they would take most of the memory.
class TreeRoom
{
public:
  TreeRoom(const ScenePlans& plans, const PlanOptions& options);
  /// The plan of an object is there. Of any thread.
  void Take(std::size_t object, ObjectPlan& plan);

private:
  std::mutex Guard;
  std::vector<std::size_t> Branches; // by object, or
  static constexpr std::size_t Unknown = ~std::size_t(0);
  std::size_t Leading = 0; // objects, whose branches are all known,
  std::size_t Sum = 0;     // and how many these are at least
  std::size_t Limit;
};

/// isUsed: one a row, whether it is to be met. memory may be null: then nothing is known. Nor is
/// what lacks trees that may have to be given out now.
ScenePlans RecallPlans(const PlanInput& input, const PlanOptions& options,
                       const std::vector<Constraint>& rows,
                       const std::vector<unsigned char>& isUsed, PlanCache* memory);

/// Those that are new and whole.
void KeepPlans(const PlanInput& input, std::uint64_t seed, const ScenePlans& plans,
               PlanCache& memory);

/// Plans all objects whose plans are not known, in parallel, by all ranks. While it lasts, soFar
/// has the paths that are ready, for who asks for them (Monitor::Publishes); in the end it is
/// empty. Stopped by the monitor some plans are not done.
Result FlyUnknown(const PlanInput& input, const PlanOptions& options, const PlanTools& tools,
                  const std::vector<Constraint>& rows, const std::vector<unsigned char>& isUsed,
                  const ParallelFor& parallelFor, Monitor& monitor, ScenePlans& plans,
                  std::vector<Track>& soFar);

inline constexpr const char* PlanKind = "plans";
/// Plans objects for rank 0. atOnce: threads of parallelFor.
Result ServePlans(ReadingStream& inputs, SharedItems& items, int atOnce,
                  const ParallelFor& parallelFor);

} // namespace waft
