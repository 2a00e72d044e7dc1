// SPDX-License-Identifier: BSD-3-Clause
// Obstacles of plain form, once: the fields that a scene file has of each kind, the mesh that they
// make, and where the source of obstacles has them from.
#pragma once

#include "Base/Mesh.h"
#include "Scene/SceneFields.h"

#include <vector>

namespace waft
{

struct ObstacleSourceOptions;

/// What a solid is made of: the points that the fields of its kind name, in their order, and a
/// radius where it has one.
struct PlainSolid
{
  std::vector<Vec3> Points;
  double Radius = 0.0;
};

struct SolidKind
{
  const char* Word;               // in scene files
  std::vector<SceneField> Fields; // of points, then of the radius
  /// What its motion says the place of.
  Vec3 (*Reference)(const PlainSolid& solid);
  bool (*HasVolume)(const PlainSolid& solid);
  const char* Expected;         // of the last of its points, where it has no volume
  const char* ExpectedOfOption; // the same of the source, its property first
  TriangleMesh (*Mesh)(const PlainSolid& solid);
  PlainSolid (*Made)(const ObstacleSourceOptions& options);
};

/// In the order of ObstacleKind from Box on.
const std::vector<SolidKind>& SolidKinds();

/// The solid moved so that its reference point comes to a place.
PlainSolid MovedTo(const SolidKind& kind, const PlainSolid& solid, const Vec3& place);

} // namespace waft
