// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Drift/DriftContacts.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace waft
{

KeptDistances KeptBy(const std::vector<BodyProblem>& bodies, double framesPerSecond)
{
  KeptDistances kept(framesPerSecond);
  for (const BodyProblem& body : bodies)
  {
    kept.AddBody(body.Object().ClearanceRadius, body.Object().SettlingSpeed, body.NumberOfFrames(),
                 body.HeldMarks());
  }
  return kept;
}

std::vector<DriftContact> FindContacts(const KeptDistances& kept,
                                       const std::vector<std::vector<Vec3>>& paths, double margin,
                                       const ParallelFor& parallel)
{
  const std::size_t count = paths.size();
  double widest = 0.0;
  for (std::size_t o = 0; o < count; ++o)
  {
    widest = std::max(widest, kept.Needed(o, o));
  }
  const double reach = (1.0 + margin) * widest;
  const std::size_t frames = paths.empty() ? 0 : paths.front().size();
  std::vector<std::vector<DriftContact>> byFrame(frames);
  parallel(frames,
           [&](std::size_t begin, std::size_t end)
           {
             std::vector<std::size_t> order(count);
             for (std::size_t f = begin; f < end; ++f)
             {
               // Swept along x.
               std::iota(order.begin(), order.end(), std::size_t(0));
               std::sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) {
                           return paths[a][f].x() != paths[b][f].x()
                                    ? paths[a][f].x() < paths[b][f].x()
                                    : a < b;
                         });
               for (std::size_t i = 0; i < count; ++i)
               {
                 for (std::size_t j = i + 1;
                      j < count && paths[order[j]][f].x() - paths[order[i]][f].x() <= reach; ++j)
                 {
                   const auto [a, b] = std::minmax(order[i], order[j]);
                   const double apart = (paths[a][f] - paths[b][f]).norm();
                   const double more = margin * kept.Needed(a, b);
                   if (apart < kept.Needed(a, b) + more)
                   {
                     const auto frame = static_cast<int>(f);
                     const double distance = kept.At(frame, a, b);
                     if (apart < distance + more)
                     {
                       byFrame[f].push_back({ frame, a, b, distance });
                     }
                   }
                 }
               }
               std::sort(byFrame[f].begin(), byFrame[f].end(),
                         [](const DriftContact& one, const DriftContact& other)
                         { return std::tie(one.A, one.B) < std::tie(other.A, other.B); });
             }
           });
  std::vector<DriftContact> contacts;
  for (const std::vector<DriftContact>& some : byFrame)
  {
    contacts.insert(contacts.end(), some.begin(), some.end());
  }
  return contacts;
}

} // namespace waft
