// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace waft
{

/// The column of each row in the assignment of least total cost (shortest augmenting paths;
/// Jonker and Volgenant 1987). Every row has the same number of columns, at least as many as there
/// are rows.
std::vector<std::size_t> LeastCostAssignment(const std::vector<std::vector<double>>& costs);

} // namespace waft
