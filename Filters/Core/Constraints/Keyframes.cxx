// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/Keyframes.h"

#include "Constraints/Arrivals.h"
#include "Constraints/NearestColumns.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <tuple>

namespace waft
{

namespace
{

/// The rows of one (Row, Target).
struct Target
{
  std::vector<std::size_t> Rows;
  int Frame = 0;
  int Until = 0;
  bool HasPosition = false;
  Vec3 Position = Vec3::Zero();
  int ClassId = -1;
  int ObjectId = -1;
};

struct Group
{
  int Frame = 0;
  int Id = 0;
  std::vector<Target> Targets;
};

std::vector<Group> CollectGroups(const std::vector<Constraint>& rows)
{
  std::map<std::pair<int, int>, Target> targets;
  std::map<std::pair<int, int>, int> groupOf;
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    const Constraint& row = rows[i];
    const std::pair<int, int> key{ row.Row, row.Target };
    Target& target = targets[key];
    if (target.Rows.empty())
    {
      target.Frame = EarliestFrame(row);
      groupOf[key] = row.Group;
    }
    target.Rows.push_back(i);
    target.Frame = std::min(target.Frame, EarliestFrame(row));
    target.Until = std::max(target.Until, LastFrame(row));
    if (IsPositional(row.Kind) && !target.HasPosition)
    {
      target.HasPosition = true;
      target.Position = row.Value;
    }
    target.ClassId = std::max(target.ClassId, row.ClassId);
    target.ObjectId = std::max(target.ObjectId, row.ObjectId);
  }
  // A row without a group is a group of its own, where it is about no position.
  std::map<std::tuple<int, int, int>, Group> groups;
  for (const auto& [key, target] : targets)
  {
    const int id = groupOf[key];
    if (id < 0 && target.HasPosition)
    {
      continue;
    }
    Group& group = groups[id >= 0 ? std::tuple(0, id, 0) : std::tuple(1, key.first, key.second)];
    if (group.Targets.empty())
    {
      group.Frame = target.Frame;
      group.Id = id;
    }
    group.Frame = std::min(group.Frame, target.Frame);
    group.Targets.push_back(target);
  }
  std::vector<Group> result;
  for (auto& entry : groups)
  {
    result.push_back(std::move(entry.second));
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const Group& a, const Group& b) { return a.Frame < b.Frame; });
  return result;
}

/// Where an object was last asked to be before a frame, and whether it is asked to be anywhere
/// between two frames.
class KnownPositions
{
public:
  KnownPositions(const std::vector<MotionObject>& objects, const std::vector<Constraint>& rows)
  {
    for (const MotionObject& object : objects)
    {
      this->Known[object.ObjectId][-1] = { object.Position, object.Release };
    }
    for (const Constraint& row : rows)
    {
      if (row.ObjectId >= 0 && IsPositional(row.Kind))
      {
        this->Add(row.ObjectId, EarliestFrame(row), LastFrame(row), row.Value);
      }
    }
  }
  void Add(int object, int frame, int until, const Vec3& position)
  {
    this->Known[object][frame] = { position, until };
  }
  const Vec3& Before(int object, int frame) const
  {
    return std::prev(this->Known.at(object).lower_bound(frame))->second.first;
  }
  bool IsTaken(int object, int frame, int until) const
  {
    const auto& known = this->Known.at(object);
    const auto next = known.lower_bound(frame);
    return (next != known.end() && next->first <= until) || std::prev(next)->second.second >= frame;
  }

private:
  std::map<int, std::map<int, std::pair<Vec3, int>>> Known;
};

/// Those that a group may choose among.
std::set<int> Candidates(const std::vector<MotionObject>& objects, const Group& group,
                         const std::map<int, std::vector<int>>& choices)
{
  std::set<int> ids;
  const auto choice = choices.find(group.Id);
  if (choice != choices.end())
  {
    ids.insert(choice->second.begin(), choice->second.end());
  }
  else
  {
    for (const MotionObject& object : objects)
    {
      ids.insert(object.ObjectId);
    }
  }
  for (const Target& target : group.Targets)
  {
    ids.erase(target.ObjectId);
  }
  return ids;
}

/// The objects that a target may have, each where it is before those of its group. Who has another
/// place at the time is penalised.
std::vector<NearestColumns::Candidate> CandidatesFor(const Target& target,
                                                     const FrameWindow& frames,
                                                     const std::vector<MotionObject>& objects,
                                                     const std::set<int>& ids,
                                                     const KnownPositions& known)
{
  std::vector<NearestColumns::Candidate> candidates;
  for (std::size_t o = 0; o < objects.size(); ++o)
  {
    const int id = objects[o].ObjectId;
    if (ids.count(id) == 0 || (target.ClassId >= 0 && target.ClassId != objects[o].ClassId))
    {
      continue;
    }
    candidates.push_back({ o, Vec3::Zero(), 0 });
    if (target.HasPosition)
    {
      candidates.back().Position = known.Before(id, frames.From);
      candidates.back().Penalty = known.IsTaken(id, frames.From, frames.To) ? 1 : 0;
    }
  }
  return candidates;
}

/// Index of the object of each target, -1 where it has none.
std::vector<int> ChooseObjects(const std::vector<MotionObject>& objects,
                               const std::set<int>& candidates, const KnownPositions& known,
                               const std::vector<const Target*>& open)
{
  FrameWindow frames{ std::numeric_limits<int>::max(), 0 };
  for (const Target* target : open)
  {
    frames.From = std::min(frames.From, target->Frame);
    frames.To = std::max(frames.To, target->Until);
  }
  std::map<std::pair<int, bool>, std::size_t> kindOf;
  std::vector<std::vector<NearestColumns::Candidate>> kinds;
  std::vector<NearestColumns::Row> rows;
  for (const Target* target : open)
  {
    const std::pair<int, bool> key(target->ClassId, target->HasPosition);
    const auto [kind, isNew] = kindOf.emplace(key, kinds.size());
    if (isNew)
    {
      kinds.push_back(CandidatesFor(*target, frames, objects, candidates, known));
    }
    rows.push_back({ kind->second, target->Position });
  }
  // Nobody is left out for the sake of penalties.
  const RankedCost leftOut{ static_cast<std::int64_t>(open.size()) + 1, 0.0 };
  NearestColumns problem(objects.size(), leftOut, std::move(kinds), std::move(rows));
  return AssignLeastCost(problem).ColumnOf;
}

} // namespace

void AssignKeyframes(const std::vector<MotionObject>& objects, std::vector<Constraint>& rows,
                     const std::map<int, std::vector<int>>& choices)
{
  KnownPositions known(objects, rows);
  for (const Group& group : CollectGroups(rows))
  {
    const std::set<int> candidates = Candidates(objects, group, choices);
    std::vector<const Target*> open;
    for (const Target& target : group.Targets)
    {
      if (target.ObjectId < 0)
      {
        open.push_back(&target);
      }
    }
    const std::vector<int> chosen = ChooseObjects(objects, candidates, known, open);
    for (std::size_t t = 0; t < open.size(); ++t)
    {
      if (chosen[t] < 0)
      {
        continue;
      }
      const MotionObject& object = objects[static_cast<std::size_t>(chosen[t])];
      for (std::size_t row : open[t]->Rows)
      {
        GiveTo(object, rows[row]);
        rows[row].Choice =
          choices.count(group.Id) > 0 ? ObjectChoice::AmongListed : ObjectChoice::AmongAll;
      }
      if (open[t]->HasPosition)
      {
        known.Add(object.ObjectId, open[t]->Frame, open[t]->Until, open[t]->Position);
      }
    }
  }
}

int ChosenTargets::FirstFrame() const
{
  return std::min_element(this->Targets.begin(), this->Targets.end(),
                          [](const Target& a, const Target& b) { return a.Frame < b.Frame; })
    ->Frame;
}

std::vector<ChosenTargets> CollectChosen(const std::vector<MotionObject>& objects,
                                         const std::vector<Constraint>& rows,
                                         const std::vector<char>& counts)
{
  std::map<int, std::size_t> indexOf;
  for (std::size_t o = 0; o < objects.size(); ++o)
  {
    indexOf[objects[o].ObjectId] = o;
  }
  std::map<std::pair<int, int>, std::vector<std::size_t>> targets;
  std::vector<char> isIdle(objects.size(), 1);
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    targets[{ rows[i].Row, rows[i].Target }].push_back(i);
    const auto object = indexOf.find(rows[i].ObjectId);
    if (object != indexOf.end() && IsPositional(rows[i].Kind))
    {
      isIdle[object->second] = 0;
    }
  }
  std::map<std::tuple<int, int, int>, std::pair<ChosenTargets, bool>> groups; // among all
  for (const auto& [key, own] : targets)
  {
    ChosenTargets::Target target;
    target.Rows = own;
    bool isChosen = true, hasPosition = false;
    for (const std::size_t i : own)
    {
      const Constraint& row = rows[i];
      isChosen = isChosen && row.Choice != ObjectChoice::Given && counts[i] &&
                 indexOf.count(row.ObjectId) > 0;
      if (IsPositional(row.Kind) && !hasPosition)
      {
        hasPosition = true;
        target.Frame = EarliestFrame(row);
        target.Position = row.Value;
      }
      target.Until = std::max(target.Until, LastFrame(row));
      target.ClassId = std::max(target.ClassId, row.ClassId);
    }
    if (!isChosen || !hasPosition)
    {
      continue;
    }
    const Constraint& first = rows[own.front()];
    target.Object = indexOf.at(first.ObjectId);
    auto& [group, amongAll] =
      groups
        .try_emplace(first.Group >= 0 ? std::tuple(0, first.Group, 0)
                                      : std::tuple(1, target.Frame, target.Until),
                     ChosenTargets(), true)
        .first->second;
    amongAll = amongAll && first.Choice == ObjectChoice::AmongAll;
    group.Candidates.push_back(target.Object);
    group.Targets.push_back(std::move(target));
  }
  std::vector<ChosenTargets> result;
  for (auto& [key, entry] : groups)
  {
    for (std::size_t o = 0; o < objects.size() && entry.second; ++o)
    {
      if (isIdle[o])
      {
        entry.first.Candidates.push_back(o);
      }
    }
    if (entry.first.Candidates.size() > 1)
    {
      result.push_back(std::move(entry.first));
    }
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const ChosenTargets& a, const ChosenTargets& b)
                   { return a.FirstFrame() < b.FirstFrame(); });
  return result;
}

} // namespace waft
