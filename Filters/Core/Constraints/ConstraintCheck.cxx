// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/ConstraintCheck.h"

#include "Constraints/ConstraintConflicts.h"
#include "Constraints/ConstraintFeasibility.h"

#include <algorithm>
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
      const Constraint& row = constraints[n];
      this->Members[{ row.Row, row.Target }].push_back(n);
      this->Own[row.ObjectId].push_back(row);
      std::vector<int>& frames = this->Frames[row.ObjectId];
      if (row.Frame < 0 || row.Frame >= scene.Time.NumberOfFrames)
      {
        continue; // it cannot be
      }
      frames.push_back(row.Frame);
      for (const auto& entry :
           DerivativeStencil(TraitsOf(row.Kind).Derivative, row.Frame, scene.Time))
      {
        frames.push_back(entry.first);
      }
    }
    for (auto& [objectId, frames] : this->Frames)
    {
      std::sort(frames.begin(), frames.end());
      frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
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
    return this->Windows[objectId] =
             object ? LandingWindows(*object, this->Own[objectId], this->Obstacles,
                                     this->Scene.Time.FramesPerSecond)
                    : std::vector<LandingWindow>();
  }

  KeptConstraints& KeptOf(int objectId)
  {
    const double tolerance =
      2.0 * ToleranceOf(ConstraintKind::Position, { this->Scene.Bounds.Width() });
    return this->Kept.try_emplace(objectId, this->Find(objectId)->Position, tolerance)
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
    line.Arrival = ArrivalOf(first);
    line.Release = first.Release;
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

  /// A row as balls about positions, one for each of its frames that another row of its object
  /// speaks of: at the others nothing can contradict it.
  std::vector<ConstraintBall> Expand(const Constraint& row, int line) const
  {
    ConstraintBall ball;
    ball.Value = row.Value;
    ball.Radius = RadiusOf(row);
    ball.Line = line;
    ball.Kind = row.Kind;
    ball.Frame = row.Frame;
    ball.Stencil = DerivativeStencil(TraitsOf(row.Kind).Derivative, row.Frame, this->Scene.Time);
    if (!IsPositional(row.Kind))
    {
      return { ball };
    }
    const double restHeight = this->Find(row.ObjectId)->RestHeight;
    const int last = std::min(LastFrame(row), this->Scene.Time.NumberOfFrames - 1);
    CarriedPlace place;
    (void)WantedPlace(row, restHeight, this->Obstacles, place); // judged before
    const std::vector<int>& frames = this->Frames.at(row.ObjectId);
    std::vector<ConstraintBall> balls;
    for (auto f = std::lower_bound(frames.begin(), frames.end(), row.Frame);
         f != frames.end() && *f <= last; ++f)
    {
      ball.Value = place.At(*f);
      ball.Frame = *f;
      ball.Stencil = { { *f, 1.0 } };
      balls.push_back(ball);
    }
    return balls;
  }

  Contradiction Add(const Constraint& row, int line)
  {
    if (!this->Find(row.ObjectId))
    {
      return {}; // not assigned yet
    }
    KeptConstraints& kept = this->KeptOf(row.ObjectId);
    if (IsAttitude(row.Kind))
    {
      return kept.AddOrientation(row, line);
    }
    for (const ConstraintBall& ball : this->Expand(row, line))
    {
      Contradiction found = kept.Add(ball);
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
        for (const std::size_t member : members)
        {
          const auto kept = this->Kept.find(this->Constraints[member].ObjectId);
          if (kept != this->Kept.end())
          {
            kept->second.Withdraw(line);
          }
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
    const ConstraintBall& ball = found.Candidate;
    if (found.Lines.empty())
    {
      return this->NameOf(ball.Line, ball.Kind, ball.Frame) + " contradicts itself: " + found.How;
    }
    std::string text = this->NameOf(ball.Line, ball.Kind, ball.Frame) + " contradicts ";
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
  std::map<int, std::vector<Constraint>> Own; // rows of each object
  std::map<int, std::vector<int>> Frames;     // that they speak of, ascending
  std::map<int, std::vector<LandingWindow>> Windows;
  std::map<int, KeptConstraints> Kept;
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

const ReportRow* FindLine(const std::vector<ReportRow>& report, int row, int target)
{
  const Key key(row, target);
  const auto found = std::lower_bound(report.begin(), report.end(), key,
                                      [](const ReportRow& line, const Key& wanted)
                                      { return Key(line.Row, line.Target) < wanted; });
  return found == report.end() || Key(found->Row, found->Target) != key ? nullptr : &*found;
}

bool IsBinding(const Constraint& constraint, const std::vector<ReportRow>& report)
{
  const ReportRow* line = FindLine(report, constraint.Row, constraint.Target);
  return line == nullptr || line->Status == ConstraintStatus::Met;
}

} // namespace waft
