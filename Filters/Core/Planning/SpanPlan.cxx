// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/SpanPlan.h"

#include "Planning/FreeFlight.h"
#include "Planning/PlannerNumbers.h"
#include "Planning/SpanWay.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

namespace waft
{

namespace
{

/// As if it stood still where it is at a frame: what its motion adds is the Ride of the request.
void StandAt(double frame, LandingWindow& landing)
{
  landing.Centre = { landing.Centre.At(frame), frame, nullptr };
}

class SpanPlanner
{
public:
  SpanPlanner(const SegmentLibrary& library, const ClearanceField& field,
              const SpanRequest& request, const SpanPlanOptions& options, Random random) :
    Library(library),
    Field(field), MissField(field), Request(request), Options(options), Stream(random),
    Fitter(library, this->Field, this->MissField, this->Request, options.CheckMargin)
  {
    if (request.HasGoal)
    {
      this->MissField.ForgetLanding(request.FirstFrame + request.Clock.Frames);
    }
  }

  SpanResult Run();

private:
  // What is tried in turn until there is a path; see Run.
  bool JoinTrees();
  bool JoinAnyhow();
  bool ComeNear();
  bool FlyOn();
  bool FlyAnew();
  bool Hover();

  void JudgeSpeed();
  int MostCandidates() const;
  int EnoughCandidates() const;
  bool IsWanting() const;
  void Attempt(const Join& join);
  bool Fly(int flights);
  ClearanceField FlightField(const ClearanceField& base) const;
  double StyleDistance(const std::vector<Vec3>& positions) const;

  const SegmentLibrary& Library;
  const ClearanceField& Field;
  ClearanceField MissField; // holds when the goal is not reached
  SpanRequest Request;
  SpanPlanOptions Options;
  Random Stream;
  SpanFitter Fitter;

  SpanTask Task;
  bool IsReachable = true; // in the time, as far as speed goes
  ClearanceField Flight;   // on the clock of flight
  std::optional<SpanSearch> Search;
  int Candidates = 0, Tries = 0; // paths to the goal, and joins that were tried to be one
  double Merit = 1e300;          // of the best candidate
  SpanResult Result;
};

/// The field on the clock of flight: braking and launching last half as many frames there.
ClearanceField SpanPlanner::FlightField(const ClearanceField& base) const
{
  ClearanceField field = base;
  if (field.Obstacles != nullptr && field.Obstacles->HasMoving())
  {
    field.SceneFrames = this->Request.Clock.FramesOfFlight();
    for (double& frame : field.SceneFrames)
    {
      frame += this->Request.FirstFrame;
    }
    field.FirstFrame = this->Request.FirstFrame;
  }
  const double first = this->Request.FirstFrame;
  const double flight = std::round(this->Request.Clock.FlightFrames());
  for (LandingWindow& landing : field.Landings)
  {
    if (this->Request.Clock.LaunchFrames > 0 && landing.First <= first)
    {
      StandAt(first, landing);
      landing.Last = std::min(landing.Last, first + 0.5 * this->Request.Clock.LaunchFrames);
    }
    else if (this->Request.Clock.BrakeFrames > 0 &&
             landing.Last >= first + this->Request.Clock.Frames)
    {
      StandAt(first + this->Request.Clock.Frames, landing);
      landing.First = std::max(first, first + flight - 0.5 * this->Request.Clock.BrakeFrames);
    }
  }
  // Marks that are tighter than the margin lower it next to them.
  for (const SpanEnd* end : { &this->Request.Start, &this->Request.Goal })
  {
    const double frame = end == &this->Request.Start ? first : first + flight;
    const double distance = field.Distance(end->Position, frame);
    if (distance < field.Rule.Radius + this->Options.Margin)
    {
      field.TightMarks.push_back({ end->Position, distance - this->Options.Margin - 1e-9 });
    }
  }
  return field;
}

/// Where no piece of the database fits: comes to a stop and stays.
bool SpanPlanner::Hover()
{
  SpanResult& result = this->Result;
  const auto frames = static_cast<std::size_t>(this->Request.Clock.Frames) + 1;
  const Vec3 step = this->Request.Before.empty()
                      ? Vec3(Vec3::Zero())
                      : Vec3(this->Request.Start.Position - this->Request.Before.back());
  result.Pieces.clear();
  result.PieceFrames.clear();
  result.RetimingFactor = 1.0;
  result.HasContinuation = false;
  for (const double pause : PlannerNumbers::Pauses)
  {
    result.Positions.assign(frames, this->Request.Start.Position);
    for (std::size_t k = 1; k < frames; ++k)
    {
      const double rate = std::max(0.0, 1.0 - static_cast<double>(k) / pause);
      result.Positions[k] = result.Positions[k - 1] + rate * rate * step;
    }
    if (this->MissField.FirstHit(result.Positions, 1, static_cast<int>(frames) - 1,
                                 this->Request.FirstFrame + 1, 1.0, 0.0) < 0)
    {
      break;
    }
  }
  result.SecondDifferences = SecondDifferences(result.Positions);
  result.Sources.assign(frames, FrameSource());
  result.Halts = true;
  return true;
}

/// Of the whole flight so far with this span, braking and launching left out.
double SpanPlanner::StyleDistance(const std::vector<Vec3>& positions) const
{
  if (this->Options.Gauge == nullptr)
  {
    return 0.0;
  }
  StyleHistory flight;
  this->Options.Gauge->Append(positions, this->Options.FrameStep,
                              std::max(1, this->Request.Clock.LaunchFrames),
                              this->Request.Clock.Frames - this->Request.Clock.BrakeFrames, flight);
  StyleHistory history = this->Request.History;
  history.LogCurvature.Add(flight.LogCurvature);
  history.Acceleration.Add(flight.Acceleration);
  return this->Options.Gauge->Distance(history) +
         PlannerNumbers::AccelerationExcessWeight * this->Options.Gauge->AccelerationExcess(flight);
}

/// Keeps the path of a join when it is one, and better than those before.
void SpanPlanner::Attempt(const Join& join)
{
  if (!this->Search->IsGapClear(join))
  {
    return;
  }
  ++this->Tries;
  PieceChain chain;
  chain.Pieces = this->Search->Chain(join, chain.JoinIndex);
  chain.JoinAngle = join.Angle;
  SpanResult candidate = this->Result;
  if (!this->Fitter.FitRefined(chain, true, candidate))
  {
    return;
  }
  ++this->Candidates;
  const double merit = join.Score + this->StyleDistance(candidate.Positions) +
                       (candidate.IsHardLanding ? PlannerNumbers::HardLandingPenalty : 0.0) +
                       (candidate.HasLargeJerk ? PlannerNumbers::JerkPenalty : 0.0);
  if (merit < this->Merit)
  {
    this->Merit = merit;
    this->Result = std::move(candidate);
    this->Result.ReachesGoal = true;
    this->Result.Distance = join.Distance;
    this->Result.Cost = join.Score;
  }
}

int SpanPlanner::MostCandidates() const
{
  return this->Options.Gauge != nullptr ? this->Options.NumberOfCandidates : 1;
}

int SpanPlanner::EnoughCandidates() const
{
  const int most = this->MostCandidates();
  const double lengths = this->Task.Frames * this->Options.FrameStep / PlannerNumbers::LongFlight;
  const double few = most / std::max(1.0, lengths * lengths);
  return std::max(std::min(most, PlannerNumbers::FewestCandidates),
                  static_cast<int>(std::lround(few)));
}

/// Whether there are not enough paths to choose from yet, or none of them without a fault.
bool SpanPlanner::IsWanting() const
{
  return this->Candidates < this->EnoughCandidates() ||
         (this->Candidates < this->MostCandidates() && this->Merit >= PlannerNumbers::JerkPenalty);
}

/// Trees grow until they have met often enough.
bool SpanPlanner::JoinTrees()
{
  if (!this->Request.HasGoal || !this->IsReachable)
  {
    return false;
  }
  const int limit = this->Options.MaximumNumberOfBranches;
  const int roughAfter =
    this->Task.Way.empty() ? PlannerNumbers::RoughAfter : PlannerNumbers::RoughAfterInMaze;
  int firstFound = 0;
  for (int step = 0; this->IsWanting() && step < PlannerNumbers::StepsPerBranch * limit &&
                     this->Search->NumberOfBranches() < limit && this->Tries <= limit;
       ++step)
  {
    if (this->Options.Stop != nullptr && this->Options.Stop->load())
    {
      break;
    }
    if (this->Candidates == 0 && step == roughAfter)
    {
      this->Search->AllowRough();
    }
    // What is asked of a join grows milder the longer the search takes.
    const double patience = step / PlannerNumbers::Patience;
    const double threshold = std::min(PlannerNumbers::MildestThreshold,
                                      this->Options.JoinThreshold * (1.0 + patience * patience));
    Join join;
    while (this->IsWanting() && this->Search->Take(threshold, join))
    {
      this->Attempt(join);
    }
    firstFound = this->Candidates == 0 ? step : firstFound;
    if (this->Candidates > 0 &&
        step > PlannerNumbers::MoreSteps * firstFound + PlannerNumbers::MoreStepsAtLeast)
    {
      break;
    }
    this->Search->Step();
  }
  return this->Candidates > 0;
}

/// The joins that were not good enough.
bool SpanPlanner::JoinAnyhow()
{
  Join join;
  while (this->Request.HasGoal && this->IsReachable && this->Candidates == 0 &&
         this->Search->Take(PlannerNumbers::LastThreshold, join))
  {
    this->Attempt(join);
  }
  return this->Candidates > 0;
}

/// The forward tree's paths that come nearest to the goal about in time.
bool SpanPlanner::ComeNear()
{
  if (!this->Request.HasGoal)
  {
    return false;
  }
  for (int step = 0; !this->IsReachable && step < PlannerNumbers::StepsTowards; ++step)
  {
    this->Search->Step();
  }
  for (const Join& nearest : this->Search->Approaches())
  {
    PieceChain chain;
    chain.Pieces = this->Search->Chain(nearest, chain.JoinIndex);
    this->Result.Cost = nearest.Score;
    if (this->Fitter.Fit(chain, false, this->Result))
    {
      return true;
    }
  }
  return false;
}

/// So many free flights at most, out of where the trees cannot come near.
bool SpanPlanner::Fly(int flights)
{
  const ClearanceField missed = this->FlightField(this->MissField);
  for (int flight = 0; flight < flights; ++flight)
  {
    this->Stream.Bits();
    PieceChain chain;
    chain.Pieces = FlyFree(this->Library, missed, this->Task, this->Options.Margin,
                           PlannerNumbers::FlightSteps, this->Stream);
    chain.JoinIndex = static_cast<int>(chain.Pieces.size());
    if (!chain.Pieces.empty() && this->Fitter.FitRefined(chain, false, this->Result))
    {
      return true;
    }
    this->Task.HasContinuation = false;
  }
  return false;
}

bool SpanPlanner::FlyOn()
{
  return this->Fly(PlannerNumbers::FlightsOn);
}

/// The seam is left to be healed.
bool SpanPlanner::FlyAnew()
{
  this->Task.Start.HasVelocity = false;
  return this->Fly(PlannerNumbers::FlightsAnew);
}

/// What is too far for any flight is flown towards, as far as the top speed goes.
void SpanPlanner::JudgeSpeed()
{
  SpanTask& task = this->Task;
  const Vec3 way = task.Goal.Position - task.Start.Position;
  const double needed = std::max(0.0, way.norm() - this->Request.GoalRadius) / task.Frames;
  const double top = this->Library.TopStep();
  if (needed > top)
  {
    const double rate = this->Library.Options().FramesPerSecond;
    char text[160];
    std::snprintf(text, sizeof text,
                  "asks for %.3g m/s on average, the database's top speed is %.3g m/s",
                  needed * rate, top * rate);
    this->Result.Message = text;
  }
  if (needed > SpeedAllowance * top)
  {
    this->IsReachable = false;
    this->Result.IsRuledOut = true;
    task.Goal.Position = task.Start.Position + way.normalized() * (top * task.Frames);
  }
}

SpanResult SpanPlanner::Run()
{
  SpanTask& task = this->Task;
  task.Start = this->Request.Start;
  task.Goal = this->Request.Goal;
  task.Frames = std::max(1, static_cast<int>(std::lround(this->Request.Clock.FlightFrames())));
  task.FirstFrame = this->Request.FirstFrame;
  task.HasContinuation = this->Request.HasContinuation;
  task.Continuation = this->Request.Continuation;
  task.GoesOn = this->Request.GoesOn;
  this->Flight = this->FlightField(this->Field);
  if (this->Request.HasGoal)
  {
    this->JudgeSpeed();
    if (!FindWay(this->Flight, this->Options, this->Request.Guide, task))
    {
      this->Result.IsRuledOut = true;
      this->Options.MaximumNumberOfBranches =
        std::max(1, this->Options.MaximumNumberOfBranches / PlannerNumbers::RuledOutBranches);
    }
    SpanSearchOptions searchOptions;
    searchOptions.RetimingLimit = this->Options.RetimingLimit;
    searchOptions.Margin = this->Options.Margin;
    this->Search.emplace(this->Library, this->Flight, task, searchOptions, this->Stream);
  }
  static constexpr bool (SpanPlanner::*Resorts[])() = {
    &SpanPlanner::JoinTrees,  // to the goal, as smoothly as is asked for
    &SpanPlanner::JoinAnyhow, // to the goal
    &SpanPlanner::ComeNear,   // to a stop near the goal
    &SpanPlanner::FlyOn,      // anywhere, with the velocity at the start
    &SpanPlanner::FlyAnew,    // anywhere
    &SpanPlanner::Hover,      // nowhere
  };
  for (const auto resort : Resorts)
  {
    if ((this->*resort)())
    {
      break;
    }
  }
  SpanResult& result = this->Result;
  for (int tree = 0; tree < 2 && this->Search; ++tree)
  {
    result.Trees[tree] = this->Search->Tree(tree);
  }
  if (!result.ReachesGoal && this->Request.HasGoal)
  {
    result.Distance = (result.Positions.back() - this->Request.Goal.Position).norm();
  }
  result.ReachesGoal = result.ReachesGoal || !this->Request.HasGoal;
  return std::move(result);
}

} // namespace

SpanResult PlanSpan(const SegmentLibrary& library, const ClearanceField& field,
                    const SpanRequest& request, const SpanPlanOptions& options, Random random)
{
  return SpanPlanner(library, field, request, options, random).Run();
}

} // namespace waft
