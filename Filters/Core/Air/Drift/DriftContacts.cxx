// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Drift/DriftContacts.h"

#include "Base/NearPairs.h"

#include <algorithm>
#include <tuple>

namespace waft
{
namespace
{
constexpr double OnePlace = 1e-9; // m: bodies nearer than this have no line between them
}

double PosedExtents::Needed(std::size_t a, std::size_t b, std::size_t frame, const Vec3& line) const
{
  double needed = 0.0;
  for (const std::size_t o : { a, b })
  {
    const std::vector<Quat>& poses = (*this->Poses)[o].Orientations;
    if (frame >= poses.size())
    {
      return 1e30;
    }
    needed += (poses[frame].conjugate() * line).cwiseProduct(this->HalfAxes[o]).norm();
  }
  return needed;
}

KeptDistances KeptBy(const std::vector<BodyProblem>& bodies, double framesPerSecond)
{
  KeptDistances kept(framesPerSecond);
  for (const BodyProblem& body : bodies)
  {
    kept.AddBody(body.Object().ClearanceRadius, body.Object().SettlingSpeed, body.NumberOfFrames(),
                 body.HeldMarks(), body.Object().FirstPresent());
  }
  return kept;
}

std::vector<DriftContact> FindContacts(const KeptDistances& kept,
                                       const std::vector<std::vector<Vec3>>& paths, double margin,
                                       const ParallelFor& parallel, const PosedExtents& extents)
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
             std::vector<Vec3> places;
             std::vector<std::size_t> present; // bodies
             for (std::size_t f = begin; f < end; ++f)
             {
               const auto frame = static_cast<int>(f);
               places.clear();
               present.clear();
               for (std::size_t o = 0; o < count; ++o)
               {
                 if (kept.IsPresent(frame, o))
                 {
                   places.push_back(paths[o][f]);
                   present.push_back(o);
                 }
               }
               const auto look = [&](std::size_t i, std::size_t j)
               {
                 const std::size_t a = present[i], b = present[j];
                 const double apart = (places[i] - places[j]).norm();
                 const double more = margin * kept.Needed(a, b);
                 if (apart < kept.Needed(a, b) + more)
                 {
                   double distance = kept.At(frame, a, b);
                   if (extents.Poses != nullptr && apart > OnePlace)
                   {
                     const Vec3 line = (places[i] - places[j]) / apart;
                     distance = std::min(distance, extents.Needed(a, b, f, line));
                   }
                   if (apart < distance + more)
                   {
                     byFrame[f].push_back({ frame, static_cast<std::uint32_t>(a),
                                            static_cast<std::uint32_t>(b), distance });
                   }
                 }
               };
               SweepPairs(places, reach, look);
               std::sort(byFrame[f].begin(), byFrame[f].end(),
                         [](const DriftContact& one, const DriftContact& other)
                         { return std::tie(one.A, one.B) < std::tie(other.A, other.B); });
               byFrame[f].shrink_to_fit();
             }
           });
  std::size_t all = 0;
  for (const std::vector<DriftContact>& some : byFrame)
  {
    all += some.size();
  }
  std::vector<DriftContact> contacts;
  contacts.reserve(all);
  for (std::vector<DriftContact>& some : byFrame)
  {
    contacts.insert(contacts.end(), some.begin(), some.end());
    some = {};
  }
  return contacts;
}

} // namespace waft
