// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/ConstraintCheck.h"

#include "Constraints/ConstraintConflicts.h"
#include "Constraints/ConstraintFeasibility.h"

#include <map>
#include <set>
#include <utility>

namespace waft
{

namespace
{

using Key = std::pair<int, int>; // (Row, Target)

class Judge
{
public:
  Judge(const std::vector<Constraint>& constraints, const std::vector<MotionObject>& objects,
        const ObstacleSet& obstacles, const SceneInfo& scene) :
    Constraints(constraints),
    Obstacles(obstacles), Scene(scene)
  {
    for (const MotionObject& object : objects)
    {
      this->Objects[object.ObjectId] = &object;
    }
    for (std::size_t n = 0; n < constraints.size(); ++n)
    {
      this->Members[{ constraints[n].Row, constraints[n].Target }].push_back(n);
    }
  }

  std::vector<ReportRow> Run(const std::vector<bool>& unassignable)
  {
    for (const auto& [key, members] : this->Members)
    {
      this->Report.push_back(this->JudgeAlone(key, members, unassignable));
    }
    int index = 0;
    for (const auto& [key, members] : this->Members)
    {
      ReportRow& line = this->Report[index];
      if (line.Status == ConstraintStatus::Met && line.ObjectId >= 0)
      {
        line.Message = this->Keep(members, index);
        line.Status = line.Message.empty() ? ConstraintStatus::Met : ConstraintStatus::Conflict;
      }
      ++index;
    }
    return std::move(this->Report);
  }

private:
  const MotionObject* Find(int objectId) const
  {
    const auto found = this->Objects.find(objectId);
    return found == this->Objects.end() ? nullptr : found->second;
  }

  const std::vector<LandingWindow>& WindowsOf(int objectId)
  {
    const auto found = this->Windows.find(objectId);
    if (found != this->Windows.end())
    {
      return found->second;
    }
    const MotionObject* object = this->Find(objectId);
    return this->Windows[objectId] = object
                                       ? LandingWindows(*object, this->Constraints, this->Obstacles,
                                                        this->Scene.Time.FramesPerSecond)
                                       : std::vector<LandingWindow>();
  }

  ObjectWishes& WishesOf(int objectId)
  {
    const double tolerance =
      2.0 * ToleranceOf(ConstraintKind::Position, { this->Scene.Bounds.Width() });
    return this->Wishes.try_emplace(objectId, this->Find(objectId)->Position, tolerance)
      .first->second;
  }

  ReportRow JudgeAlone(const Key& key, const std::vector<std::size_t>& members,
                       const std::vector<bool>& unassignable)
  {
    const Constraint& first = this->Constraints[members.front()];
    ReportRow line;
    line.Row = key.first;
    line.Target = key.second;
    line.ObjectId = first.ObjectId;
    line.Frame = first.Frame;
    line.Kind = first.Kind;
    for (const std::size_t n : members)
    {
      const Constraint& row = this->Constraints[n];
      const std::string why =
        unassignable[n]
          ? "no object of its class is left for this target, expected at most as many targets as "
            "objects"
          : WhyInfeasible(row, this->Find(row.ObjectId), this->WindowsOf(row.ObjectId),
                          this->Obstacles, this->Scene);
      if (why.empty() && line.Status == ConstraintStatus::Met &&
          row.Status != ConstraintStatus::Met)
      {
        line.Status = row.Status;
        line.Message = std::string(ToString(row.Kind)) + " at frame " + std::to_string(row.Frame) +
                       ": found " + ToString(row.Status) + " by an earlier stage";
      }
      if (!why.empty() && line.Status == ConstraintStatus::Met)
      {
        line.Status = ConstraintStatus::Infeasible;
        line.Message =
          std::string(ToString(row.Kind)) + " at frame " + std::to_string(row.Frame) + ": " + why;
      }
    }
    return line;
  }

  /// A row as wishes about positions, one for each of its frames.
  std::vector<Wish> Expand(const Constraint& row, int line) const
  {
    Wish wish;
    wish.Value = row.Value;
    wish.Radius = RadiusOf(row);
    wish.Line = line;
    wish.Kind = row.Kind;
    wish.Frame = row.Frame;
    wish.Stencil = DerivativeStencil(TraitsOf(row.Kind).Derivative, row.Frame, this->Scene.Time);
    if (!IsPositional(row.Kind))
    {
      return { wish };
    }
    const double restHeight = this->Find(row.ObjectId)->RestHeight;
    const int last = std::min(LastFrame(row), this->Scene.Time.NumberOfFrames - 1);
    std::vector<Wish> wishes;
    for (int f = row.Frame; f <= last; ++f)
    {
      (void)WantedPosition(row, f, restHeight, this->Obstacles, wish.Value); // judged before
      wish.Frame = f;
      wish.Stencil = { { f, 1.0 } };
      wishes.push_back(wish);
    }
    return wishes;
  }

  Contradiction Add(const Constraint& row, int line)
  {
    if (!this->Find(row.ObjectId))
    {
      return {}; // not assigned yet
    }
    ObjectWishes& wishes = this->WishesOf(row.ObjectId);
    if (IsAttitude(row.Kind))
    {
      return wishes.AddOrientation(row, line);
    }
    for (const Wish& wish : this->Expand(row, line))
    {
      Contradiction found = wishes.Add(wish);
      if (!found.IsEmpty())
      {
        return found;
      }
    }
    return {};
  }

  /// Adds all constraints of a line, or none: then the text says why.
  std::string Keep(const std::vector<std::size_t>& members, int line)
  {
    for (const std::size_t n : members)
    {
      const Contradiction found = this->Add(this->Constraints[n], line);
      if (!found.IsEmpty())
      {
        for (auto& [objectId, wishes] : this->Wishes)
        {
          wishes.Withdraw(line);
        }
        return this->Sentence(found);
      }
    }
    return {};
  }

  std::string NameOf(int line, ConstraintKind kind, int frame) const
  {
    return LineName(this->Report[line].Row, this->Report[line].Target, kind, frame);
  }

  std::string Sentence(const Contradiction& found) const
  {
    constexpr std::size_t most = 4; // names in one sentence
    const Wish& wish = found.Candidate;
    if (found.Lines.empty())
    {
      return this->NameOf(wish.Line, wish.Kind, wish.Frame) + " contradicts itself: " + found.How;
    }
    std::string text = this->NameOf(wish.Line, wish.Kind, wish.Frame) + " contradicts ";
    std::size_t named = 0;
    for (const int line : found.Lines)
    {
      if (named == most)
      {
        text += " and " + std::to_string(found.Lines.size() - named) + " more";
        break;
      }
      text += named++ ? ", " : "";
      text += line < 0 ? "the object's start"
                       : this->NameOf(line, this->Report[line].Kind, this->Report[line].Frame);
    }
    return text + ": " + found.How;
  }

  const std::vector<Constraint>& Constraints;
  const ObstacleSet& Obstacles;
  const SceneInfo& Scene;
  std::map<int, const MotionObject*> Objects;
  std::map<Key, std::vector<std::size_t>> Members;
  std::map<int, std::vector<LandingWindow>> Windows;
  std::map<int, ObjectWishes> Wishes;
  std::vector<ReportRow> Report;
};

} // namespace

std::vector<ReportRow> JudgeConstraints(const std::vector<Constraint>& constraints,
                                        const std::vector<MotionObject>& objects,
                                        const ObstacleSet& obstacles, const SceneInfo& scene)
{
  return Judge(constraints, objects, obstacles, scene).Run(FindUnassignable(constraints, objects));
}

std::string LineName(int row, int target, ConstraintKind kind, int frame)
{
  return "row " + std::to_string(row) + " target " + std::to_string(target) + " (" +
         ToString(kind) + " at frame " + std::to_string(frame) + ")";
}

bool IsBinding(const Constraint& constraint, const std::vector<ReportRow>& report)
{
  const auto less = [](const ReportRow& line, const Key& key)
  { return Key(line.Row, line.Target) < key; };
  const Key key(constraint.Row, constraint.Target);
  const auto found = std::lower_bound(report.begin(), report.end(), key, less);
  return found == report.end() || Key(found->Row, found->Target) != key ||
         found->Status == ConstraintStatus::Met;
}

} // namespace waft
