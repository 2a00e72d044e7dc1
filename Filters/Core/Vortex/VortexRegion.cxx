// SPDX-License-Identifier: BSD-3-Clause
#include "Vortex/VortexRegion.h"

#include <cmath>
#include <map>
#include <numeric>

namespace waft
{

namespace
{

double DistanceToAxis(const Vortex& vortex, const Vec3& x)
{
  const Vec3 axis = vortex.P2 - vortex.P1;
  const double along = std::clamp((x - vortex.P1).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
  return (x - vortex.P1 - along * axis).norm();
}

bool IsNear(const VortexSample& a, const VortexSample& b, double distance, double time)
{
  return std::abs(a.Time - b.Time) <= time && (a.Position - b.Position).norm() <= distance;
}

} // namespace

std::vector<VortexSample> SamplesOf(const Vortex& vortex, const std::set<int>& claims,
                                    const std::vector<VortexSample>& samples, double width)
{
  const double reach = std::max(4.0 * vortex.CoreRadius, 0.15 * width);
  std::vector<VortexSample> found;
  for (const VortexSample& s : samples)
  {
    const bool inRegion = std::abs(s.Time - vortex.CenterTime) <= 2.5 * vortex.Duration &&
                          DistanceToAxis(vortex, s.Position) <= reach;
    if (s.Weight > 0.0 && (inRegion || (s.VortexId >= 0 && claims.count(s.VortexId))))
    {
      found.push_back(s);
    }
  }
  return found;
}

int CountWitnesses(const Vortex& vortex, const std::vector<VortexSample>& samples)
{
  // Greatest at mid-segment, one core radius away from the axis.
  const Vec3 side = (vortex.P2 - vortex.P1).unitOrthogonal();
  const double greatest =
    vortex.SpatialAcceleration(0.5 * (vortex.P1 + vortex.P2) + vortex.CoreRadius * side).norm();
  std::map<int, int> felt;
  int witnesses = 0;
  for (const VortexSample& s : samples)
  {
    if (greatest > 0.0 && vortex.Acceleration(s.Position, s.Time).norm() > 0.25 * greatest &&
        ++felt[s.Track] == 5)
    {
      ++witnesses;
    }
  }
  return witnesses;
}

bool AreDuplicates(const Vortex& a, const Vortex& b, const VortexFitOptions& options)
{
  const Vec3 centers = 0.5 * (a.P1 + a.P2 - b.P1 - b.P2);
  const Vec3 axisA = (a.P2 - a.P1).normalized();
  const Vec3 axisB = (b.P2 - b.P1).normalized();
  return centers.norm() < options.MergeDistance * options.Bounds.Width() &&
         axisA.cross(axisB).norm() < std::sin(std::min(options.MergeAngle, M_PI_2)) &&
         std::abs(a.CenterTime - b.CenterTime) <
           options.MergeTime * std::min(a.Duration, b.Duration);
}

std::vector<VortexSample> StrongestRegion(const std::vector<VortexSample>& samples, double width,
                                          std::vector<std::size_t>& region)
{
  const double distance = 0.2 * width;
  constexpr double time = 1.5; // s
  const auto energy = [&](std::size_t n)
  { return samples[n].Weight * samples[n].Acceleration.squaredNorm(); };
  std::vector<std::size_t> order(samples.size());
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  std::sort(order.begin(), order.end(),
            [&](std::size_t l, std::size_t r)
            { return energy(l) != energy(r) ? energy(l) > energy(r) : l < r; });
  std::vector<std::size_t> seeds;
  for (const std::size_t n : order)
  {
    bool apart = energy(n) > 0.0;
    for (const std::size_t seed : seeds)
    {
      apart = apart && !IsNear(samples[n], samples[seed], 0.5 * distance, 0.5 * time);
    }
    if (apart)
    {
      seeds.push_back(n);
    }
    if (seeds.size() == 24)
    {
      break;
    }
  }
  region.clear();
  double most = 0.0;
  for (const std::size_t seed : seeds)
  {
    std::vector<std::size_t> near;
    double sum = 0.0;
    for (std::size_t n = 0; n < samples.size(); ++n)
    {
      if (samples[n].Weight > 0.0 && IsNear(samples[n], samples[seed], distance, time))
      {
        near.push_back(n);
        sum += energy(n);
      }
    }
    if (sum > most)
    {
      most = sum;
      region = std::move(near);
    }
  }
  std::vector<VortexSample> found;
  for (const std::size_t n : region)
  {
    found.push_back(samples[n]);
  }
  return found;
}

} // namespace waft
