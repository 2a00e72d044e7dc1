// SPDX-License-Identifier: BSD-3-Clause
// Who goes where: rows that any object may fulfil are given to objects by least total squared
// distance.
#pragma once

#include "Base/Motion.h"

#include <vector>

namespace waft
{

/// Column of each row in the assignment of least total cost (shortest augmenting paths, Jonker and
/// Volgenant 1987), -1 where a row stays without one. costs: [rows * columns], infinite where a
/// pair is not allowed. As many rows as possible are assigned.
std::vector<int> AssignLeastCost(const std::vector<double>& costs, std::size_t rows,
                                 std::size_t columns);

/// Gives each row with ObjectId -1 to an object. Rows of equal (Row, Target) go to the same object;
/// those of one Group to distinct ones, and to none that the group names itself; a ClassId asks for
/// an object of that class. Groups are treated in the order of their frames; an object's cost is
/// the squared distance from its place before (its start, or its last position or rest row). Rows
/// left over keep -1.
void AssignRows(const std::vector<MotionObject>& objects, std::vector<Constraint>& rows);

} // namespace waft
