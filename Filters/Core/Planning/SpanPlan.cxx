// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/SpanPlan.h"

#include "Planning/FreeFlight.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace waft
{

namespace
{

/// More than any difference in style.
constexpr double HardLandingPenalty = 4.0;
constexpr double JerkPenalty = 1.0;

/// Of a path twice as fierce as air ever is, against the distances of style.
constexpr double AccelerationExcessWeight = 0.1;

/// Free flights tried before the object is left to hover.
constexpr int FreeAttempts = 8;

class SpanPlanner
{
public:
  SpanPlanner(const SegmentLibrary& library, const ClearanceField& field,
              const SpanRequest& request, const SpanPlanOptions& options) :
    Library(library),
    Field(field), MissField(field), Request(request), Options(options),
    Fitter(library, this->Field, this->MissField, this->Request, options.CheckMargin)
  {
    auto& contacts = this->MissField.Contacts;
    contacts.erase(std::remove_if(contacts.begin(), contacts.end(),
                                  [&](const ContactStretch& contact) {
                                    return contact.Constraint >= 0 &&
                                           contact.Constraint == request.GoalConstraint;
                                  }),
                   contacts.end());
  }

  SpanResult Run(Random random);

private:
  ClearanceField FlightField(const ClearanceField& base) const;
  bool Search(const ClearanceField& field, const SpanTask& task, bool reachable, Random& random,
              SpanResult& result) const;
  void Hover(SpanResult& result) const;
  double StyleDistance(const std::vector<Vec3>& positions) const;
  bool WayAround(const ClearanceField& field, SpanTask& task) const;

  const SegmentLibrary& Library;
  const ClearanceField& Field;
  ClearanceField MissField; // holds when the goal is not reached
  SpanRequest Request;
  SpanPlanOptions Options;
  SpanFitter Fitter;
};

/// The field on the clock of flight: braking and launching last half as many frames there.
ClearanceField SpanPlanner::FlightField(const ClearanceField& base) const
{
  ClearanceField field = base;
  const double first = this->Request.FirstFrame;
  const double flight = std::lround(this->Request.Clock.FlightFrames());
  for (ContactStretch& contact : field.Contacts)
  {
    if (this->Request.Clock.LaunchFrames > 0 && contact.FirstFrame <= first)
    {
      contact.LastFrame =
        std::min(contact.LastFrame, first + 0.5 * this->Request.Clock.LaunchFrames);
    }
    else if (this->Request.Clock.BrakeFrames > 0 &&
             contact.LastFrame >= first + this->Request.Clock.Frames)
    {
      contact.FirstFrame = std::max(first, first + flight - 0.5 * this->Request.Clock.BrakeFrames);
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
void SpanPlanner::Hover(SpanResult& result) const
{
  const auto frames = static_cast<std::size_t>(this->Request.Clock.Frames) + 1;
  const Vec3 step = this->Request.Before.empty()
                      ? Vec3(Vec3::Zero())
                      : Vec3(this->Request.Start.Position - this->Request.Before.back());
  result.Pieces.clear();
  result.PieceFrames.clear();
  result.RetimingFactor = 1.0;
  result.HasContinuation = false;
  for (double pause : { 8.0, 4.0, 2.0, 1.0 })
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
}

/// Of the whole flight so far with this span, braking and launching left out.
double SpanPlanner::StyleDistance(const std::vector<Vec3>& positions) const
{
  if (this->Options.Gauge == nullptr)
  {
    return 0.0;
  }
  StyleHistory flight;
  StyleGauge::Append(positions, this->Options.FrameStep,
                     std::max(1, this->Request.Clock.LaunchFrames),
                     this->Request.Clock.Frames - this->Request.Clock.BrakeFrames, flight);
  StyleHistory history = this->Request.History;
  history.LogCurvature.insert(history.LogCurvature.end(), flight.LogCurvature.begin(),
                              flight.LogCurvature.end());
  history.Acceleration.insert(history.Acceleration.end(), flight.Acceleration.begin(),
                              flight.Acceleration.end());
  return this->Options.Gauge->Distance(std::move(history)) +
         AccelerationExcessWeight * this->Options.Gauge->AccelerationExcess(flight);
}

/// Sets task.Way to the guide, or where that or the straight one is blocked to a way around; false
/// when the map shows none.
bool SpanPlanner::WayAround(const ClearanceField& field, SpanTask& task) const
{
  task.Way = this->Request.Guide;
  if (!this->Options.Rooms || field.Obstacles == nullptr || field.Obstacles->IsEmpty())
  {
    return true;
  }
  const auto isClear = [&](const std::vector<Vec3>& way)
  {
    for (std::size_t k = 1; k < way.size(); ++k)
    {
      if (!field.Obstacles->IsClear(way[k - 1], 0.0, way[k], 0.0, 0.0))
      {
        return false;
      }
    }
    return true;
  };
  if (task.Way.size() > 1 && isClear(task.Way))
  {
    return true;
  }
  task.Way.clear();
  const Vec3 lift = Vec3(0.0, 0.0, field.Rule.Radius + this->Options.Margin);
  const Vec3 a = task.Start.Position + (task.Start.IsRest ? lift : Vec3(Vec3::Zero()));
  const Vec3 b = task.Goal.Position + (task.Goal.IsRest ? lift : Vec3(Vec3::Zero()));
  const double radius = std::min({ field.Rule.Radius, field.Required(a), field.Required(b) });
  if (field.Obstacles->IsClear(a, 0.0, b, 0.0, 0.9 * std::max(0.0, radius)))
  {
    return true;
  }
  for (int level = 0; task.Way.empty(); ++level)
  {
    const FreeSpaceGrid* rooms = this->Options.Rooms(level);
    if (rooms == nullptr)
    {
      return level == 0;
    }
    task.Way = rooms->FindWay(a, b);
  }
  return true;
}

bool SpanPlanner::Search(const ClearanceField& field, const SpanTask& task, bool reachable,
                         Random& random, SpanResult& result) const
{
  SpanSearchOptions searchOptions;
  searchOptions.RetimingLimit = this->Options.RetimingLimit;
  searchOptions.Margin = this->Options.Margin;
  SpanSearch search(this->Library, field, task, searchOptions, Random(random));
  double best = 1e300;
  int candidates = 0;
  int tries = 0;
  const auto attempt = [&](const Join& join)
  {
    if (!search.IsGapClear(join))
    {
      return;
    }
    ++tries;
    PieceChain chain;
    chain.Pieces = search.Chain(join, chain.JoinPlace);
    chain.JoinAngle = join.Angle;
    SpanResult candidate = result;
    if (!this->Fitter.FitRefined(chain, true, candidate))
    {
      return;
    }
    ++candidates;
    const double merit = join.Score + this->StyleDistance(candidate.Positions) +
                         (candidate.IsHardLanding ? HardLandingPenalty : 0.0) +
                         (candidate.HasLargeJerk ? JerkPenalty : 0.0);
    if (merit < best)
    {
      best = merit;
      result = std::move(candidate);
      result.Distance = join.Distance;
      result.Cost = join.Score;
    }
  };
  Join join;
  const int limit = this->Options.MaximumNumberOfBranches;
  const int enough = this->Options.Gauge != nullptr ? this->Options.NumberOfCandidates : 1;
  int firstFound = 0;
  for (int step = 0; reachable && candidates < enough && step < 6 * limit &&
                     search.NumberOfBranches() < limit && tries <= limit;
       ++step)
  {
    if (this->Options.Stop != nullptr && this->Options.Stop->load())
    {
      break;
    }
    if (candidates == 0 && step == (task.Way.empty() ? 3000 : 600))
    {
      search.AllowRough();
    }
    // What is asked of a join grows milder the longer the search takes.
    const double patience = step / 300.0;
    const double threshold =
      std::min(0.6, this->Options.JoinThreshold * (1.0 + patience * patience));
    while (candidates < enough && search.Take(threshold, join))
    {
      attempt(join);
    }
    firstFound = candidates == 0 ? step : firstFound;
    if (candidates > 0 && step > 3 * firstFound + 200)
    {
      break;
    }
    search.Step();
  }
  while (reachable && candidates == 0 && search.Take(1.0, join))
  {
    attempt(join);
  }
  bool found = candidates > 0;
  for (int step = 0; !reachable && step < 200; ++step)
  {
    search.Step();
  }
  result.ReachesGoal = found;
  for (std::size_t i = 0; !found && i < search.Approaches().size(); ++i)
  {
    const Join& nearest = search.Approaches()[i];
    PieceChain chain;
    chain.Pieces = search.Chain(nearest, chain.JoinPlace);
    found = this->Fitter.Fit(chain, false, result);
    result.Distance = nearest.Distance;
    result.Cost = nearest.Score;
  }
  for (int tree = 0; tree < 2; ++tree)
  {
    result.Trees[tree] = search.Tree(tree);
  }
  return found;
}

SpanResult SpanPlanner::Run(Random random)
{
  SpanResult result;
  SpanTask task;
  task.Start = this->Request.Start;
  task.Goal = this->Request.Goal;
  task.Frames = std::max(1, static_cast<int>(std::lround(this->Request.Clock.FlightFrames())));
  task.FirstFrame = this->Request.FirstFrame;
  task.HasContinuation = this->Request.HasContinuation;
  task.Continuation = this->Request.Continuation;
  task.GoesOn = this->Request.GoesOn;

  bool reachable = this->Request.HasGoal;
  if (this->Request.HasGoal)
  {
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
      result.Message = text;
    }
    if (needed > SpeedAllowance * top)
    {
      reachable = false;
      result.IsRuledOut = true;
      task.Goal.Position = task.Start.Position + way.normalized() * (top * task.Frames);
    }
  }
  const ClearanceField flight = this->FlightField(this->Field);
  if (this->Request.HasGoal)
  {
    if (!this->WayAround(flight, task))
    {
      result.IsRuledOut = true;
      this->Options.MaximumNumberOfBranches =
        std::max(1, this->Options.MaximumNumberOfBranches / 20);
    }
  }
  if (this->Request.HasGoal && this->Search(flight, task, reachable, random, result))
  {
    if (!result.ReachesGoal)
    {
      result.Distance = (result.Positions.back() - this->Request.Goal.Position).norm();
    }
    return result;
  }
  const ClearanceField missed = this->FlightField(this->MissField);
  bool flies = false;
  for (int attempt = 0; attempt < FreeAttempts && !flies; ++attempt)
  {
    random.Bits();
    // At last the seam is left to be healed.
    task.Start.HasVelocity = this->Request.Start.HasVelocity && attempt + 2 < FreeAttempts;
    PieceChain chain;
    chain.Pieces = FlyFree(this->Library, missed, task, this->Options.Margin, 2000, random);
    chain.JoinPlace = static_cast<int>(chain.Pieces.size());
    flies = !chain.Pieces.empty() && this->Fitter.FitRefined(chain, false, result);
    task.HasContinuation = false;
  }
  if (!flies)
  {
    this->Hover(result);
  }
  result.ReachesGoal = !this->Request.HasGoal;
  result.Distance =
    this->Request.HasGoal ? (result.Positions.back() - this->Request.Goal.Position).norm() : 0.0;
  return result;
}

} // namespace

SpanResult PlanSpan(const SegmentLibrary& library, const ClearanceField& field,
                    const SpanRequest& request, const SpanPlanOptions& options, Random random)
{
  return SpanPlanner(library, field, request, options).Run(random);
}

} // namespace waft
