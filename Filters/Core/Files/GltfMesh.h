// SPDX-License-Identifier: BSD-3-Clause
// The surface of a glTF 2.0 file.
#pragma once

#include "Base/Mesh.h"
#include "Base/Result.h"

#include <array>
#include <string>
#include <vector>

namespace waft
{

struct GltfSurface
{
  TriangleMesh Mesh;                                     // m, y up as in the file
  std::vector<std::array<double, 2>> TextureCoordinates; // one a point, or none
};

/// All triangles (glTF 2.0, sections 3.5 to 3.7) of the default scene, else the first, of a .glb,
/// or of a .gltf with its buffers inside or in files beside it, where their nodes stand, or their
/// joints; shape keys and animations are left out. KHR_mesh_quantization and
/// EXT_mesh_gpu_instancing are read. Points are rounded to floats. Fails, naming the JSON pointer,
/// on what is missing, of another type, cut off, beyond its buffer or not finite, on points beyond
/// limits::Coordinate, on nodes that are not trees, and on other extensions that a file requires.
Result ReadGltf(const std::string& path, GltfSurface& surface);

} // namespace waft
