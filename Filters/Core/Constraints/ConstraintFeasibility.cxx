// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/ConstraintFeasibility.h"

#include "Base/NumberText.h"

#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace waft
{

namespace
{

std::string Metres(double value)
{
  return NumberText(value) + " m";
}

std::string ExpectedInside(const Box& box)
{
  return ", expected between " + PointText(box.Min) + " and " + PointText(box.Max);
}

std::string WhyPositionInfeasible(const Constraint& row, const MotionObject* object,
                                  const std::vector<LandingWindow>& windows,
                                  const ObstacleSet& obstacles, const SceneInfo& scene)
{
  const Box& box = scene.Bounds;
  const double tolerance = 1e-9 * box.Width();
  const double outside = (box.Min - row.Value).cwiseMax(row.Value - box.Max).cwiseMax(0.0).norm();
  if (outside > row.Radius + tolerance)
  {
    return "the position " + PointText(row.Value) + " lies " + Metres(outside) +
           " outside the volume" + ExpectedInside(box);
  }
  const int exempt = object ? RequiredClearance(*object, windows, row.Frame).Exempt : -1;
  SurfaceHit hit;
  const double distance = obstacles.SignedDistance(row.Value, row.Frame, hit, exempt);
  if (distance < -row.Radius - tolerance)
  {
    return "the position " + PointText(row.Value) + " lies " + Metres(-distance) +
           " inside obstacle " + std::to_string(hit.ObstacleId) +
           ", expected outside; the nearest free place is " + PointText(hit.Point);
  }
  return {};
}

/// Of a place that goes along with an obstacle, from a frame to another.
std::string WhyRideInfeasible(const CarriedPlace& place, int first, int last,
                              const ObstacleSet& obstacles, const Box& box)
{
  const double tolerance = 1e-9 * box.Width();
  for (int f = first + 1; place.IsMoving() && f <= last; ++f)
  {
    const Vec3 x = place.At(f);
    const bool isOutside = box.InnerDistance(x) < -tolerance;
    SurfaceHit hit;
    if (isOutside || obstacles.SignedDistance(x, f, 0.0, hit, place.On->ObstacleId) < -tolerance)
    {
      return "obstacle " + std::to_string(place.On->ObstacleId) + " carries it to " + PointText(x) +
             " at frame " + std::to_string(f) + ", " +
             (isOutside ? "outside the volume" + ExpectedInside(box)
                        : "inside obstacle " + std::to_string(hit.ObstacleId));
    }
  }
  return {};
}

std::string WhyRestInfeasible(const Constraint& row, const MotionObject* object,
                              const ObstacleSet& obstacles, const SceneInfo& scene)
{
  const Box& box = scene.Bounds;
  const double tolerance = 1e-9 * box.Width();
  Vec3 centre;
  SurfaceHit hit;
  if (row.Until < row.Frame)
  {
    return "rests until frame " + std::to_string(row.Until) + ", expected " +
           std::to_string(row.Frame) + " or later";
  }
  if (!RestingPosition(obstacles, row.Value, row.Frame, object ? object->RestHeight : 0.0, centre,
                       hit))
  {
    return "there is no surface below " + PointText(row.Value) + " to rest on";
  }
  if (box.InnerDistance(centre) < -tolerance)
  {
    return "the resting place " + PointText(centre) + " lies outside the volume" +
           ExpectedInside(box);
  }
  SurfaceHit other;
  if (obstacles.SignedDistance(centre, row.Frame, other, hit.ObstacleId) < -tolerance)
  {
    return "the resting place " + PointText(centre) + " lies inside obstacle " +
           std::to_string(other.ObstacleId);
  }
  if (row.On >= 0 && hit.ObstacleId != row.On)
  {
    return "the first surface below " + PointText(row.Value) + " is of obstacle " +
           std::to_string(hit.ObstacleId) + ", expected obstacle " + std::to_string(row.On) +
           ", which it is to lie on";
  }
  return WhyRideInfeasible(
    { centre, static_cast<double>(row.Frame), obstacles.Find(hit.ObstacleId) }, row.Frame,
    std::min(row.Until, scene.Time.NumberOfFrames - 1), obstacles, box);
}

} // namespace

std::string WhyInfeasible(const Constraint& row, const MotionObject* object,
                          const std::vector<LandingWindow>& windows, const ObstacleSet& obstacles,
                          const SceneInfo& scene)
{
  if (row.ObjectId >= 0 && !object)
  {
    return "there is no object " + std::to_string(row.ObjectId);
  }
  const int frames = scene.Time.NumberOfFrames;
  if (row.Frame < 0 || row.Frame >= frames)
  {
    return "frame " + std::to_string(row.Frame) + " is outside the range, expected 0 to " +
           std::to_string(frames - 1);
  }
  if (!row.Value.allFinite() || !row.Orientation.coeffs().allFinite() ||
      !std::isfinite(row.Radius) || row.Radius < 0.0)
  {
    return "its value or radius is not a finite number, expected numbers and a radius from 0";
  }
  const bool isHung = object && object->Release > 0 && row.Frame <= object->Release &&
                      row.Target != OfNoRow && !IsAttitude(row.Kind);
  if (isHung)
  {
    return "object " + std::to_string(object->ObjectId) +
           (object->Hangs() ? " hangs at its start until frame " : " appears at frame ") +
           std::to_string(object->Release) + ", expected a later frame";
  }
  if (row.On >= 0 && obstacles.Find(row.On) == nullptr)
  {
    return "there is no obstacle " + std::to_string(row.On) + " that it is on";
  }
  switch (row.Kind)
  {
    case ConstraintKind::Position:
    {
      const std::string why = WhyPositionInfeasible(row, object, windows, obstacles, scene);
      CarriedPlace place;
      (void)WantedPlace(row, 0.0, obstacles, place);
      return !why.empty()
               ? why
               : WhyRideInfeasible(place, row.Frame, std::min(LastFrame(row), frames - 1),
                                   obstacles, scene.Bounds);
    }
    case ConstraintKind::Rest:
      return WhyRestInfeasible(row, object, obstacles, scene);
    case ConstraintKind::Velocity:
    case ConstraintKind::Acceleration:
    case ConstraintKind::Orientation:
      break; // by themselves these are possible anywhere
  }
  return {};
}

std::string WhyStartInfeasible(const MotionObject& object,
                               const std::vector<LandingWindow>& windows,
                               const ObstacleSet& obstacles, const SceneInfo& scene)
{
  Constraint start;
  start.ObjectId = object.ObjectId;
  start.Value = object.Position;
  if (object.On >= 0 && obstacles.Find(object.On) == nullptr)
  {
    return "there is no obstacle " + std::to_string(object.On) + " that it is on";
  }
  const std::string why = WhyPositionInfeasible(start, &object, windows, obstacles, scene);
  return !why.empty() ? why
                      : WhyRideInfeasible(StartPlace(object, obstacles), 0, object.Released(),
                                          obstacles, scene.Bounds);
}

std::vector<bool> FindUnassignable(const std::vector<Constraint>& constraints,
                                   const std::vector<MotionObject>& objects)
{
  struct Group
  {
    std::map<int, std::size_t> Taken; // by class; -1: of any class
    std::size_t Total = 0;
    std::set<std::pair<int, int>> Placed, Refused; // (Row, Target)
  };
  std::map<int, std::size_t> available;
  std::map<int, int> classOf; // by ObjectId
  for (const MotionObject& object : objects)
  {
    ++available[object.ClassId];
    classOf[object.ObjectId] = object.ClassId;
  }
  std::map<int, Group> groups;
  std::set<std::pair<int, int>> named; // (group, object): given or assigned already
  for (const Constraint& row : constraints)
  {
    const auto found = classOf.find(row.ObjectId);
    if (row.Group >= 0 && found != classOf.end() && named.emplace(row.Group, row.ObjectId).second)
    {
      Group& group = groups[row.Group];
      ++group.Total;
      group.Taken[found->second] += found->second >= 0 ? 1 : 0;
    }
  }
  std::vector<bool> refused(constraints.size(), false);
  for (std::size_t n = 0; n < constraints.size(); ++n)
  {
    const Constraint& row = constraints[n];
    Group lone;
    Group& group = row.Group >= 0 ? groups[row.Group] : lone;
    const std::pair<int, int> target(row.Row, row.Target);
    if (row.ObjectId >= 0 || group.Placed.count(target))
    {
      continue;
    }
    const bool classFull = row.ClassId >= 0 && group.Taken[row.ClassId] >= available[row.ClassId];
    if (group.Refused.count(target) || classFull || group.Total >= objects.size())
    {
      group.Refused.insert(target);
      refused[n] = true;
      continue;
    }
    ++group.Taken[row.ClassId];
    ++group.Total;
    group.Placed.insert(target);
  }
  return refused;
}

} // namespace waft
