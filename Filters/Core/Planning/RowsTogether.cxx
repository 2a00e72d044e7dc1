// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/RowsTogether.h"

#include "Constraints/LeastCost.h"
#include "Planning/PlannerNumbers.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace waft
{

namespace
{

constexpr std::size_t None = NoObject;

/// Is the target within the gap's time, and of a kind that its object can fulfil?
bool Fits(const TargetStops& target, const FlightGap& gap, const std::vector<MotionObject>& objects)
{
  return target.First.First > gap.From.Last && (gap.IsOpen || target.Last.Last < gap.To.First) &&
         target.Suits(objects[gap.Object]);
}

/// What the search has settled: this gap goes first to this target, or it does not.
struct Decision
{
  std::size_t Gap = 0;
  std::size_t Target = 0;
  bool IsNext = true;
};

struct Solution
{
  RankedCost Cost;
  std::vector<Decision> Decisions;
  std::vector<std::size_t> GapOf; // by target, None: left over
  bool HasMistake = false;
  Decision Mistake; // the way that begins with it ends where another object is to go on
};

/// The ways of objects as an assignment: what comes next takes what was before, either the end of a
/// fixed position or a target. A way that begins at one object's position may then end at
/// another's, or pass a target of the wrong class; so first legs of such ways are decided one by
/// one, the cheapest solution first (branch and bound).
class Cover
{
public:
  Cover(const std::vector<MotionObject>& objects, const std::vector<TargetStops>& targets,
        const std::vector<FlightGap>& gaps, const SpeedLimit& limit) :
    Objects(objects),
    Targets(targets), Gaps(gaps), Limit(limit)
  {
    for (std::size_t g = 0; g < this->Gaps.size(); ++g)
    {
      if (!this->Gaps[g].IsOpen)
      {
        this->Closed.push_back(g);
      }
    }
  }

  /// By target, the object, None where it is left over.
  std::vector<std::size_t> Run() const
  {
    const std::size_t pairs =
      (this->Targets.size() + this->Closed.size()) * (this->Targets.size() + this->Gaps.size());
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
        decisions.push_back({ best.Mistake.Gap, best.Mistake.Target, isNext });
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

  /// What is settled, and where ways begin then.
  struct Beginning
  {
    std::vector<Stop> From;                                 // by gap
    std::set<std::pair<std::size_t, std::size_t>> Excluded; // (gap, target): not its next
  };

  Solution Solve(std::vector<Decision> decisions) const;
  Beginning Settle(const std::vector<Decision>& decisions, Solution& solution) const;
  /// What may lead to each open target, and to each fixed position at the end of a gap.
  void AddTargets(const Beginning& begin, const Solution& solution,
                  AssignmentProblem& problem) const;
  void AddEnds(const Beginning& begin, const Solution& solution, AssignmentProblem& problem) const;
  /// Follows each gap's way, and finds the first that is not what it should be.
  void Follow(const std::vector<int>& chosen, Solution& solution) const;

  const std::vector<MotionObject>& Objects;
  const std::vector<TargetStops>& Targets;
  const std::vector<FlightGap>& Gaps;
  const SpeedLimit& Limit;
  std::vector<std::size_t> Closed; // gaps after which a position is fixed
};

Cover::Beginning Cover::Settle(const std::vector<Decision>& decisions, Solution& solution) const
{
  Beginning begin;
  for (const FlightGap& gap : this->Gaps)
  {
    begin.From.push_back(gap.From);
  }
  auto& excluded = begin.Excluded;
  for (const Decision& decision : decisions)
  {
    const std::size_t g = decision.Gap;
    if (!decision.IsNext)
    {
      excluded.emplace(g, decision.Target);
      continue;
    }
    const TargetStops& target = this->Targets[decision.Target];
    solution.Cost = solution.Cost + this->Leg(begin.From[g], target.First);
    solution.GapOf[decision.Target] = g;
    begin.From[g] = target.Last;
    excluded.erase(excluded.lower_bound({ g, 0 }), excluded.lower_bound({ g + 1, 0 }));
  }
  return begin;
}

void Cover::AddTargets(const Beginning& begin, const Solution& solution,
                       AssignmentProblem& problem) const
{
  const std::size_t targets = this->Targets.size();
  const std::size_t gaps = this->Gaps.size();
  for (std::size_t w = 0; w < targets; ++w)
  {
    const TargetStops& target = this->Targets[w];
    if (solution.GapOf[w] != None)
    {
      problem.LeftOut[w] = RankedCost();
      continue;
    }
    for (std::size_t g = 0; g < gaps; ++g)
    {
      if (Fits(target, this->Gaps[g], this->Objects) && target.First.First > begin.From[g].Last &&
          begin.Excluded.count({ g, w }) == 0)
      {
        problem.At(w, g) = this->Leg(begin.From[g], target.First);
      }
    }
    for (std::size_t v = 0; v < targets; ++v)
    {
      const TargetStops& before = this->Targets[v];
      if (solution.GapOf[v] == None && before.Last.Last < target.First.First &&
          (before.ClassId < 0 || target.ClassId < 0 || before.ClassId == target.ClassId))
      {
        problem.At(w, gaps + v) = this->Leg(before.Last, target.First);
      }
    }
    problem.At(w, gaps + w) = { static_cast<std::int64_t>(targets + gaps), 0.0 };
  }
}

void Cover::AddEnds(const Beginning& begin, const Solution& solution,
                    AssignmentProblem& problem) const
{
  const std::size_t targets = this->Targets.size();
  for (std::size_t k = 0; k < this->Closed.size(); ++k)
  {
    const std::size_t g = this->Closed[k];
    const FlightGap& gap = this->Gaps[g];
    problem.At(targets + k, g) = this->Leg(begin.From[g], gap.To);
    if (begin.From[g].First == gap.From.First) // as the user wants it, however fast
    {
      problem.At(targets + k, g) = { 0, (gap.To.Value - gap.From.Value).squaredNorm() };
    }
    for (std::size_t v = 0; v < targets; ++v)
    {
      if (solution.GapOf[v] == None && Fits(this->Targets[v], gap, this->Objects))
      {
        problem.At(targets + k, this->Gaps.size() + v) = this->Leg(this->Targets[v].Last, gap.To);
      }
    }
  }
}

/// Rows are targets, then the frames at which gaps end; columns are those at which gaps begin, then
/// targets. A gap that was decided to go first to a target begins there. A target that is left over
/// takes itself, so that no way begins with it.
Solution Cover::Solve(std::vector<Decision> decisions) const
{
  const std::size_t targets = this->Targets.size();
  const std::size_t gaps = this->Gaps.size();
  const auto count = static_cast<std::int64_t>(targets + gaps);
  Solution solution;
  solution.GapOf.assign(targets, None);
  const Beginning begin = this->Settle(decisions, solution);
  // Nothing of this is ever left out where it can be otherwise, neither a way to a fixed position.
  AssignmentProblem problem(
    gaps + targets, std::vector<RankedCost>(targets + this->Closed.size(), { count * count, 0.0 }));
  this->AddTargets(begin, solution, problem);
  this->AddEnds(begin, solution, problem);
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
  const std::size_t targets = this->Targets.size();
  const std::size_t gaps = this->Gaps.size();
  std::vector<std::size_t> nextOf(gaps + targets, None); // rows of the assignment
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
    for (; next < targets; next = nextOf[gaps + next])
    {
      isRight = isRight && Fits(this->Targets[next], this->Gaps[g], this->Objects);
      solution.GapOf[next] = g;
    }
    const std::size_t end = next == None ? None : this->Closed[next - targets];
    isRight = isRight && end == (this->Gaps[g].IsOpen ? None : g);
    if (!isRight && first < targets && !solution.HasMistake)
    {
      solution.HasMistake = true;
      solution.Mistake = { g, first, true };
    }
  }
}

} // namespace

std::vector<FlightGap> CollectGaps(const std::vector<MotionObject>& objects,
                                   const std::vector<std::vector<Stop>>& stops,
                                   const std::vector<TargetStops>& targets)
{
  std::vector<FlightGap> gaps;
  for (std::size_t o = 0; o < objects.size(); ++o)
  {
    for (std::size_t k = 0; k < stops[o].size(); ++k)
    {
      FlightGap gap;
      gap.Object = o;
      gap.From = stops[o][k];
      gap.IsOpen = k + 1 == stops[o].size();
      gap.To = gap.IsOpen ? Stop() : stops[o][k + 1];
      if (std::any_of(targets.begin(), targets.end(),
                      [&](const TargetStops& target) { return Fits(target, gap, objects); }))
      {
        gaps.push_back(gap);
      }
    }
  }
  return gaps;
}

std::vector<std::size_t> CoverTogether(const std::vector<MotionObject>& objects,
                                       const std::vector<TargetStops>& targets,
                                       const std::vector<FlightGap>& gaps, const SpeedLimit& limit)
{
  return targets.empty() ? std::vector<std::size_t>() : Cover(objects, targets, gaps, limit).Run();
}

} // namespace waft
