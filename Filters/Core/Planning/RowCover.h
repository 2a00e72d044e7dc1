// SPDX-License-Identifier: BSD-3-Clause
// Who goes where of single rows that any object may fulfil: all of them together, along time.
#pragma once

#include "Base/Motion.h"
#include "Constraints/Constraint.h"
#include "Obstacles/ObstacleSet.h"
#include "Planning/Legs.h"

#include <vector>

namespace waft
{

/// Gives the rows with ObjectId -1 that are in no group to objects, those of equal (Row, Target) to
/// the same one: a cover of the rows by the objects' ways from their starts in the order of time,
/// through rows that have an object and those that any may fulfil. As many as possible are covered
/// by legs that can be flown at the database's top speed (SpeedLimit::Haste), as few of these as
/// possible in haste, and the sum of their squared lengths [m^2] is the least. isFree: one a row,
/// 0 where the row takes no part since it cannot be met. What is left over goes to an object that
/// has nothing else to do, the one that can come nearest; else it keeps -1.
void CoverRows(const std::vector<MotionObject>& objects, const std::vector<unsigned char>& isFree,
               const ObstacleSet& obstacles, const SpeedLimit& limit,
               std::vector<Constraint>& rows);

} // namespace waft
