// SPDX-License-Identifier: BSD-3-Clause
// Lloyd's algorithm on columns of a matrix, from seeds spread by k-means++.
#pragma once

#include "Base/Random.h"

#include <Eigen/Core>

#include <vector>

namespace waft
{

/// Parts `members` (columns of `points`, at least two) in at most `count` clusters, each with at
/// least one member; members keep their order. Never fewer than two parts: points that all
/// coincide are parted by their order.
std::vector<std::vector<int>> KMeans(const Eigen::MatrixXd& points, const std::vector<int>& members,
                                     int count, int iterations, Random& random);

/// Mean of some columns, summed in their order.
Eigen::VectorXd MeanOf(const Eigen::MatrixXd& points, const std::vector<int>& members);

} // namespace waft
