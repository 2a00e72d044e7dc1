// SPDX-License-Identifier: BSD-3-Clause
// Plans of objects that are kept from one run to the next.
#pragma once

#include "Constraints/Constraint.h"
#include "Planning/ObjectPlan.h"
#include "Planning/Planner.h"
#include "Planning/SegmentLibrary.h"
#include "Planning/StyleGauge.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>

namespace waft
{

/// All that the plan of one object depends on besides what all objects have in common, byte by
/// byte: the object, its own rows that count (`own`: their indices in the list, in order; numbered
/// among themselves, since other rows shift their numbers) and its guide.
std::string PlanKey(const MotionObject& object, const std::vector<Constraint>& rows,
                    const std::vector<int>& own, const std::vector<Guide>& guides);

/// The database as plans use it.
struct PlanTools
{
  MotionDatabase Scaled; // empty where the database serves as it is
  SegmentLibrary Library;
  StyleGauge Gauge;
};

SegmentLibraryOptions LibraryOptionsOf(const PlanOptions& options, const MotionDatabase& database,
                                       const SceneInfo& scene);
/// Builds them; fails as SegmentLibrary does.
Result MakePlanTools(const MotionDatabase& database, const SegmentLibraryOptions& options,
                     const ParallelFor& parallelFor, std::shared_ptr<const PlanTools>& tools);

/// Keeps one plan for each Seed and ObjectId, the latest. What was not used for longest is dropped
/// beyond a limit of memory. Keeps the tools, too, while the database stays where it is.
class PlanCache
{
public:
  explicit PlanCache(std::size_t limit = std::size_t(256) << 20) : Limit(limit) {}

  /// Before the plans of one run are asked for: forgets all when what they have in common has
  /// changed: database, obstacles with their motions, volume and time, all options but the Seed.
  /// Known by digests of 128 bits.
  void Begin(const PlanInput& input, const PlanOptions& options);
  /// After Begin: the tools of the last run, or new ones when the database or its address
  /// is another.
  Result Tools(const PlanInput& input, const SegmentLibraryOptions& options,
               const ParallelFor& parallelFor, std::shared_ptr<const PlanTools>& tools);
  /// The plan of this key, or null. Constraint of its outcomes counts the object's own rows.
  const ObjectPlan* Find(std::uint64_t seed, int objectId, const std::string& key);
  void Keep(std::uint64_t seed, int objectId, const std::string& key, const ObjectPlan& plan);

  std::size_t Size() const { return this->Plans.size(); }
  std::size_t Bytes() const { return this->Used; }

private:
  struct Entry
  {
    std::string Key;
    ObjectPlan Plan;
    std::size_t Bytes = 0;
    std::uint64_t LastUse = 0;
  };
  void DropOldest();

  std::size_t Limit;
  std::size_t Used = 0;
  std::uint64_t Clock = 0;
  std::string Shared;
  std::string ToolsKey; // of the database, its address and the options of its library
  std::string DatabaseKey;
  std::shared_ptr<const PlanTools> KeptTools;
  std::map<std::pair<std::uint64_t, int>, Entry> Plans;
};

} // namespace waft
