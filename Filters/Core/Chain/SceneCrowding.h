// SPDX-License-Identifier: BSD-3-Clause
// Where a scene leaves too little room: parts of JudgeScene.
#pragma once

#include "Chain/JudgeScene.h"
#include "Obstacles/ObstacleSet.h"

#include <string>
#include <vector>

namespace waft
{

/// As std::snprintf has it; up to a thousand letters.
std::string Format(const char* text, ...) __attribute__((format(printf, 1, 2)));

/// A finding about a row, whose text begins with kind and row.
Finding AboutRow(const char* kind, const Constraint& row, const std::string& text);

/// Whether a row was not judged to be impossible, by itself or beside another.
bool CanBe(const Constraint& row);

/// Gaps between obstacles that no body passes, marks near to obstacles and to one another, a volume
/// full of bodies. rows: judged, with their objects.
void FindCrowding(const Scene& scene, const ObstacleSet& obstacles,
                  const std::vector<Constraint>& rows, std::vector<Finding>& findings);

} // namespace waft
