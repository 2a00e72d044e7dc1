// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/InputCheck.h"

#include "Obstacles/SurfaceRepair.h"
#include "Planning/PlannerNumbers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <string>
#include <utility>

namespace waft
{

Result CheckPlanInput(const PlanInput& input)
{
  const Timeline& time = input.Scene.Time;
  if (time.NumberOfFrames < 1 || !(time.FramesPerSecond > 0.0))
  {
    return Result::Error("planner: the scene has no frames, at least one expected");
  }
  if (!((input.Scene.Bounds.Size().array() > 0.0).all()))
  {
    return Result::Error("planner: the volume is empty");
  }
  std::set<int> ids;
  for (const MotionObject& object : input.Objects)
  {
    if (!ids.insert(object.ObjectId).second)
    {
      return Result::Error("planner: ObjectId " + std::to_string(object.ObjectId) +
                           " occurs twice in the objects");
    }
    if (!object.Position.allFinite() || !object.Velocity.allFinite())
    {
      return Result::Error("planner: position or velocity of object " +
                           std::to_string(object.ObjectId) + " is not finite");
    }
  }
  for (const Constraint& row : input.Constraints)
  {
    const std::string name = "planner: constraint row " + std::to_string(row.Row) + ", target " +
                             std::to_string(row.Target);
    if (row.Frame < 0 || row.Frame >= time.NumberOfFrames)
    {
      return Result::Error(name + ": frame " + std::to_string(row.Frame) + " is outside 0.." +
                           std::to_string(time.NumberOfFrames - 1));
    }
    if (row.ObjectId >= 0 && ids.count(row.ObjectId) == 0)
    {
      return Result::Error(name + ": there is no object " + std::to_string(row.ObjectId));
    }
    if (!row.Value.allFinite() || !std::isfinite(row.Radius))
    {
      return Result::Error(name + ": Value or Radius is not finite");
    }
  }
  std::set<int> guided;
  for (const Guide& guide : input.Guides)
  {
    const std::string name = "planner: the guide of object " + std::to_string(guide.ObjectId);
    if (ids.count(guide.ObjectId) == 0)
    {
      return Result::Error(name + ": there is no such object");
    }
    if (!guided.insert(guide.ObjectId).second)
    {
      return Result::Error(name + ": there is another one, at most one expected");
    }
    if (guide.Points.size() < 2)
    {
      return Result::Error(name + ": at least 2 points expected");
    }
    for (const Vec3& x : guide.Points)
    {
      if (!x.allFinite())
      {
        return Result::Error(name + ": a point is not finite");
      }
    }
  }
  return Result::Ok();
}

namespace
{

bool IsFar(double one, double other)
{
  return std::max(one, other) > (1.0 + 1e-9) * PlannerNumbers::FarFactor * std::min(one, other);
}

} // namespace

double DatabaseScale(const MotionDatabase& database, const SceneInfo& scene)
{
  const double ratio = scene.Bounds.Size().maxCoeff() / database.Volume.Size().maxCoeff();
  constexpr double far = PlannerNumbers::FarFactor;
  return std::isfinite(ratio) && ratio > 0.0 ? ratio / std::clamp(ratio, 1.0 / far, far) : 1.0;
}

std::vector<std::string> DatabaseRemarks(const MotionDatabase& database, const SceneInfo& scene)
{
  std::vector<std::string> remarks;
  char text[256];
  const double rate = scene.Time.FramesPerSecond;
  if (IsFar(database.FramesPerSecond, rate))
  {
    std::snprintf(
      text, sizeof text,
      "Database: traced at %.6g frames per second, the scene has %.6g: its segments are "
      "resampled",
      database.FramesPerSecond, rate);
    remarks.emplace_back(text);
  }
  return remarks;
}

Result BuildPlanObstacles(std::vector<ObstacleMesh> meshes, ObstacleSet& obstacles)
{
  WAFT_RETURN_IF_FAILED(obstacles.Build(std::move(meshes)));
  for (const ObstacleMesh& obstacle : obstacles.Obstacles())
  {
    WAFT_RETURN_IF_FAILED(CheckSelfIntersection(
      "Obstacles: obstacle " + std::to_string(obstacle.ObstacleId), obstacle.Mesh));
  }
  return Result::Ok();
}

std::vector<std::string> PlanRemarks(const MotionDatabase& database, const SceneInfo& scene,
                                     const PlanOutput& plan)
{
  std::vector<std::string> remarks = DatabaseRemarks(database, scene);
  for (const ObjectRow& object : plan.Objects)
  {
    if (object.NumberOfRows == 0 && !object.Message.empty())
    {
      remarks.push_back(object.Message);
    }
  }
  return remarks;
}

} // namespace waft
