// SPDX-License-Identifier: BSD-3-Clause
// Fields on a lattice in OpenVDB files, one file a frame: smoke and wind for and from other
// programs. The one place, besides the level sets of obstacles, that knows OpenVDB.
#pragma once

#include "Base/PointLattice.h"
#include "Base/Result.h"
#include "Base/Types.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace waft
{

struct VolumeField
{
  std::string Name;
  int Components = 1;        // 1 or 3
  std::vector<float> Values; // Components a point, i fastest
};

/// Fields at the points of a lattice.
struct Volume : PointLattice
{
  std::vector<VolumeField> Fields;
};

/// The voxels between two corners, both included.
struct VoxelBox
{
  std::array<int, 3> First{ 0, 0, 0 };
  std::array<int, 3> Last{ -1, -1, -1 };

  bool IsEmpty() const;
  std::array<int, 3> Dimensions() const;
  double NumberOfVoxels() const;
  /// Grows to hold the other one, too.
  void Add(const VoxelBox& other);
  VoxelBox Moved(const std::array<int, 3>& shift) const;
};

/// A grid of a file, without its values.
struct VolumeGrid
{
  std::string Name;
  std::string Type;            // as OpenVDB calls it: "float", "vec3s"
  int Components = 0;          // 1 or 3; 0: of a type that is not read
  bool IsUpright = false;      // its transform scales and shifts only
  Vec3 Zero = Vec3::Zero();    // position of the centre of voxel (0, 0, 0) [m]
  Vec3 Spacing = Vec3::Ones(); // m
  VoxelBox Active;             // of its active voxels
};

/// By how many voxels indices of the pattern are above those of the grid at the same place; none:
/// their voxels are not the same, or not along the axes of the world.
std::optional<std::array<int, 3>> ShiftOnto(const VolumeGrid& pattern, const VolumeGrid& grid);

struct VolumeContents
{
  std::vector<VolumeGrid> Grids; // in the order of their names
  /// What WriteVolume noted; defaults in files of other programs.
  bool HasScene = false;
  SceneInfo Scene;
};

/// Fails on a file that cannot be read.
Result ListVolume(const std::string& path, VolumeContents& contents);

/// Largest number of voxels that are read as a lattice.
constexpr double MostVoxels = 512.0 * 512.0 * 512.0;

/// The values of a grid in a box, of inactive voxels its background. Of a staggered vector grid the
/// means of opposite faces. Grids of float, double, int32, bool, vec3s and vec3d are read. Fails on
/// a box of more than MostVoxels.
Result ReadVolumeGrid(const std::string& path, const std::string& name, const VoxelBox& box,
                      VolumeField& field);

/// What the head of such a file says that wrote it, a text of OpenVDB.
constexpr std::string_view VolumeSign("creator\x06\0\0\0string\x04\0\0\0Waft", 25);

/// One grid a field: float, of which zeros are inactive, or vec3s, all of it active. The file
/// appears whole or not at all.
Result WriteVolume(const std::string& path, const Volume& volume, const SceneInfo& scene);

} // namespace waft
