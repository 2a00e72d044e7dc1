// SPDX-License-Identifier: BSD-3-Clause
// Turns poses by the least that keeps a mesh above the surfaces near its centre, smoothly in time;
// where turning is not enough, moves the centre a little.
#pragma once

#include "Base/Mesh.h"
#include "Obstacles/ObstacleSet.h"

#include <vector>

namespace waft
{

/// How a frame may be changed.
enum class PoseFreedom : unsigned char
{
  Free,    // towards lying flat along the nearest surface, on the nearer side
  Leaving, // the same, but with the body's z axis along that of Target
  Landing, // likewise
  Fixed    // not at all
};

struct ContactFrame
{
  PoseFreedom Freedom = PoseFreedom::Free;
  Quat Target = Quat::Identity();
};

/// Poses of one body, one a frame; all lists have one length.
struct ContactInput
{
  const TriangleMesh* Mesh = nullptr;
  double BoundingRadius = 0.0; // m, of the mesh about its origin
  const std::vector<Vec3>* Positions = nullptr;
  const std::vector<ContactFrame>* Frames = nullptr;
  const ObstacleSet* Obstacles = nullptr;
  int SmoothingFrames = 4; // half-width of the blend in time
  double MostShift = 0.0;  // m, by which a centre may be moved
};

/// Changes orientations where a vertex would be below a surface; `changed` marks these frames. Adds
/// to `shifts` [m, one a frame, those that Positions have in them already] what the centre must
/// move besides, at most MostShift; frames that are Fixed are left alone. Returns the
/// deepest that a vertex still lies below a surface [m], 0 when none does.
double KeepAboveSurfaces(const ContactInput& input, std::vector<Quat>& orientations,
                         std::vector<unsigned char>& changed, std::vector<Vec3>& shifts);

} // namespace waft
