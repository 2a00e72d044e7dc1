// SPDX-License-Identifier: BSD-3-Clause
#include "Vortex/AirVortexFit.h"

#include "Vortex/VortexSamples.h"

#include <Eigen/Dense>

#include <algorithm>

namespace waft
{
namespace
{

constexpr int LeftOutOf = 5;  // one track of so many is left out
constexpr double Ridge = 0.1; // of a vortex' own part of the normal matrix: two that are nearly one
constexpr double LeftOutShare = 0.45; // of the time

/// What vortices of strength 1 do at a sample, a column each.
Eigen::Matrix3Xd UnitFields(const std::vector<Vortex>& vortices, const VortexSample& sample)
{
  Eigen::Matrix3Xd fields(3, vortices.size());
  for (std::size_t n = 0; n < vortices.size(); ++n)
  {
    Vortex unit = vortices[n];
    unit.Strength = 1.0;
    fields.col(static_cast<Eigen::Index>(n)) = unit.Acceleration(sample.Position, sample.Time);
  }
  return fields;
}

void SolveStrengths(const std::vector<VortexSample>& samples, std::vector<Vortex>& vortices)
{
  const auto count = static_cast<Eigen::Index>(vortices.size());
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  for (const VortexSample& sample : samples)
  {
    if (sample.Weight > 0.0)
    {
      const Eigen::Matrix3Xd fields = UnitFields(vortices, sample);
      normal.noalias() += fields.transpose() * fields;
      right.noalias() += fields.transpose() * sample.Acceleration;
    }
  }
  for (Eigen::Index n = 0; n < count; ++n)
  {
    normal(n, n) = normal(n, n) > 0.0 ? (1.0 + Ridge) * normal(n, n) : 1.0;
  }
  const Eigen::VectorXd strengths = normal.ldlt().solve(right);
  for (Eigen::Index n = 0; n < count; ++n)
  {
    vortices[static_cast<std::size_t>(n)].Strength = strengths[n];
  }
}

double Explained(const std::vector<VortexSample>& samples, const std::vector<Vortex>& vortices)
{
  double all = 0.0;
  double left = 0.0;
  for (const VortexSample& sample : samples)
  {
    if (sample.Weight > 0.0)
    {
      Vec3 rest = sample.Acceleration;
      for (const Vortex& vortex : vortices)
      {
        rest -= vortex.Acceleration(sample.Position, sample.Time);
      }
      all += sample.Acceleration.squaredNorm();
      left += rest.squaredNorm();
    }
  }
  return all > 0.0 ? 1.0 - left / all : 0.0;
}

Result FitWithStrengths(const std::vector<VortexSample>& samples, const std::vector<Vortex>& priors,
                        const VortexFitOptions& options, Monitor& monitor,
                        std::vector<Vortex>& vortices)
{
  const Result result = FitVortices(samples, priors, options, monitor, vortices);
  if (result)
  {
    SolveStrengths(samples, vortices);
  }
  return result;
}

} // namespace

Result FitAirVortices(const std::vector<Track>& tracks, const Timeline& time,
                      const std::vector<Vortex>& priors, const VortexFitOptions& options,
                      Monitor& monitor, AirVortexFit& found)
{
  found = AirVortexFit();
  std::vector<Track> turned = tracks;
  WAFT_RETURN_IF_FAILED(TakeAirAccelerations(time, turned));
  std::vector<VortexSample> samples;
  WAFT_RETURN_IF_FAILED(SamplesFromTracks(turned, time, false, samples));
  if (tracks.size() >= LeftOutOf)
  {
    std::vector<VortexSample> seen = samples;
    std::vector<VortexSample> others;
    for (VortexSample& sample : seen)
    {
      if (sample.Track % LeftOutOf == LeftOutOf - 1)
      {
        others.push_back(sample);
        sample.Weight = 0.0;
      }
    }
    PartMonitor part(monitor, 0.0, LeftOutShare);
    std::vector<Vortex> vortices;
    const Result result = FitWithStrengths(seen, priors, options, part, vortices);
    if (!result || result.IsStopped())
    {
      found.Vortices = std::move(vortices);
      return result;
    }
    found.ExplainedLeftOut = Explained(others, vortices);
  }
  PartMonitor part(monitor, tracks.size() >= LeftOutOf ? LeftOutShare : 0.0, 1.0);
  const Result result = FitWithStrengths(samples, priors, options, part, found.Vortices);
  found.Explained = result ? Explained(samples, found.Vortices) : 0.0;
  return result;
}

} // namespace waft
