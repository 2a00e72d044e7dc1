// SPDX-License-Identifier: BSD-3-Clause
// All objects of a run that are to fly, planned by threads while the caller's ticks the monitor.
#include "Planning/FreeSpaceGrids.h"
#include "Planning/Itinerary.h"
#include "Planning/PlannerNumbers.h"
#include "Planning/ScenePlans.h"

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <shared_mutex>
#include <string>
#include <thread>

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

/// Runs the work in a thread of its own while the caller's ticks the monitor; before each tick,
/// `publish` is called.
void RunWhileTicking(const std::function<void()>& work, std::size_t count,
                     const std::function<void()>& publish, Monitor& monitor, FlightWatch& watch)
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
    const std::size_t planned = watch.Done;
    publish();
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

} // namespace

bool FlyUnknown(const PlanInput& input, const PlanOptions& options, const PlanTools& tools,
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
    return true;
  }
  FlightWatch watch;
  const ObjectPlanOptions shared = SharedOptions(input, options, tools, watch.Stop);
  FreeSpaceGrids rooms(input.Obstacles, input.Scene.Bounds, input.Objects, shared.Span.Margin,
                       watch.Stop);
  const auto fly = [&](std::size_t i)
  {
    const MotionObject& object = input.Objects[i];
    ObjectPlanOptions own = shared;
    own.Span.Rooms = [&rooms, &object](int level) { return rooms.Of(object, level); };
    const Itinerary itinerary = GuidedItinerary(input, object, rows, isUsed, options.GuideWeight);
    plans.Plans[i] =
      PlanObject(tools.Library, object, itinerary, input.Obstacles, input.Scene, own);
    plans.IsDone[i] = !watch.Stop;
    ++watch.Done;
  };
  const auto flyRange = [&](std::size_t begin, std::size_t end)
  {
    for (std::size_t k = begin; k < end && !watch.Stop; ++k)
    {
      {
        const std::shared_lock<std::shared_mutex> wait(watch.Holding);
      }
      fly(unknown[k]);
    }
  };
  std::vector<char> isPublished(input.Objects.size(), 0);
  const auto publish = [&]()
  {
    if (monitor.Publishes())
    {
      PublishReady(input.Objects, plans, isPublished, soFar);
    }
  };
  RunWhileTicking([&]() { parallelFor(unknown.size(), flyRange); }, unknown.size(), publish,
                  monitor, watch);
  soFar.clear();
  return !watch.Stop;
}

} // namespace waft
