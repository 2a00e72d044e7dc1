// SPDX-License-Identifier: BSD-3-Clause
#include "Chain/JudgeScene.h"

#include "Chain/ChainScene.h"
#include "Chain/SceneCrowding.h"
#include "Constraints/LoopRows.h"
#include "Planning/InputCheck.h"
#include "Planning/Planner.h"
#include "Spacetime/Run/SpacetimeBudget.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <map>
#include <utility>

namespace waft
{
namespace
{

constexpr double KeptUp = 0.5;   // share of the air's top speed that a body is carried at for long
constexpr double Sinking = 0.1;  // the same of air that sinks all the way
constexpr std::size_t Alike = 5; // findings of one kind that are told

/// "0.52 s (16 frames)"
std::string TimeText(double seconds, const Timeline& time)
{
  return Format("%.2g s (%.0f frames)", seconds, std::ceil(seconds * time.FramesPerSecond));
}

/// The way of an object from where it is, or its place before, to a row.
struct Leg
{
  const MotionObject& Object;
  const Constraint& To;
  Vec3 From;
  double Room;    // how far it may be from there [m]
  double Seconds; // there are

  double Distance() const { return (this->To.Value - this->From).norm() - this->Room; }
};

/// In the order of the objects, then of time; rows that cannot be met are left out.
std::vector<Leg> LegsOf(const Scene& scene, const std::vector<Constraint>& rows)
{
  std::map<int, std::vector<const Constraint*>> of;
  for (const Constraint& row : rows)
  {
    if (IsPositional(row.Kind) && CanBe(row))
    {
      of[row.ObjectId].push_back(&row);
    }
  }
  std::vector<Leg> legs;
  for (const MotionObject& object : scene.Objects)
  {
    std::vector<const Constraint*>& own = of[object.ObjectId];
    std::stable_sort(own.begin(), own.end(),
                     [](const Constraint* a, const Constraint* b) { return a->Frame < b->Frame; });
    Vec3 place = object.Position;
    int frame = object.Released(), source = -1;
    double room = 0.0;
    for (const Constraint* row : own)
    {
      if (row->Frame > frame && row->Row != source) // within a given path any speed will do
      {
        legs.push_back(
          { object, *row, place, room, (row->Frame - frame) / scene.Info.Time.FramesPerSecond });
      }
      place = row->Value;
      frame = row->Frame;
      room = row->Radius;
      source = row->Row;
    }
  }
  return legs;
}

/// Places that are farther apart than air carries a body in the time.
void FindHaste(const Scene& scene, const std::vector<Leg>& legs, double topSpeed,
               std::vector<Finding>& findings)
{
  for (const Leg& leg : legs)
  {
    const double distance = leg.Distance() - leg.To.Radius;
    if (distance > KeptUp * topSpeed * leg.Seconds)
    {
      findings.push_back(AboutRow(
        "too fast", leg.To,
        Format(
          ": object %d has %.3g s for %.3g m to its mark at frame %d, %.3g m/s; the fastest of "
          "the database is %.2g m/s, and half of that is kept up: give it %s or more",
          leg.Object.ObjectId, leg.Seconds, distance, leg.To.Frame, distance / leg.Seconds,
          topSpeed, TimeText(distance / (KeptUp * topSpeed), scene.Info.Time).c_str())));
    }
  }
}

/// Rests that leave no time to come down by settling and the air together.
void FindFalls(const Scene& scene, const ObstacleSet& obstacles, const std::vector<Leg>& legs,
               double topSpeed, std::vector<Finding>& findings)
{
  for (const Leg& leg : legs)
  {
    SurfaceHit hit;
    if (!IsRest(leg.To.Kind))
    {
      continue;
    }
    const bool isAbove = obstacles.SurfaceBelow(leg.To.Value, leg.To.Frame, hit);
    const double height = leg.From.z() - (isAbove ? hit.Point.z() : leg.To.Value.z()) - leg.Room;
    const double fastest = leg.Object.SettlingSpeed + Sinking * topSpeed;
    if (height > fastest * leg.Seconds)
    {
      findings.push_back(AboutRow(
        "no time to fall", leg.To,
        Format(
          ": object %d falls %.3g m in %.3g s to its rest at frame %d; it settles at %.2g m/s: "
          "give it %s or more",
          leg.Object.ObjectId, height, leg.Seconds, leg.To.Frame, leg.Object.SettlingSpeed,
          TimeText(height / fastest, scene.Info.Time).c_str())));
    }
  }
}

/// Bodies that sink faster than air bears them to their marks, or in a form that drifts.
void FindSinking(const std::vector<Leg>& legs, double topSpeed, std::vector<Finding>& findings)
{
  for (const Leg& leg : legs)
  {
    const double height = leg.From.z() - leg.To.Value.z() + leg.Room + leg.To.Radius;
    const double asked = leg.Object.SettlingSpeed - height / leg.Seconds;
    const double adrift = leg.To.Drifts != 0 ? leg.Object.SettlingSpeed : 0.0;
    if (!IsRest(leg.To.Kind) && std::max(asked, adrift) > KeptUp * topSpeed)
    {
      findings.push_back(AboutRow(
        "too heavy", leg.To,
        Format(
          ": object %d sinks at %.2g m/s, and %s frame %d the air has to rise at %.2g m/s under "
          "it; the fastest of the database is %.2g m/s, and half of that is kept up: expected a "
          "smaller settling speed",
          leg.Object.ObjectId, leg.Object.SettlingSpeed,
          adrift > asked ? "to drift from" : "to be at its mark at", leg.To.Frame,
          std::max(asked, adrift), topSpeed)));
    }
  }
}

/// Rows that cannot be met, and objects that cannot be where they begin.
void FindImpossible(const Scene& scene, const PlanOutput& plan, std::vector<Finding>& findings)
{
  std::map<std::pair<int, int>, const Constraint*> rowOf;
  for (const Constraint& row : plan.Constraints)
  {
    rowOf.emplace(std::make_pair(row.Row, row.Target), &row);
  }
  for (const ReportRow& line : plan.Report)
  {
    if (line.Status != ConstraintStatus::Infeasible && line.Status != ConstraintStatus::Conflict)
    {
      continue;
    }
    Finding finding;
    finding.IsPossible = false;
    finding.Kind = ToString(line.Status);
    finding.ObjectId = line.ObjectId;
    finding.Frame = line.Frame;
    finding.Row = line.Row;
    finding.Target = line.Target;
    const auto row = rowOf.find({ line.Row, line.Target });
    if (row != rowOf.end() && IsPositional(line.Kind))
    {
      finding.Place = row->second->Value;
    }
    finding.Text = Format("row %d target %d (object %d, frame %d, %s): %s: ", line.Row, line.Target,
                          line.ObjectId, line.Frame, ToString(line.Kind), finding.Kind.c_str()) +
                   line.Message;
    findings.push_back(std::move(finding));
  }
  for (std::size_t i = 0; i < plan.Objects.size(); ++i)
  {
    if (!plan.Objects[i].Message.empty())
    {
      Finding finding;
      finding.Kind = "start";
      finding.Text = plan.Objects[i].Message;
      finding.ObjectId = plan.Objects[i].ObjectId;
      finding.Frame = 0;
      finding.Place = scene.Objects[i].Position;
      findings.push_back(std::move(finding));
    }
  }
}

void FindOdd(const std::vector<std::string>& sentences, std::vector<Finding>& findings)
{
  for (const std::string& sentence : sentences)
  {
    findings.emplace_back();
    findings.back().Text = sentence;
  }
}

} // namespace

std::string Format(const char* text, ...)
{
  char formatted[1024];
  va_list values;
  va_start(values, text);
  std::vsnprintf(formatted, sizeof formatted, text, values);
  va_end(values);
  return formatted;
}

Finding AboutRow(const char* kind, const Constraint& row, const std::string& text)
{
  Finding finding;
  finding.Kind = kind;
  finding.Text = kind +
                 (row.Row == OfNoRow ? Format(": the loop, to the start of object %d", row.Target)
                                     : Format(": row %d target %d", row.Row, row.Target)) +
                 text;
  finding.ObjectId = row.ObjectId;
  finding.Frame = row.Frame;
  finding.Row = row.Row;
  finding.Target = row.Target;
  finding.Place = row.Value;
  return finding;
}

bool CanBe(const Constraint& row)
{
  return row.Status != ConstraintStatus::Infeasible && row.Status != ConstraintStatus::Conflict;
}

std::string Finding::Line() const
{
  return (this->IsPossible ? "hard: " : "cannot be met: ") + this->Text;
}

std::size_t SceneJudgement::NumberOfImpossible() const
{
  return static_cast<std::size_t>(std::count_if(this->Findings.begin(), this->Findings.end(),
                                                [](const Finding& finding)
                                                { return !finding.IsPossible; }));
}

std::vector<std::string> SceneJudgement::Lines() const
{
  std::vector<std::string> lines;
  std::vector<std::pair<const Finding*, std::size_t>> kinds; // the first of each, and how many
  for (const Finding& finding : this->Findings)
  {
    auto same = std::find_if(kinds.begin(), kinds.end(),
                             [&finding](const auto& kind) {
                               return kind.first->Kind == finding.Kind &&
                                      kind.first->IsPossible == finding.IsPossible;
                             });
    if (same == kinds.end())
    {
      same = kinds.emplace(kinds.end(), &finding, 0);
    }
    if (++same->second <= Alike || finding.Kind.empty())
    {
      lines.push_back(finding.Line());
    }
  }
  for (const auto& [first, count] : kinds)
  {
    if (count > Alike && !first->Kind.empty())
    {
      Finding more = *first;
      more.Text = first->Kind + ": " + std::to_string(count - Alike) + " more";
      lines.push_back(more.Line());
    }
  }
  return lines;
}

Result JudgeScene(const Scene& scene, const MotionDatabase& database, const ParallelFor& parallel,
                  SceneJudgement& judgement)
{
  if (scene.Objects.empty())
  {
    return Result::Error("/objects: expected at least one object, found none");
  }
  ObstacleSet obstacles;
  WAFT_RETURN_IF_FAILED(
    BuildPlanObstacles(ObstaclesOfFrames(scene.Obstacles, scene.Info.Time), obstacles));
  const PlanInput input{ database, scene.Objects, scene.Constraints, obstacles, scene.Info };
  PlanOutput plan;
  WAFT_RETURN_IF_FAILED(JudgePlan(input, PlanOptions(), parallel, plan));
  SceneJudgement judged;
  judged.NumberOfObjects = scene.Objects.size();
  FindImpossible(scene, plan, judged.Findings);
  FindOdd(scene.Warnings, judged.Findings);
  FindOdd(DatabaseRemarks(database, scene.Info), judged.Findings);
  std::vector<Constraint> rows = plan.Constraints;
  if (scene.Info.Loops != 0)
  {
    int number = 0;
    WAFT_RETURN_IF_FAILED(CloseLoop(scene.Info, scene.Objects, obstacles, rows, number));
    for (Constraint& row : rows)
    {
      row.Row = row.Row == number ? OfNoRow : row.Row;
    }
  }
  const std::vector<Leg> legs = LegsOf(scene, rows);
  FindHaste(scene, legs, plan.TopSpeed, judged.Findings);
  FindFalls(scene, obstacles, legs, plan.TopSpeed, judged.Findings);
  FindSinking(legs, plan.TopSpeed, judged.Findings);
  FindCrowding(scene, obstacles, plan.Constraints, judged.Findings);
  if (const Result room = CheckRoom(VolumeAboveGround(scene), scene.Info.Time.NumberOfFrames,
                                    scene.Objects.size(), SpacetimeOptions());
      !room)
  {
    FindOdd({ "not in full: " + room.Message() }, judged.Findings);
    judged.Findings.back().Kind = "not in full";
  }
  judged.Constraints = std::move(plan.Constraints);
  judged.Report = std::move(plan.Report);
  judgement = std::move(judged);
  return Result::Ok();
}

} // namespace waft
