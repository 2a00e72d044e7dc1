// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Run/AirSetup.h"

#include "Constraints/ConstraintCheck.h"
#include "Constraints/RowsOfObjects.h"
#include "Grid/SmokeEnsemble.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace waft
{
namespace
{

// The ground is mostly a slab below the volume, which the air does not meet.
bool IsInside(const Box& volume, const ObstacleMesh& obstacle)
{
  const double touching = 1e-6 * volume.Width();
  const Box box = BoxAbout(obstacle.Mesh.Points);
  const bool apart = ((box.Max - volume.Min).array() <= touching).any() ||
                     ((volume.Max - box.Min).array() <= touching).any();
  return !apart || obstacle.IsMoving();
}

} // namespace

Result SetUpObstacles(AirContext& run)
{
  WAFT_RETURN_IF_FAILED(run.Obstacles.Build(run.Input.Obstacles));
  std::vector<ObstacleMesh> inside;
  for (const ObstacleMesh& obstacle : run.Input.Obstacles)
  {
    if (IsInside(run.Input.Scene.Bounds, obstacle))
    {
      inside.push_back(obstacle);
    }
  }
  if (!inside.empty())
  {
    WAFT_RETURN_IF_FAILED(run.Inside.Build(std::move(inside)));
    run.FromSolids = [&solids = run.Inside](const Vec3& x, double frame, double reach, Vec3& away)
    {
      SurfaceHit hit;
      const double distance = solids.SignedDistance(x, frame, reach, hit);
      away = hit.Normal;
      return distance;
    };
  }
  return Result::Ok();
}

BodyProblem ProblemOf(const AirContext& run, const MotionObject& object,
                      const std::vector<Vec3>& plan, std::vector<Constraint> rows)
{
  if (object.VelocityGiven != 0)
  {
    Constraint row;
    row.ObjectId = object.ObjectId;
    row.Kind = ConstraintKind::Velocity;
    row.Frame = object.Released();
    row.Value = object.Velocity;
    if (object.Hangs()) // half of the difference is of the step before
    {
      const double rate = run.Input.Scene.Time.FramesPerSecond;
      const CarriedPlace start = StartPlace(object, run.Obstacles);
      row.Value += start.Velocity(object.Release - 0.5, rate);
      row.Value *= 0.5;
    }
    row.Row = row.Target = OfNoRow;
    rows.push_back(row);
  }
  if (object.Goes.From >= 0) // as after a row that asks for nothing
  {
    Constraint row;
    row.ObjectId = object.ObjectId;
    row.Kind = ConstraintKind::Orientation;
    row.Frame = object.Goes.From;
    row.Value = object.Position;
    row.Goes = object.Goes;
    row.Row = row.Target = OfNoRow;
    rows.push_back(row);
  }
  return BodyProblem(run.Around, object, plan, std::move(rows));
}

Result SetUpBodies(const AirContext& run, AirBodies& bodies, AssimilationOutput& output)
{
  bodies = AirBodies();
  output.Constraints = run.Rows;
  output.Report = JudgeConstraints(run.Rows, run.Input.Objects, run.Obstacles, run.Input.Scene);
  std::map<int, const MotionObject*> objects;
  for (const MotionObject& object : run.Input.Objects)
  {
    objects[object.ObjectId] = &object;
  }
  const RowsOfObjects places(run.Rows);
  for (std::size_t o = 0; o < run.Input.Tracks.size(); ++o)
  {
    const int id = run.Input.Tracks[o].ObjectId;
    const std::vector<Vec3>& plan = run.Plans[o];
    const auto object = objects.find(id);
    if (object == objects.end())
    {
      return Result::Error("Objects: no object " + std::to_string(id) + ", which Tracks has");
    }
    std::vector<Constraint> rows;
    for (const std::size_t place : places.Of(id))
    {
      const Constraint& row = run.Rows[place];
      if (IsBinding(row, output.Report))
      {
        rows.push_back(row);
      }
      else if (row.Status == ConstraintStatus::Unreachable && IsPositional(row.Kind))
      {
        // The plan comes as near as it can.
        Constraint near = row;
        near.Kind = ConstraintKind::Position;
        near.Value = plan[static_cast<std::size_t>(row.Frame)];
        near.Radius = 0.0;
        near.IsOpenWindow = false;
        rows.push_back(near);
      }
    }
    bodies.Problems.push_back(ProblemOf(run, *object->second, plan, std::move(rows)));
    bodies.Paths.push_back(plan);
  }
  return Result::Ok();
}

AirScene SetUpScene(const AirContext& run, const AssimilationOptions& options)
{
  AirScene scene;
  SmokeOptions& smoke = scene.Smoke;
  smoke.Bounds = run.Input.Scene.Bounds;
  smoke.FramesPerSecond = run.Input.Scene.Time.FramesPerSecond;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const bool isOpen = run.Input.Scene.Open[axis] != 0;
    smoke.Boundary[axis] = isOpen ? BoundaryKind::Open : BoundaryKind::Closed; // never the floor
  }
  smoke.Breeze = run.Input.Scene.Breeze;
  smoke.BuoyancyTemperature = 0.0;
  smoke.AirDensity = run.Input.Scene.AirDensity;
  smoke.NegligibleForce = StirringLeast;
  smoke.Confinement /= TimeScaleOf(smoke.Bounds.Width());
  const Vec3 size = smoke.Bounds.Size();
  const double voxel = size.maxCoeff() / options.Resolution;
  for (int c = 0; c < 3; ++c)
  {
    const auto axis = static_cast<std::size_t>(c);
    smoke.Resolution[axis] = std::max(4, static_cast<int>(std::lround(size[c] / voxel)));
  }
  scene.LatticeDimensions = AirLatticeDimensions(smoke.Bounds, options);
  scene.Time = run.Input.Scene.Time;
  if (run.Solids && run.FromSolids)
  {
    scene.Solids = run.Solids(smoke);
    scene.SolidsMove = run.Obstacles.HasMoving();
  }
  return scene;
}

} // namespace waft
