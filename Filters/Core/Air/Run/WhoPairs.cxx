// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Run/WhoPairs.h"

#include "Air/Run/AirSetup.h"
#include "Air/Run/AirWhen.h"
#include "Base/Random.h"
#include "Constraints/LeastCost.h"
#include "Constraints/RowsOfObjects.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>

namespace waft
{
namespace
{

// Objects a target, of more than are paired with all: by legs, and by chance.
constexpr std::size_t ByLegs = 8, ByChance = 16;
constexpr std::uint64_t PairStream = 0x77686f;
constexpr int TriedIterations = 3;   // of each start, of which the cheapest goes on
constexpr int PairIterations = 6;    // in all
constexpr double MostOverLegs = 3.0; // by its start, of a pair that is looked at closely
constexpr int MostPlannings = 6;     // of pairs with an obstacle between, in a group
constexpr int FramesOfPairs = 3;     // that are tried of a window
constexpr double Never = std::numeric_limits<double>::infinity();

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
                       return IsPositional(row.Kind) && EarliestFrame(row) <= until &&
                              LastFrame(row) >= frame;
                     });
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

// The pairs that are tried: all, or of each target those objects with which an exchange makes the
// legs of both least longer, and some by chance.
std::vector<WhoPair> PairsOf(const ChosenTargets& group, const AirContext& run,
                             const std::map<int, Vec3>& places)
{
  std::vector<WhoPair> pairs;
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
    const bool isAll = group.Candidates.size() <= MostPaired;
    const std::size_t tried = std::min(longer.size(), isAll ? longer.size() : ByLegs + ByChance);
    Random random(run.Input.Scene.Seed, PairStream + t);
    for (std::size_t k = isAll ? tried : ByLegs; k < tried; ++k)
    {
      std::swap(longer[k], longer[k + random.Index(static_cast<std::uint32_t>(longer.size() - k))]);
    }
    for (std::size_t k = 0; k < tried; ++k)
    {
      pairs.push_back({ t, longer[k].second, Never, false, !isAll && k >= ByLegs + ByChance / 2 });
    }
  }
  return pairs;
}

// The rows that the object of a pair would have; none where it is asked for elsewhere meanwhile.
std::vector<Constraint> RowsOf(const Choosing& choosing, const ChosenTargets& group,
                               const RowsOfObjects& places, const WhoPair& pair)
{
  const AirContext& run = choosing.Run;
  const ChosenTargets::Target& target = group.Targets[pair.Target];
  const int id = run.Input.Objects[pair.Object].ObjectId;
  std::vector<Constraint> rows = OwnRows(run, places, id, choosing.Counts, choosing.IsOpen);
  const bool isHung = run.Input.Objects[pair.Object].Release >= target.Frame;
  if (pair.Object != target.Object && (isHung || IsAsked(rows, target.Frame, target.Until)))
  {
    return {};
  }
  for (const std::size_t i : target.Rows)
  {
    rows.push_back(run.Rows[i]);
    rows.back().ObjectId = id;
  }
  return rows;
}

// Of an object by index; objects of the input have no track where they do not fly.
std::size_t TrackOf(const AirContext& run, std::size_t object)
{
  const std::vector<Track>& tracks = run.Input.Tracks;
  const int id = run.Input.Objects[object].ObjectId;
  const auto found = std::find_if(tracks.begin(), tracks.end(),
                                  [id](const Track& own) { return own.ObjectId == id; });
  return static_cast<std::size_t>(found - tracks.begin());
}

// A pair that comes at a frame, if that costs less than what was tried; only roughly where it costs
// more than `most`.
void JudgeAt(const Choosing& choosing, const ChosenTargets& group, int frame,
             std::vector<Constraint> rows, double most, WhoPair& pair)
{
  const AirContext& run = choosing.Run;
  const MotionObject& object = run.Input.Objects[pair.Object];
  const bool isPlanned = pair.Object == group.Targets[pair.Target].Object &&
                         frame == rows.back().Frame; // the plan is of just this
  const int sooner = IsRest(rows.back().Kind) ? rows.back().Frame - frame : 0;
  SetArrivals(Constraint(rows.back()), frame, run.Obstacles, rows);
  BodyProblem body = ProblemOf(run, object, run.Plans[TrackOf(run, pair.Object)], std::move(rows));
  const Way way = isPlanned
                    ? LeastDrift(run, choosing.Air, body, PairIterations,
                                 body.Starts(choosing.Air, 0), Obstacles::MayBePassed, most)
                    : LeastDrift(run, choosing.Air, body, PairIterations,
                                 OtherStarts(choosing.Air, body), Obstacles::InTheWay, most);
  const double cost = way.Passes
                        ? LeastDrift(run, choosing.Air, body, PairIterations,
                                     OtherStarts(choosing.Air, body), Obstacles::NotThere, most)
                            .Cost
                        : way.Cost;
  const double longer = 1.0 + static_cast<double>(sooner) / body.NumberOfFlownSteps();
  if (pair.Cost == Never || longer * cost < pair.Cost)
  {
    pair.Cost = longer * cost; // as lying costs nothing
    pair.Passes = way.Passes;
  }
}

// What a pair costs; only roughly where that is more than `most`.
void Judge(const Choosing& choosing, const ChosenTargets& group, const RowsOfObjects& places,
           double most, WhoPair& pair)
{
  const AirContext& run = choosing.Run;
  const std::vector<Constraint> rows = RowsOf(choosing, group, places, pair);
  const std::size_t track = TrackOf(run, pair.Object);
  if (!rows.empty() && track < run.Plans.size())
  {
    for (const int frame : FramesOf(run, run.Input.Objects[pair.Object], rows.back(),
                                    OthersOf(rows.back(), rows), FramesOfPairs))
    {
      JudgeAt(choosing, group, frame, rows, most, pair);
    }
  }
}

// What each pair costs; the others of a target are held against that by legs.
void JudgeAll(const Choosing& choosing, const ChosenTargets& group, std::vector<WhoPair>& pairs)
{
  const RowsOfObjects places(choosing.Run.Rows);
  std::vector<double> most(group.Targets.size(), Never);
  for (const bool byLegs : { true, false })
  {
    choosing.Run.Parallel(
      pairs.size(),
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t p = begin; p < end && choosing.Caller.Tick(-1.0, ""); ++p)
        {
          WhoPair& pair = pairs[p];
          if (byLegs == (pair.Object == group.Targets[pair.Target].Object))
          {
            Judge(choosing, group, places, byLegs ? Never : most[pair.Target], pair);
            most[pair.Target] = byLegs ? MostOverLegs * pair.Cost : most[pair.Target];
          }
        }
      });
  }
}

// Pairs with an obstacle between, from plans around it; without a plan they are none.
void PlanPairs(const Choosing& choosing, const ChosenTargets& group,
               const std::vector<WhoPair*>& pairs)
{
  const AirContext& run = choosing.Run;
  const RowsOfObjects places(run.Rows);
  std::vector<MotionObject> objects;
  std::vector<Constraint> rows;
  for (const WhoPair* pair : pairs)
  {
    objects.push_back(run.Input.Objects[pair->Object]);
    const std::vector<Constraint> own = RowsOf(choosing, group, places, *pair);
    rows.insert(rows.end(), own.begin(), own.end());
  }
  const std::vector<std::vector<Vec3>> plans = run.Input.PlanAround(objects, rows);
  run.Parallel(pairs.size(),
               [&](std::size_t begin, std::size_t end)
               {
                 for (std::size_t p = begin; p < end; ++p)
                 {
                   Way way;
                   if (!plans[p].empty())
                   {
                     BodyProblem body = ProblemOf(run, objects[p], plans[p],
                                                  RowsOf(choosing, group, places, *pairs[p]));
                     way = LeastDrift(run, choosing.Air, body, PairIterations, { plans[p] });
                   }
                   pairs[p]->Cost = way.Passes ? Never : way.Cost;
                   pairs[p]->Passes = false;
                 }
               });
}

} // namespace

Way LeastDrift(const AirContext& run, const AirSampler& air, BodyProblem& body, int iterations,
               std::vector<std::vector<Vec3>> starts, Obstacles obstacles, double most)
{
  SetLatestTouchDowns(run.Search, body);
  DriftProblem problem = body.In(air);
  problem.TooNear = obstacles == Obstacles::NotThere ? nullptr : problem.TooNear;
  const auto drifted = [&](std::vector<Vec3> path, int tries)
  {
    const double cost = SolveDrift(problem, air, run.Search.Weights, tries, path).Cost;
    const bool passes =
      obstacles == Obstacles::InTheWay && run.FromSolids && body.PassesThrough(path);
    return Way{ cost, passes, std::move(path) };
  };
  Way least;
  for (std::vector<Vec3>& path : starts)
  {
    Way way = drifted(std::move(path), iterations / 2);
    const bool isBetter = way.Passes == least.Passes ? way.Cost < least.Cost : least.Passes;
    if (least.Cost == Never || isBetter)
    {
      least = std::move(way);
    }
  }
  if (!(least.Cost < most))
  {
    return least;
  }
  Way further = drifted(least.Path, iterations - iterations / 2);
  return further.Passes && !least.Passes ? least : further;
}

std::vector<std::vector<Vec3>> OtherStarts(const AirSampler& air, const BodyProblem& body)
{
  std::vector<std::vector<Vec3>> starts = body.Starts(air, 0);
  starts.erase(starts.begin());
  return starts;
}

std::vector<WhoPair> JudgedPairs(const Choosing& choosing, const ChosenTargets& group)
{
  std::vector<WhoPair> pairs =
    PairsOf(group, choosing.Run, PlacesBefore(choosing.Run, choosing.IsOpen, group.FirstFrame()));
  JudgeAll(choosing, group, pairs);
  return pairs;
}

Giving GivingOf(const ChosenTargets& group, const std::vector<WhoPair>& pairs, std::size_t objects,
                bool all)
{
  AssignmentProblem problem(objects,
                            std::vector<RankedCost>(group.Targets.size(), RankedCost{ 1, 0.0 }));
  double before = 0.0, after = 0.0;
  for (const WhoPair& pair : pairs)
  {
    if (pair.Cost < Never && (all || !pair.IsSpare))
    {
      problem.At(pair.Target, pair.Object) = { 0, pair.Cost };
    }
    before += pair.Object == group.Targets[pair.Target].Object ? pair.Cost : 0.0;
  }
  const std::vector<int> chosen = AssignLeastCost(problem);
  if (std::count(chosen.begin(), chosen.end(), -1) > 0)
  {
    return {};
  }
  Giving giving;
  giving.Objects.assign(chosen.begin(), chosen.end());
  for (std::size_t t = 0; t < chosen.size(); ++t)
  {
    after += problem.At(t, giving.Objects[t]).Amount;
  }
  giving.Share = before > 0.0 ? after / before : 1.0;
  return giving;
}

// What a pair with an obstacle between costs is known by a plan alone, and but a bound before:
// those that would be taken are planned, and it is given out anew.
Giving GiveOut(const Choosing& choosing, const ChosenTargets& group, std::vector<WhoPair>& pairs)
{
  const std::size_t objects = choosing.Run.Input.Objects.size();
  for (int k = 0; choosing.Run.Input.PlanAround && k < MostPlannings; ++k)
  {
    const Giving giving = GivingOf(group, pairs, objects, true);
    std::vector<WhoPair*> taken;
    for (WhoPair& pair : pairs)
    {
      if (pair.Passes && !giving.Objects.empty() && giving.Objects[pair.Target] == pair.Object)
      {
        taken.push_back(&pair);
      }
    }
    if (taken.empty())
    {
      return giving;
    }
    PlanPairs(choosing, group, taken);
  }
  for (WhoPair& pair : pairs)
  {
    pair.Cost = pair.Passes ? Never : pair.Cost;
  }
  return GivingOf(group, pairs, objects, true);
}

} // namespace waft
