// SPDX-License-Identifier: BSD-3-Clause
// Which bodies of a finished motion cut each other, and when.
#pragma once

#include "Base/Motion.h"
#include "Base/Parallel.h"
#include "Base/Pose.h"
#include "Base/Shape.h"
#include "Constraints/Constraint.h"
#include "Constraints/KeptDistances.h"
#include "Rotation/MeshContact.h"

#include <vector>

namespace waft
{

/// Meshes of shapes, by ShapeId; they point to those.
std::vector<ContactMesh> ContactMeshesOf(const std::vector<Shape>& shapes);

/// How deep the mesh of a body may be in another's before it counts: in lengths of the shorter.
inline constexpr double TouchedDepth = 0.02;

/// A motion with its poses: the tracks' positions, poses of their order. All of one length.
struct PosedMotion
{
  const std::vector<Track>* Tracks = nullptr;
  const std::vector<PoseTrack>* Poses = nullptr;
  std::vector<const MotionObject*> Objects; // by track
  const std::vector<ContactMesh>* Meshes = nullptr;
  /// By track and frame: it lies, by a rest, once it has touched; empty: none does.
  std::vector<std::vector<char>> Lies;

  std::size_t NumberOfFrames() const
  {
    return this->Tracks->empty() ? 0 : this->Tracks->front().Positions.size();
  }
  const ContactMesh& MeshOf(std::size_t track) const
  {
    return (*this->Meshes)[static_cast<std::size_t>(this->Objects[track]->ShapeId)];
  }
  const Vec3& PlaceOf(std::size_t track, std::size_t frame) const
  {
    return (*this->Tracks)[track].Positions[frame];
  }
  const Quat& PoseOf(std::size_t track, std::size_t frame) const
  {
    return (*this->Poses)[track].Orientations[frame];
  }
  PosedMesh At(std::size_t track, std::size_t frame) const
  {
    return { &this->MeshOf(track), this->PlaceOf(track, frame), this->PoseOf(track, frame) };
  }
};

/// The first frame at which a row holds its body, or of a rest, at which it touches.
inline int FirstContact(const Constraint& row)
{
  return IsRest(row.Kind) && row.TouchDown >= 0 ? row.TouchDown : row.Frame;
}

/// Sets Lies by the rests that are met.
void TakeRests(const std::vector<Constraint>& rows, PosedMotion& motion);

/// What marks leave bodies between them: of starts, positions and rests that are met or not said to
/// be missed.
KeptDistances KeptOf(const PosedMotion& motion, const std::vector<Constraint>& rows,
                     double framesPerSecond);

/// Two bodies, track A before track B, of which one is deep in the other.
struct MeshCut
{
  int Frame = 0;
  std::size_t A = 0, B = 0;
  bool NearMarks = false; // marks of both leave less room than bodies so wide need
};

/// In the order of frames, of A and of B. depth: in lengths of the shorter body; 0: all that cut.
/// Bodies that both lie or stand still, as in a heap, are passed over.
std::vector<MeshCut> FindMeshCuts(const PosedMotion& motion, const KeptDistances& kept,
                                  double depth, const ParallelFor& parallel);

} // namespace waft
