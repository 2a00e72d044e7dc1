// SPDX-License-Identifier: BSD-3-Clause
// Surfaces from files.
#pragma once

#include "Base/Mesh.h"
#include "Base/Result.h"

#include <array>
#include <string>
#include <vector>

namespace waft
{

struct SurfaceFile
{
  TriangleMesh Mesh;                                     // z up
  std::vector<std::array<double, 2>> TextureCoordinates; // one a point, or none
};

/// The triangles of a .vtp, .obj, .ply, .stl, .glb or .gltf; glTF is y-up and is turned to z-up.
/// Fails, naming the line, element or array, on files that are cut or damaged, on indices of points
/// that are not there, and on coordinates that are not finite or beyond 1e6.
Result ReadSurfaceFile(const std::string& path, SurfaceFile& surface);

} // namespace waft
