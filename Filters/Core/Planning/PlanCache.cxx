// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/PlanCache.h"

#include "Base/StateArchive.h"
#include "Constraints/MotionProblem.h"
#include "Planning/InputCheck.h"

#include <algorithm>
#include <cstdint>

namespace waft
{

namespace
{

/// Of what all plans of a scene have in common besides the database.
std::string SharedKey(const PlanInput& input, const PlanOptions& options)
{
  DigestStream sum;
  const Timeline& time = input.Scene.Time;
  sum.Values(input.Obstacles.Obstacles(), input.Scene.Bounds, time.NumberOfFrames,
             time.FramesPerSecond);
  PlanOptions::VisitStyle(sum, options);
  return sum.Text();
}

std::size_t BytesOf(const ObjectPlan& plan)
{
  std::size_t bytes = sizeof(ObjectPlan) + plan.Positions.size() * sizeof(Vec3) +
                      plan.Uses.size() * sizeof(SegmentUse) +
                      plan.Samples.size() * sizeof(UseSample) +
                      plan.Outcomes.size() * sizeof(MarkOutcome);
  for (const SpanTrees& span : plan.Spans)
  {
    bytes += (span.Trees[0].size() + span.Trees[1].size()) * sizeof(Branch);
  }
  return bytes;
}

} // namespace

std::string PlanKey(const MotionObject& object, const std::vector<Constraint>& rows,
                    const std::vector<int>& own, const std::vector<Guide>& guides)
{
  MemoryStream key;
  key.Values(object);
  std::map<std::pair<int, int>, int> numbers; // of rows by Row and Target, in that order
  for (const int index : own)
  {
    numbers[{ rows[index].Row, rows[index].Target }] = 0;
  }
  int next = 0;
  for (auto& entry : numbers)
  {
    entry.second = next++;
  }
  key.Length(own);
  for (const int index : own)
  {
    Constraint row = rows[index];
    row.Row = numbers[{ row.Row, row.Target }];
    row.Target = 0;
    row.Group = row.ClassId = -1; // it has its object
    key.Values(row);
  }
  for (const Guide& guide : guides)
  {
    if (guide.ObjectId == object.ObjectId)
    {
      key.Values(guide.Points);
    }
  }
  return { key.Content.begin(), key.Content.end() };
}

SegmentLibraryOptions LibraryOptionsOf(const PlanOptions& options, const MotionDatabase& database,
                                       const SceneInfo& scene)
{
  SegmentLibraryOptions library;
  library.Scale = DatabaseScale(database, scene);
  library.FramesPerSecond = scene.Time.FramesPerSecond;
  library.Freedom = options.RotationFreedom;
  library.MaximumTilt = options.MaxTilt;
  library.MaximumConnectionCost = options.ConnectionThreshold;
  return library;
}

Result MakePlanTools(const MotionDatabase& database, const SegmentLibraryOptions& options,
                     const ParallelFor& parallelFor, std::shared_ptr<const PlanTools>& tools)
{
  auto made = std::make_shared<PlanTools>();
  const bool isScaled = options.Scale != 1.0;
  made->Scaled = isScaled ? database.Scaled(options.Scale) : MotionDatabase();
  // What falls is as fast in a small volume.
  made->Scaled.TopSpeed = std::max(made->Scaled.TopSpeed, database.TopSpeed);
  const MotionDatabase& used = isScaled ? made->Scaled : database;
  WAFT_RETURN_IF_FAILED(made->Library.Build(used, options, parallelFor));
  made->Gauge = StyleGauge(used);
  tools = std::move(made);
  return Result::Ok();
}

Result PlanCache::Tools(const PlanInput& input, const SegmentLibraryOptions& options,
                        const ParallelFor& parallelFor, std::shared_ptr<const PlanTools>& tools)
{
  MemoryStream key;
  const auto address = reinterpret_cast<std::uintptr_t>(&input.Database);
  key.Values(address, options.FramesPerSecond, options.Scale, options.Freedom, options.MaximumTilt,
             options.MaximumConnectionCost, options.MinimumNumberOfNeighbours,
             options.RoughConnectionFactor);
  const std::string wanted =
    this->DatabaseKey + std::string(key.Content.begin(), key.Content.end());
  if (!this->KeptTools || wanted != this->ToolsKey)
  {
    this->KeptTools.reset();
    WAFT_RETURN_IF_FAILED(MakePlanTools(input.Database, options, parallelFor, this->KeptTools));
    this->ToolsKey = wanted;
  }
  tools = this->KeptTools;
  return Result::Ok();
}

void PlanCache::Begin(const PlanInput& input, const PlanOptions& options)
{
  DigestStream database;
  database.Values(input.Database);
  this->DatabaseKey = database.Text();
  const std::string shared = this->DatabaseKey + SharedKey(input, options);
  if (shared != this->Shared)
  {
    this->Plans.clear();
    this->Used = 0;
    this->Shared = shared;
  }
}

const ObjectPlan* PlanCache::Find(std::uint64_t seed, int objectId, const std::string& key)
{
  const auto found = this->Plans.find({ seed, objectId });
  if (found == this->Plans.end() || found->second.Key != key)
  {
    return nullptr;
  }
  found->second.LastUse = ++this->Clock;
  return &found->second.Plan;
}

void PlanCache::Keep(std::uint64_t seed, int objectId, const std::string& key,
                     const ObjectPlan& plan)
{
  Entry& entry = this->Plans[{ seed, objectId }];
  this->Used -= entry.Bytes;
  entry = { key, plan, BytesOf(plan), ++this->Clock };
  this->Used += entry.Bytes;
  while (this->Used > this->Limit && !this->Plans.empty())
  {
    this->DropOldest();
  }
}

void PlanCache::DropOldest()
{
  const auto oldest = std::min_element(this->Plans.begin(), this->Plans.end(),
                                       [](const auto& a, const auto& b)
                                       { return a.second.LastUse < b.second.LastUse; });
  this->Used -= oldest->second.Bytes;
  this->Plans.erase(oldest);
}

} // namespace waft
