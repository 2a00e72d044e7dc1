// SPDX-License-Identifier: BSD-3-Clause
#include "Obstacles/DistanceLattice.h"

#include <algorithm>

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

} // namespace waft
