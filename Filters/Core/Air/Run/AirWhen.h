// SPDX-License-Identifier: BSD-3-Clause
// When each object comes in a window of frames, by the air.
#pragma once

#include "Air/Run/AirState.h"

#include <vector>

namespace waft
{

/// Whether both are of one target.
inline bool IsOfTarget(const Constraint& row, const Constraint& other)
{
  return row.Row == other.Row && row.Target == other.Target;
}
/// But for those of a row's target.
std::vector<Constraint> OthersOf(const Constraint& row, const std::vector<Constraint>& rows);
/// All of a row's target are met at a frame.
void SetArrivals(const Constraint& row, int frame, const ObstacleSet& obstacles,
                 std::vector<Constraint>& rows);

/// Frames of a row's window that are tried for an object: `most` of them, spread evenly, less those
/// at which another of its rows asks where it is; of a row without an open window its own frame.
std::vector<int> FramesOf(const AirContext& run, const MotionObject& object, const Constraint& row,
                          const std::vector<Constraint>& others, int most);

/// Rows whose windows are open take the frame, each object's one after another in time, at which
/// its least control in an air is least; those that do not bind stay open. Rows, plans and bodies
/// of the run are then those; the drift that was found is the plan of who comes at another frame
/// than it was planned to. chosen: objects with such rows.
Result ChooseWhen(AirContext& run, const HalfSeries& series, AirBodies& bodies,
                  AssimilationOutput& output, int& chosen);

/// How the forms that drift do so in an air; one that is known already, of the same frames, stays.
/// Bodies are set up anew where there is a new one.
Result MoveFormations(AirContext& run, const HalfSeries& series, AirBodies& bodies,
                      AssimilationOutput& output);

} // namespace waft
