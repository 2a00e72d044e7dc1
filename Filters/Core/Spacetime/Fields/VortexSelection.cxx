// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Fields/VortexSelection.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace waft
{
namespace
{

constexpr double MergeDistance = 0.2; // of the width, between centres
constexpr double MergeTime = 1.0;     // of the longer duration, between centre times

bool AreNear(const Vortex& a, const Vortex& b, double width)
{
  const double distance = (0.5 * (a.P1 + a.P2) - 0.5 * (b.P1 + b.P2)).norm();
  return distance < MergeDistance * width &&
         std::abs(a.CenterTime - b.CenterTime) < MergeTime * std::max(a.Duration, b.Duration);
}

} // namespace

std::vector<Vortex> SelectVortices(const std::vector<Vortex>& vortices,
                                   const std::vector<Track>& tracks, const SceneInfo& scene,
                                   int maximum)
{
  std::map<int, std::size_t> index;
  for (std::size_t k = 0; k < vortices.size(); ++k)
  {
    index.emplace(vortices[k].VortexId, k);
  }
  std::vector<double> score(vortices.size(), 0.0);
  std::vector<bool> isClaimed(vortices.size(), false);
  for (const Track& track : tracks)
  {
    for (std::size_t frame = 0; frame < track.VortexIds.size(); ++frame)
    {
      const auto found = index.find(track.VortexIds[frame]);
      if (found != index.end())
      {
        isClaimed[found->second] = true;
        score[found->second] +=
          vortices[found->second]
            .Acceleration(track.Positions[frame], scene.Time.Time(static_cast<double>(frame)))
            .squaredNorm();
      }
    }
  }
  std::vector<std::size_t> order(vortices.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return score[a] > score[b]; });
  std::vector<bool> isKept(vortices.size(), false);
  std::vector<std::size_t> chosen;
  for (const std::size_t k : order)
  {
    if (!isClaimed[k])
    {
      isKept[k] = true;
      continue;
    }
    const bool isFree =
      std::none_of(chosen.begin(), chosen.end(),
                   [&](std::size_t other)
                   { return AreNear(vortices[k], vortices[other], scene.Bounds.Width()); });
    if (isFree && static_cast<int>(chosen.size()) < maximum && score[k] > 0.0)
    {
      chosen.push_back(k);
      isKept[k] = true;
    }
  }
  std::vector<Vortex> kept;
  for (std::size_t k = 0; k < vortices.size(); ++k)
  {
    if (isKept[k])
    {
      kept.push_back(vortices[k]);
    }
  }
  return kept;
}

} // namespace waft
