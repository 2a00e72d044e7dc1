// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/RowConflicts.h"

#include "Base/NumberText.h"
#include "Constraints/ConstraintCheck.h"
#include "Constraints/Keyframes.h"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <utility>

namespace waft
{

namespace
{

using TargetKey = std::pair<int, int>; // (Row, Target)

/// The stops of one line of the report.
struct Line
{
  TargetKey Id;
  ConstraintKind Kind = ConstraintKind::Position;
  std::vector<Stop> Stops; // by frame

  int First() const { return this->Stops.front().First; }
  int Last() const { return this->Stops.back().Last; }
  std::string Name() const
  {
    return LineName(this->Id.first, this->Id.second, this->Kind, this->First());
  }
};

struct GivenUp
{
  ConstraintStatus Status = ConstraintStatus::Conflict;
  std::string Message;
};

/// Which of some lines go with which: a bit a pair, since of ten thousand lines at one frame nearly
/// every pair may be a conflict.
class LinePairs
{
public:
  void Resize(std::size_t count)
  {
    this->Count = count;
    this->Bits.assign(count * count, false);
  }
  void Add(std::size_t a, std::size_t b)
  {
    this->Bits[a * this->Count + b] = true;
    this->Bits[b * this->Count + a] = true;
  }
  bool Has(std::size_t a, std::size_t b) const { return this->Bits[a * this->Count + b]; }

private:
  std::size_t Count = 0;
  std::vector<bool> Bits;
};

/// The lines of one object, and which of them go with which.
class ObjectLines
{
public:
  ObjectLines(std::vector<Line> lines, const SpeedLimit& limit, double diagonal) :
    Lines(std::move(lines)), Limit(limit), Diagonal(diagonal)
  {
    std::stable_sort(this->Lines.begin(), this->Lines.end(),
                     [](const Line& a, const Line& b)
                     { return std::pair(a.First(), a.Last()) < std::pair(b.First(), b.Last()); });
  }

  void Settle(const Stop& start, std::map<TargetKey, GivenUp>& givenUp);

private:
  struct Leg
  {
    const Stop* From = nullptr;
    const Stop* To = nullptr;
  };

  Leg TooFast(const Line& a, const Line& b) const;
  bool IsTooFast(const Stop& from, const Stop& to) const
  {
    return this->Limit.Haste(from, to) > SpeedAllowance;
  }
  void FindConflicts();
  std::vector<std::vector<std::size_t>> Clusters() const;
  std::vector<std::size_t> Most(const std::vector<std::size_t>& members) const;
  bool GoTogether(std::size_t a, std::size_t b) const { return !this->Conflicts.Has(a, b); }
  std::string Why(std::size_t line, const std::vector<std::size_t>& kept) const;
  std::string Speeds(const Leg& leg) const;

  std::vector<Line> Lines;
  const SpeedLimit& Limit;
  double Diagonal; // of the volume [m]
  LinePairs Conflicts;
};

/// The first leg from one line to the other that cannot be flown, or none. a does not begin later.
ObjectLines::Leg ObjectLines::TooFast(const Line& a, const Line& b) const
{
  if (a.Stops.size() + b.Stops.size() == 2 || a.Last() < b.First())
  {
    const Leg only{ &a.Stops.back(), &b.Stops.front() };
    return this->IsTooFast(*only.From, *only.To) ? only : Leg();
  }
  const Stop* before = nullptr;
  bool wasOfA = false;
  bool wasOfBoth = false;
  auto nextA = a.Stops.begin();
  auto nextB = b.Stops.begin();
  while (nextA != a.Stops.end() || nextB != b.Stops.end())
  {
    const bool isOfA =
      nextB == b.Stops.end() || (nextA != a.Stops.end() && nextA->First <= nextB->First);
    const Stop& stop = isOfA ? *nextA++ : *nextB++;
    bool isOfBoth = false;
    if (before != nullptr && !wasOfBoth && wasOfA != isOfA) // within a line any speed will do
    {
      if (this->IsTooFast(*before, stop))
      {
        return { before, &stop };
      }
      isOfBoth = stop.First <= before->Last;
    }
    before = &stop;
    wasOfA = isOfA;
    wasOfBoth = isOfBoth;
  }
  return {};
}

void ObjectLines::FindConflicts()
{
  this->Conflicts.Resize(this->Lines.size());
  for (std::size_t i = 0; i < this->Lines.size(); ++i)
  {
    for (std::size_t j = i + 1; j < this->Lines.size(); ++j)
    {
      const int frames = this->Lines[j].First() - this->Lines[i].Last();
      if (frames > 0 && this->Limit.Reach(frames / 2, false, false) > this->Diagonal)
      {
        break; // all the later ones are far enough away in time
      }
      if (this->TooFast(this->Lines[i], this->Lines[j]).From != nullptr)
      {
        this->Conflicts.Add(i, j);
      }
    }
  }
}

/// Lines that hang together by conflicts, each cluster in order of time; none of a single line.
std::vector<std::vector<std::size_t>> ObjectLines::Clusters() const
{
  std::vector<std::vector<std::size_t>> clusters;
  std::vector<std::size_t> open(this->Lines.size()); // not in a cluster yet, in order of time
  std::iota(open.begin(), open.end(), 0);
  while (!open.empty())
  {
    std::vector<std::size_t> found{ open.front() };
    open.erase(open.begin());
    for (std::size_t k = 0; k < found.size(); ++k)
    {
      const auto reached =
        std::stable_partition(open.begin(), open.end(),
                              [&](std::size_t line) { return this->GoTogether(found[k], line); });
      found.insert(found.end(), reached, open.end());
      open.erase(reached, open.end());
    }
    if (found.size() > 1)
    {
      std::sort(found.begin(), found.end());
      clusters.push_back(std::move(found));
    }
  }
  return clusters;
}

/// As many of the members as go together: in time what goes with the one before goes with all, so
/// it is the longest chain.
std::vector<std::size_t> ObjectLines::Most(const std::vector<std::size_t>& members) const
{
  std::vector<std::size_t> length(members.size(), 1); // of the chain from here on
  for (std::size_t i = members.size(); i-- > 0;)
  {
    for (std::size_t j = i + 1; j < members.size(); ++j)
    {
      if (this->GoTogether(members[i], members[j]))
      {
        length[i] = std::max(length[i], length[j] + 1);
      }
    }
  }
  std::vector<std::size_t> kept;
  const auto fits = [&](std::size_t member)
  {
    return std::all_of(kept.begin(), kept.end(),
                       [&](std::size_t k) { return this->GoTogether(k, member); });
  };
  std::size_t next = 0;
  for (std::size_t wanted = *std::max_element(length.begin(), length.end()); wanted > 0; --wanted)
  {
    std::size_t best = members.size();
    for (std::size_t i = next; i < members.size(); ++i)
    {
      if (length[i] == wanted && fits(members[i]) &&
          (best == members.size() || this->Lines[members[i]].Id < this->Lines[members[best]].Id))
      {
        best = i;
      }
    }
    if (best < members.size())
    {
      kept.push_back(members[best]);
      next = best + 1;
    }
  }
  // Balls and lines that overlap in time may leave room for one more.
  for (const std::size_t member : members)
  {
    if (std::find(kept.begin(), kept.end(), member) == kept.end() && fits(member))
    {
      kept.push_back(member);
    }
  }
  return kept;
}

std::string ObjectLines::Speeds(const Leg& leg) const
{
  const double way =
    (leg.To->Position - leg.From->Position).norm() - leg.From->Radius - leg.To->Radius;
  const int frames = leg.To->First - leg.From->Last;
  if (frames <= 0)
  {
    return NumberText(way) + " m apart at the same time";
  }
  const double reach = SpeedAllowance * this->Limit.Reach(frames, leg.From->IsRest, leg.To->IsRest);
  return NumberText(way) + " m apart in " + std::to_string(frames) +
         (frames == 1 ? " frame" : " frames") + ", expected at most " + NumberText(reach) + " m, " +
         NumberText(SpeedAllowance) + " times the database's top speed";
}

std::string ObjectLines::Why(std::size_t line, const std::vector<std::size_t>& kept) const
{
  constexpr std::size_t most = 4; // names in one sentence
  std::string text = this->Lines[line].Name() + " contradicts ";
  std::string how;
  std::size_t named = 0;
  for (const std::size_t other : kept)
  {
    if (named < most && !this->GoTogether(line, other))
    {
      const auto [first, second] = std::minmax(line, other);
      text += (named++ > 0 ? ", " : "") + this->Lines[other].Name();
      how =
        how.empty() ? this->Speeds(this->TooFast(this->Lines[first], this->Lines[second])) : how;
    }
  }
  return text + ": " + how;
}

void ObjectLines::Settle(const Stop& start, std::map<TargetKey, GivenUp>& givenUp)
{
  const auto isFar = [&](const Line& line)
  { return line.First() > 0 && this->Limit.Haste(start, line.Stops.front()) > SpeedAllowance; };
  const auto far =
    std::stable_partition(this->Lines.begin(), this->Lines.end(), std::not_fn(isFar));
  for (auto line = far; line != this->Lines.end(); ++line)
  {
    if (far != this->Lines.begin() && std::prev(far)->First() > line->Last())
    {
      givenUp[line->Id] = { ConstraintStatus::Unreachable,
                            line->Name() + " is too far from the object's start: " +
                              this->Speeds({ &start, &line->Stops.front() }) };
    }
  }
  this->Lines.erase(far, this->Lines.end());
  this->FindConflicts();
  for (const std::vector<std::size_t>& members : this->Clusters())
  {
    const std::vector<std::size_t> kept = this->Most(members);
    std::vector<char> isKept(this->Lines.size(), 0);
    for (const std::size_t member : kept)
    {
      isKept[member] = 1;
    }
    for (const std::size_t member : members)
    {
      if (isKept[member] == 0)
      {
        givenUp[this->Lines[member].Id] = { ConstraintStatus::Conflict, this->Why(member, kept) };
      }
    }
  }
}

/// The lines of each object that may be met by themselves.
std::map<int, std::vector<Line>> CollectLines(const std::vector<Constraint>& constraints,
                                              const std::map<int, const MotionObject*>& objects,
                                              const ObstacleSet& obstacles,
                                              const std::vector<ReportRow>& report)
{
  std::map<TargetKey, ConstraintStatus> judged;
  for (const ReportRow& line : report)
  {
    judged[{ line.Row, line.Target }] = line.Status;
  }
  std::map<int, std::map<TargetKey, Line>> lines;
  for (const Constraint& row : constraints)
  {
    const TargetKey id{ row.Row, row.Target };
    const auto object = objects.find(row.ObjectId);
    if (object == objects.end() || !IsPositional(row.Kind) || row.Status != ConstraintStatus::Met ||
        judged[id] == ConstraintStatus::Infeasible ||
        (row.Frame == 0 && judged[id] == ConstraintStatus::Conflict))
    {
      continue;
    }
    Line& line = lines[row.ObjectId][id];
    line.Id = id;
    line.Kind = row.Kind;
    line.Stops.push_back(StopOf(row, object->second->RestHeight, obstacles));
  }
  std::map<int, std::vector<Line>> result;
  for (auto& [objectId, own] : lines)
  {
    for (auto& [id, line] : own)
    {
      std::stable_sort(line.Stops.begin(), line.Stops.end(),
                       [](const Stop& a, const Stop& b) { return a.First < b.First; });
      result[objectId].push_back(std::move(line));
    }
  }
  return result;
}

} // namespace

std::vector<ReportRow> JudgeWithSpeeds(const std::vector<Constraint>& constraints,
                                       const std::vector<MotionObject>& objects,
                                       const ObstacleSet& obstacles, const SceneInfo& scene,
                                       const SpeedLimit& limit)
{
  std::vector<ReportRow> report = JudgeConstraints(constraints, objects, obstacles, scene);
  std::map<int, const MotionObject*> byId;
  for (const MotionObject& object : objects)
  {
    byId[object.ObjectId] = &object;
  }
  std::map<TargetKey, GivenUp> givenUp;
  for (auto& [objectId, lines] : CollectLines(constraints, byId, obstacles, report))
  {
    ObjectLines(std::move(lines), limit, scene.Bounds.Size().norm())
      .Settle(StartOf(*byId[objectId], obstacles), givenUp);
  }
  if (givenUp.empty())
  {
    return report;
  }
  std::vector<Constraint> rest = constraints;
  for (Constraint& row : rest)
  {
    const auto found = givenUp.find({ row.Row, row.Target });
    row.Status = found != givenUp.end() ? found->second.Status : row.Status;
  }
  report = JudgeConstraints(rest, objects, obstacles, scene);
  for (ReportRow& line : report)
  {
    const auto found = givenUp.find({ line.Row, line.Target });
    if (found != givenUp.end())
    {
      line.Message = found->second.Message;
    }
  }
  return report;
}

} // namespace waft
