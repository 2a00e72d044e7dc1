// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/PixelSites.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <utility>

namespace waft
{

namespace
{

// The bits of two coordinates in turn: neighbours in this order are neighbours in the plane.
std::uint64_t MortonCode(const Vec3& p)
{
  const auto x = static_cast<std::uint64_t>(p.x());
  const auto y = static_cast<std::uint64_t>(p.y());
  std::uint64_t code = 0;
  for (unsigned bit = 0; bit < 24; ++bit)
  {
    code |= ((x >> bit & 1u) << (2 * bit)) | ((y >> bit & 1u) << (2 * bit + 1));
  }
  return code;
}

std::vector<std::size_t> OrderByX(const std::vector<Vec3>& sites)
{
  std::vector<std::size_t> order(sites.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return sites[a].x() < sites[b].x(); });
  return order;
}

/// The first of the sites that are nearest to a point: looked for to either side, until x alone is
/// farther.
std::size_t NearestOf(const std::vector<Vec3>& sites, const std::vector<std::size_t>& byX,
                      const Vec3& point)
{
  std::size_t nearest = 0;
  double least = 1e300;
  const auto mayBeNearer = [&](std::size_t site)
  {
    const double d = (sites[site] - point).squaredNorm();
    if (d < least || (d == least && site < nearest))
    {
      least = d;
      nearest = site;
    }
    const double along = sites[site].x() - point.x();
    return along * along <= least;
  };
  const auto right =
    std::lower_bound(byX.begin(), byX.end(), point.x(),
                     [&](std::size_t site, double x) { return sites[site].x() < x; });
  for (auto site = right; site != byX.end() && mayBeNearer(*site); ++site)
  {
  }
  for (auto site = right; site != byX.begin() && mayBeNearer(*std::prev(site)); --site)
  {
  }
  return nearest;
}

} // namespace

std::vector<Vec3> FirstSites(const WeightedPixels& pixels, std::size_t count, double area,
                             Random& random)
{
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  for (std::size_t i = 0; i < pixels.Points.size(); ++i)
  {
    order.emplace_back(MortonCode(pixels.Points[i]), i);
  }
  std::sort(order.begin(), order.end());
  std::vector<Vec3> sites;
  double sum = 0.0;
  double next = area / static_cast<double>(count) * random.Uniform();
  for (const auto& [code, i] : order)
  {
    sum += pixels.Weights[i];
    while (sum > next && sites.size() < count)
    {
      sites.push_back(pixels.Points[i] +
                      Vec3(random.Uniform(-0.5, 0.5), random.Uniform(-0.5, 0.5), 0.0));
      next += area / static_cast<double>(count);
    }
  }
  while (sites.size() < count) // rounding of the last sum
  {
    sites.push_back(pixels.Points[order.back().second]);
  }
  return sites;
}

void RelaxInArea(const WeightedPixels& pixels, std::vector<Vec3>& sites)
{
  const double work = static_cast<double>(pixels.Points.size() * sites.size());
  const int iterations = static_cast<int>(std::clamp(1e9 / work, 8.0, 60.0));
  for (int iteration = 0; iteration < iterations; ++iteration)
  {
    std::vector<Vec3> moments(sites.size(), Vec3::Zero());
    std::vector<double> weights(sites.size(), 0.0);
    const std::vector<std::size_t> byX = OrderByX(sites);
    for (std::size_t i = 0; i < pixels.Points.size(); ++i)
    {
      const std::size_t nearest = NearestOf(sites, byX, pixels.Points[i]);
      const double weight = pixels.Weights[i] * pixels.Weights[i];
      moments[nearest] += weight * pixels.Points[i];
      weights[nearest] += weight;
    }
    for (std::size_t s = 0; s < sites.size(); ++s)
    {
      if (weights[s] > 0.0)
      {
        sites[s] = moments[s] / weights[s];
      }
    }
  }
}

void RelaxOnLines(const std::vector<Vec3>& lines, double spacing, std::vector<Vec3>& sites)
{
  constexpr int sweeps = 40;
  for (int sweep = 0; sweep < sweeps; ++sweep)
  {
    bool moved = false;
    for (std::size_t s = 0; s < sites.size(); ++s)
    {
      const auto energyAt = [&](const Vec3& x)
      {
        double energy = 0.0;
        for (std::size_t o = 0; o < sites.size(); ++o)
        {
          if (o != s)
          {
            const double d2 = std::max((sites[o] - x).squaredNorm() / (spacing * spacing), 1e-6);
            energy += 1.0 / (d2 * d2);
          }
        }
        return energy;
      };
      Vec3 best = sites[s];
      double least = energyAt(best);
      for (const Vec3& x : lines)
      {
        if ((x - sites[s]).squaredNorm() < 0.3 * spacing * spacing)
        {
          const double energy = energyAt(x);
          if (energy < least * (1.0 - 1e-9))
          {
            least = energy;
            best = x;
          }
        }
      }
      moved = moved || best != sites[s];
      sites[s] = best;
    }
    if (!moved)
    {
      return;
    }
  }
}

} // namespace waft
