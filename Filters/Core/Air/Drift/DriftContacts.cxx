// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Drift/DriftContacts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace waft
{
namespace
{

/// The distance that two objects keep at a frame.
double KeptDistance(const BodyProblem& a, const BodyProblem& b, int frame, int second)
{
  const double radii = a.Object().ClearanceRadius + b.Object().ClearanceRadius;
  double distance = radii;
  const int last = a.NumberOfFrames() - 1;
  for (int away = 0; away <= second; ++away)
  {
    for (const int at : { frame - away, frame + away })
    {
      const Vec3* one = at >= 0 && at <= last ? a.HeldAt(at) : nullptr;
      const Vec3* other = one ? b.HeldAt(at) : nullptr;
      if (other)
      {
        const double aside = static_cast<double>(away) / second;
        distance = std::min(distance, (*one - *other).norm() + radii * aside * aside);
      }
    }
  }
  return distance;
}

} // namespace

std::vector<std::vector<DriftNeighbour>> FindContacts(const std::vector<BodyProblem>& bodies,
                                                      const std::vector<std::vector<Vec3>>& paths,
                                                      double framesPerSecond,
                                                      const ParallelFor& parallel)
{
  const std::size_t count = bodies.size();
  double largest = 0.0;
  for (const BodyProblem& body : bodies)
  {
    largest = std::max(largest, body.Object().ClearanceRadius);
  }
  const int second = std::max(1, static_cast<int>(std::lround(framesPerSecond)));
  struct Pair
  {
    std::size_t A, B;
    double Distance;
  };
  const std::size_t frames = paths.empty() ? 0 : paths.front().size();
  std::vector<std::vector<Pair>> pairs(frames);
  parallel(
    frames,
    [&](std::size_t begin, std::size_t end)
    {
      std::vector<std::size_t> order(count);
      for (std::size_t f = begin; f < end; ++f)
      {
        // Swept along x.
        std::iota(order.begin(), order.end(), std::size_t(0));
        std::sort(order.begin(), order.end(),
                  [&](std::size_t a, std::size_t b) {
                    return paths[a][f].x() != paths[b][f].x() ? paths[a][f].x() < paths[b][f].x()
                                                              : a < b;
                  });
        for (std::size_t i = 0; i < count; ++i)
        {
          const std::size_t a = order[i];
          for (std::size_t j = i + 1; j < count; ++j)
          {
            const std::size_t b = order[j];
            if (paths[b][f].x() - paths[a][f].x() > 2.0 * largest)
            {
              break;
            }
            const double apart = (paths[a][f] - paths[b][f]).norm();
            if (apart >= bodies[a].Object().ClearanceRadius + bodies[b].Object().ClearanceRadius)
            {
              continue;
            }
            const double kept = KeptDistance(bodies[a], bodies[b], static_cast<int>(f), second);
            if (apart < kept)
            {
              pairs[f].push_back({ a, b, kept });
            }
          }
        }
      }
    });
  std::vector<std::vector<DriftNeighbour>> contacts(count);
  for (std::size_t f = 0; f < frames; ++f)
  {
    for (const Pair& pair : pairs[f])
    {
      const auto frame = static_cast<int>(f);
      contacts[pair.A].push_back({ frame, paths[pair.B][f], pair.Distance });
      contacts[pair.B].push_back({ frame, paths[pair.A][f], pair.Distance });
    }
  }
  return contacts;
}

} // namespace waft
