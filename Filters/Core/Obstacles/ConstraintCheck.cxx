// SPDX-License-Identifier: BSD-3-Clause
#include "Obstacles/ConstraintCheck.h"

#include "Obstacles/ConstraintFeasibility.h"
#include "Obstacles/LinearRows.h"

#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <utility>

namespace waft
{

namespace
{

using Key = std::pair<int, int>; // (Row, Target)

std::string Number(double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.4g", value);
  return text;
}

/// One wish as a ball on a linear form of positions.
struct Wish
{
  std::map<int, double> Stencil;
  Vec3 Value = Vec3::Zero();
  double Radius = 0.0;
  int Line = -1; // of the report; -1: the start
  ConstraintKind Kind = ConstraintKind::Position;
  int Frame = 0;
};

/// What has been kept about one object.
struct ObjectWishes
{
  LinearRows Exact;
  std::map<int, std::vector<Wish>> Positions; // by frame
  std::vector<Wish> Derivatives;              // velocities and accelerations
  std::vector<std::pair<Constraint, int>> Orientations;
};

class Judge
{
public:
  Judge(const std::vector<Constraint>& constraints, const std::vector<MotionObject>& objects,
        const ObstacleSet& obstacles, const SceneInfo& scene) :
    Constraints(constraints),
    Obstacles(obstacles), Scene(scene), Tolerance(2e-9 * scene.Bounds.Width())
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
        std::string why =
          unassignable[n]
            ? "no object of its class is left for this target, expected at most as many targets as "
              "objects"
            : WhyInfeasible(row, this->Find(row.ObjectId), this->WindowsOf(row.ObjectId),
                            this->Obstacles, this->Scene);
        if (!why.empty() && line.Status == ConstraintStatus::Met)
        {
          line.Status = ConstraintStatus::Infeasible;
          line.Message =
            ToString(row.Kind) + std::string(" at frame ") + std::to_string(row.Frame) + ": " + why;
        }
      }
      this->Report.push_back(line);
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
    const auto found = this->Wishes.find(objectId);
    if (found != this->Wishes.end())
    {
      return found->second;
    }
    ObjectWishes& wishes = this->Wishes[objectId];
    Wish start;
    start.Stencil = { { 0, 1.0 } };
    start.Value = this->Find(objectId)->Position;
    wishes.Positions[0].push_back(start);
    std::set<int> tags;
    double gap = 0.0;
    wishes.Exact.Add(start.Stencil, start.Value, -1, this->Tolerance, tags, gap);
    return wishes;
  }

  std::vector<Wish> Expand(const Constraint& row, int line)
  {
    Wish wish;
    wish.Value = row.Value;
    wish.Radius = row.Radius;
    wish.Line = line;
    wish.Kind = row.Kind;
    wish.Frame = row.Frame;
    wish.Stencil = PositionStencil(row.Kind, row.Frame, this->Scene.Time);
    if (row.Kind != ConstraintKind::Rest)
    {
      return { wish };
    }
    SurfaceHit hit;
    RestingPlace(this->Obstacles, row.Value, row.Frame, this->Find(row.ObjectId)->RestHeight,
                 wish.Value, hit);
    wish.Radius = 0.0;
    std::vector<Wish> wishes;
    for (int f = row.Frame; f <= std::min(row.Until, this->Scene.Time.NumberOfFrames - 1); ++f)
    {
      wish.Frame = f;
      wish.Stencil = { { f, 1.0 } };
      wishes.push_back(wish);
    }
    return wishes;
  }

  std::string NameOf(int line) const
  {
    if (line < 0)
    {
      return "the object's start";
    }
    const ReportRow& row = this->Report[line];
    return "row " + std::to_string(row.Row) + " target " + std::to_string(row.Target) + " (" +
           ToString(row.Kind) + " at frame " + std::to_string(row.Frame) + ")";
  }

  std::string Conflict(const Wish& wish, const std::set<int>& others, const std::string& how) const
  {
    std::string text = "row " + std::to_string(this->Report[wish.Line].Row) + " target " +
                       std::to_string(this->Report[wish.Line].Target) + " (" + ToString(wish.Kind) +
                       " at frame " + std::to_string(wish.Frame) + ") contradicts ";
    std::size_t named = 0;
    for (const int line : others)
    {
      if (named == 4)
      {
        text += " and " + std::to_string(others.size() - named) + " more";
        break;
      }
      text += (named++ ? ", " : "") + this->NameOf(line);
    }
    return text + ": " + how;
  }

  /// Balls of positions at all frames of a derivative's stencil decide whether it can hold.
  std::string CheckDerivative(const ObjectWishes& wishes, const Wish& derivative,
                              const Wish& candidate) const
  {
    Vec3 centre = -derivative.Value;
    double reach = derivative.Radius;
    double largest = 0.0;
    std::set<int> others;
    for (const auto& [frame, c] : derivative.Stencil)
    {
      const Wish* best = candidate.Stencil.size() == 1 && candidate.Stencil.count(frame) &&
                             candidate.Kind != ConstraintKind::Velocity &&
                             candidate.Kind != ConstraintKind::Acceleration
                           ? &candidate
                           : nullptr;
      const auto found = wishes.Positions.find(frame);
      for (std::size_t n = 0; found != wishes.Positions.end() && n < found->second.size(); ++n)
      {
        best = !best || found->second[n].Radius < best->Radius ? &found->second[n] : best;
      }
      if (!best)
      {
        return {};
      }
      centre += c * best->Value;
      reach += std::abs(c) * best->Radius;
      largest = std::max(largest, std::abs(c));
      others.insert(best->Line);
    }
    others.insert(derivative.Line);
    if (largest == 0.0 || centre.norm() <= reach + largest * this->Tolerance)
    {
      return {};
    }
    others.erase(candidate.Line);
    return this->Conflict(candidate, others,
                          "the positions allow no " + std::string(ToString(derivative.Kind)) +
                            " nearer than " + Number(centre.norm() - reach + derivative.Radius) +
                            ", expected at most " + Number(derivative.Radius));
  }

  std::string Check(ObjectWishes& wishes, const Wish& wish)
  {
    const bool isPlace = wish.Kind == ConstraintKind::Position || wish.Kind == ConstraintKind::Rest;
    if (isPlace)
    {
      for (const Wish& other : wishes.Positions[wish.Frame])
      {
        const double distance = (wish.Value - other.Value).norm();
        if (distance > wish.Radius + other.Radius + this->Tolerance)
        {
          return this->Conflict(wish, { other.Line },
                                Number(distance) + " m apart, expected at most " +
                                  Number(wish.Radius + other.Radius) + " m");
        }
      }
      for (const Wish& derivative : wishes.Derivatives)
      {
        if (derivative.Stencil.count(wish.Frame))
        {
          if (std::string text = this->CheckDerivative(wishes, derivative, wish); !text.empty())
          {
            return text;
          }
        }
      }
    }
    else
    {
      for (const Wish& other : wishes.Derivatives)
      {
        const double distance = (wish.Value - other.Value).norm();
        if (other.Kind == wish.Kind && other.Frame == wish.Frame &&
            distance > wish.Radius + other.Radius + this->Tolerance)
        {
          return this->Conflict(wish, { other.Line },
                                Number(distance) + " apart, expected at most " +
                                  Number(wish.Radius + other.Radius));
        }
      }
      if (std::string text = this->CheckDerivative(wishes, wish, wish); !text.empty())
      {
        return text;
      }
    }
    std::set<int> tags;
    double gap = 0.0;
    if (wish.Radius == 0.0 && wishes.Exact.Add(wish.Stencil, wish.Value, wish.Line, this->Tolerance,
                                               tags, gap) == LinearRows::Answer::Contradictory)
    {
      return this->Conflict(wish, tags,
                            "no positions satisfy all of them, " + Number(gap) + " m are missing");
    }
    return {};
  }

  std::string CheckOrientation(const ObjectWishes& wishes, const Constraint& row, int line) const
  {
    for (const auto& [other, otherLine] : wishes.Orientations)
    {
      const double angle = row.Orientation.angularDistance(other.Orientation);
      if (other.Frame == row.Frame && angle > row.Radius + other.Radius + 1e-6)
      {
        Wish wish;
        wish.Line = line;
        wish.Kind = row.Kind;
        wish.Frame = row.Frame;
        return this->Conflict(wish, { otherLine },
                              Number(angle) + " rad apart, expected at most " +
                                Number(row.Radius + other.Radius) + " rad");
      }
    }
    return {};
  }

  /// Adds all constraints of a line, or none: then the text says why.
  std::string Keep(const std::vector<std::size_t>& members, int line)
  {
    std::set<int> touched;
    std::string why;
    for (std::size_t m = 0; m < members.size() && why.empty(); ++m)
    {
      const Constraint& row = this->Constraints[members[m]];
      ObjectWishes& wishes = this->WishesOf(row.ObjectId);
      touched.insert(row.ObjectId);
      if (row.Kind == ConstraintKind::Orientation)
      {
        why = this->CheckOrientation(wishes, row, line);
        wishes.Orientations.emplace_back(row, line);
        continue;
      }
      for (const Wish& wish : this->Expand(row, line))
      {
        why = this->Check(wishes, wish);
        if (!why.empty())
        {
          break;
        }
        const bool isPlace =
          wish.Kind == ConstraintKind::Position || wish.Kind == ConstraintKind::Rest;
        (isPlace ? wishes.Positions[wish.Frame] : wishes.Derivatives).push_back(wish);
      }
    }
    for (const int objectId : touched)
    {
      if (!why.empty())
      {
        this->Withdraw(this->Wishes[objectId], line);
      }
    }
    return why;
  }

  static void Withdraw(ObjectWishes& wishes, int line)
  {
    const auto erase = [line](std::vector<Wish>& list)
    {
      list.erase(std::remove_if(list.begin(), list.end(),
                                [line](const Wish& wish) { return wish.Line == line; }),
                 list.end());
    };
    wishes.Exact.Withdraw(line);
    erase(wishes.Derivatives);
    for (auto& [frame, list] : wishes.Positions)
    {
      erase(list);
    }
    auto& turns = wishes.Orientations;
    turns.erase(std::remove_if(turns.begin(), turns.end(),
                               [line](const auto& turn) { return turn.second == line; }),
                turns.end());
  }

  const std::vector<Constraint>& Constraints;
  const ObstacleSet& Obstacles;
  const SceneInfo& Scene;
  double Tolerance; // m
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
