// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/LoopRows.h"

#include "Base/NumberText.h"
#include "Constraints/Keyframes.h"
#include "Constraints/Rest.h"
#include "Constraints/RowsOfObjects.h"

#include <algorithm>
#include <map>
#include <string>

namespace waft
{
namespace
{

constexpr double SamePlace = 1e-6;  // of the volume's width
constexpr double LongestStep = 2.0; // over an obstacle's own

// An obstacle's step from the last frame to the first is one like any of its own.
Result CheckObstacles(const ObstacleSet& obstacles)
{
  for (const ObstacleMesh& obstacle : obstacles.Obstacles())
  {
    const std::vector<Vec3>& at = obstacle.Offsets;
    double longest = 0.0;
    for (std::size_t k = 0; k + 1 < at.size(); ++k)
    {
      longest = std::max(longest, (at[k + 1] - at[k]).norm());
    }
    if (!at.empty() && (at.front() - at.back()).norm() > LongestStep * longest)
    {
      return Result::Error("the scene loops, and obstacle " + std::to_string(obstacle.ObstacleId) +
                           " ends " + NumberText((at.front() - at.back()).norm()) +
                           " m from where it begins: expected its last place to be its first");
    }
  }
  return Result::Ok();
}

bool Leaves(const MotionObject& object, const RowsOfObjects& places,
            const std::vector<Constraint>& rows)
{
  const std::vector<std::size_t>& own = places.Of(object.ObjectId);
  return object.Goes.From >= 0 ||
         std::any_of(own.begin(), own.end(),
                     [&rows](std::size_t i) { return rows[i].Goes.From >= 0; });
}

// The row by which it lies at a frame, or null.
Constraint* RestAt(int frame, const MotionObject& object, const RowsOfObjects& places,
                   std::vector<Constraint>& rows)
{
  for (const std::size_t i : places.Of(object.ObjectId))
  {
    if (IsRest(rows[i].Kind) && rows[i].Frame <= frame && rows[i].Until >= frame)
    {
      return &rows[i];
    }
  }
  return nullptr;
}

// What its object asks of who goes on as it.
std::vector<Constraint> RowsAt(const MotionObject& object, int frame, double framesPerSecond,
                               const ObstacleSet& obstacles)
{
  Constraint place;
  place.Frame = place.Until = frame;
  place.Target = object.ObjectId;
  place.Group = object.ShapeId;
  place.Choice = ObjectChoice::AmongListed;
  const CarriedPlace start = StartPlace(object, obstacles);
  place.Value = start.At(0);
  std::vector<Constraint> asked = { place };
  if (object.VelocityGiven != 0 || object.Hangs())
  {
    Constraint velocity = place;
    velocity.Kind = ConstraintKind::Velocity;
    velocity.Value = object.Hangs() ? start.Velocity(0.5, framesPerSecond) : object.Velocity;
    asked.push_back(velocity);
  }
  return asked;
}

} // namespace

Result CloseLoop(const SceneInfo& scene, const std::vector<MotionObject>& objects,
                 const ObstacleSet& obstacles, std::vector<Constraint>& rows, int& number)
{
  WAFT_RETURN_IF_FAILED(CheckObstacles(obstacles));
  AssignKeyframes(objects, rows); // whom nobody has yet
  const int frame = scene.Time.NumberOfFrames;
  const RowsOfObjects places(rows);
  std::map<int, std::vector<int>> endings; // by shape, ids
  std::map<int, std::size_t> beginnings;
  std::vector<Constraint> closing;
  std::map<int, Constraint*> lying; // who lies to the end
  for (const MotionObject& object : objects)
  {
    if (!Leaves(object, places, rows))
    {
      endings[object.ShapeId].push_back(object.ObjectId);
      if (Constraint* rest = RestAt(frame - 1, object, places, rows))
      {
        lying[object.ObjectId] = rest;
      }
    }
    if (object.FirstPresent() == 0)
    {
      ++beginnings[object.ShapeId];
      const std::vector<Constraint> asked =
        RowsAt(object, frame, scene.Time.FramesPerSecond, obstacles);
      closing.insert(closing.end(), asked.begin(), asked.end());
    }
  }
  for (const MotionObject& object : objects)
  {
    const std::size_t ending = endings[object.ShapeId].size();
    const std::size_t beginning = beginnings[object.ShapeId];
    if (ending != beginning)
    {
      return Result::Error("the scene loops, and of the shape of object " +
                           std::to_string(object.ObjectId) + " " + std::to_string(ending) +
                           " are there at the last frame, " + std::to_string(beginning) +
                           " at the first: expected as many; who appears takes the place of one "
                           "that leaves");
    }
  }
  for (const MotionObject& object : objects)
  {
    const auto rest = lying.find(object.ObjectId);
    Vec3 centre;
    SurfaceHit hit;
    if (rest == lying.end() ||
        !RestingPosition(obstacles, rest->second->Value, frame - 1, object.RestHeight, centre, hit))
    {
      continue;
    }
    const auto begins = [&](const Constraint& row)
    {
      return row.ObjectId < 0 && row.Group == object.ShapeId && IsPositional(row.Kind) &&
             (row.Value - centre).norm() <= SamePlace * scene.Bounds.Width();
    };
    const auto found = std::find_if(closing.begin(), closing.end(), begins);
    if (found == closing.end())
    {
      return Result::Error("the scene loops, and object " + std::to_string(object.ObjectId) +
                           " lies at " + PointText(centre) +
                           " to the last frame: expected an `until` before it, or an object of its "
                           "shape that begins there");
    }
    for (Constraint& row : closing)
    {
      if (row.Target == found->Target)
      {
        GiveTo(object, row);
        row.Choice = ObjectChoice::Given;
        row.Group = -1;
      }
    }
    rest->second->Until = frame;
    std::vector<int>& others = endings[object.ShapeId];
    others.erase(std::find(others.begin(), others.end(), object.ObjectId));
  }
  number = 0;
  int group = 0;
  for (const Constraint& row : rows)
  {
    number = std::max(number, row.Row + 1);
    group = std::max(group, row.Group + 1);
  }
  std::map<int, std::vector<int>> choices;
  for (const auto& [shape, ids] : endings)
  {
    choices[group + shape] = ids;
  }
  for (Constraint& row : closing)
  {
    row.Row = number;
    row.Group += row.Group >= 0 ? group : 0;
  }
  rows.insert(rows.end(), closing.begin(), closing.end());
  AssignKeyframes(objects, rows, choices);
  return Result::Ok();
}

} // namespace waft
