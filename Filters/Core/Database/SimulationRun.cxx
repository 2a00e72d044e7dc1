// SPDX-License-Identifier: BSD-3-Clause
#include "Database/SimulationRun.h"

#include "Obstacles/DistanceFrames.h"

#include <algorithm>
#include <cmath>

namespace waft
{

namespace
{

int WarmUpFramesOf(const DatabaseOptions& options)
{
  return static_cast<int>(std::lround(options.WarmUpSeconds * options.FramesPerSecond));
}

} // namespace

int StepsOfSimulation(const DatabaseOptions& options)
{
  return WarmUpFramesOf(options) + options.NumberOfFrames;
}

Result SmokeOptionsOf(const DatabaseOptions& options, SmokeOptions& smoke)
{
  smoke = options.Smoke;
  smoke.Bounds = options.Bounds;
  smoke.FramesPerSecond = options.FramesPerSecond;
  smoke.WarmUpSeconds = 0.0; // it is taken in steps, so that a run can be stopped within it
  const Vec3 size = options.Bounds.Size();
  const double spacing = size.maxCoeff() / options.Resolution;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double voxels = size[axis] / spacing;
    smoke.Resolution[axis] = static_cast<int>(std::lround(voxels));
    if (std::abs(voxels - smoke.Resolution[axis]) > 1e-6 * voxels)
    {
      return Result::Error("Bounds: expected sides that are whole numbers of voxels of " +
                           std::to_string(spacing) + " m");
    }
  }
  return smoke.Validate();
}

Result SimulationRun::Begin(const DatabaseOptions& options, int simulation)
{
  this->WarmUpFrames = WarmUpFramesOf(options);
  this->StepsTaken = 0;
  this->StartTime = this->WarmUpFrames / options.FramesPerSecond;

  EnsembleOptions scene = options.Ensemble;
  scene.Seed = SimulationSeed(options.Seed, simulation);
  scene.Bounds = options.Bounds;
  scene.NumberOfFrames = options.NumberOfFrames;
  scene.FramesPerSecond = options.FramesPerSecond;
  scene.WarmUpSeconds = this->StartTime;
  Ensemble ensemble;
  WAFT_RETURN_IF_FAILED(MakeEnsemble(scene, ensemble));
  this->Vortices = ensemble.Forces.Vortices;

  SmokeOptions smoke;
  WAFT_RETURN_IF_FAILED(SmokeOptionsOf(options, smoke));
  SmokeForces forces = ensemble.Forces;
  for (Vortex& vortex : forces.Vortices)
  {
    vortex.CenterTime += this->StartTime;
  }
  for (AnalyticWind& wind : forces.Winds)
  {
    wind.CenterTime += this->StartTime;
  }
  WAFT_RETURN_IF_FAILED(this->Solver.Begin(smoke, std::move(forces)));
  this->Distances = nullptr;
  if (!ensemble.Obstacles.empty())
  {
    WAFT_RETURN_IF_FAILED(this->PositionObstacles(smoke, ensemble.Obstacles));
  }

  const Vec3 spacing = smoke.Spacing();
  PointLattice lattice;
  lattice.Dimensions = smoke.Resolution;
  lattice.Spacing = spacing;
  lattice.Origin = smoke.Bounds.Min + 0.5 * spacing;
  TraceOptions trace = options.Trace;
  trace.FramesPerSecond = options.FramesPerSecond;
  trace.Volume = options.Bounds;
  trace.SettlingSpeed = options.SettlingSpeed;
  SolidTest isSolid;
  if (this->Distances)
  {
    isSolid = [distances = this->Distances](const Vec3& x, double)
    { return distances->Sample(x) < 0.0; };
  }
  return this->Tracer.Begin(lattice, trace, this->Vortices, isSolid);
}

Result SimulationRun::PositionObstacles(const SmokeOptions& options,
                                        const std::vector<ObstacleMesh>& obstacles)
{
  this->Distances = std::make_shared<DistanceLattice>();
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Distances->Dimensions[axis] = options.Resolution[axis] + 1;
  }
  this->Distances->Origin = options.Bounds.Min;
  this->Distances->Spacing = options.Spacing().x();
  this->Distances->Band = 4.0 * this->Distances->Spacing;
  WAFT_RETURN_IF_FAILED(ComputeDistanceLattice(obstacles, 0.0, *this->Distances));
  return this->Solver.SetSolids(this->Distances->Values);
}

Result SimulationRun::Step(Monitor& monitor)
{
  const Result stepped = this->Solver.Step(SerialFor(), monitor);
  if (!stepped || stepped.IsStopped())
  {
    return stepped;
  }
  if (this->StepsTaken++ < this->WarmUpFrames)
  {
    return Result::Ok();
  }
  this->Solver.Read(this->Fields);
  FlowFrame frame;
  frame.Time = this->Fields.Time - this->StartTime;
  frame.Velocity = std::move(this->Fields.Velocity);
  frame.VortexForce = std::move(this->Fields.VortexForce);
  frame.WindForce = std::move(this->Fields.WindForce);
  return this->Tracer.Feed(std::move(frame), SerialFor());
}

TracedSimulation SimulationRun::Finish()
{
  TracedSimulation traced{ this->Tracer.Finish(), std::move(this->Vortices) };
  for (Track& track : traced.Tracks)
  {
    track.VortexAccelerations = {};
  }
  return traced;
}

} // namespace waft
