// SPDX-License-Identifier: BSD-3-Clause
// What is tried, from the least on, to part two bodies that are in each other.
#pragma once

#include "Rotation/MeshContact.h"

#include <vector>

namespace waft
{

/// Of two bodies, at the height of their meeting.
struct PartingChange
{
  Vec3 TurnA = Vec3::Zero(), TurnB = Vec3::Zero();   // rad, rotation vectors
  Vec3 ShiftA = Vec3::Zero(), ShiftB = Vec3::Zero(); // m
};

/// Turns by 4 to 40 degrees; of each angle first those that bring the normals along the line
/// between the bodies, then others about the axes of the scene; of both bodies, or of one.
std::vector<PartingChange> TurnLadder(const PosedMesh& a, const PosedMesh& b);

/// The same turns with shifts by 0.03 to 0.25 of the shorter body's length, along that line and
/// either normal; both bodies share it, or one goes all of the way.
std::vector<PartingChange> ShiftLadder(const PosedMesh& a, const PosedMesh& b,
                                       const PartingChange& turned);

/// The farthest that a shift of the ladder takes a body, in lengths of the shorter one.
double FarthestShift();

} // namespace waft
