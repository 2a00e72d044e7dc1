// SPDX-License-Identifier: BSD-3-Clause
// What became of the rows that are about poses.
#pragma once

#include "Rotation/Attitude.h"
#include "Rotation/RotationRefine.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace waft
{

/// Judges the orientation rows by themselves, measures them on the poses, and warns of those that
/// no earlier stage has reported.
void ReportOrientations(const RotationInput& input,
                        const std::map<std::pair<int, int>, std::string>& tooFast,
                        RotationOutput& output);

/// A line for each position that asks where its body faces, with the angle [rad] by which it is
/// missed and why; warns of those.
void ReportFacings(const RotationInput& input,
                   const std::map<std::pair<int, int>, std::string>& tooFast,
                   RotationOutput& output);

/// Says in a row of an object when its rests began.
void TakeRestTimes(const std::vector<RestTimes>& rests, Constraint& row);

/// A line for each rest of which that is known.
void ReportRests(RotationOutput& output);

} // namespace waft
