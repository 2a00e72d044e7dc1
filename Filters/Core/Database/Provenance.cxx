// SPDX-License-Identifier: BSD-3-Clause
#include "Database/Provenance.h"

#include "Trajectory/ParameterText.h"

namespace waft
{

namespace
{

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
  const auto add = [&p](const OptionField& field, const auto& value)
  {
    std::string& text = p[field.Name];
    EachNumber(value,
               [&text](auto number) { text += (text.empty() ? "" : " ") + ParameterText(number); });
  };
  DatabaseOptions::VisitSimulations(add, options);
  AnnotationOptions::Visit(add, options.Trace.Annotation);
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
  p["NumberOfEmitters"] = ParameterText(options.Ensemble.NumberOfEmitters);
  const Range& radius = options.Ensemble.EmitterRadius;
  p["EmitterRadius"] = ParameterText(radius.front(), radius.back());
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
