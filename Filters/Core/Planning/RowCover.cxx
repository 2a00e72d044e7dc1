// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/RowCover.h"

#include "Constraints/Keyframes.h"
#include "Constraints/LeastCost.h"
#include "Planning/PlannerNumbers.h"
#include "Planning/RowTurns.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace waft
{

namespace
{

constexpr std::size_t None = NoObject;

/// The rows of one (Row, Target).
struct Wish
{
  std::vector<std::size_t> Rows;
  Stop First, Last; // the same of a single row
  int ClassId = -1;
  bool IsFree = true; // it can be met

  bool Suits(const MotionObject& object) const
  {
    return this->ClassId < 0 || this->ClassId == object.ClassId;
  }
};

/// A stretch of an object's time line between two positions that are fixed.
struct Gap
{
  std::size_t Object = 0;
  Stop From;
  Stop To;
  bool IsOpen = true; // no position is fixed after it
};

/// Is the wish within the gap's time, and of a kind that its object can fulfil?
bool Fits(const Wish& wish, const Gap& gap, const std::vector<MotionObject>& objects)
{
  return wish.First.First > gap.From.Last && (gap.IsOpen || wish.Last.Last < gap.To.First) &&
         wish.Suits(objects[gap.Object]);
}

/// What the search has settled: this gap goes first to this wish, or it does not.
struct Decision
{
  std::size_t Gap = 0;
  std::size_t Wish = 0;
  bool IsNext = true;
};

struct Solution
{
  RankedCost Cost;
  std::vector<Decision> Decisions;
  std::vector<std::size_t> GapOf; // by wish, None: left over
  bool HasMistake = false;
  Decision Mistake; // the way that begins with it ends where another object is to go on
};

/// The ways of objects as an assignment: what comes next takes what was before, either the end of a
/// fixed position or a wish. A way that begins at one object's position may then end at another's,
/// or pass a wish of the wrong class; so first legs of such ways are decided one by one, the
/// cheapest solution first (branch and bound).
class Cover
{
public:
  Cover(const std::vector<MotionObject>& objects, const std::vector<Wish>& wishes,
        std::vector<Gap> gaps, const SpeedLimit& limit) :
    Objects(objects),
    Wishes(wishes), Gaps(std::move(gaps)), Limit(limit)
  {
    for (std::size_t g = 0; g < this->Gaps.size(); ++g)
    {
      if (!this->Gaps[g].IsOpen)
      {
        this->Closed.push_back(g);
      }
    }
  }

  /// By wish, the object, None where it is left over.
  std::vector<std::size_t> Run() const
  {
    const std::size_t pairs =
      (this->Wishes.size() + this->Closed.size()) * (this->Wishes.size() + this->Gaps.size());
    const std::size_t most =
      std::min(PlannerNumbers::MostSolutions, PlannerNumbers::MostPairs / pairs + 1);
    std::multimap<RankedCost, Solution> open; // equal ones in the order in which they were found
    Solution best = this->Solve({});
    for (std::size_t solved = 1; best.HasMistake; ++solved)
    {
      if (solved >= most)
      {
        open.clear(); // from here on straight to a solution
      }
      for (const bool isNext : { true, false })
      {
        std::vector<Decision> decisions = best.Decisions;
        decisions.push_back({ best.Mistake.Gap, best.Mistake.Wish, isNext });
        Solution solution = this->Solve(std::move(decisions));
        open.emplace(solution.Cost, std::move(solution));
      }
      best = std::move(open.begin()->second);
      open.erase(open.begin());
    }
    std::vector<std::size_t> chosen;
    for (const std::size_t gap : best.GapOf)
    {
      chosen.push_back(gap == None ? None : this->Gaps[gap].Object);
    }
    return chosen;
  }

private:
  RankedCost Leg(const Stop& from, const Stop& to) const
  {
    const double haste = this->Limit.Haste(from, to);
    return haste > 1.0 ? RankedCost::Never()
                       : RankedCost{ haste > PlannerNumbers::EasyHaste ? 1 : 0,
                                     (to.Value - from.Value).squaredNorm() };
  }

  Solution Solve(std::vector<Decision> decisions) const;
  /// Follows each gap's way, and finds the first that is not what it should be.
  void Follow(const std::vector<int>& chosen, Solution& solution) const;

  const std::vector<MotionObject>& Objects;
  const std::vector<Wish>& Wishes;
  std::vector<Gap> Gaps;
  const SpeedLimit& Limit;
  std::vector<std::size_t> Closed; // gaps after which a position is fixed
};

/// Rows are wishes, then the frames at which gaps end; columns are those at which gaps begin, then
/// wishes. A gap that was decided to go first to a wish begins there. A wish that is left over
/// takes itself, so that no way begins with it.
Solution Cover::Solve(std::vector<Decision> decisions) const
{
  const std::size_t wishes = this->Wishes.size();
  const std::size_t gaps = this->Gaps.size();
  const auto count = static_cast<std::int64_t>(wishes + gaps);
  Solution solution;
  solution.GapOf.assign(wishes, None);
  std::vector<Stop> from;
  for (const Gap& gap : this->Gaps)
  {
    from.push_back(gap.From);
  }
  std::set<std::pair<std::size_t, std::size_t>> excluded;
  for (const Decision& decision : decisions)
  {
    const std::size_t g = decision.Gap;
    if (!decision.IsNext)
    {
      excluded.emplace(g, decision.Wish);
      continue;
    }
    const Wish& wish = this->Wishes[decision.Wish];
    solution.Cost = solution.Cost + this->Leg(from[g], wish.First);
    solution.GapOf[decision.Wish] = g;
    from[g] = wish.Last;
    excluded.erase(excluded.lower_bound({ g, 0 }), excluded.lower_bound({ g + 1, 0 }));
  }
  const auto isOpen = [&](std::size_t w) { return solution.GapOf[w] == None; };
  // Nothing of this is ever left out where it can be otherwise, neither a way to a fixed position.
  AssignmentProblem problem(
    gaps + wishes, std::vector<RankedCost>(wishes + this->Closed.size(), { count * count, 0.0 }));
  for (std::size_t w = 0; w < wishes; ++w)
  {
    const Wish& wish = this->Wishes[w];
    if (!isOpen(w))
    {
      problem.LeftOut[w] = RankedCost();
      continue;
    }
    for (std::size_t g = 0; g < gaps; ++g)
    {
      if (Fits(wish, this->Gaps[g], this->Objects) && wish.First.First > from[g].Last &&
          excluded.count({ g, w }) == 0)
      {
        problem.At(w, g) = this->Leg(from[g], wish.First);
      }
    }
    for (std::size_t v = 0; v < wishes; ++v)
    {
      const Wish& before = this->Wishes[v];
      if (isOpen(v) && before.Last.Last < wish.First.First &&
          (before.ClassId < 0 || wish.ClassId < 0 || before.ClassId == wish.ClassId))
      {
        problem.At(w, gaps + v) = this->Leg(before.Last, wish.First);
      }
    }
    problem.At(w, gaps + w) = { count, 0.0 };
  }
  for (std::size_t k = 0; k < this->Closed.size(); ++k)
  {
    const std::size_t g = this->Closed[k];
    const Gap& gap = this->Gaps[g];
    problem.At(wishes + k, g) = this->Leg(from[g], gap.To);
    if (from[g].First == gap.From.First) // as the user wants it, however fast
    {
      problem.At(wishes + k, g) = { 0, (gap.To.Value - gap.From.Value).squaredNorm() };
    }
    for (std::size_t v = 0; v < wishes; ++v)
    {
      if (isOpen(v) && Fits(this->Wishes[v], gap, this->Objects))
      {
        problem.At(wishes + k, gaps + v) = this->Leg(this->Wishes[v].Last, gap.To);
      }
    }
  }
  const std::vector<int> chosen = AssignLeastCost(problem);
  for (std::size_t row = 0; row < chosen.size(); ++row)
  {
    solution.Cost =
      solution.Cost + (chosen[row] < 0 ? problem.LeftOut[row]
                                       : problem.At(row, static_cast<std::size_t>(chosen[row])));
  }
  solution.Decisions = std::move(decisions);
  this->Follow(chosen, solution);
  return solution;
}

void Cover::Follow(const std::vector<int>& chosen, Solution& solution) const
{
  const std::size_t wishes = this->Wishes.size();
  const std::size_t gaps = this->Gaps.size();
  std::vector<std::size_t> nextOf(gaps + wishes, None); // rows of the assignment
  for (std::size_t row = 0; row < chosen.size(); ++row)
  {
    if (chosen[row] >= 0)
    {
      nextOf[static_cast<std::size_t>(chosen[row])] = row;
    }
  }
  for (std::size_t g = 0; g < gaps; ++g)
  {
    const std::size_t first = nextOf[g];
    std::size_t next = first;
    bool isRight = true;
    for (; next < wishes; next = nextOf[gaps + next])
    {
      isRight = isRight && Fits(this->Wishes[next], this->Gaps[g], this->Objects);
      solution.GapOf[next] = g;
    }
    const std::size_t end = next == None ? None : this->Closed[next - wishes];
    isRight = isRight && end == (this->Gaps[g].IsOpen ? None : g);
    if (!isRight && first < wishes && !solution.HasMistake)
    {
      solution.HasMistake = true;
      solution.Mistake = { g, first, true };
    }
  }
}

std::vector<Wish> CollectWishes(const std::vector<unsigned char>& isFree,
                                const ObstacleSet& obstacles, const std::vector<Constraint>& rows)
{
  std::map<std::pair<int, int>, Wish> wishes;
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    const Constraint& row = rows[i];
    if (row.ObjectId >= 0 || row.Group >= 0 || !IsPositional(row.Kind))
    {
      continue;
    }
    const Stop stop = StopOf(row, 0.0, obstacles);
    Wish& wish = wishes[{ row.Row, row.Target }];
    const bool isNew = wish.Rows.empty();
    wish.First = isNew || stop.First < wish.First.First ? stop : wish.First;
    wish.Last = isNew || stop.Last > wish.Last.Last ? stop : wish.Last;
    wish.ClassId = std::max(wish.ClassId, row.ClassId);
    wish.IsFree = wish.IsFree && isFree[i] != 0;
    wish.Rows.push_back(i);
  }
  std::vector<Wish> result;
  for (auto& entry : wishes)
  {
    result.push_back(std::move(entry.second));
  }
  // Those that can be met come first, in order of time.
  std::stable_sort(
    result.begin(), result.end(),
    [](const Wish& a, const Wish& b)
    { return std::pair(!a.IsFree, a.First.First) < std::pair(!b.IsFree, b.First.First); });
  return result;
}

/// The positions that each object is fixed to, in order of time, its start first.
std::vector<std::vector<Stop>> FixedStops(const std::vector<MotionObject>& objects,
                                          const std::vector<unsigned char>& isFree,
                                          const ObstacleSet& obstacles,
                                          const std::vector<Constraint>& rows)
{
  std::map<int, std::size_t> indexOf;
  std::vector<std::vector<Stop>> stops(objects.size());
  for (std::size_t o = 0; o < objects.size(); ++o)
  {
    indexOf[objects[o].ObjectId] = o;
    stops[o].push_back(StartOf(objects[o]));
  }
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    const auto object = indexOf.find(rows[i].ObjectId);
    if (object != indexOf.end() && IsPositional(rows[i].Kind) && isFree[i] != 0)
    {
      stops[object->second].push_back(
        StopOf(rows[i], objects[object->second].RestHeight, obstacles));
    }
  }
  for (std::vector<Stop>& own : stops)
  {
    std::stable_sort(own.begin(), own.end(),
                     [](const Stop& a, const Stop& b)
                     { return std::pair(a.First, a.Last) < std::pair(b.First, b.Last); });
  }
  return stops;
}

std::vector<Gap> CollectGaps(const std::vector<MotionObject>& objects,
                             const std::vector<std::vector<Stop>>& stops,
                             const std::vector<Wish>& wishes)
{
  std::vector<Gap> gaps;
  for (std::size_t o = 0; o < objects.size(); ++o)
  {
    for (std::size_t k = 0; k < stops[o].size(); ++k)
    {
      Gap gap;
      gap.Object = o;
      gap.From = stops[o][k];
      gap.IsOpen = k + 1 == stops[o].size();
      gap.To = gap.IsOpen ? Stop() : stops[o][k + 1];
      if (std::any_of(wishes.begin(), wishes.end(),
                      [&](const Wish& wish) { return Fits(wish, gap, objects); }))
      {
        gaps.push_back(gap);
      }
    }
  }
  return gaps;
}

/// The object that comes nearest in time to a wish that no way leads to: of those that have nothing
/// else to do, or of all when the wish cannot be met anyway.
std::size_t Nearest(const Wish& wish, const std::vector<MotionObject>& objects,
                    const std::vector<unsigned char>& isIdle, const SpeedLimit& limit)
{
  std::size_t nearest = None;
  double least = 0.0;
  for (std::size_t o = 0; o < objects.size(); ++o)
  {
    const double haste = limit.Haste(StartOf(objects[o]), wish.First);
    if (wish.Suits(objects[o]) && (isIdle[o] != 0 || !wish.IsFree) &&
        (nearest == None || haste < least))
    {
      nearest = o;
      least = haste;
    }
  }
  return nearest;
}

/// By wish, the object: all together, or where they are too many for that one after the other.
std::vector<std::size_t> Choose(const std::vector<MotionObject>& objects,
                                const std::vector<Wish>& wishes,
                                const std::vector<std::vector<Stop>>& stops,
                                const SpeedLimit& limit)
{
  if (wishes.empty())
  {
    return {};
  }
  std::vector<Gap> gaps = CollectGaps(objects, stops, wishes);
  if (wishes.size() + gaps.size() <= PlannerNumbers::MostTogether)
  {
    return Cover(objects, wishes, std::move(gaps), limit).Run();
  }
  std::vector<TurnWish> turns;
  for (const Wish& wish : wishes)
  {
    turns.push_back({ wish.First, wish.Last, wish.ClassId });
  }
  return CoverInTurn(objects, stops, turns, limit);
}

} // namespace

void CoverRows(const std::vector<MotionObject>& objects, const std::vector<unsigned char>& isFree,
               const ObstacleSet& obstacles, const SpeedLimit& limit, std::vector<Constraint>& rows)
{
  const std::vector<Wish> wishes = CollectWishes(isFree, obstacles, rows);
  if (wishes.empty())
  {
    return;
  }
  const auto end =
    std::find_if(wishes.begin(), wishes.end(), [](const Wish& wish) { return !wish.IsFree; });
  const std::vector<Wish> free(wishes.begin(), end);
  const std::vector<std::vector<Stop>> stops = FixedStops(objects, isFree, obstacles, rows);
  std::vector<unsigned char> isIdle;
  for (const std::vector<Stop>& own : stops)
  {
    isIdle.push_back(own.size() == 1 ? 1 : 0);
  }
  std::vector<std::size_t> chosen = Choose(objects, free, stops, limit);
  for (const std::size_t object : chosen)
  {
    if (object != None)
    {
      isIdle[object] = 0;
    }
  }
  chosen.resize(wishes.size(), None);
  for (std::size_t w = 0; w < wishes.size(); ++w)
  {
    if (chosen[w] == None)
    {
      chosen[w] = Nearest(wishes[w], objects, isIdle, limit);
    }
    if (chosen[w] == None)
    {
      continue;
    }
    isIdle[chosen[w]] = 0;
    for (const std::size_t row : wishes[w].Rows)
    {
      rows[row].ObjectId = objects[chosen[w]].ObjectId;
    }
  }
}

} // namespace waft
