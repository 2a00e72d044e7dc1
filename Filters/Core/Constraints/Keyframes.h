// SPDX-License-Identifier: BSD-3-Clause
// Who goes where in keyframes: groups of targets that any object may take.
#pragma once

#include "Base/Motion.h"
#include "Constraints/Constraint.h"

#include <cstddef>
#include <map>
#include <vector>

namespace waft
{

/// An object's.
inline void GiveTo(const MotionObject& object, Constraint& row)
{
  row.ObjectId = object.ObjectId;
  row.Release = object.Release;
}

/// Gives each row with ObjectId -1 that is in a group, or is about no position, to an object. Rows
/// of equal (Row, Target) go to the same object; those of one Group to distinct ones, and to none
/// that the group names itself; a ClassId asks for an object of that class. Groups are treated in
/// the order of their frames, each by least total squared distance [m^2] from the objects'
/// positions before (their starts, or their last position or rest rows); an object that has another
/// position at the time is taken last. Rows left over keep -1. choices: by Group, the only ids that
/// its rows may go to; groups that are not there choose among all.
void AssignKeyframes(const std::vector<MotionObject>& objects, std::vector<Constraint>& rows,
                     const std::map<int, std::vector<int>>& choices = {});

/// Targets that were given out by choice, and who else may take them.
struct ChosenTargets
{
  struct Target
  {
    std::vector<std::size_t> Rows; // all of one (Row, Target)
    int Frame = 0, Until = 0;      // the earliest and the last of its rows
    Vec3 Position = Vec3::Zero();
    int ClassId = -1;
    std::size_t Object = 0; // index of the one that has it
  };
  std::vector<Target> Targets;
  std::vector<std::size_t> Candidates; // indices of objects, those that have them first

  /// The earliest frame of any of its targets.
  int FirstFrame() const;
};

/// Targets of one group, or of none and of the same frames, that objects may exchange: positions of
/// rows with a Choice, all of which count. Where all were chosen among all objects those take part,
/// too, of which no row asks for a position. In the order of their frames. counts: by row.
std::vector<ChosenTargets> CollectChosen(const std::vector<MotionObject>& objects,
                                         const std::vector<Constraint>& rows,
                                         const std::vector<char>& counts);

} // namespace waft
