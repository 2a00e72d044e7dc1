// SPDX-License-Identifier: BSD-3-Clause
// Where the meshes of a glTF file stand. Private to this library.
#pragma once

#include "Base/Types.h"
#include "Files/GltfFile.h"

#include <map>
#include <string>
#include <vector>

namespace waft
{

struct GltfNode
{
  std::uint64_t Index = 0;
  Eigen::Matrix4d Transform; // to the scene's coordinates
};

/// The nodes of the default scene, else the first, in the order of the file. Throws on nodes that
/// are not trees.
std::vector<GltfNode> NodesOfScene(const GltfFile& file);

/// Where a node shows its mesh: once, or at the places that EXT_mesh_gpu_instancing names.
std::vector<Eigen::Matrix4d> InstancesOf(GltfFile& file, const GltfNode& node);

/// The joints of skins (glTF 2.0, section 3.7.3).
class GltfSkins
{
public:
  GltfSkins(GltfFile& file, const std::vector<GltfNode>& nodes);

  /// Of each joint of a skin: from where its points were bound to where they are in the scene.
  const std::vector<Eigen::Matrix4d>& Joints(std::uint64_t skin, const std::string& user);

private:
  GltfFile& File;
  std::map<std::uint64_t, Eigen::Matrix4d> Places; // of nodes of the scene
  std::map<std::uint64_t, std::vector<Eigen::Matrix4d>> Skins;
};

} // namespace waft
