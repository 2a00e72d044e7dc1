// SPDX-License-Identifier: BSD-3-Clause
// All objects of a run that are to fly, planned by threads and other ranks while the caller's
// thread ticks the monitor.
#include "Base/SharedLoop.h"
#include "Constraints/RowsOfObjects.h"
#include "Planning/FreeSpaceGrids.h"
#include "Planning/Itinerary.h"
#include "Planning/PlannerNumbers.h"
#include "Planning/ScenePlans.h"

#include <algorithm>
#include <functional>
#include <mutex>
#include <shared_mutex>
#include <string>
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
                          const std::vector<std::size_t>& places,
                          const std::vector<unsigned char>& isUsed, double guideWeight)
{
  Itinerary itinerary = MakeItinerary(object, rows, places, isUsed, input.Obstacles, input.Scene);
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
    Rows(rows), Places(rows), IsUsed(isUsed), GuideWeight(options.GuideWeight),
    Library(tools.Library), Shared(SharedOptions(input, options, tools, watch.Stop)),
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
      GuidedItinerary(this->Input, object, this->Rows, this->Places.Of(object.ObjectId),
                      this->IsUsed, this->GuideWeight);
    return PlanObject(this->Library, object, itinerary, this->Input.Obstacles, this->Input.Scene,
                      own);
  }

private:
  const PlanInput& Input;
  const std::vector<Constraint>& Rows;
  RowsOfObjects Places;
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
  TreeRoom trees(plans, options);
  const auto keep = [&](std::size_t i, ObjectPlan plan)
  {
    trees.Take(i, plan);
    plans.Plans[i] = std::move(plan);
    plans.IsDone[i] = !watch.Stop;
    ++watch.Done;
  };
  const std::string of = " of " + std::to_string(unknown.size()) + " objects";
  std::vector<char> isPublished(input.Objects.size(), 0);
  SharedLoop loop;
  loop.Kind = PlanKind;
  loop.Items = unknown;
  loop.Tell = [&](StateArchive& job)
  {
    MoveJob(job, input.Database, input.Objects, rows, isUsed, input.Obstacles.Obstacles(),
            input.Scene, input.Guides, options);
  };
  loop.Work = [&](std::size_t i) { keep(i, flights.Fly(i)); };
  loop.Take = [&](std::size_t i, ReadingStream& stream)
  {
    ObjectPlan plan;
    stream.Values(plan);
    keep(i, std::move(plan));
  };
  loop.IsWatched = true;
  loop.Watch = [&]()
  {
    if (monitor.Publishes())
    {
      PublishReady(input.Objects, plans, isPublished, soFar);
    }
    const std::size_t planned = watch.Done;
    const std::unique_lock<std::shared_mutex> hold(watch.Holding);
    const bool goesOn =
      monitor.Tick(0.05 + 0.9 * static_cast<double>(planned) / static_cast<double>(unknown.size()),
                   "Planned " + std::to_string(planned) + of);
    watch.Stop = watch.Stop || !goesOn;
  };
  const Result shared = RunShared(loop, input.Ranks, parallelFor, watch.Stop);
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
    MakePlanTools(database, LibraryOptionsOf(options, database, input.Scene), parallelFor, tools));
  FlightWatch watch;
  Flights flights(input, options, *tools, rows, isUsed, watch);
  ServeLoop(
    items, 4 * atOnce, parallelFor,
    [&](std::size_t i, StateArchive& result)
    {
      const ObjectPlan plan = flights.Fly(i);
      result.Values(plan);
    },
    watch.Stop);
  return Result::Ok();
}

} // namespace waft
