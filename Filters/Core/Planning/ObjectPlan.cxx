// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/ObjectPlan.h"

#include "Base/BodyLaw.h"
#include "Base/SmoothStep.h"
#include "Planning/ObjectProgress.h"
#include "Planning/PlannerNumbers.h"
#include "Planning/Seams.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <optional>

namespace waft
{

namespace
{

/// All of the way of what it is braked to, and none of that before half of the braking; of what it
/// launches from likewise. goal: null where there is none.
std::vector<Vec3> RideOf(const SpanRequest& request, const Mark& start, const Mark* goal)
{
  std::vector<Vec3> ride;
  const SpanClock& clock = request.Clock;
  const bool leaves = clock.LaunchFrames > 0 && start.Place.IsMoving();
  const bool comes = clock.BrakeFrames > 0 && goal != nullptr && goal->Place.IsMoving();
  for (int k = 0; (leaves || comes) && k <= clock.Frames + 2; ++k)
  {
    const double frame = request.FirstFrame + k;
    Vec3 way = Vec3::Zero();
    if (leaves)
    {
      way += (1.0 - SmoothStep(2.0 * k / clock.LaunchFrames)) *
             (start.Place.At(frame) - start.Place.At(start.Until));
    }
    if (comes)
    {
      const double braked = 1.0 - static_cast<double>(clock.Frames - k) / clock.BrakeFrames;
      way += SmoothStep(2.0 * braked) * (goal->Place.At(frame) - goal->Place.At(goal->Frame));
    }
    ride.push_back(way);
  }
  return ride;
}

class ObjectPlanner
{
public:
  ObjectPlanner(const SegmentLibrary& library, const MotionObject& object,
                const Itinerary& itinerary, const ObstacleSet& obstacles, const SceneInfo& scene,
                const ObjectPlanOptions& options);
  ObjectPlan Run();

private:
  void PlanFlight(std::size_t from, int lastFrame, int attempt = 0);
  bool ReturnFrom(std::size_t mark, const ObjectProgress& start);
  void Settle(std::size_t spans);
  void Draw(const Mark& from, Mark& to);
  SpanEnd EndAt(std::size_t mark, bool isGoal) const;
  bool IsDrawn(std::size_t mark) const;

  const SegmentLibrary& Library;
  const MotionObject& Object;
  const SceneInfo& Scene;
  const ObjectPlanOptions& Options;
  ObjectProgress Now;
  std::vector<SpanTrees> Settled; // of flights that stay, before those of Now
};

ObjectPlanner::ObjectPlanner(const SegmentLibrary& library, const MotionObject& object,
                             const Itinerary& itinerary, const ObstacleSet& obstacles,
                             const SceneInfo& scene, const ObjectPlanOptions& options) :
  Library(library),
  Object(object), Scene(scene), Options(options),
  Now(object, itinerary, obstacles, scene, options.Span.CheckMargin)
{
}

/// True when the flight from this mark to the next is too short for a segment.
bool ObjectPlanner::IsDrawn(std::size_t mark) const
{
  const std::vector<Mark>& marks = this->Now.Way.Marks;
  return mark + 1 < marks.size() &&
         marks[mark + 1].Frame - marks[mark].Until < this->Library.ShortestSpan();
}

SpanEnd ObjectPlanner::EndAt(std::size_t index, bool isGoal) const
{
  const std::vector<Mark>& marks = this->Now.Way.Marks;
  const Mark& mark = marks[index];
  SpanEnd end;
  end.Position = isGoal ? mark.Position : this->Now.Plan.Positions[mark.Until];
  end.IsRest = mark.IsRest;
  end.Descent =
    PlannerNumbers::LandingDescent * LawOf(this->Object).SettlingSpeed() * this->Scene.Time.Step();
  end.HasVelocity = mark.HasVelocity && !mark.Halts;
  end.Velocity = mark.Velocity;
  if (mark.IsRest || mark.Halts || end.HasVelocity || (!isGoal && this->Now.Halted))
  {
    return end;
  }
  // Next to a given stretch its own speed is taken over, else that of the flight before.
  if (isGoal && this->IsDrawn(index))
  {
    end.HasVelocity = true;
    end.Velocity = (marks[index + 1].Position - mark.Position) /
                   static_cast<double>(marks[index + 1].Frame - mark.Frame);
  }
  else if (!isGoal && mark.Frame > 1)
  {
    const int frame = mark.Frame;
    end.HasVelocity = true;
    end.Velocity = 1.5 * this->Now.Plan.Positions[frame] -
                   2.0 * this->Now.Plan.Positions[frame - 1] +
                   0.5 * this->Now.Plan.Positions[frame - 2];
  }
  return end;
}

void ObjectPlanner::Draw(const Mark& from, Mark& to)
{
  const Vec3 start = this->Now.Plan.Positions[from.Until];
  const int frames = to.Frame - from.Until;
  MarkOutcome outcome;
  outcome.Constraint = to.Constraint;
  // Frame by frame from one position that was met to the next it is the artist's own path, as fast
  // as it may be.
  const bool isGiven = frames == 1 && from.Constraint >= 0 && this->Now.LastReached;
  const double most = SpeedAllowance * this->Library.TopStep() * frames;
  const Vec3 way = to.Position - start;
  if (!isGiven && way.norm() - to.Radius > most)
  {
    Vec3 reached = start + way.normalized() * (PlannerNumbers::DrawnFraction * most);
    while ((reached - start).norm() > 1e-3 &&
           this->Now.Field.FirstHit({ start, 0.5 * (start + reached), reached }, 1, 2, to.Frame,
                                    0.0, 0.0) >= 0)
    {
      reached = 0.5 * (start + reached);
    }
    outcome.IsReached = false;
    outcome.Message = "far faster than the database's top speed";
    this->Now.Miss(to, reached);
  }
  for (int frame = from.Until + 1; frame <= to.Frame; ++frame)
  {
    const double u = static_cast<double>(frame - from.Until) / static_cast<double>(frames);
    this->Now.Plan.Positions[frame] = start + u * (to.Position - start);
  }
  this->Now.Fix(to.Frame, to.Position);
  this->Now.Seams.push_back(from.Until);
  this->Now.Seams.push_back(to.Frame);
  this->Now.HasContinuation = false;
  this->Now.Halted = false;
  this->Now.LastReached = outcome.IsReached;
  this->Now.Plan.Outcomes.push_back(outcome);
}

/// attempt: each has random numbers of its own.
void ObjectPlanner::PlanFlight(std::size_t from, int lastFrame, int attempt)
{
  const std::vector<Mark>& marks = this->Now.Way.Marks;
  const Mark& start = marks[from];
  const bool hasGoal = from + 1 < marks.size();
  const auto second = static_cast<int>(std::lround(this->Scene.Time.FramesPerSecond));
  SpanRequest request;
  request.FirstFrame = start.Until;
  request.Start = this->EndAt(from, false);
  request.HasGoal = hasGoal;
  const bool launches = start.IsRest || start.Halts || this->Now.Halted;
  const bool brakes = hasGoal && (marks[from + 1].IsRest || marks[from + 1].Halts);
  request.Clock = SpanClock::Of(lastFrame - start.Until, launches, brakes, second);
  if (hasGoal)
  {
    request.Goal = this->EndAt(from + 1, true);
    request.GoalRadius = marks[from + 1].Radius;
    request.GoesOn = !brakes && lastFrame + 1 < this->Scene.Time.NumberOfFrames;
  }
  else
  {
    request.Goal.Position = request.Start.Position;
  }
  request.Ride = RideOf(request, start, hasGoal ? &marks[from + 1] : nullptr);
  request.HasContinuation = this->Now.HasContinuation && !launches;
  request.Continuation = this->Now.Continuation;
  if (request.FirstFrame >= 2)
  {
    request.Before = { this->Now.Plan.Positions[request.FirstFrame - 2],
                       this->Now.Plan.Positions[request.FirstFrame - 1] };
  }
  else if (launches)
  {
    request.Before = { request.Start.Position, request.Start.Position };
  }
  request.History = this->Now.History;
  if (hasGoal && !this->Now.Way.Way.IsEmpty())
  {
    request.Guide = this->Now.Way.Way.Take(request.Start.Position, request.Goal.Position);
    request.GuideWeight = this->Options.Span.GuideWeight;
  }
  const std::uint64_t stream = static_cast<std::uint64_t>(this->Object.ObjectId) * 8192u +
                               static_cast<std::uint64_t>(from) +
                               (static_cast<std::uint64_t>(attempt) << 48u);
  const auto begin = std::chrono::steady_clock::now();
  SpanResult span = PlanSpan(this->Library, this->Now.Field, request, this->Options.Span,
                             Random(this->Options.Seed, stream));
  if (hasGoal)
  {
    MarkOutcome outcome;
    outcome.Constraint = marks[from + 1].Constraint;
    outcome.IsReached = span.ReachesGoal;
    outcome.RetimingFactor = span.RetimingFactor;
    outcome.Cost = span.Cost;
    outcome.NumberOfBranches = static_cast<int>(span.Trees[0].size() + span.Trees[1].size());
    outcome.Message = span.Message;
    outcome.Seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    this->Now.Plan.Outcomes.push_back(outcome);
    this->Now.LastReached = span.ReachesGoal;
    this->Now.IsRuledOut = span.IsRuledOut;
    if (!span.ReachesGoal)
    {
      this->Now.Miss(this->Now.Way.Marks[from + 1], span.Positions.back());
    }
  }
  this->Now.Keep(this->Library, this->Options.Span.Gauge, this->Scene.Time, request, span);
}

/// The flight on from a mark found no way: it may have come there too fast, or head on to a wall.
/// Other flights to the mark are tried, from the progress before them; what there is stays when
/// none leads on, and it is false.
bool ObjectPlanner::ReturnFrom(std::size_t mark, const ObjectProgress& start)
{
  const ObjectProgress found = this->Now;
  for (int attempt = 1; attempt <= PlannerNumbers::Returns; ++attempt)
  {
    this->Now = start;
    this->PlanFlight(mark - 1, found.Way.Marks[mark].Frame, attempt);
    if (this->Now.LastReached)
    {
      this->PlanFlight(mark, found.Way.Marks[mark + 1].Frame, attempt);
      if (this->Now.LastReached)
      {
        return true;
      }
    }
  }
  this->Now = found;
  return false;
}

/// So many spans more stay, wherever it is returned to: a copy of the progress with all trees would
/// take the longer the more there are.
void ObjectPlanner::Settle(std::size_t spans)
{
  std::vector<SpanTrees>& all = this->Now.Plan.Spans;
  const auto end = all.begin() + static_cast<std::ptrdiff_t>(spans);
  std::move(all.begin(), end, std::back_inserter(this->Settled));
  all.erase(all.begin(), end);
}

ObjectPlan ObjectPlanner::Run()
{
  // A copy, since the marks of the progress move when they are missed; frames stay.
  const std::vector<Mark> marks = this->Now.Way.Marks;
  const int last = this->Scene.Time.NumberOfFrames - 1;
  this->Now.Fix(0, marks.front().Position);
  std::optional<ObjectProgress> before; // the flight that came here, when another one may
  std::size_t shared = 0;               // spans that are the same in it as in Now, from the first
  for (std::size_t i = 0; i < marks.size(); ++i)
  {
    if (this->Now.Way.Marks[i].IsRest || this->Now.Way.Marks[i].Until > marks[i].Frame)
    {
      this->Now.LieStill(this->Now.Way.Marks[i]);
    }
    if (i + 1 == marks.size())
    {
      if (this->Now.Way.Marks[i].Until < last)
      {
        this->PlanFlight(i, last);
      }
    }
    else if (this->IsDrawn(i))
    {
      this->Draw(this->Now.Way.Marks[i], this->Now.Way.Marks[i + 1]);
      before.reset();
    }
    else
    {
      if (before)
      {
        std::vector<SpanTrees>& spans = before->Plan.Spans;
        spans.erase(spans.begin(), spans.begin() + static_cast<std::ptrdiff_t>(shared));
      }
      this->Settle(before ? shared : this->Now.Plan.Spans.size());
      ObjectProgress here = this->Now;
      shared = here.Plan.Spans.size();
      this->PlanFlight(i, marks[i + 1].Frame);
      if (!this->Now.LastReached && !this->Now.IsRuledOut && before && this->ReturnFrom(i, *before))
      {
        shared = 0;
      }
      const Mark& reached = this->Now.Way.Marks[i + 1];
      if (this->Now.LastReached && !reached.IsRest && !reached.Halts)
      {
        before = std::move(here);
      }
      else
      {
        before.reset();
      }
    }
  }
  const std::vector<Vec3> separate = this->Now.Plan.Positions;
  const auto reach =
    static_cast<int>(std::lround(this->Scene.Time.FramesPerSecond / PlannerNumbers::SeamRate));
  const std::vector<Vec3> united =
    UniteFlights(this->Now.Seams, reach, this->Now.Way.Rows, this->Now.Warp);
  ClearPathOptions clearing;
  clearing.Tolerance = this->Options.Tolerance;
  clearing.MostStep = PlannerNumbers::RepairAllowance * this->Library.TopStep();
  clearing.FrameStep = this->Scene.Time.Step();
  this->Now.Plan.Positions =
    ClearPath(this->Now.Field, this->Now.Warp, clearing, united,
              this->Now.Warp.Rows.empty() ? separate : united, this->Now.Plan.Shortfall);
  this->Settle(this->Now.Plan.Spans.size());
  this->Now.Plan.Spans = std::move(this->Settled);
  return std::move(this->Now.Plan);
}

} // namespace

ObjectPlan PlanObject(const SegmentLibrary& library, const MotionObject& object,
                      const Itinerary& itinerary, const ObstacleSet& obstacles,
                      const SceneInfo& scene, const ObjectPlanOptions& options)
{
  const auto begin = std::chrono::steady_clock::now();
  ObjectPlan plan = ObjectPlanner(library, object, itinerary, obstacles, scene, options).Run();
  plan.Seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return plan;
}

} // namespace waft
