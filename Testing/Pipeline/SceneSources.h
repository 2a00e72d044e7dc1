// SPDX-License-Identifier: BSD-3-Clause
// Scene files of the project, and a mesh that scenes of tests may name.
#pragma once

#include <string>

inline std::string SceneFile(const std::string& name)
{
  return std::string(WAFT_SOURCE_DIR) + "/Data/Scenes/" + name;
}

/// An .obj file: a closed surface that is no box, sphere or cylinder, z up.
constexpr const char* Tetrahedron =
  "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
