// SPDX-License-Identifier: BSD-3-Clause
#include "Obstacles/DistanceFrames.h"

#include "Obstacles/NarrowBand.h"
#include "Obstacles/SurfaceRepair.h"
#include "Obstacles/TriangleTree.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>
#include <utility>

namespace waft
{

namespace
{

Result CheckLattice(const DistanceLattice& lattice)
{
  for (const int n : lattice.Dimensions)
  {
    if (n < 1)
    {
      return Result::Error("distance lattice: expected at least one point along each axis");
    }
  }
  if (!(lattice.Spacing > 0.0) || !(lattice.Band > 0.0) || !lattice.Origin.allFinite() ||
      !std::isfinite(lattice.Spacing) || !std::isfinite(lattice.Band))
  {
    return Result::Error("distance lattice: expected a finite origin, positive spacing and band");
  }
  return Result::Ok();
}

/// The points that a surface within bounds may be nearer to than Band, or around.
LatticeWindow WindowOf(const DistanceLattice& lattice, const Box& bounds)
{
  LatticeWindow window;
  const double reach = lattice.Band + lattice.Spacing;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double last = lattice.Dimensions[axis] - 1;
    const double low = (bounds.Min[axis] - reach - lattice.Origin[axis]) / lattice.Spacing;
    const double high = (bounds.Max[axis] + reach - lattice.Origin[axis]) / lattice.Spacing;
    window.Low[axis] = static_cast<int>(std::clamp(std::floor(low), 0.0, last + 1.0));
    window.End[axis] = static_cast<int>(std::clamp(std::ceil(high), -1.0, last)) + 1;
  }
  return window;
}

/// Where the tree's own lattice has the point: the surface stays where it is at frame 0.
Vec3 PointOf(const DistanceLattice& lattice, int i, int j, int k, const Vec3& offset)
{
  return lattice.Origin + lattice.Spacing * Vec3(i, j, k) - offset;
}

/// Signs of the window's points by the exact crossings of each column.
void MarkInside(const TriangleTree& tree, const Vec3& offset, const DistanceLattice& lattice,
                const LatticeWindow& window, std::vector<char>& inside)
{
  inside.assign(window.NumberOfPoints(), 0);
  const auto columns = static_cast<std::size_t>(window.Size(0)) * window.Size(1);
  std::size_t column = 0;
  for (int j = window.Low[1]; j < window.End[1]; ++j)
  {
    for (int i = window.Low[0]; i < window.End[0]; ++i, ++column)
    {
      const Vec3 foot = PointOf(lattice, i, j, 0, offset);
      const auto crossings = tree.Crossings(foot.x(), foot.y());
      std::size_t passed = 0;
      int depth = 0;
      for (int k = window.Low[2]; k < window.End[2] && !crossings.empty(); ++k)
      {
        const double z = foot.z() + k * lattice.Spacing;
        for (; passed < crossings.size() && crossings[passed].Z <= z; ++passed)
        {
          depth += crossings[passed].Upwards ? -1 : 1;
        }
        inside[(k - window.Low[2]) * columns + column] = depth > 0;
      }
    }
  }
}

/// OpenVDB widens its band from voxel to voxel with the neighbours' triangles only, so that far
/// values may come from the second nearest triangle; the tree, started from them, is exact.
void Sharpen(const TriangleTree& tree, const Vec3& offset, const DistanceLattice& lattice,
             const LatticeWindow& window, std::vector<float>& distance)
{
  const auto band = static_cast<float>(lattice.Band);
  const double reach = lattice.Band + lattice.Spacing;
  std::size_t p = 0;
  window.ForEachPoint(
    [&](int i, int j, int k)
    {
      if (distance[p] < reach)
      {
        const double bound = 1.0001 * distance[p];
        const auto closest = tree.ClosestPoint(PointOf(lattice, i, j, k, offset), bound * bound);
        if (closest.Triangle >= 0)
        {
          distance[p] = static_cast<float>(std::sqrt(closest.SquaredDistance));
        }
      }
      distance[p] = std::min(distance[p], band);
      ++p;
    });
}

} // namespace

struct DistanceFrames::Internals
{
  struct Obstacle
  {
    int Index = 0; // in Build's list
    ObstacleMesh Mesh;
    TriangleTree Tree;
  };

  DistanceLattice Lattice; // without values
  std::vector<Obstacle> Moving;
  std::vector<float> Still; // of the obstacles that stand, m
  std::vector<int> NearestStill;

  /// Lowers distances to those of one obstacle as it stands at a frame, where they are larger.
  void Lower(const Obstacle& obstacle, double frame, std::vector<float>& distances,
             std::vector<int>* nearest) const
  {
    const Vec3 offset = obstacle.Mesh.Offset(frame);
    const Box bounds{ obstacle.Tree.Bounds().Min + offset, obstacle.Tree.Bounds().Max + offset };
    const LatticeWindow window = WindowOf(this->Lattice, bounds);
    if (window.NumberOfPoints() == 0)
    {
      return;
    }
    std::vector<char> inside;
    std::vector<float> distance;
    MarkInside(obstacle.Tree, offset, this->Lattice, window, inside);
    UnsignedNarrowBand(obstacle.Mesh.Mesh, offset, this->Lattice, window, distance);
    Sharpen(obstacle.Tree, offset, this->Lattice, window, distance);
    std::size_t p = 0;
    window.ForEachPoint(
      [&](int i, int j, int k)
      {
        const std::size_t n = (static_cast<std::size_t>(k) * this->Lattice.Dimensions[1] + j) *
                                this->Lattice.Dimensions[0] +
                              i;
        const float value = inside[p] ? -distance[p] : distance[p];
        if (value < distances[n])
        {
          distances[n] = value;
          if (nearest)
          {
            (*nearest)[n] = obstacle.Index;
          }
        }
        ++p;
      });
  }
};

DistanceFrames::DistanceFrames() = default;
DistanceFrames::~DistanceFrames() = default;

Result DistanceFrames::Build(const std::vector<ObstacleMesh>& obstacles,
                             const DistanceLattice& lattice)
{
  this->Impl.reset();
  WAFT_RETURN_IF_FAILED(CheckLattice(lattice));
  try
  {
    auto built = std::make_unique<Internals>();
    built->Lattice.Dimensions = lattice.Dimensions;
    built->Lattice.Origin = lattice.Origin;
    built->Lattice.Spacing = lattice.Spacing;
    built->Lattice.Band = lattice.Band;
    const std::size_t count = static_cast<std::size_t>(lattice.Dimensions[0]) *
                              lattice.Dimensions[1] * lattice.Dimensions[2];
    built->Still.assign(count, static_cast<float>(lattice.Band));
    built->NearestStill.assign(count, -1);
    for (std::size_t n = 0; n < obstacles.size(); ++n)
    {
      ObstacleMesh mesh = obstacles[n];
      WAFT_RETURN_IF_FAILED(
        RepairSurface("obstacle " + std::to_string(mesh.ObstacleId), mesh.Mesh));
      TriangleTree tree(mesh.Mesh);
      Internals::Obstacle obstacle{ static_cast<int>(n), std::move(mesh), std::move(tree) };
      if (obstacle.Mesh.IsMoving())
      {
        built->Moving.push_back(std::move(obstacle));
      }
      else
      {
        built->Lower(obstacle, 0.0, built->Still, &built->NearestStill);
      }
    }
    this->Impl = std::move(built);
    return Result::Ok();
  }
  catch (const std::exception& error)
  {
    return Result::Error(std::string("distance lattice: ") + error.what());
  }
}

Result DistanceFrames::At(double frame, std::vector<float>& distances,
                          std::vector<int>* nearest) const
{
  if (!this->Impl)
  {
    return Result::Error("distance lattice: no obstacles were built");
  }
  try
  {
    distances = this->Impl->Still;
    if (nearest)
    {
      *nearest = this->Impl->NearestStill;
    }
    for (const Internals::Obstacle& obstacle : this->Impl->Moving)
    {
      this->Impl->Lower(obstacle, frame, distances, nearest);
    }
    return Result::Ok();
  }
  catch (const std::exception& error)
  {
    return Result::Error(std::string("distance lattice: ") + error.what());
  }
}

Result ComputeDistanceLattice(const std::vector<ObstacleMesh>& obstacles, double frame,
                              DistanceLattice& lattice)
{
  lattice.Values.clear();
  DistanceFrames frames;
  WAFT_RETURN_IF_FAILED(frames.Build(obstacles, lattice));
  return frames.At(frame, lattice.Values);
}

} // namespace waft
