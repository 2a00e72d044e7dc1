// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/RowCover.h"

#include "Constraints/Keyframes.h"
#include "Planning/PlannerNumbers.h"
#include "Planning/RowTurns.h"
#include "Planning/RowsTogether.h"

#include <algorithm>
#include <map>
#include <utility>

namespace waft
{

namespace
{

/// The rows of one (Row, Target).
struct TargetRows
{
  std::vector<std::size_t> Rows;
  TargetStops Stops;
  bool IsFree = true; // it can be met
};

std::vector<TargetRows> CollectTargets(const std::vector<unsigned char>& isFree,
                                       const ObstacleSet& obstacles,
                                       const std::vector<Constraint>& rows)
{
  std::map<std::pair<int, int>, TargetRows> targets;
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    const Constraint& row = rows[i];
    if (row.ObjectId >= 0 || row.Group >= 0 || !IsPositional(row.Kind))
    {
      continue;
    }
    const Stop stop = StopOf(row, 0.0, obstacles);
    TargetRows& target = targets[{ row.Row, row.Target }];
    const bool isNew = target.Rows.empty();
    TargetStops& asked = target.Stops;
    asked.First = isNew || stop.First < asked.First.First ? stop : asked.First;
    asked.Last = isNew || stop.Last > asked.Last.Last ? stop : asked.Last;
    asked.ClassId = std::max(asked.ClassId, row.ClassId);
    target.IsFree = target.IsFree && isFree[i] != 0;
    target.Rows.push_back(i);
  }
  std::vector<TargetRows> result;
  for (auto& entry : targets)
  {
    result.push_back(std::move(entry.second));
  }
  // Those that can be met come first, in order of time.
  std::stable_sort(result.begin(), result.end(),
                   [](const TargetRows& a, const TargetRows& b) {
                     return std::pair(!a.IsFree, a.Stops.First.First) <
                            std::pair(!b.IsFree, b.Stops.First.First);
                   });
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
    stops[o].push_back(StartOf(objects[o], obstacles));
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

/// The object that comes nearest in time, from its start, the first of its stops, to a target that
/// no way leads to: of those that have nothing else to do, or of all when the target cannot be met
/// anyway.
std::size_t Nearest(const TargetRows& target, const std::vector<MotionObject>& objects,
                    const std::vector<std::vector<Stop>>& stops,
                    const std::vector<unsigned char>& isIdle, const SpeedLimit& limit)
{
  std::size_t nearest = NoObject;
  double least = 0.0;
  for (std::size_t o = 0; o < objects.size(); ++o)
  {
    const double haste = limit.Haste(stops[o].front(), target.Stops.First);
    if (target.Stops.Suits(objects[o]) && (isIdle[o] != 0 || !target.IsFree) &&
        (nearest == NoObject || haste < least))
    {
      nearest = o;
      least = haste;
    }
  }
  return nearest;
}

/// By target, the object: all together, or where they are too many for that one after the other.
std::vector<std::size_t> Choose(const std::vector<MotionObject>& objects,
                                const std::vector<TargetStops>& targets,
                                const std::vector<std::vector<Stop>>& stops,
                                const SpeedLimit& limit)
{
  const std::vector<FlightGap> gaps = CollectGaps(objects, stops, targets);
  return targets.size() + gaps.size() <= PlannerNumbers::MostTogether
           ? CoverTogether(objects, targets, gaps, limit)
           : CoverInTurn(objects, stops, targets, limit);
}

} // namespace

void CoverRows(const std::vector<MotionObject>& objects, const std::vector<unsigned char>& isFree,
               const ObstacleSet& obstacles, const SpeedLimit& limit, std::vector<Constraint>& rows)
{
  const std::vector<TargetRows> targets = CollectTargets(isFree, obstacles, rows);
  if (targets.empty())
  {
    return;
  }
  std::vector<TargetStops> free; // which come first
  for (const TargetRows& target : targets)
  {
    if (target.IsFree)
    {
      free.push_back(target.Stops);
    }
  }
  const std::vector<std::vector<Stop>> stops = FixedStops(objects, isFree, obstacles, rows);
  std::vector<unsigned char> isIdle;
  for (const std::vector<Stop>& own : stops)
  {
    isIdle.push_back(own.size() == 1 ? 1 : 0);
  }
  std::vector<std::size_t> chosen = Choose(objects, free, stops, limit);
  for (const std::size_t object : chosen)
  {
    if (object != NoObject)
    {
      isIdle[object] = 0;
    }
  }
  chosen.resize(targets.size(), NoObject);
  for (std::size_t w = 0; w < targets.size(); ++w)
  {
    if (chosen[w] == NoObject)
    {
      chosen[w] = Nearest(targets[w], objects, stops, isIdle, limit);
    }
    if (chosen[w] == NoObject)
    {
      continue;
    }
    isIdle[chosen[w]] = 0;
    for (const std::size_t row : targets[w].Rows)
    {
      GiveTo(objects[chosen[w]], rows[row]);
      rows[row].Choice = ObjectChoice::AmongAll;
    }
  }
}

} // namespace waft
