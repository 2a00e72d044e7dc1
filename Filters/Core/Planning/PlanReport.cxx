// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/PlanReport.h"

#include "Constraints/ConstraintCheck.h"
#include "Constraints/ConstraintFeasibility.h"
#include "Constraints/Rest.h"

#include <cstdio>
#include <map>

namespace waft
{

namespace
{

/// Adds a sentence to the line of a constraint.
void AddToReport(std::vector<ReportRow>& report, const Constraint& row, bool isReached,
                 const std::string& text)
{
  ReportRow* line = FindLine(report, row.Row, row.Target);
  if (line == nullptr)
  {
    return;
  }
  if (line->Status == ConstraintStatus::Met && !isReached)
  {
    line->Status = ConstraintStatus::Unreachable;
  }
  line->Message += (line->Message.empty() || text.empty() ? "" : "; ") + text;
}

std::string Describe(const MarkOutcome& outcome)
{
  if (outcome.NumberOfBranches == 0)
  {
    return outcome.Message;
  }
  char text[128];
  std::snprintf(text, sizeof text, "%sretimed by %.3f, cost %.3g, %d branches",
                outcome.Message.empty() ? "" : "; ", outcome.RetimingFactor, outcome.Cost,
                outcome.NumberOfBranches);
  return outcome.Message + text;
}

/// Sentences of one line are parted by semicolons.
void Append(std::string& message, const std::string& text)
{
  message += (message.empty() ? "" : "; ") + text;
}

/// Worse is larger.
int Rank(ConstraintStatus status)
{
  return status == ConstraintStatus::Met           ? 0
         : status == ConstraintStatus::Unreachable ? 1
         : status == ConstraintStatus::Conflict    ? 2
                                                   : 3;
}

} // namespace

void ReportObject(const MotionObject& object, const ObjectPlan& plan, bool isPlanned,
                  PlanOutput& output)
{
  ObjectRow own;
  own.ObjectId = object.ObjectId;
  own.IsPlanned = isPlanned;
  own.Seconds = plan.Seconds;
  const MarkOutcome* last = nullptr;
  for (const MarkOutcome& outcome : plan.Outcomes)
  {
    own.NumberOfBranches += outcome.NumberOfBranches;
    own.Cost += outcome.Cost;
    if (outcome.Constraint < 0)
    {
      continue; // the end of a guide
    }
    const Constraint& row = output.Constraints[outcome.Constraint];
    AddToReport(output.Report, row, outcome.IsReached,
                outcome.IsReached ? Describe(outcome)
                                  : "no path found in the limits" +
                                      (outcome.Message.empty() ? "" : ": " + outcome.Message));
    output.Flights.push_back({ object.ObjectId, row.Row, row.Target, row.Frame, outcome.IsReached,
                               outcome.RetimingFactor, outcome.Cost, outcome.NumberOfBranches,
                               outcome.Seconds });
    last = &outcome;
  }
  if (plan.Shortfall.Frame >= 0)
  {
    char text[128];
    std::snprintf(text, sizeof text, "object %d comes %.3g m too near to something at frame %d",
                  object.ObjectId, plan.Shortfall.Depth, plan.Shortfall.Frame);
    own.Message = text;
    if (last != nullptr)
    {
      AddToReport(output.Report, output.Constraints[last->Constraint], true, text);
    }
  }
  output.Objects.push_back(std::move(own));
}

void ReportStarts(const PlanInput& input, PlanOutput& output)
{
  std::map<int, std::vector<Constraint>> rests; // by object
  for (const Constraint& row : output.Constraints)
  {
    if (IsRest(row.Kind))
    {
      rests[row.ObjectId].push_back(row);
    }
  }
  std::map<int, std::string> reasons;
  for (const MotionObject& object : input.Objects)
  {
    const std::string why =
      WhyStartInfeasible(object,
                         LandingWindows(object, rests[object.ObjectId], input.Obstacles,
                                        input.Scene.Time.FramesPerSecond),
                         input.Obstacles, input.Scene);
    if (!why.empty())
    {
      reasons[object.ObjectId] =
        "object " + std::to_string(object.ObjectId) + " at its start: " + why;
    }
  }
  for (ReportRow& line : output.Report)
  {
    const auto found = reasons.find(line.ObjectId);
    if (found != reasons.end())
    {
      Append(line.Message, found->second);
    }
  }
  for (ObjectRow& own : output.Objects)
  {
    const auto found = reasons.find(own.ObjectId);
    if (found != reasons.end())
    {
      own.Status = ConstraintStatus::Infeasible;
      Append(own.Message, found->second);
    }
  }
}

void MarkUnmet(const std::vector<ReportRow>& report, std::vector<Constraint>& constraints)
{
  for (Constraint& row : constraints)
  {
    const ReportRow* line = FindLine(report, row.Row, row.Target);
    row.Status = line != nullptr ? line->Status : row.Status;
  }
}

void CountLines(PlanOutput& output)
{
  std::map<int, ObjectRow*> rowOf;
  for (ObjectRow& own : output.Objects)
  {
    rowOf[own.ObjectId] = &own;
  }
  for (const ReportRow& line : output.Report)
  {
    const auto found = rowOf.find(line.ObjectId);
    if (found == rowOf.end())
    {
      continue; // of any object, or of one that was not planned
    }
    ObjectRow& own = *found->second;
    ++own.NumberOfRows;
    own.NumberOfMet += line.Status == ConstraintStatus::Met ? 1 : 0;
    own.Status = Rank(line.Status) > Rank(own.Status) ? line.Status : own.Status;
  }
}

std::vector<Track> TracksSoFar(const std::vector<Track>& planned,
                               const std::vector<MotionObject>& objects, const Timeline& time)
{
  std::map<int, const Track*> known;
  for (const Track& track : planned)
  {
    known[track.ObjectId] = &track;
  }
  std::vector<Track> tracks(objects.size());
  for (std::size_t i = 0; i < tracks.size(); ++i)
  {
    const MotionObject& object = objects[i];
    const auto own = known.find(object.ObjectId);
    tracks[i].ObjectId = object.ObjectId;
    tracks[i].Positions =
      own != known.end()
        ? own->second->Positions
        : std::vector<Vec3>(static_cast<std::size_t>(time.NumberOfFrames), object.Position);
  }
  return tracks;
}

} // namespace waft
