// SPDX-License-Identifier: BSD-3-Clause
// A field in space and time as quadratic B-splines on a lattice, and its value at a place.
#pragma once

#include "Base/Types.h"
#include "Particles/SphKernels.h"

#include <array>
#include <cstddef>
#include <vector>

namespace waft
{

/// The nodes whose B-splines are not zero at a place: three along each axis.
struct SplineStencil
{
  std::array<int, 3> First; // node of the first along each axis
  float Weights[3][3];      // [axis][0, 1, 2]: of it and the next two; they sum to 1
};

/// A wind as quadratic B-splines on a lattice in space, linear in time.
struct SplineWind
{
  std::array<int, 3> Dimensions{ 0, 0, 0 };
  Vec3 Origin = Vec3::Zero();  // first node [dx]
  Vec3 Spacing = Vec3::Ones(); // [dx]
  double FramesPerKnot = 1.0;
  std::vector<std::vector<float>> Knots; // (x, y, z, 0) a node [dx / frame^2], or [dx / frame]
  double Drag = 0.0; // 0: an acceleration; otherwise draws velocities with this rate [1 / frame]

  bool IsEmpty() const { return this->Knots.empty(); }
  std::size_t NumberOfNodes() const { return this->Node(0, 0, this->Dimensions[2]); }
  /// Index of a node in a row of all, x running fastest.
  std::size_t Node(int i, int j, int k) const
  {
    return (static_cast<std::size_t>(k) * this->Dimensions[1] + j) * this->Dimensions[0] + i;
  }
  /// x: a place [dx], held half a spacing within the outer nodes; the lattice has three nodes or
  /// more along each axis.
  SplineStencil Stencil(const Vec3& x) const;
  /// Coefficients at a frame.
  void At(double frame, std::vector<float>& coefficients) const;
  SphSplineField Field(const std::vector<float>& coefficients) const;
};

/// Value of a field at a place [dx] and frame.
Vec3 SampleField(const SplineWind& field, const Vec3& x, double frame);

} // namespace waft
