// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Run/AirWho.h"

#include "Air/Run/AirRounds.h"
#include "Air/Run/AirSetup.h"
#include "Air/Run/RunProgress.h"
#include "Constraints/ConstraintCheck.h"
#include "Constraints/Keyframes.h"
#include "Constraints/LeastCost.h"
#include "Constraints/RowsOfObjects.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

namespace waft
{
namespace
{

constexpr std::size_t MostPaired = 100; // objects, of which all pairs are tried
constexpr std::size_t MostChosen = 1000;
constexpr std::size_t MostTried = 24; // objects a target, of more
constexpr int PairIterations = 6;     // of each start
constexpr double Never = std::numeric_limits<double>::infinity();

struct Pair
{
  std::size_t Target = 0, Object = 0;
  double Cost = Never;
};

/// Of the rows of an object that count beside those that are open still.
std::vector<Constraint> OwnRows(const AirContext& run, const RowsOfObjects& places, int id,
                                const std::vector<char>& counts, const std::vector<char>& isOpen)
{
  std::vector<Constraint> rows;
  for (const std::size_t i : places.Of(id))
  {
    if (counts[i] && !isOpen[i])
    {
      rows.push_back(run.Rows[i]);
    }
  }
  return rows;
}

bool IsAsked(const std::vector<Constraint>& rows, int frame, int until)
{
  return std::any_of(rows.begin(), rows.end(),
                     [&](const Constraint& row) {
                       return IsPositional(row.Kind) && row.Frame <= until &&
                              LastFrame(row) >= frame;
                     });
}

// The least cost of a drift by rows, and its path. mayPass: what leads through an obstacle counts.
double DriftBy(const AirContext& run, const AirSampler& air, BodyProblem& body, int iterations,
               bool mayPass, std::vector<Vec3>& path)
{
  SetLatestTouchDowns(run.Search, body);
  const DriftProblem problem = body.In(air);
  std::vector<std::vector<Vec3>> starts = body.Starts(air, 0);
  double least = Never;
  for (std::size_t k = mayPass ? 0 : 1; k < starts.size(); ++k) // the plan leads elsewhere
  {
    const double cost = SolveDrift(problem, air, run.Search.Weights, iterations, starts[k]).Cost;
    const bool passes = !mayPass && run.FromSolids && body.PassesThrough(starts[k]);
    if (!passes && cost < least)
    {
      least = cost;
      path = std::move(starts[k]);
    }
  }
  return least;
}

// The pairs that are tried: all, or of each target those objects with which an exchange makes the
// legs of both least longer.
std::vector<Pair> PairsOf(const ChosenTargets& group, const AirContext& run,
                          const std::map<int, Vec3>& places)
{
  std::vector<Pair> pairs;
  const std::vector<MotionObject>& objects = run.Input.Objects;
  const auto leg = [&](std::size_t o, const Vec3& to)
  { return (to - places.at(objects[o].ObjectId)).norm(); };
  std::vector<const ChosenTargets::Target*> ownOf(objects.size(), nullptr);
  for (const ChosenTargets::Target& target : group.Targets)
  {
    ownOf[target.Object] = &target;
  }
  for (std::size_t t = 0; t < group.Targets.size(); ++t)
  {
    const ChosenTargets::Target& target = group.Targets[t];
    std::vector<std::pair<double, std::size_t>> longer;
    for (const std::size_t o : group.Candidates)
    {
      if (target.ClassId < 0 || target.ClassId == objects[o].ClassId)
      {
        const ChosenTargets::Target* other = ownOf[o];
        const double exchanged =
          other ? leg(target.Object, other->Position) - leg(o, other->Position) : 0.0;
        longer.emplace_back(o == target.Object ? -Never : leg(o, target.Position) + exchanged, o);
      }
    }
    std::sort(longer.begin(), longer.end());
    longer.resize(group.Candidates.size() > MostPaired ? std::min(longer.size(), MostTried)
                                                       : longer.size());
    for (const auto& [by, o] : longer)
    {
      pairs.push_back({ t, o, Never });
    }
  }
  return pairs;
}

// Where each object was last asked to be before a frame, or its start.
std::map<int, Vec3> PlacesBefore(const AirContext& run, const std::vector<char>& isOpen, int frame)
{
  std::map<int, std::pair<int, Vec3>> last;
  for (const MotionObject& object : run.Input.Objects)
  {
    last[object.ObjectId] = { -1, object.Position };
  }
  for (std::size_t i = 0; i < run.Rows.size(); ++i)
  {
    const Constraint& row = run.Rows[i];
    const auto own = last.find(row.ObjectId);
    if (own != last.end() && !isOpen[i] && IsPositional(row.Kind) && row.Frame < frame &&
        row.Frame > own->second.first)
    {
      own->second = { row.Frame, row.Value };
    }
  }
  std::map<int, Vec3> places;
  for (const auto& [id, at] : last)
  {
    places[id] = at.second;
  }
  return places;
}

void GiveTo(const ChosenTargets::Target& target, int id, std::vector<Constraint>& rows)
{
  for (const std::size_t i : target.Rows)
  {
    rows[i].ObjectId = id;
  }
}

// What each pair costs.
void Judge(const AirContext& run, const AirSampler& air, const ChosenTargets& group,
           const std::vector<char>& counts, const std::vector<char>& isOpen,
           std::vector<Pair>& pairs, Monitor& monitor)
{
  const RowsOfObjects places(run.Rows);
  run.Parallel(pairs.size(),
               [&](std::size_t begin, std::size_t end)
               {
                 for (std::size_t p = begin; p < end && monitor.Tick(-1.0, ""); ++p)
                 {
                   Pair& pair = pairs[p];
                   const ChosenTargets::Target& target = group.Targets[pair.Target];
                   const MotionObject& object = run.Input.Objects[pair.Object];
                   const bool has = pair.Object == target.Object;
                   std::vector<Constraint> rows =
                     OwnRows(run, places, object.ObjectId, counts, isOpen);
                   if (!has && IsAsked(rows, target.Frame, target.Until))
                   {
                     continue;
                   }
                   for (const std::size_t i : target.Rows)
                   {
                     rows.push_back(run.Rows[i]);
                     rows.back().ObjectId = object.ObjectId;
                   }
                   const auto track = std::find_if(run.Input.Tracks.begin(), run.Input.Tracks.end(),
                                                   [&](const Track& own)
                                                   { return own.ObjectId == object.ObjectId; });
                   const auto at = static_cast<std::size_t>(track - run.Input.Tracks.begin());
                   if (at < run.Plans.size())
                   {
                     BodyProblem body = ProblemOf(run, object, run.Plans[at], std::move(rows));
                     std::vector<Vec3> path;
                     pair.Cost = DriftBy(run, air, body, PairIterations, has, path);
                   }
                 }
               });
}

// Gives a group's targets out by least cost. By how much of what legs cost they then do.
double GiveOut(const ChosenTargets& group, const std::vector<Pair>& pairs,
               const std::vector<MotionObject>& objects, std::vector<Constraint>& rows,
               int& changed)
{
  AssignmentProblem problem(objects.size(),
                            std::vector<RankedCost>(group.Targets.size(), RankedCost{ 1, 0.0 }));
  double before = 0.0, after = 0.0;
  for (const Pair& pair : pairs)
  {
    if (pair.Cost < Never)
    {
      problem.At(pair.Target, pair.Object) = { 0, pair.Cost };
    }
    before += pair.Object == group.Targets[pair.Target].Object ? pair.Cost : 0.0;
  }
  const std::vector<int> chosen = AssignLeastCost(problem);
  if (std::find(chosen.begin(), chosen.end(), -1) != chosen.end())
  {
    return 1.0;
  }
  for (std::size_t t = 0; t < chosen.size(); ++t)
  {
    const auto o = static_cast<std::size_t>(chosen[t]);
    after += problem.At(t, o).Amount;
    changed += o != group.Targets[t].Object ? 1 : 0;
    GiveTo(group.Targets[t], objects[o].ObjectId, rows);
  }
  return before > 0.0 ? after / before : 1.0;
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

// Who has other rows than the input gives it drifts there; that is its plan.
void PlanAnew(const AirContext& run, const AirSampler& air, const std::vector<char>& isChanged,
              AirBodies& bodies, std::vector<std::vector<Vec3>>& plans)
{
  run.Parallel(bodies.Size(),
               [&](std::size_t begin, std::size_t end)
               {
                 for (std::size_t o = begin; o < end; ++o)
                 {
                   if (isChanged[o])
                   {
                     (void)DriftBy(run, air, bodies.Problems[o], FurtherIterations, false,
                                   plans[o]);
                   }
                 }
               });
}

} // namespace

std::vector<int> WhoOf(const AirContext& run)
{
  std::vector<int> who;
  for (const Constraint& row : run.Rows)
  {
    if (row.Choice != ObjectChoice::Given)
    {
      who.insert(who.end(), { row.Row, row.Target, row.ObjectId });
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
  std::vector<char> counts = CountingRows(run, output.Report);
  const std::vector<ChosenTargets> groups = CollectChosen(run.Input.Objects, run.Rows, counts);
  if (groups.empty())
  {
    return Result::Ok();
  }
  PartMonitor monitor(run.Caller, DrawEnd, DrawEnd, "Choosing who goes where by the air");
  const AirSampler air(state.Sampled.Velocity);
  std::vector<char> isOpen(run.Rows.size(), 0);
  for (const ChosenTargets& group : groups)
  {
    for (const ChosenTargets::Target& target : group.Targets)
    {
      for (const std::size_t i : target.Rows)
      {
        isOpen[i] = 1;
      }
    }
  }
  int changed = 0;
  std::size_t targets = 0;
  double share = 0.0;
  for (const ChosenTargets& group : groups)
  {
    targets += group.Targets.size();
    const auto size = static_cast<double>(group.Targets.size());
    if (group.Candidates.size() <= MostChosen)
    {
      std::vector<Pair> pairs =
        PairsOf(group, run, PlacesBefore(run, isOpen, group.Targets.front().Frame));
      Judge(run, air, group, counts, isOpen, pairs, monitor);
      if (!monitor.Tick(-1.0, ""))
      {
        return Result::Stopped();
      }
      const std::vector<Constraint> before = run.Rows;
      int own = 0;
      const double now = GiveOut(group, pairs, run.Input.Objects, run.Rows, own);
      const std::vector<ReportRow> judged =
        JudgeConstraints(run.Rows, run.Input.Objects, run.Obstacles, run.Input.Scene);
      const std::vector<char> still = CountingRows(run, judged);
      const bool isWorse = still != counts; // a row that cannot be met by who would have it
      run.Rows = isWorse ? before : run.Rows;
      changed += isWorse ? 0 : own;
      share += size * (isWorse ? 1.0 : now);
    }
    else
    {
      share += size;
    }
    for (const ChosenTargets::Target& target : group.Targets)
    {
      for (const std::size_t i : target.Rows)
      {
        isOpen[i] = 0;
      }
    }
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
  row.Candidate = std::to_string(changed) + " of " + std::to_string(targets) +
                  " marks go to other objects than by the shortest legs; the square of the control "
                  "falls to " +
                  NumberText(share / static_cast<double>(targets), 2) + " of that";
  output.Rounds.push_back(row);
  return Result::Ok();
}

Result TakeWho(const std::vector<int>& who, const std::vector<std::vector<Vec3>>& plans,
               AirContext& run, AirBodies& bodies, AssimilationOutput& output)
{
  std::map<std::pair<int, int>, int> ids;
  for (std::size_t k = 0; k + 2 < who.size(); k += 3)
  {
    ids[{ who[k], who[k + 1] }] = who[k + 2];
  }
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
    for (std::size_t t = 0; t < objects.size(); ++t)
    {
      GiveTo(group.Targets[t], run.Input.Objects[objects[t]].ObjectId, run.Rows);
    }
  }
  for (std::size_t o = 0; o < std::min(plans.size(), run.Plans.size()); ++o)
  {
    run.Plans[o] = plans[o].empty() ? run.Plans[o] : plans[o];
  }
  return SetUpBodies(run, bodies, output);
}

} // namespace waft
