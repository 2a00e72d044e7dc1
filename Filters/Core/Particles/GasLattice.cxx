// SPDX-License-Identifier: BSD-3-Clause
#include "Particles/GasLattice.h"

#include <cmath>

namespace waft
{

GasLattice GasLattice::Make(const Box& bounds, const std::array<int, 3>& dimensions)
{
  GasLattice lattice;
  lattice.Bounds = bounds;
  lattice.Dimensions = dimensions;
  const double cells = static_cast<double>(dimensions[0]) * dimensions[1] * dimensions[2];
  lattice.Spacing = std::cbrt(bounds.Size().prod() / cells);
  return lattice;
}

GasLattice GasLattice::Make(const Box& bounds, int count)
{
  const Vec3 size = bounds.Size();
  const double spacing = std::cbrt(size.prod() / std::max(1, count));
  std::array<int, 3> best{ 1, 1, 1 };
  double least = 1e300;
  for (int choice = 0; choice < 8; ++choice)
  {
    std::array<int, 3> n;
    for (int a = 0; a < 3; ++a)
    {
      n[a] = std::max(1, static_cast<int>(size[a] / spacing) + ((choice >> a) & 1));
    }
    const double miss = std::abs(static_cast<double>(n[0]) * n[1] * n[2] - count);
    if (miss < least)
    {
      least = miss;
      best = n;
    }
  }
  return Make(bounds, best);
}

Result GasLattice::CheckLayers() const
{
  const std::array<int, 3>& n = this->Dimensions;
  return *std::min_element(n.begin(), n.end()) >= 3
           ? Result::Ok()
           : Result::Error("Bounds: too flat for its gas, which is " + std::to_string(n[0]) +
                           " x " + std::to_string(n[1]) + " x " + std::to_string(n[2]) +
                           " particles, at least three layers each way expected");
}

std::vector<Vec3> GasLattice::Points() const
{
  const Vec3 size = this->SizeInSpacings();
  std::vector<Vec3> points;
  for (int k = 0; k < this->Dimensions[2]; ++k)
  {
    for (int j = 0; j < this->Dimensions[1]; ++j)
    {
      for (int i = 0; i < this->Dimensions[0]; ++i)
      {
        points.emplace_back(size.x() * (i + 0.5) / this->Dimensions[0],
                            size.y() * (j + 0.5) / this->Dimensions[1],
                            size.z() * (k + 0.5) / this->Dimensions[2]);
      }
    }
  }
  return points;
}

double GasLattice::ParticleMass(const SphFluid& fluid) const
{
  const Vec3 size = this->SizeInSpacings();
  const Vec3 cell(size.x() / this->Dimensions[0], size.y() / this->Dimensions[1],
                  size.z() / this->Dimensions[2]);
  const int reach = static_cast<int>(std::ceil(fluid.Support() / cell.minCoeff()));
  double sum = 0.0;
  for (int k = -reach; k <= reach; ++k)
  {
    for (int j = -reach; j <= reach; ++j)
    {
      for (int i = -reach; i <= reach; ++i)
      {
        sum += fluid.Kernel(Vec3(i, j, k).cwiseProduct(cell).norm());
      }
    }
  }
  return 1.0 / sum;
}

} // namespace waft
