// SPDX-License-Identifier: BSD-3-Clause
#include "Obstacles/DistanceLattice.h"

#include "Obstacles/NarrowBand.h"
#include "Obstacles/SurfaceRepair.h"
#include "Obstacles/TriangleTree.h"

#include <cmath>
#include <exception>
#include <string>

namespace waft
{

namespace
{

/// The cell of x and the weights in it; clamped[axis] tells where x is beyond the lattice.
struct Cell
{
  std::array<int, 3> Low{};
  Vec3 Weight = Vec3::Zero();
  std::array<bool, 3> Clamped{};
};

Cell CellOf(const DistanceLattice& lattice, const Vec3& x)
{
  Cell cell;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double last = lattice.Dimensions[axis] - 1;
    const double position = (x[axis] - lattice.Origin[axis]) / lattice.Spacing;
    const double inside = std::clamp(position, 0.0, last);
    cell.Clamped[axis] = inside != position || last == 0.0;
    cell.Low[axis] = std::max(0, std::min(static_cast<int>(inside), lattice.Dimensions[axis] - 2));
    cell.Weight[axis] = inside - cell.Low[axis];
  }
  return cell;
}

double Corner(const DistanceLattice& lattice, const Cell& cell, int di, int dj, int dk)
{
  const std::size_t nx = lattice.Dimensions[0];
  const std::size_t ny = lattice.Dimensions[1];
  const std::size_t i = std::min(cell.Low[0] + di, lattice.Dimensions[0] - 1);
  const std::size_t j = std::min(cell.Low[1] + dj, lattice.Dimensions[1] - 1);
  const std::size_t k = std::min(cell.Low[2] + dk, lattice.Dimensions[2] - 1);
  return lattice.Values[(k * ny + j) * nx + i];
}

double Mix(double a, double b, double weight)
{
  return a + weight * (b - a);
}

/// Signs of the lattice's points by the exact crossings of each column.
void MarkInside(const TriangleTree& tree, const Vec3& offset, const DistanceLattice& lattice,
                std::vector<char>& inside)
{
  const std::size_t nx = lattice.Dimensions[0];
  const std::size_t ny = lattice.Dimensions[1];
  for (std::size_t j = 0; j < ny; ++j)
  {
    for (std::size_t i = 0; i < nx; ++i)
    {
      const Vec3 foot = lattice.Origin + lattice.Spacing * Vec3(i, j, 0) - offset;
      const auto crossings = tree.Crossings(foot.x(), foot.y());
      std::size_t passed = 0;
      int depth = 0;
      for (int k = 0; k < lattice.Dimensions[2] && !crossings.empty(); ++k)
      {
        const double z = foot.z() + k * lattice.Spacing;
        for (; passed < crossings.size() && crossings[passed].Z <= z; ++passed)
        {
          depth += crossings[passed].Upwards ? -1 : 1;
        }
        inside[(k * ny + j) * nx + i] = depth > 0;
      }
    }
  }
}

/// OpenVDB widens its band from voxel to voxel with the neighbours' triangles only, so that far
/// values may come from the second nearest triangle; the tree, started from them, is exact.
void Sharpen(const TriangleTree& tree, const Vec3& offset, const DistanceLattice& lattice,
             std::vector<float>& distance)
{
  const auto band = static_cast<float>(lattice.Band);
  std::size_t p = 0;
  for (int k = 0; k < lattice.Dimensions[2]; ++k)
  {
    for (int j = 0; j < lattice.Dimensions[1]; ++j)
    {
      for (int i = 0; i < lattice.Dimensions[0]; ++i, ++p)
      {
        const double bound = 1.0001 * distance[p];
        const double reach = lattice.Band + lattice.Spacing;
        if (distance[p] < reach)
        {
          const Vec3 x = lattice.Origin + lattice.Spacing * Vec3(i, j, k) - offset;
          const auto closest = tree.ClosestPoint(x, bound * bound);
          if (closest.Triangle >= 0)
          {
            distance[p] = static_cast<float>(std::sqrt(closest.SquaredDistance));
          }
        }
        distance[p] = std::min(distance[p], band);
      }
    }
  }
}

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

} // namespace

double DistanceLattice::Sample(const Vec3& x) const
{
  Vec3 gradient;
  return this->Sample(x, gradient);
}

double DistanceLattice::Sample(const Vec3& x, Vec3& gradient) const
{
  const Cell cell = CellOf(*this, x);
  const Vec3& w = cell.Weight;
  double c[2][2][2];
  for (int n = 0; n < 8; ++n)
  {
    c[n & 1][n >> 1 & 1][n >> 2] = Corner(*this, cell, n & 1, n >> 1 & 1, n >> 2);
  }
  double alongX[2][2], slope[2][2];
  for (int j = 0; j < 2; ++j)
  {
    for (int k = 0; k < 2; ++k)
    {
      alongX[j][k] = Mix(c[0][j][k], c[1][j][k], w.x());
      slope[j][k] = c[1][j][k] - c[0][j][k];
    }
  }
  const double y0 = Mix(alongX[0][0], alongX[1][0], w.y());
  const double y1 = Mix(alongX[0][1], alongX[1][1], w.y());
  gradient.x() =
    Mix(Mix(slope[0][0], slope[1][0], w.y()), Mix(slope[0][1], slope[1][1], w.y()), w.z()) /
    this->Spacing;
  gradient.y() =
    Mix(alongX[1][0] - alongX[0][0], alongX[1][1] - alongX[0][1], w.z()) / this->Spacing;
  gradient.z() = (y1 - y0) / this->Spacing;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (cell.Clamped[axis])
    {
      gradient[axis] = 0.0;
    }
  }
  return Mix(y0, y1, w.z());
}

Result ComputeDistanceLattice(const std::vector<ObstacleMesh>& obstacles, double frame,
                              DistanceLattice& lattice)
{
  lattice.Values.clear();
  if (Result result = CheckLattice(lattice); !result)
  {
    return result;
  }
  try
  {
    const std::size_t count = static_cast<std::size_t>(lattice.Dimensions[0]) *
                              lattice.Dimensions[1] * lattice.Dimensions[2];
    std::vector<float> values(count, static_cast<float>(lattice.Band));
    std::vector<float> distance;
    std::vector<char> inside;
    for (const ObstacleMesh& obstacle : obstacles)
    {
      TriangleMesh mesh = obstacle.Mesh;
      const std::string name = "obstacle " + std::to_string(obstacle.ObstacleId);
      if (Result result = RepairSurface(name, mesh); !result)
      {
        return result;
      }
      const Vec3 offset = obstacle.Offset(frame);
      inside.assign(count, 0);
      const TriangleTree tree(mesh);
      MarkInside(tree, offset, lattice, inside);
      UnsignedNarrowBand(mesh, offset, lattice, distance);
      Sharpen(tree, offset, lattice, distance);
      for (std::size_t p = 0; p < count; ++p)
      {
        values[p] = std::min(values[p], inside[p] ? -distance[p] : distance[p]);
      }
    }
    lattice.Values = std::move(values);
    return Result::Ok();
  }
  catch (const std::exception& error)
  {
    return Result::Error(std::string("distance lattice: ") + error.what());
  }
}

} // namespace waft
