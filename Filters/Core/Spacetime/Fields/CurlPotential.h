// SPDX-License-Identifier: BSD-3-Clause
// Divergence-free fields on a lattice: the discrete curl of a vector potential, plus a mean flow.
#pragma once

#include "Spacetime/Model/SplineWind.h"

#include <Eigen/Core>

#include <cstddef>

namespace waft
{

/// The linear map from unknowns to the coefficients of a SplineWind whose discrete divergence
/// (central differences) vanishes.
/// Unknowns are, knot by knot, the potential (x, y, z a node) on the lattice with one more layer
/// all around, then the mean flow (x, y, z). Coefficients are, knot by knot, (x, y, z) a node.
class CurlPotential
{
public:
  /// shape: the lattice; its knots are not read. knots: how many, one or more.
  CurlPotential(const SplineWind& shape, int knots);

  Eigen::Index NumberOfUnknowns() const;
  Eigen::Index NumberOfCoefficients() const;
  /// The coefficients c of unknowns; resizes c.
  void Curl(const Eigen::VectorXd& unknown, Eigen::VectorXd& c) const;
  /// The transpose of Curl; resizes unknown.
  void Adjoint(const Eigen::VectorXd& c, Eigen::VectorXd& unknown) const;
  /// How much of a gradient each unknown is to move: those of the mean flow weigh on all nodes,
  /// those of the potential on few.
  Eigen::VectorXd Scale() const;

private:
  std::size_t Outer(int i, int j, int k) const // node of the potential's lattice, from -1
  {
    return (static_cast<std::size_t>(k + 1) * (this->Shape.Dimensions[1] + 2) + j + 1) *
             (this->Shape.Dimensions[0] + 2) +
           i + 1;
  }
  std::size_t OuterNodes() const
  {
    return static_cast<std::size_t>(this->Shape.Dimensions[0] + 2) *
           (this->Shape.Dimensions[1] + 2) * (this->Shape.Dimensions[2] + 2);
  }
  std::size_t UnknownsPerKnot() const { return 3 * this->OuterNodes() + 3; }

  SplineWind Shape; // geometry only
  int Knots = 1;
};

} // namespace waft
