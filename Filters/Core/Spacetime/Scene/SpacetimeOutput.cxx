// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Scene/SpacetimeOutput.h"

#include "Constraints/MotionProblem.h"

namespace waft
{

namespace
{

void Serialise(StateArchive& stream, ParticleSeries& particles)
{
  stream.List(particles.ObjectIds);
  stream.List(particles.Masses);
  stream.List(particles.Frames,
              [](StateArchive& s, ParticleSeries::Frame& frame)
              {
                for (auto* list :
                     { &frame.Positions, &frame.Velocities, &frame.Densities, &frame.Pressures,
                       &frame.Winds, &frame.VortexForces, &frame.Residuals })
                {
                  s.List(*list);
                }
              });
}

} // namespace

void Serialise(StateArchive& stream, SpacetimeOutput& output)
{
  const auto serialise = [](StateArchive& s, auto& element) { Serialise(s, element); };
  stream.List(output.Tracks, serialise);
  Serialise(stream, output.Particles);
  stream.List(output.Vortices, serialise);
  Serialise(stream, output.Wind);
  stream.List(output.Convergence, [](StateArchive& s, ConvergenceRow& row) { Serialise(s, row); });
  stream.List(output.Report, serialise);
  stream.List(output.PositionResiduals);
  stream.List(output.VelocityResiduals);
  stream.Values(output.Spacing, output.ObjectReplayError, output.GasReplayError,
                output.GasHiddenHand, output.RepairedFraction, output.LargestRepair);
  stream.List(output.Warnings, [](StateArchive& s, std::string& text) { s.Text(text); });
}

} // namespace waft
