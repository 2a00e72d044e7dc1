// SPDX-License-Identifier: BSD-3-Clause
#include "Database/Provenance.h"

#include "Trajectory/ParameterText.h"

namespace waft
{

namespace
{

std::string Text(const Range& range)
{
  return ParameterText(range.Low, range.High);
}

const char* Name(BoundaryKind kind)
{
  return kind == BoundaryKind::Closed ? "Closed"
                                      : (kind == BoundaryKind::Open ? "Open" : "Periodic");
}

const char* Name(AdvectionScheme scheme)
{
  return scheme == AdvectionScheme::Linear
           ? "Linear"
           : (scheme == AdvectionScheme::MonotoneCubic ? "MonotoneCubic" : "MacCormack");
}

/// All that a simulation of a given index depends on.
std::map<std::string, std::string> ParametersOfSimulations(const DatabaseOptions& options)
{
  std::map<std::string, std::string> p;
  p["Version"] = WAFT_VERSION;
  p["Seed"] = ParameterText(options.Seed);
  p["NumberOfFrames"] = ParameterText(options.NumberOfFrames);
  p["FramesPerSecond"] = ParameterText(options.FramesPerSecond);
  const Vec3& min = options.Bounds.Min;
  const Vec3& max = options.Bounds.Max;
  p["Bounds"] = ParameterText(min.x(), max.x(), min.y(), max.y(), min.z(), max.z());
  p["Resolution"] = ParameterText(options.Resolution);
  p["WarmUpSeconds"] = ParameterText(options.WarmUpSeconds);
  p["SettlingSpeed"] = ParameterText(options.SettlingSpeed);
  p["SeedStride"] = ParameterText(options.Trace.SeedStride);
  p["VortexShare"] = ParameterText(options.Trace.Annotation.VortexShare);
  p["ForceFloor"] = ParameterText(options.Trace.Annotation.ForceFloor);
  p["ShortestRun"] = ParameterText(options.Trace.Annotation.ShortestRun);
  const SmokeOptions& smoke = options.Smoke;
  p["Advection"] = Name(smoke.Advection);
  p["Boundary"] =
    ParameterText(Name(smoke.Boundary[0]), Name(smoke.Boundary[1]), Name(smoke.Boundary[2]),
                  smoke.ClosedFloor ? "ClosedFloor" : "OpenFloor");
  p["Confinement"] = ParameterText(smoke.Confinement);
  p["CourantNumber"] = ParameterText(smoke.CourantNumber);
  p["MaximumSubsteps"] = ParameterText(smoke.MaximumSubsteps);
  p["Tolerance"] = ParameterText(smoke.Tolerance);
  p["MaximumIterations"] = ParameterText(smoke.MaximumIterations);
  p["Buoyancy"] = ParameterText(smoke.BuoyancyTemperature, smoke.BuoyancyDensity);
  p["Dissipation"] = ParameterText(smoke.Dissipation);
  const EnsembleOptions& scene = options.Ensemble;
  p["NumberOfVortices"] = ParameterText(scene.NumberOfVortices);
  p["NumberOfWinds"] = ParameterText(scene.NumberOfWinds);
  p["NumberOfObstacles"] = ParameterText(scene.NumberOfObstacles);
  p["NumberOfEmitters"] = ParameterText(scene.NumberOfEmitters);
  p["VortexDiameter"] = Text(scene.VortexDiameter);
  p["VortexLength"] = Text(scene.VortexLength);
  p["VortexAcceleration"] = Text(scene.VortexAcceleration);
  p["VortexDuration"] = Text(scene.VortexDuration);
  p["WindRadius"] = Text(scene.WindRadius);
  p["WindAcceleration"] = Text(scene.WindAcceleration);
  p["WindDuration"] = Text(scene.WindDuration);
  p["ObstacleSize"] = Text(scene.ObstacleSize);
  p["EmitterRadius"] = Text(scene.EmitterRadius);
  return p;
}

} // namespace

std::map<std::string, std::string> ProvenanceOf(const DatabaseOptions& options)
{
  std::map<std::string, std::string> p = ParametersOfSimulations(options);
  p["NumberOfSimulations"] = ParameterText(options.NumberOfSimulations);
  p.merge(ParametersOf(options.Cluster)); // Seed is that of the simulations
  return p;
}

std::string SimulationText(const DatabaseOptions& options)
{
  std::string text;
  for (const auto& [key, value] : ParametersOfSimulations(options))
  {
    text += key + " = " + value + "\n";
  }
  return text;
}

} // namespace waft
