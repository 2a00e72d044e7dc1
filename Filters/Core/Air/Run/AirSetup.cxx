// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Run/AirSetup.h"

#include "Constraints/ConstraintCheck.h"
#include "Constraints/RowsOfObjects.h"
#include "Grid/SmokeEnsemble.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace waft
{
namespace
{

// The ground is mostly a slab below the volume, which the air does not meet.
bool HasSolidsInside(const AssimilationInput& input)
{
  const Box& volume = input.Scene.Bounds;
  const double touching = 1e-6 * volume.Width();
  for (const ObstacleMesh& obstacle : input.Obstacles)
  {
    const Box box = BoxAbout(obstacle.Mesh.Points);
    const bool apart = ((box.Max - volume.Min).array() <= touching).any() ||
                       ((volume.Max - box.Min).array() <= touching).any();
    if (!apart || obstacle.IsMoving())
    {
      return true;
    }
  }
  return false;
}

} // namespace

Result SetUpBodies(const AirContext& run, AirBodies& bodies, AssimilationOutput& output)
{
  output.Constraints = run.Input.Constraints;
  output.Report =
    JudgeConstraints(run.Input.Constraints, run.Input.Objects, run.Obstacles, run.Input.Scene);
  std::map<int, const MotionObject*> objects;
  for (const MotionObject& object : run.Input.Objects)
  {
    objects[object.ObjectId] = &object;
  }
  const RowsOfObjects places(run.Input.Constraints);
  for (const Track& track : run.Input.Tracks)
  {
    const auto object = objects.find(track.ObjectId);
    if (object == objects.end())
    {
      return Result::Error("Objects: no object " + std::to_string(track.ObjectId) +
                           ", which Tracks has");
    }
    std::vector<Constraint> rows;
    for (const std::size_t place : places.Of(track.ObjectId))
    {
      const Constraint& row = run.Input.Constraints[place];
      if (IsBinding(row, output.Report))
      {
        rows.push_back(row);
      }
      else if (row.Status == ConstraintStatus::Unreachable && IsPositional(row.Kind))
      {
        // The plan comes as near as it can.
        Constraint near = row;
        near.Kind = ConstraintKind::Position;
        near.Value = track.Positions[static_cast<std::size_t>(row.Frame)];
        near.Radius = 0.0;
        rows.push_back(near);
      }
    }
    if (object->second->VelocityGiven != 0)
    {
      Constraint row;
      row.ObjectId = track.ObjectId;
      row.Kind = ConstraintKind::Velocity;
      row.Value = object->second->Velocity;
      row.Row = row.Target = OfNoRow;
      rows.push_back(row);
    }
    bodies.Problems.emplace_back(run.Around, *object->second, track.Positions, rows);
    bodies.Paths.push_back(track.Positions);
  }
  return Result::Ok();
}

AirScene SetUpScene(const AirContext& run)
{
  AirScene scene;
  SmokeOptions& smoke = scene.Smoke;
  smoke.Bounds = run.Input.Scene.Bounds;
  smoke.FramesPerSecond = run.Input.Scene.Time.FramesPerSecond;
  smoke.Boundary.fill(BoundaryKind::Closed);
  smoke.BuoyancyTemperature = 0.0;
  smoke.AirDensity = run.Input.Scene.AirDensity;
  smoke.NegligibleForce = StirringLeast;
  smoke.Confinement /= TimeScaleOf(smoke.Bounds.Width());
  const Vec3 size = smoke.Bounds.Size();
  const double voxel = size.maxCoeff() / run.Options.Resolution;
  for (int c = 0; c < 3; ++c)
  {
    const auto axis = static_cast<std::size_t>(c);
    smoke.Resolution[axis] = std::max(4, static_cast<int>(std::lround(size[c] / voxel)));
  }
  scene.LatticeDimensions = AirLatticeDimensions(smoke.Bounds, run.Options);
  scene.Time = run.Input.Scene.Time;
  if (run.Solids && HasSolidsInside(run.Input))
  {
    scene.Solids = run.Solids(smoke);
    scene.SolidsMove = run.Obstacles.HasMoving();
  }
  return scene;
}

} // namespace waft
