// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/MeshCuts.h"

#include "Base/NearPairs.h"
#include "Constraints/RowsOfObjects.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace waft
{
namespace
{

bool StandsStill(const PosedMotion& motion, std::size_t track, std::size_t frame)
{
  if (!motion.Lies.empty() && motion.Lies[track][frame] != 0)
  {
    return true;
  }
  const std::vector<Vec3>& path = (*motion.Tracks)[track].Positions;
  const std::vector<Quat>& poses = (*motion.Poses)[track].Orientations;
  return frame > 0 && path[frame] == path[frame - 1] &&
         poses[frame].coeffs() == poses[frame - 1].coeffs();
}

} // namespace

std::vector<ContactMesh> ContactMeshesOf(const std::vector<Shape>& shapes)
{
  std::vector<ContactMesh> meshes;
  meshes.reserve(shapes.size());
  for (const Shape& shape : shapes)
  {
    meshes.emplace_back(shape.Mesh);
  }
  return meshes;
}

void TakeRests(const std::vector<Constraint>& rows, PosedMotion& motion)
{
  const int frames = static_cast<int>(motion.NumberOfFrames());
  motion.Lies.assign(motion.Tracks->size(), std::vector<char>(static_cast<std::size_t>(frames), 0));
  std::map<int, std::size_t> trackOf;
  for (std::size_t i = 0; i < motion.Tracks->size(); ++i)
  {
    trackOf[(*motion.Tracks)[i].ObjectId] = i;
  }
  for (const Constraint& row : rows)
  {
    const auto found = trackOf.find(row.ObjectId);
    if (found == trackOf.end() || !IsRest(row.Kind) || row.Status != ConstraintStatus::Met)
    {
      continue;
    }
    for (int f = std::max(FirstContact(row) + 1, 0); f <= std::min(LastFrame(row), frames - 1); ++f)
    {
      motion.Lies[found->second][static_cast<std::size_t>(f)] = 1;
    }
  }
}

KeptDistances KeptOf(const PosedMotion& motion, const std::vector<Constraint>& rows,
                     double framesPerSecond)
{
  const RowsOfObjects places(rows);
  KeptDistances kept(framesPerSecond);
  const int frames = static_cast<int>(motion.NumberOfFrames());
  for (std::size_t i = 0; i < motion.Tracks->size(); ++i)
  {
    const MotionObject& object = *motion.Objects[i];
    const std::vector<Vec3>& path = (*motion.Tracks)[i].Positions;
    std::vector<HeldMark> marks;
    for (int f = 0; f <= std::min(object.Released(), frames - 1); ++f)
    {
      marks.push_back({ f, path[static_cast<std::size_t>(f)], 0.0 });
    }
    for (const std::size_t place : places.Of(object.ObjectId))
    {
      const Constraint& row = rows[place];
      if (row.Status != ConstraintStatus::Met || !IsPositional(row.Kind))
      {
        continue;
      }
      const int last = std::min(LastFrame(row), frames - 1);
      for (int f = std::max(FirstContact(row), 0); f <= last; ++f)
      {
        const bool isExact = RadiusOf(row) <= 0.0;
        marks.push_back(
          { f, isExact ? path[static_cast<std::size_t>(f)] : row.Value, RadiusOf(row) });
      }
    }
    kept.AddBody(object.ClearanceRadius, object.SettlingSpeed, frames, std::move(marks));
  }
  return kept;
}

std::vector<MeshCut> FindMeshCuts(const PosedMotion& motion, const KeptDistances& kept,
                                  double depth, const ParallelFor& parallel)
{
  double reach = 0.0;
  for (std::size_t i = 0; i < motion.Tracks->size(); ++i)
  {
    reach = std::max(reach, 2.0 * motion.MeshOf(i).Radius());
  }
  std::vector<std::vector<MeshCut>> byFrame(motion.NumberOfFrames());
  parallel(byFrame.size(),
           [&](std::size_t begin, std::size_t end)
           {
             MeshPair pair;
             std::vector<Vec3> places;
             std::vector<std::size_t> present; // tracks
             for (std::size_t f = begin; f < end; ++f)
             {
               places.clear();
               present.clear();
               for (std::size_t i = 0; i < motion.Tracks->size(); ++i)
               {
                 if ((*motion.Tracks)[i].IsPresent(f))
                 {
                   places.push_back(motion.PlaceOf(i, f));
                   present.push_back(i);
                 }
               }
               const auto look = [&](std::size_t i, std::size_t j)
               {
                 const std::size_t a = present[i], b = present[j];
                 const ContactMesh& one = motion.MeshOf(a);
                 const ContactMesh& other = motion.MeshOf(b);
                 if ((places[i] - places[j]).norm() > one.Radius() + other.Radius() ||
                     (StandsStill(motion, a, f) && StandsStill(motion, b, f)))
                 {
                   return;
                 }
                 const double most = depth * std::min(one.Length(), other.Length());
                 pair.Place(motion.At(a, f), motion.At(b, f), most);
                 if (depth > 0.0 ? pair.IsDeeper(most) : pair.Cut())
                 {
                   const int frame = static_cast<int>(f);
                   byFrame[f].push_back({ frame, a, b, kept.At(frame, a, b) < kept.Needed(a, b) });
                 }
               };
               SweepPairs(places, reach, look);
               std::sort(byFrame[f].begin(), byFrame[f].end(),
                         [](const MeshCut& one, const MeshCut& other)
                         { return std::tie(one.A, one.B) < std::tie(other.A, other.B); });
             }
           });
  std::vector<MeshCut> cuts;
  for (const std::vector<MeshCut>& some : byFrame)
  {
    cuts.insert(cuts.end(), some.begin(), some.end());
  }
  return cuts;
}

} // namespace waft
