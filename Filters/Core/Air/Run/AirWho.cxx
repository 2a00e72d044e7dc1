// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Run/AirWho.h"

#include "Air/Run/AirRounds.h"
#include "Air/Run/AirSetup.h"
#include "Air/Run/RunProgress.h"
#include "Air/Run/WhoPairs.h"
#include "Base/NumberText.h"
#include "Constraints/ConstraintCheck.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <utility>

namespace waft
{
namespace
{

constexpr std::size_t MostChosen = 1000;

void Give(const ChosenTargets& group, const std::vector<std::size_t>& objects, AirContext& run)
{
  for (std::size_t t = 0; t < objects.size(); ++t)
  {
    for (const std::size_t i : group.Targets[t].Rows)
    {
      GiveTo(run.Input.Objects[objects[t]], run.Rows[i]);
    }
  }
}

std::vector<char> CountingRows(const AirContext& run, const std::vector<ReportRow>& report)
{
  std::vector<char> counts;
  for (const Constraint& row : run.Rows)
  {
    counts.push_back(IsBinding(row, report) ? 1 : 0);
  }
  return counts;
}

/// What choosing has brought, over targets.
struct Chosen
{
  int Changed = 0;
  std::size_t Targets = 0, Passing = 0; // pairs with an obstacle between that no plan was made for
  bool HasSpares = false;
  double Share = 0.0, WithoutSpares = 0.0; // of what legs cost

  void Add(const ChosenTargets& group, double share, double withoutSpares)
  {
    const auto size = static_cast<double>(group.Targets.size());
    this->Targets += group.Targets.size();
    this->Share += size * share;
    this->WithoutSpares += size * withoutSpares;
  }
  std::string Text() const
  {
    const auto all = static_cast<double>(this->Targets);
    std::string text =
      std::to_string(this->Changed) + " of " + std::to_string(this->Targets) +
      " marks go to other objects than by the shortest legs; the square of the control falls to " +
      NumberText(this->Share / all, 2) + " of that";
    if (this->HasSpares)
    {
      text +=
        " (with half as many pairs by chance to " + NumberText(this->WithoutSpares / all, 2) + ")";
    }
    if (this->Passing > 0)
    {
      text += "; " + std::to_string(this->Passing) +
              " pairs with an obstacle between were left out: a plan around it is the chain's";
    }
    return text;
  }
};

// Gives a group's targets out, if all rows that can be met still can.
Result ChooseIn(const ChosenTargets& group, const Choosing& choosing, AirContext& run,
                Chosen& chosen)
{
  if (group.Candidates.size() > MostChosen)
  {
    chosen.Add(group, 1.0, 1.0);
    return Result::Ok();
  }
  std::vector<WhoPair> pairs = JudgedPairs(choosing, group);
  if (!choosing.Caller.Tick(-1.0, ""))
  {
    return Result::Stopped();
  }
  if (!run.Input.PlanAround)
  {
    chosen.Passing += static_cast<std::size_t>(
      std::count_if(pairs.begin(), pairs.end(), [](const WhoPair& pair) { return pair.Passes; }));
  }
  const Giving giving = GiveOut(choosing, group, pairs);
  const std::vector<Constraint> before = run.Rows;
  Give(group, giving.Objects, run);
  const std::vector<ReportRow> judged =
    JudgeConstraints(run.Rows, run.Input.Objects, run.Obstacles, run.Input.Scene);
  if (CountingRows(run, judged) != choosing.Counts) // who would have a row cannot meet it
  {
    run.Rows = before;
    chosen.Add(group, 1.0, 1.0);
    return Result::Ok();
  }
  for (std::size_t t = 0; t < giving.Objects.size(); ++t)
  {
    chosen.Changed += giving.Objects[t] != group.Targets[t].Object ? 1 : 0;
  }
  const bool hasSpares = group.Candidates.size() > MostPaired;
  chosen.HasSpares = chosen.HasSpares || hasSpares;
  chosen.Add(group, giving.Share,
             hasSpares ? GivingOf(group, pairs, run.Input.Objects.size(), false).Share
                       : giving.Share);
  return Result::Ok();
}

void SetOpen(const ChosenTargets& group, char isOpen, Choosing& choosing)
{
  for (const ChosenTargets::Target& target : group.Targets)
  {
    for (const std::size_t i : target.Rows)
    {
      choosing.IsOpen[i] = isOpen;
    }
  }
}

// Who has other rows than the input gives it drifts there; that is its plan.
void PlanAnew(const AirContext& run, const AirSampler& air, const std::vector<char>& isChanged,
              AirBodies& bodies, std::vector<std::vector<Vec3>>& plans)
{
  std::vector<char> passes(bodies.Size(), 0);
  run.Parallel(bodies.Size(),
               [&](std::size_t begin, std::size_t end)
               {
                 for (std::size_t o = begin; o < end; ++o)
                 {
                   if (isChanged[o])
                   {
                     BodyProblem& body = bodies.Problems[o];
                     Way way =
                       LeastDrift(run, air, body, FurtherIterations, OtherStarts(air, body));
                     passes[o] = way.Passes ? 1 : 0;
                     plans[o] = std::move(way.Path);
                   }
                 }
               });
  std::vector<std::size_t> which;
  std::vector<MotionObject> objects;
  std::vector<Constraint> rows;
  for (std::size_t o = 0; run.Input.PlanAround && o < bodies.Size(); ++o)
  {
    if (passes[o])
    {
      which.push_back(o);
      objects.push_back(bodies.Problems[o].Object());
      const std::vector<Constraint>& own = bodies.Problems[o].Rows();
      std::copy_if(own.begin(), own.end(), std::back_inserter(rows),
                   [](const Constraint& row) { return row.Row != OfNoRow; });
    }
  }
  if (which.empty())
  {
    return;
  }
  std::vector<std::vector<Vec3>> around = run.Input.PlanAround(objects, rows);
  for (std::size_t k = 0; k < which.size(); ++k)
  {
    plans[which[k]] = around[k].empty() ? plans[which[k]] : std::move(around[k]);
  }
}

} // namespace

std::vector<int> WhoOf(const AirContext& run)
{
  std::vector<int> who;
  for (const Constraint& row : run.Rows)
  {
    if (row.Choice != ObjectChoice::Given || row.FrameFrom >= 0)
    {
      who.insert(who.end(), { row.Row, row.Target, row.ObjectId, ArrivalOf(row) });
    }
  }
  return who;
}

std::vector<std::vector<Vec3>> PlansOf(const AirContext& run)
{
  std::vector<std::vector<Vec3>> plans(run.Plans.size());
  for (std::size_t o = 0; o < plans.size(); ++o)
  {
    if (run.Plans[o] != run.Input.Tracks[o].Positions)
    {
      plans[o] = run.Plans[o];
    }
  }
  return plans;
}

Result ChooseWho(AirContext& run, AirState& state, AssimilationOutput& output)
{
  const AirSampler air(state.Sampled.Velocity);
  PartMonitor monitor(run.Caller, DrawEnd, DrawEnd, "Choosing who goes where by the air");
  Choosing choosing{ run, air, CountingRows(run, output.Report),
                     std::vector<char>(run.Rows.size(), 0), monitor };
  const std::vector<ChosenTargets> groups =
    CollectChosen(run.Input.Objects, run.Rows, choosing.Counts);
  if (groups.empty())
  {
    return Result::Ok();
  }
  for (const ChosenTargets& group : groups)
  {
    SetOpen(group, 1, choosing);
  }
  Chosen chosen;
  for (const ChosenTargets& group : groups)
  {
    const Result result = ChooseIn(group, choosing, run, chosen);
    if (!result || result.IsStopped())
    {
      return result;
    }
    SetOpen(group, 0, choosing);
  }
  std::map<int, std::size_t> trackOf;
  for (std::size_t o = 0; o < run.Input.Tracks.size(); ++o)
  {
    trackOf[run.Input.Tracks[o].ObjectId] = o;
  }
  std::vector<char> isChanged(run.Plans.size(), 0);
  for (std::size_t i = 0; i < run.Rows.size(); ++i)
  {
    for (const int id : { run.Rows[i].ObjectId, run.Input.Constraints[i].ObjectId })
    {
      if (run.Rows[i].ObjectId != run.Input.Constraints[i].ObjectId && trackOf.count(id) > 0)
      {
        isChanged[trackOf[id]] = 1;
      }
    }
  }
  WAFT_RETURN_IF_FAILED(SetUpBodies(run, state.Bodies, output));
  std::vector<std::vector<Vec3>> plans = run.Plans;
  PlanAnew(run, air, isChanged, state.Bodies, plans);
  run.Plans = std::move(plans);
  WAFT_RETURN_IF_FAILED(SetUpBodies(run, state.Bodies, output));
  AssimilationRound row = RoundOf(run, state, "who");
  row.Candidate = chosen.Text();
  output.Rounds.push_back(row);
  return Result::Ok();
}

Result TakeWho(const std::vector<int>& who, const std::vector<std::vector<Vec3>>& plans,
               AirContext& run, AirBodies& bodies, AssimilationOutput& output)
{
  std::map<std::pair<int, int>, int> ids, frames;
  for (std::size_t k = 0; k + 3 < who.size(); k += 4)
  {
    ids[{ who[k], who[k + 1] }] = who[k + 2];
    frames[{ who[k], who[k + 1] }] = who[k + 3];
  }
  for (Constraint& row : run.Rows)
  {
    const auto known = frames.find({ row.Row, row.Target });
    if (row.IsOpenWindow && known != frames.end() && known->second >= row.FrameFrom &&
        known->second <= row.Frame)
    {
      SetArrival(known->second, ValueAt(row, known->second, run.Obstacles), row);
    }
  }
  SetHolds(run.Input.Scene.Time.NumberOfFrames - 1, run.Rows);
  const std::vector<char> counts = CountingRows(run, output.Report);
  for (const ChosenTargets& group : CollectChosen(run.Input.Objects, run.Rows, counts))
  {
    // Those who are known first; the others by the shortest legs, but whom somebody else has.
    std::vector<char> isTaken(run.Input.Objects.size(), 0);
    std::vector<std::size_t> objects(group.Targets.size(), run.Input.Objects.size());
    const auto suits = [&](std::size_t t, std::size_t o)
    {
      const int classId = group.Targets[t].ClassId;
      return !isTaken[o] && (classId < 0 || classId == run.Input.Objects[o].ClassId);
    };
    const auto take = [&](std::size_t t, std::size_t o)
    {
      objects[t] = o;
      isTaken[o] = 1;
    };
    for (std::size_t t = 0; t < objects.size(); ++t)
    {
      const Constraint& row = run.Rows[group.Targets[t].Rows.front()];
      const auto known = ids.find({ row.Row, row.Target });
      for (const std::size_t o : group.Candidates)
      {
        if (known != ids.end() && run.Input.Objects[o].ObjectId == known->second && suits(t, o))
        {
          take(t, o);
        }
      }
    }
    for (const bool byLegs : { true, false })
    {
      for (std::size_t t = 0; t < objects.size(); ++t)
      {
        for (const std::size_t o : group.Candidates)
        {
          if (objects[t] == run.Input.Objects.size() && suits(t, o) &&
              (!byLegs || o == group.Targets[t].Object))
          {
            take(t, o);
          }
        }
      }
    }
    if (std::count(objects.begin(), objects.end(), run.Input.Objects.size()) > 0)
    {
      continue; // classes changed: by legs
    }
    Give(group, objects, run);
  }
  for (std::size_t o = 0; o < std::min(plans.size(), run.Plans.size()); ++o)
  {
    run.Plans[o] = plans[o].empty() ? run.Plans[o] : plans[o];
  }
  return SetUpBodies(run, bodies, output);
}

} // namespace waft
