// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Paper/ClosedCurl.h"

#include <vector>

namespace waft
{
namespace
{

struct MirroredNode
{
  Eigen::Index Unknown = 0; // of the component x
  double Sign = 1.0;
};

/// node: from -1 to one beyond the lattice's last.
MirroredNode Mirror(const SplineWind& shape, const std::array<int, 3>& node, int component)
{
  MirroredNode mirrored;
  std::array<int, 3> within = node;
  for (int a = 0; a < 3; ++a)
  {
    const int last = shape.Dimensions[a] - 2; // within the walls, from 1
    if (within[a] < 1 || within[a] > last)
    {
      within[a] = within[a] < 1 ? 1 - within[a] : 2 * last + 1 - within[a];
      mirrored.Sign *= a == component ? 1.0 : -1.0;
    }
  }
  const Eigen::Index nx = shape.Dimensions[0] - 2;
  const Eigen::Index ny = shape.Dimensions[1] - 2;
  mirrored.Unknown = 3 * (((within[2] - 1) * ny + within[1] - 1) * nx + within[0] - 1);
  return mirrored;
}

} // namespace

Eigen::SparseMatrix<double, Eigen::RowMajor> ClosedCurl(const SplineWind& shape)
{
  const auto& n = shape.Dimensions;
  std::vector<Eigen::Triplet<double>> entries;
  const auto slope =
    [&](Eigen::Index row, int component, int axis, std::array<int, 3> node, double factor)
  {
    for (const int side : { 1, -1 })
    {
      std::array<int, 3> other = node;
      other[axis] += side;
      const MirroredNode at = Mirror(shape, other, component);
      entries.emplace_back(row, at.Unknown + component,
                           factor * side * at.Sign * 0.5 / shape.Spacing[axis]);
    }
  };
  for (int k = 0; k < n[2]; ++k)
  {
    for (int j = 0; j < n[1]; ++j)
    {
      for (int i = 0; i < n[0]; ++i)
      {
        const auto row = static_cast<Eigen::Index>(3 * shape.Node(i, j, k));
        for (int c = 0; c < 3; ++c)
        {
          const int next = (c + 1) % 3;
          const int after = (c + 2) % 3;
          slope(row + c, after, next, { i, j, k }, 1.0);
          slope(row + c, next, after, { i, j, k }, -1.0);
        }
      }
    }
  }
  const Eigen::Index unknowns = 3 * static_cast<Eigen::Index>(n[0] - 2) * (n[1] - 2) * (n[2] - 2);
  Eigen::SparseMatrix<double, Eigen::RowMajor> curl(
    static_cast<Eigen::Index>(3 * shape.NumberOfNodes()), unknowns);
  curl.setFromTriplets(entries.begin(), entries.end());
  return curl;
}

} // namespace waft
