// SPDX-License-Identifier: BSD-3-Clause
// The signed distance of obstacles as a smooth function of position and frame, in gas spacings.
#pragma once

#include "Base/Mesh.h"
#include "Base/Result.h"
#include "Base/Types.h"

#include <array>
#include <vector>

namespace waft
{

/// Quadratic B-splines over a lattice of distances: the gradient is continuous, which keeps forces
/// continuous where the trilinear interpolant has kinks. Distances are positive outside.
class ObstacleField
{
public:
  /// bounds and obstacles in metres; spacing: of the lattice [m]; unit: one gas spacing [m]; band:
  /// distances beyond it are not needed [m]; frames: those that will be asked for.
  Result Build(const std::vector<ObstacleMesh>& obstacles, const Box& bounds, double spacing,
               double unit, double band, int numberOfFrames);

  bool IsEmpty() const { return this->Lattices.empty(); }
  bool IsMoving() const { return this->Lattices.size() > 1; }
  /// Distance at p (gas spacings from bounds.Min), gradient and Hessian.
  double Evaluate(const Vec3& p, int frame, Vec3& gradient, Mat3& hessian) const;
  double Distance(const Vec3& p, int frame) const;

private:
  std::array<int, 3> Dimensions{ 0, 0, 0 };
  std::array<double, 3> Origin{ 0.0, 0.0, 0.0 }; // gas spacings
  double InverseSpacing = 1.0;                   // per gas spacing
  std::vector<std::vector<float>> Lattices;      // one, or one a frame when an obstacle moves
};

} // namespace waft
