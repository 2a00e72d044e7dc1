// SPDX-License-Identifier: BSD-3-Clause
// Winds of a closed box: no divergence, no mean flow, nothing through the walls.
#pragma once

#include "Spacetime/Model/SplineWind.h"

#include <Eigen/SparseCore>

namespace waft
{

/// The linear map from a vector potential to the coefficients of one knot of a SplineWind: its
/// discrete curl (central differences). Unknowns are (x, y, z) of the nodes within the walls, x
/// running fastest; beyond a wall the potential goes on as its mirror image, tangential components
/// with the other sign, so that the wind's normal component vanishes on the wall. Pressure balances
/// what is left out: a mean flow and flow through walls move nothing in a closed gas.
/// shape: a lattice whose outer nodes are half a spacing beyond the walls, four nodes or more along
/// each axis; its knots are not read. Rows: coefficients (x, y, z) a node, as CurlPotential has
/// them.
Eigen::SparseMatrix<double, Eigen::RowMajor> ClosedCurl(const SplineWind& shape);

} // namespace waft
