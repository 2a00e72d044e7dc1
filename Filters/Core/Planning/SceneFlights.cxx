// SPDX-License-Identifier: BSD-3-Clause
// All objects of a run that are to fly, planned by threads and other ranks while the caller's
// thread ticks the monitor.
#include "Planning/FreeSpaceGrids.h"
#include "Planning/Itinerary.h"
#include "Planning/PlannerNumbers.h"
#include "Planning/ScenePlans.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <shared_mutex>
#include <string>
#include <thread>
#include <utility>

namespace waft
{

namespace
{

/// What the threads that plan and the one that ticks the monitor report to each other.
struct FlightWatch
{
  std::atomic<std::size_t> Done{ 0 };
  std::atomic<bool> Stop{ false };
  std::shared_mutex Holding; // locked during a tick, which may last
};

/// Runs the work in a thread of its own while the caller's ticks the monitor; before each tick
/// `between` is called, which tells whether something is done elsewhere still.
void RunWhileTicking(const std::function<void()>& work, std::size_t count,
                     const std::function<bool()>& between, std::chrono::milliseconds period,
                     Monitor& monitor, FlightWatch& watch)
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
  bool isElsewhere = false;
  while (!ended.wait_for(lock, period, [&]() { return hasEnded && !isElsewhere; }))
  {
    isElsewhere = between() && !watch.Stop;
    const std::size_t planned = watch.Done;
    const std::unique_lock<std::shared_mutex> hold(watch.Holding);
    const bool goesOn = monitor.Tick(
      0.05 + 0.9 * static_cast<double>(planned) / static_cast<double>(count),
      "Planned " + std::to_string(planned) + " of " + std::to_string(count) + " objects");
    watch.Stop = watch.Stop || !goesOn;
  }
  lock.unlock();
  worker.join();
}

/// What the flights of all objects have in common.
ObjectPlanOptions SharedOptions(const PlanInput& input, const PlanOptions& options,
                                const PlanTools& tools, const std::atomic<bool>& stop)
{
  const double width = input.Scene.Bounds.Width();
  ObjectPlanOptions flight;
  flight.Seed = options.Seed;
  flight.Tolerance = PlannerNumbers::Tolerance * width;
  flight.Span.RetimingLimit = options.RetimingLimit;
  flight.Span.JoinThreshold = options.JoinThreshold;
  flight.Span.Margin = PlannerNumbers::GrowingMargin * width;
  flight.Span.CheckMargin = PlannerNumbers::CheckMargin * width;
  flight.Span.MaximumNumberOfBranches = options.MaximumNumberOfBranches;
  flight.Span.NumberOfCandidates = options.NumberOfCandidates;
  flight.Span.GuideWeight = options.GuideWeight;
  flight.Span.FrameStep = input.Scene.Time.Step();
  flight.Span.Stop = &stop;
  flight.Span.Gauge = &tools.Gauge;
  return flight;
}

/// Where an object is to be, and the guide that it follows on the way.
Itinerary GuidedItinerary(const PlanInput& input, const MotionObject& object,
                          const std::vector<Constraint>& rows,
                          const std::vector<unsigned char>& isUsed, double guideWeight)
{
  Itinerary itinerary = MakeItinerary(object, rows, isUsed, input.Obstacles, input.Scene);
  for (const Guide& guide : input.Guides)
  {
    if (guide.ObjectId == object.ObjectId && guideWeight > 0.0)
    {
      itinerary.Follow(guide.Points, PlannerNumbers::GuideEnd * input.Scene.Bounds.Width(),
                       input.Scene);
    }
  }
  return itinerary;
}

/// Flights of a scene's objects, of any thread.
class Flights
{
public:
  Flights(const PlanInput& input, const PlanOptions& options, const PlanTools& tools,
          const std::vector<Constraint>& rows, const std::vector<unsigned char>& isUsed,
          FlightWatch& watch) :
    Input(input),
    Rows(rows), IsUsed(isUsed), GuideWeight(options.GuideWeight), Library(tools.Library),
    Shared(SharedOptions(input, options, tools, watch.Stop)),
    Rooms(input.Obstacles, input.Scene.Bounds, input.Objects, Shared.Span.Margin, watch.Stop),
    Watch(watch)
  {
  }

  /// Whole unless the watch is stopped meanwhile. Waits before it begins while that is held.
  ObjectPlan Fly(std::size_t i)
  {
    {
      const std::shared_lock<std::shared_mutex> wait(this->Watch.Holding);
    }
    const MotionObject& object = this->Input.Objects[i];
    ObjectPlanOptions own = this->Shared;
    own.Span.Rooms = [this, &object](int level) { return this->Rooms.Of(object, level); };
    const Itinerary itinerary =
      GuidedItinerary(this->Input, object, this->Rows, this->IsUsed, this->GuideWeight);
    return PlanObject(this->Library, object, itinerary, this->Input.Obstacles, this->Input.Scene,
                      own);
  }

private:
  const PlanInput& Input;
  const std::vector<Constraint>& Rows;
  const std::vector<unsigned char>& IsUsed;
  double GuideWeight;
  const SegmentLibrary& Library;
  ObjectPlanOptions Shared;
  FreeSpaceGrids Rooms;
  FlightWatch& Watch;
};

/// Adds the paths that are ready and not yet published.
void PublishReady(const std::vector<MotionObject>& objects, const ScenePlans& plans,
                  std::vector<char>& isPublished, std::vector<Track>& soFar)
{
  for (std::size_t i = 0; i < objects.size(); ++i)
  {
    if (isPublished[i] == 0 && plans.IsDone[i])
    {
      isPublished[i] = 1;
      soFar.emplace_back();
      soFar.back().ObjectId = objects[i].ObjectId;
      soFar.back().Positions = plans.Plans[i].Positions;
    }
  }
}

/// All that plans of other ranks depend on.
template <class Database, class Objects, class Rows, class Used, class Obstacles, class Scene,
          class Guides, class Options>
void MoveJob(StateArchive& stream, Database& database, Objects& objects, Rows& rows, Used& isUsed,
             Obstacles& obstacles, Scene& scene, Guides& guides, Options& options)
{
  stream.Values(database, objects, rows, isUsed, obstacles, scene, guides);
  PlanOptions::Visit(stream, options);
}

/// Objects that are to be planned, handed out from the first to the last to threads and ranks.
class Queue
{
public:
  explicit Queue(std::vector<std::size_t> objects) : Objects(std::move(objects)) {}
  std::size_t Size() const { return this->Objects.size(); }
  bool Next(std::size_t& object)
  {
    const std::size_t k = this->Begun++;
    if (k < this->Objects.size())
    {
      object = this->Objects[k];
    }
    return k < this->Objects.size();
  }
  /// Fewer towards the end, so that all ranks end together.
  std::vector<std::int64_t> Some(std::int64_t most, int ranks)
  {
    const auto begun = static_cast<std::int64_t>(std::min(this->Begun.load(), this->Size()));
    const std::int64_t left = static_cast<std::int64_t>(this->Size()) - begun;
    const std::int64_t count = std::clamp<std::int64_t>(left / (2 * ranks), 1, most);
    std::vector<std::int64_t> some;
    for (std::size_t object = 0;
         static_cast<std::int64_t>(some.size()) < count && this->Next(object);)
    {
      some.push_back(static_cast<std::int64_t>(object));
    }
    return some;
  }

private:
  std::vector<std::size_t> Objects;
  std::atomic<std::size_t> Begun{ 0 };
};

} // namespace

Result FlyUnknown(const PlanInput& input, const PlanOptions& options, const PlanTools& tools,
                  const std::vector<Constraint>& rows, const std::vector<unsigned char>& isUsed,
                  const ParallelFor& parallelFor, Monitor& monitor, ScenePlans& plans,
                  std::vector<Track>& soFar)
{
  std::vector<std::size_t> unknown;
  for (std::size_t i = 0; i < input.Objects.size(); ++i)
  {
    if (plans.IsKnown[i] == 0)
    {
      unknown.push_back(i);
    }
  }
  if (unknown.empty())
  {
    return Result::Ok();
  }
  FlightWatch watch;
  Flights flights(input, options, tools, rows, isUsed, watch);
  Queue queue(std::move(unknown));
  TreeRoom trees(plans, options);
  const auto keep = [&](std::size_t i, ObjectPlan plan)
  {
    trees.Take(i, plan);
    plans.Plans[i] = std::move(plan);
    plans.IsDone[i] = !watch.Stop;
    ++watch.Done;
  };
  const auto flySome = [&](std::size_t begin, std::size_t end)
  {
    std::size_t object = 0;
    for (std::size_t k = begin; k < end && !watch.Stop && queue.Next(object); ++k)
    {
      keep(object, flights.Fly(object));
    }
  };

  SingleRank alone;
  Communicator& ranks = input.Ranks != nullptr && queue.Size() > 1 ? *input.Ranks : alone;
  MemoryStream job;
  if (ranks.Size() > 1)
  {
    MoveJob(job, input.Database, input.Objects, rows, isUsed, input.Obstacles.Obstacles(),
            input.Scene, input.Guides, options);
  }
  WorkSharing others(ranks, PlanKind, job);
  Result shared = Result::Ok();
  std::vector<char> isPublished(input.Objects.size(), 0);
  const auto between = [&]()
  {
    shared = others.Look([&](std::int64_t most) { return queue.Some(most, ranks.Size()); },
                         [&](std::int64_t object, ReadingStream& stream)
                         {
                           ObjectPlan plan;
                           stream.Values(plan);
                           keep(static_cast<std::size_t>(object), std::move(plan));
                           return Result::Ok();
                         });
    watch.Stop = watch.Stop || !shared;
    if (monitor.Publishes())
    {
      PublishReady(input.Objects, plans, isPublished, soFar);
    }
    return others.Away() > 0;
  };
  RunWhileTicking([&]() { parallelFor(queue.Size(), flySome); }, queue.Size(), between,
                  std::chrono::milliseconds(ranks.Size() > 1 ? 5 : 50), monitor, watch);
  soFar.clear();
  return !shared ? shared : watch.Stop ? Result::Stopped() : Result::Ok();
}

Result ServePlans(ReadingStream& inputs, SharedItems& items, int atOnce,
                  const ParallelFor& parallelFor)
{
  MotionDatabase database;
  std::vector<MotionObject> objects;
  std::vector<Constraint> rows;
  std::vector<unsigned char> isUsed;
  std::vector<ObstacleMesh> meshes;
  ObstacleSet obstacles;
  PlanInput input{ database, objects, rows, obstacles, SceneInfo() };
  PlanOptions options;
  MoveJob(inputs, database, objects, rows, isUsed, meshes, input.Scene, input.Guides, options);
  WAFT_RETURN_IF_FAILED(obstacles.Build(meshes));
  std::shared_ptr<const PlanTools> tools;
  WAFT_RETURN_IF_FAILED(
    MakePlanTools(database, LibraryOptionsOf(options, input.Scene), parallelFor, tools));
  FlightWatch watch;
  Flights flights(input, options, *tools, rows, isUsed, watch);
  SilentMonitor silent;
  while (!watch.Stop)
  {
    const std::vector<std::int64_t> some = items.Take(4 * atOnce, true);
    if (some.empty())
    {
      break;
    }
    std::vector<ObjectPlan> plans(some.size());
    const auto fly = [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t k = begin; k < end && !watch.Stop; ++k)
      {
        plans[k] = flights.Fly(static_cast<std::size_t>(some[k]));
      }
    };
    RunWhileTicking([&]() { parallelFor(some.size(), fly); }, some.size(),
                    [&]()
                    {
                      watch.Stop = items.IsOver();
                      return false;
                    },
                    std::chrono::milliseconds(20), silent, watch);
    watch.Stop = items.IsOver();
    for (std::size_t k = 0; k < some.size() && !watch.Stop; ++k)
    {
      MemoryStream result;
      result.Values(plans[k]);
      items.Give(some[k], std::move(result.Content));
    }
  }
  return Result::Ok();
}

} // namespace waft
