// SPDX-License-Identifier: BSD-3-Clause
// Bodies that fly straight on in one pose, as a finished motion.
#pragma once

#include "Base/ShapeMeasures.h"
#include "Rotation/MeshCuts.h"

#include <cmath>
#include <memory>

namespace waft::fixtures
{

inline Quat About(const Vec3& axis, double degrees)
{
  return Quat(Eigen::AngleAxisd(degrees * std::acos(-1.0) / 180.0, axis));
}

/// Bodies in straight flight, one shape.
struct Crowd
{
  std::shared_ptr<const std::vector<Shape>> Shapes; // of all copies
  std::shared_ptr<const std::vector<ContactMesh>> Meshes;
  std::vector<MotionObject> Objects;
  std::vector<Track> Tracks;
  std::vector<PoseTrack> Poses;

  explicit Crowd(const Shape& shape) :
    Shapes(std::make_shared<std::vector<Shape>>(1, shape)),
    Meshes(std::make_shared<std::vector<ContactMesh>>(ContactMeshesOf(*this->Shapes)))
  {
  }

  void Add(const Vec3& from, const Vec3& to, const Quat& pose, int frames)
  {
    MotionObject object;
    object.ObjectId = static_cast<int>(this->Objects.size());
    object.ClearanceRadius = ClearanceRadius(this->Shapes->front());
    this->Objects.push_back(object);
    Track track;
    track.ObjectId = object.ObjectId;
    for (int k = 0; k < frames; ++k)
    {
      track.Positions.push_back(from + (to - from) * k / (frames - 1));
    }
    this->Tracks.push_back(track);
    PoseTrack poses;
    poses.ObjectId = object.ObjectId;
    poses.Orientations.assign(static_cast<std::size_t>(frames), pose);
    this->Poses.push_back(poses);
  }

  PosedMotion Motion() const
  {
    PosedMotion motion;
    motion.Tracks = &this->Tracks;
    motion.Poses = &this->Poses;
    motion.Meshes = this->Meshes.get();
    for (const MotionObject& object : this->Objects)
    {
      motion.Objects.push_back(&object);
    }
    return motion;
  }
};

} // namespace waft::fixtures
