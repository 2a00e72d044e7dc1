// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/Planner.h"

#include "Constraints/ConstraintCheck.h"
#include "Constraints/Keyframes.h"
#include "Planning/InputCheck.h"
#include "Planning/ObjectPlan.h"
#include "Planning/PlanCache.h"
#include "Planning/PlanReport.h"
#include "Planning/PlannerNumbers.h"
#include "Planning/RowConflicts.h"
#include "Planning/RowCover.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <string>
#include <thread>

namespace waft
{

namespace
{

/// Runs the work in a thread of its own while the caller's ticks the monitor. Holding is locked
/// during a tick, which may last; before it, `show` is called.
void RunWhileTicking(const std::function<void()>& work, std::size_t count,
                     const std::atomic<std::size_t>& done, std::atomic<bool>& stop,
                     std::shared_mutex& holding, const std::function<void()>& show,
                     Monitor& monitor)
{
  std::mutex mutex;
  std::condition_variable ended;
  bool hasEnded = false;
  std::thread worker(
    [&]()
    {
      work();
      const std::lock_guard<std::mutex> lock(mutex);
      hasEnded = true;
      ended.notify_one();
    });
  std::unique_lock<std::mutex> lock(mutex);
  while (!ended.wait_for(lock, std::chrono::milliseconds(50), [&]() { return hasEnded; }))
  {
    const std::size_t planned = done;
    show();
    const std::unique_lock<std::shared_mutex> hold(holding);
    const bool goesOn = monitor.Tick(
      0.05 + 0.9 * static_cast<double>(planned) / static_cast<double>(count),
      "Planned " + std::to_string(planned) + " of " + std::to_string(count) + " objects");
    stop = stop || !goesOn;
  }
  lock.unlock();
  worker.join();
}

/// Maps for each size of object, coarse and fine, made when first asked for.
class FreeSpaceGrids
{
public:
  FreeSpaceGrids(const PlanInput& input, double margin, const std::atomic<bool>& stop) :
    Input(input), Margin(margin), Stop(stop)
  {
    // Where obstacles move a map tells nothing.
    if (!input.Obstacles.IsEmpty() && !input.Obstacles.HasMoving())
    {
      for (const MotionObject& object : input.Objects)
      {
        this->Maps[object.ClearanceRadius]; // made here, since threads only look up
      }
    }
  }
  const FreeSpaceGrid* Of(const MotionObject& object, int level)
  {
    const auto entry = this->Maps.find(object.ClearanceRadius);
    if (entry == this->Maps.end() || level >= static_cast<int>(PlannerNumbers::MapCells.size()))
    {
      return nullptr;
    }
    LazyMap& lazy = entry->second[static_cast<std::size_t>(level)];
    std::call_once(lazy.Once,
                   [&]()
                   {
                     lazy.Map = std::make_unique<FreeSpaceGrid>(
                       this->Input.Obstacles, this->Input.Scene.Bounds,
                       object.ClearanceRadius + this->Margin,
                       PlannerNumbers::MapCells[static_cast<std::size_t>(level)], this->Stop);
                   });
    return lazy.Map.get();
  }

private:
  struct LazyMap
  {
    std::once_flag Once;
    std::unique_ptr<FreeSpaceGrid> Map;
  };
  const PlanInput& Input;
  double Margin;
  const std::atomic<bool>& Stop;
  std::map<double, std::array<LazyMap, PlannerNumbers::MapCells.size()>> Maps;
};

void StoreTrees(const SegmentLibrary& library, int objectId, const std::vector<SpanTrees>& spans,
                std::size_t limit, std::vector<TreeBranch>& output)
{
  for (std::size_t s = 0; s < spans.size(); ++s)
  {
    for (int tree = 0; tree < 2; ++tree)
    {
      const auto base = static_cast<int>(output.size());
      for (const Branch& branch : spans[s].Trees[tree])
      {
        if (output.size() >= limit)
        {
          return;
        }
        TreeBranch stored;
        stored.ObjectId = objectId;
        stored.Span = static_cast<int>(s);
        stored.Tree = tree;
        stored.Parent = branch.Parent < 0 ? -1 : base + branch.Parent;
        stored.Segment = branch.Body.Segment;
        stored.Cost = branch.Cost;
        stored.Frame =
          tree == 0 ? spans[s].FirstFrame + branch.Elapsed : spans[s].LastFrame - branch.Elapsed;
        const std::vector<Vec3>& samples = library.Samples(branch.Body.Segment);
        for (int k = branch.Body.First; k <= branch.Body.Last; ++k)
        {
          stored.Points.push_back(branch.Body.Transform * samples[k]);
        }
        output.push_back(std::move(stored));
      }
    }
  }
}

/// One a row: does it bind, as far as the report says?
std::vector<unsigned char> FindBinding(const PlanOutput& output)
{
  std::vector<unsigned char> isBinding;
  for (const Constraint& row : output.Constraints)
  {
    isBinding.push_back(IsBinding(row, output.Report) ? 1 : 0);
  }
  return isBinding;
}

/// Sets Constraints and Report; returns for each row whether it is to be met.
std::vector<unsigned char> AssignAndJudge(const PlanInput& input, const SegmentLibrary& library,
                                          PlanOutput& output)
{
  const SpeedLimit limit(library.TopStep(), library.Options().FramesPerSecond,
                         library.ShortestSpan(),
                         PlannerNumbers::SamePosition * input.Scene.Bounds.Width());
  const auto judge = [&]()
  {
    output.Report =
      JudgeWithSpeeds(output.Constraints, input.Objects, input.Obstacles, input.Scene, limit);
    return FindBinding(output);
  };
  output.Constraints = input.Constraints;
  AssignKeyframes(input.Objects, output.Constraints);
  std::vector<unsigned char> isUsed = judge();
  if (std::any_of(output.Constraints.begin(), output.Constraints.end(),
                  [](const Constraint& row) { return row.ObjectId < 0; }))
  {
    CoverRows(input.Objects, isUsed, input.Obstacles, limit, output.Constraints);
    isUsed = judge();
  }
  return isUsed;
}

/// For each object the indices of its rows that count.
std::vector<std::vector<int>> OwnRows(const std::vector<MotionObject>& objects,
                                      const std::vector<Constraint>& rows,
                                      const std::vector<unsigned char>& isUsed)
{
  std::map<int, std::vector<int>> byId;
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    if (isUsed[i] != 0)
    {
      byId[rows[i].ObjectId].push_back(static_cast<int>(i));
    }
  }
  std::vector<std::vector<int>> own;
  for (const MotionObject& object : objects)
  {
    own.push_back(byId[object.ObjectId]);
  }
  return own;
}

/// A kept plan whose outcomes name indices in the list of all rows again.
ObjectPlan WithRows(ObjectPlan plan, const std::vector<int>& own)
{
  for (MarkOutcome& outcome : plan.Outcomes)
  {
    outcome.Constraint =
      outcome.Constraint < 0 ? -1 : own[static_cast<std::size_t>(outcome.Constraint)];
  }
  return plan;
}

/// The other way: outcomes count the object's own rows, whose indices in the list may change.
ObjectPlan WithOrdinals(ObjectPlan plan, const std::vector<int>& own)
{
  for (MarkOutcome& outcome : plan.Outcomes)
  {
    const auto found = std::lower_bound(own.begin(), own.end(), outcome.Constraint);
    outcome.Constraint = outcome.Constraint < 0 ? -1 : static_cast<int>(found - own.begin());
  }
  return plan;
}

} // namespace

Result PlanMotion(const PlanInput& input, const PlanOptions& options,
                  const ParallelFor& parallelFor, Monitor& monitor, PlanOutput& output,
                  PlanCache* memory)
{
  output = PlanOutput();
  if (Result valid = options.Validate(); !valid)
  {
    return valid;
  }
  if (Result valid = CheckPlanInput(input); !valid)
  {
    return valid;
  }
  SegmentLibraryOptions libraryOptions;
  libraryOptions.FramesPerSecond = input.Scene.Time.FramesPerSecond;
  libraryOptions.Freedom = options.RotationFreedom;
  libraryOptions.MaximumTilt = options.MaxTilt;
  libraryOptions.MaximumConnectionCost = options.ConnectionThreshold;
  std::shared_ptr<const PlanTools> tools;
  if (memory != nullptr)
  {
    memory->Begin(input, options);
  }
  WAFT_RETURN_IF_FAILED(memory != nullptr
                          ? memory->Tools(input, libraryOptions, parallelFor, tools)
                          : MakePlanTools(input.Database, libraryOptions, parallelFor, tools));
  const SegmentLibrary& library = tools->Library;
  if (!monitor.Tick(0.02, "Assigning objects to targets"))
  {
    return Result::Stopped();
  }
  const std::vector<unsigned char> isUsed = AssignAndJudge(input, library, output);

  ObjectPlanOptions objectOptions;
  const double width = input.Scene.Bounds.Width();
  objectOptions.Seed = options.Seed;
  objectOptions.Tolerance = PlannerNumbers::Tolerance * width;
  objectOptions.Span.RetimingLimit = options.RetimingLimit;
  objectOptions.Span.JoinThreshold = options.JoinThreshold;
  objectOptions.Span.Margin = PlannerNumbers::GrowingMargin * width;
  objectOptions.Span.CheckMargin = PlannerNumbers::CheckMargin * width;
  objectOptions.Span.MaximumNumberOfBranches = options.MaximumNumberOfBranches;
  objectOptions.Span.NumberOfCandidates = options.NumberOfCandidates;
  objectOptions.Span.GuideWeight = options.GuideWeight;
  objectOptions.Span.FrameStep = input.Scene.Time.Step();
  objectOptions.Span.Gauge = &tools->Gauge;
  const std::size_t count = input.Objects.size();
  std::vector<ObjectPlan> plans(count);
  std::vector<std::atomic<bool>> isDone(count);
  std::atomic<std::size_t> done{ 0 };
  std::shared_mutex holding;
  // Who wants the rows judged and nothing flown stops here: the first flight may take long.
  std::atomic<bool> stop{ !monitor.Tick(0.04, "Planning") };
  objectOptions.Span.Stop = &stop;
  FreeSpaceGrids rooms(input, objectOptions.Span.Margin, stop);
  std::vector<unsigned char> isKnown(count, 0);
  std::vector<std::vector<int>> ownRows = OwnRows(input.Objects, output.Constraints, isUsed);
  std::vector<std::string> keys(memory != nullptr ? count : 0);
  std::vector<std::size_t> unknown; // objects to plan
  for (std::size_t i = 0; i < count; ++i)
  {
    if (memory != nullptr)
    {
      keys[i] = PlanKey(input.Objects[i], output.Constraints, ownRows[i], input.Guides);
      const ObjectPlan* known = memory->Find(options.Seed, input.Objects[i].ObjectId, keys[i]);
      if (known != nullptr)
      {
        plans[i] = WithRows(*known, ownRows[i]);
        isKnown[i] = 1;
        isDone[i] = true;
        continue;
      }
    }
    unknown.push_back(i);
  }
  const auto planRange = [&](std::size_t begin, std::size_t end)
  {
    for (std::size_t k = begin; k < end && !stop; ++k)
    {
      {
        const std::shared_lock<std::shared_mutex> wait(holding);
      }
      const std::size_t i = unknown[k];
      ObjectPlanOptions own = objectOptions;
      own.Span.Rooms = [&rooms, &input, i](int level) { return rooms.Of(input.Objects[i], level); };
      Itinerary itinerary =
        MakeItinerary(input.Objects[i], output.Constraints, isUsed, input.Obstacles, input.Scene);
      for (const Guide& guide : input.Guides)
      {
        if (guide.ObjectId == input.Objects[i].ObjectId && options.GuideWeight > 0.0)
        {
          itinerary.Follow(guide.Points, PlannerNumbers::GuideEnd * width, input.Scene);
        }
      }
      plans[i] =
        PlanObject(library, input.Objects[i], itinerary, input.Obstacles, input.Scene, own);
      isDone[i] = !stop;
      ++done;
    }
  };
  std::vector<char> isShown(count, 0);
  const auto show = [&]()
  {
    for (std::size_t i = 0; monitor.ShowsSoFar() && i < count; ++i)
    {
      if (isShown[i] == 0 && isDone[i])
      {
        isShown[i] = 1;
        output.Tracks.emplace_back();
        output.Tracks.back().ObjectId = input.Objects[i].ObjectId;
        output.Tracks.back().Positions = plans[i].Positions;
      }
    }
  };
  if (!unknown.empty())
  {
    RunWhileTicking([&]() { parallelFor(unknown.size(), planRange); }, unknown.size(), done, stop,
                    holding, show, monitor);
  }
  output.Tracks.clear();
  const bool stopped = stop;
  for (const std::size_t i : unknown)
  {
    if (memory != nullptr && isDone[i])
    {
      memory->Keep(options.Seed, input.Objects[i].ObjectId, keys[i],
                   WithOrdinals(plans[i], ownRows[i]));
    }
  }

  // In the order of the objects, so that ids do not depend on threads.
  for (std::size_t i = 0; i < count; ++i)
  {
    if (!isDone[i])
    {
      continue;
    }
    Track track;
    track.ObjectId = input.Objects[i].ObjectId;
    track.Positions = std::move(plans[i].Positions);
    Annotate(library, plans[i].Uses, plans[i].Samples, input.Scene.Time.FramesPerSecond, track,
             output.Vortices);
    output.Tracks.push_back(std::move(track));
    StoreTrees(library, input.Objects[i].ObjectId, plans[i].Spans,
               static_cast<std::size_t>(std::max(0, options.MaximumNumberOfStoredBranches)),
               output.Trees);
    ReportObject(input.Objects[i], plans[i], isKnown[i] == 0, output);
  }
  ReportStarts(input, output);
  MarkUnmet(output.Report, output.Constraints);
  MeasureResiduals(output.Constraints, output.Tracks, input.Objects, input.Obstacles, input.Scene,
                   output.Report);
  CountLines(output);
  return stopped ? Result::Stopped() : Result::Ok();
}

} // namespace waft
