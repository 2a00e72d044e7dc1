// SPDX-License-Identifier: BSD-3-Clause
#include "Grid/NodeSolids.h"

#include "Obstacles/DistanceFrames.h"
#include "Obstacles/ObstacleSet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

namespace waft
{
namespace
{

/// Distances are exact this many voxels from a surface.
constexpr double BandInVoxels = 4.0;
constexpr std::size_t MostKeptNodes = 25 * 25 * 25; // of a frame: 250 kB

// The obstacles of a series of frames, and the frames of a small grid that were asked for already.
struct SolidFrames
{
  struct Frame
  {
    std::vector<float> Distances;
    std::vector<std::array<float, 3>> Velocities;
  };
  std::vector<ObstacleMesh> Obstacles;
  SmokeOptions Options;
  DistanceLattice Lattice; // without values
  bool IsLatticeTheGrid = true;
  DistanceFrames Distances;
  Result Built = Result::Ok();
  std::map<int, Frame> Kept;
  std::mutex Guard; // of Kept
};

// The lattice is the grid's nodes when voxels are cubes, else one of cubes over the same volume.
bool MakeLattice(const SmokeOptions& options, DistanceLattice& lattice)
{
  const Vec3 spacing = options.Spacing();
  const double least = spacing.minCoeff();
  const bool areCubes = spacing.maxCoeff() <= least * (1.0 + 1e-9);
  lattice.Origin = options.Bounds.Min;
  lattice.Spacing = least;
  lattice.Band = BandInVoxels * spacing.maxCoeff();
  for (int axis = 0; axis < 3; ++axis)
  {
    lattice.Dimensions[axis] =
      areCubes ? options.Resolution[axis] + 1
               : static_cast<int>(std::ceil(options.Bounds.Size()[axis] / least - 1e-9)) + 1;
  }
  return areCubes;
}

template <typename Body>
void ForNodes(const SmokeOptions& options, const Body& body)
{
  const Vec3 spacing = options.Spacing();
  for (int k = 0; k <= options.Resolution[2]; ++k)
  {
    for (int j = 0; j <= options.Resolution[1]; ++j)
    {
      for (int i = 0; i <= options.Resolution[0]; ++i)
      {
        body(Vec3(options.Bounds.Min + Vec3(i, j, k).cwiseProduct(spacing)));
      }
    }
  }
}

// The values at the grid's nodes of an array on the lattice: that of the nearest point.
std::vector<int> NearestAtNodes(const SolidFrames& solids, const std::vector<int>& values)
{
  const DistanceLattice& lattice = solids.Lattice;
  std::vector<int> atNodes;
  atNodes.reserve(solids.Options.NumberOfNodes());
  ForNodes(solids.Options,
           [&](const Vec3& x)
           {
             std::size_t n = 0;
             for (int axis = 2; axis >= 0; --axis)
             {
               const long index = std::lround((x[axis] - lattice.Origin[axis]) / lattice.Spacing);
               const long last = lattice.Dimensions[axis] - 1;
               n = n * lattice.Dimensions[axis] + std::clamp(index, 0L, last);
             }
             atNodes.push_back(values[n]);
           });
  return atNodes;
}

// Those of the nearest obstacles, where they are nearer than two voxels.
std::vector<std::array<float, 3>> NodeVelocities(const SolidFrames& solids, int frame,
                                                 const std::vector<float>& distances,
                                                 const std::vector<int>& nearest)
{
  const SmokeOptions& options = solids.Options;
  std::vector<std::array<float, 3>> velocityOf;
  for (const ObstacleMesh& obstacle : solids.Obstacles)
  {
    const Vec3 v =
      (obstacle.Offset(frame + 0.5) - obstacle.Offset(frame - 0.5)) * options.FramesPerSecond;
    velocityOf.push_back(
      { static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()) });
  }
  const double near = 2.0 * options.Spacing().maxCoeff();
  std::vector<std::array<float, 3>> velocities(distances.size(), { 0.0f, 0.0f, 0.0f });
  for (std::size_t node = 0; node < distances.size(); ++node)
  {
    if (distances[node] < near && nearest[node] >= 0)
    {
      velocities[node] = velocityOf[nearest[node]];
    }
  }
  return velocities;
}

Result ComputeFrame(const SolidFrames& solids, int frame, std::vector<float>& distances,
                    std::vector<std::array<float, 3>>& velocities)
{
  WAFT_RETURN_IF_FAILED(solids.Built);
  const bool moves = std::any_of(solids.Obstacles.begin(), solids.Obstacles.end(),
                                 [](const ObstacleMesh& o) { return o.IsMoving(); });
  std::vector<int> nearest;
  WAFT_RETURN_IF_FAILED(solids.Distances.At(frame, distances, moves ? &nearest : nullptr));
  if (!solids.IsLatticeTheGrid)
  {
    DistanceLattice lattice = solids.Lattice;
    lattice.Values = std::move(distances);
    distances.clear();
    distances.reserve(solids.Options.NumberOfNodes());
    ForNodes(solids.Options,
             [&](const Vec3& x) { distances.push_back(static_cast<float>(lattice.Sample(x))); });
    if (moves)
    {
      nearest = NearestAtNodes(solids, nearest);
    }
  }
  if (moves)
  {
    velocities = NodeVelocities(solids, frame, distances, nearest);
  }
  return Result::Ok();
}

Result BuildSolids(SolidFrames& solids)
{
  solids.IsLatticeTheGrid = MakeLattice(solids.Options, solids.Lattice);
  WAFT_RETURN_IF_FAILED(ObstacleSet().Build(solids.Obstacles));
  return solids.Distances.Build(solids.Obstacles, solids.Lattice);
}

} // namespace

SolidsAtFrame NodeSolids(std::vector<ObstacleMesh> obstacles, const SmokeOptions& options)
{
  auto solids = std::make_shared<SolidFrames>();
  solids->Obstacles = std::move(obstacles);
  solids->Options = options;
  solids->Built = solids->Obstacles.empty() ? Result::Ok() : BuildSolids(*solids);
  return [solids](int frame, std::vector<float>& distances,
                  std::vector<std::array<float, 3>>& velocities) -> Result
  {
    distances.clear();
    velocities.clear();
    if (solids->Obstacles.empty())
    {
      return Result::Ok();
    }
    {
      const std::lock_guard<std::mutex> lock(solids->Guard);
      const auto kept = solids->Kept.find(frame);
      if (kept != solids->Kept.end())
      {
        distances = kept->second.Distances;
        velocities = kept->second.Velocities;
        return Result::Ok();
      }
    }
    WAFT_RETURN_IF_FAILED(ComputeFrame(*solids, frame, distances, velocities));
    if (solids->Options.NumberOfNodes() <= MostKeptNodes)
    {
      const std::lock_guard<std::mutex> lock(solids->Guard);
      solids->Kept[frame] = { distances, velocities };
    }
    return Result::Ok();
  };
}

} // namespace waft
