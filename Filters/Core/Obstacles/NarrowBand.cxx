// SPDX-License-Identifier: BSD-3-Clause
#include "Obstacles/NarrowBand.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>

#include <tbb/task_arena.h>

namespace waft
{

void UnsignedNarrowBand(const TriangleMesh& mesh, const Vec3& offset,
                        const DistanceLattice& lattice, const LatticeWindow& window,
                        std::vector<float>& distance)
{
  // In index space the lattice's points are the integers.
  std::vector<openvdb::Vec3s> points;
  points.reserve(mesh.Points.size());
  for (const Vec3& p : mesh.Points)
  {
    const Vec3 index = (p + offset - lattice.Origin) / lattice.Spacing;
    points.emplace_back(openvdb::Vec3d(index.x(), index.y(), index.z()));
  }
  std::vector<openvdb::Vec3I> triangles;
  triangles.reserve(mesh.Triangles.size());
  for (const auto& t : mesh.Triangles)
  {
    triangles.emplace_back(t[0], t[1], t[2]);
  }
  const openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec3I> adapter(
    points, triangles);
  const auto transform = openvdb::math::Transform::createLinearTransform(lattice.Spacing);
  const auto width = static_cast<float>(lattice.Band / lattice.Spacing + 1.0);
  openvdb::FloatGrid::Ptr grid;
  tbb::task_arena alone(1); // threads are the caller's to give
  alone.execute(
    [&]
    {
      grid = openvdb::tools::meshToVolume<openvdb::FloatGrid>(
        adapter, *transform, width, width, openvdb::tools::UNSIGNED_DISTANCE_FIELD);
    });
  distance.clear();
  distance.reserve(window.NumberOfPoints());
  auto accessor = grid->getConstAccessor();
  const auto band = static_cast<float>(lattice.Band + lattice.Spacing);
  window.ForEachPoint(
    [&](int i, int j, int k)
    {
      const float value = accessor.getValue(openvdb::Coord(i, j, k));
      distance.push_back(std::min(std::abs(value), band));
    });
}

} // namespace waft
