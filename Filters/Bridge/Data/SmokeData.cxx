// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/SmokeData.h"

#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/SceneData.h"
#include "Obstacles/DistanceLattice.h"
#include "Obstacles/ObstacleSet.h"

#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace waft
{
namespace
{

/// Distances are exact this many voxels from a surface.
constexpr double BandInVoxels = 4.0;

template <typename ArrayType, typename Value>
void AddValues(vtkImageData* data, const char* name, const Value* values, int components)
{
  vtkNew<ArrayType> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(data->GetNumberOfPoints());
  std::copy(values, values + components * data->GetNumberOfPoints(), array->GetPointer(0));
  data->GetPointData()->AddArray(array);
}

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

Result NodeVelocities(const std::vector<ObstacleMesh>& obstacles, int frame,
                      const SmokeOptions& options, const std::vector<float>& distances,
                      std::vector<std::array<float, 3>>& velocities)
{
  std::map<int, std::array<float, 3>> velocityOf;
  for (const ObstacleMesh& obstacle : obstacles)
  {
    const Vec3 v =
      (obstacle.Offset(frame + 0.5) - obstacle.Offset(frame - 0.5)) * options.FramesPerSecond;
    velocityOf[obstacle.ObstacleId] = { static_cast<float>(v.x()), static_cast<float>(v.y()),
                                        static_cast<float>(v.z()) };
  }
  ObstacleSet set;
  if (Result built = set.Build(obstacles); !built)
  {
    return built;
  }
  const double near = 2.0 * options.Spacing().maxCoeff();
  velocities.assign(distances.size(), { 0.0f, 0.0f, 0.0f });
  std::size_t node = 0;
  ForNodes(options,
           [&](const Vec3& x)
           {
             if (distances[node] < near)
             {
               SurfaceHit hit;
               set.SignedDistance(x, frame, hit);
               velocities[node] = velocityOf[hit.ObstacleId];
             }
             ++node;
           });
  return Result::Ok();
}

} // namespace

void SmokeFrameToImage(const SmokeFrame& frame, const SceneInfo& info, vtkImageData* data)
{
  data->Initialize();
  data->SetDimensions(frame.Dimensions.data());
  data->SetOrigin(frame.Origin.data());
  data->SetSpacing(frame.Spacing.data());
  AddValues<vtkFloatArray>(data, names::Velocity, frame.Velocity.data()->data(), 3);
  AddValues<vtkFloatArray>(data, names::Density, frame.Density.data(), 1);
  AddValues<vtkFloatArray>(data, names::Pressure, frame.Pressure.data(), 1);
  AddValues<vtkFloatArray>(data, names::Vorticity, frame.Vorticity.data()->data(), 3);
  AddValues<vtkFloatArray>(data, names::VortexForce, frame.VortexForce.data()->data(), 3);
  AddValues<vtkFloatArray>(data, names::WindForce, frame.WindForce.data()->data(), 3);
  AddValues<vtkUnsignedCharArray>(data, names::Obstacle, frame.Obstacle.data(), 1);
  data->GetPointData()->SetActiveScalars(names::Density);
  data->GetPointData()->SetActiveVectors(names::Velocity);
  SceneInfoToFieldData(info, data);
}

Result NodeDistances(const std::vector<ObstacleMesh>& obstacles, int frame,
                     const SmokeOptions& options, std::vector<float>& distances,
                     std::vector<std::array<float, 3>>& velocities)
{
  distances.clear();
  velocities.clear();
  if (obstacles.empty())
  {
    return Result::Ok();
  }
  DistanceLattice lattice;
  const bool isGrid = MakeLattice(options, lattice);
  if (Result computed = ComputeDistanceLattice(obstacles, frame, lattice); !computed)
  {
    return computed;
  }
  if (isGrid)
  {
    distances = std::move(lattice.Values);
  }
  else
  {
    distances.reserve(options.NumberOfNodes());
    ForNodes(options,
             [&](const Vec3& x) { distances.push_back(static_cast<float>(lattice.Sample(x))); });
  }
  const bool moves = std::any_of(obstacles.begin(), obstacles.end(),
                                 [](const ObstacleMesh& o) { return o.IsMoving(); });
  return moves ? NodeVelocities(obstacles, frame, options, distances, velocities) : Result::Ok();
}

} // namespace waft
