// SPDX-License-Identifier: BSD-3-Clause
// How a form that is held drifts as one: by a translation, a turn and a little strain.
#pragma once

#include "Air/Field/AirSampler.h"
#include "Base/Types.h"
#include "Constraints/Constraint.h"
#include "Obstacles/ObstacleSet.h"

#include <vector>

namespace waft
{

/// One in motion: from frame Begin on, place x of the form is at Center + Shift + A (x - Center).
struct Formation
{
  int IsGroup = 0, Number = 0; // of its rows (EntryOf)
  int Begin = 0, End = 0;      // frames
  Vec3 Center = Vec3::Zero();
  std::vector<Vec3> Shifts; // by frame from Begin on
  std::vector<Mat3> Turns;  // A likewise

  bool Has(const Constraint& row) const
  {
    return EntryOf(row) == std::pair<bool, int>(this->IsGroup != 0, this->Number);
  }
  Vec3 At(const Vec3& place, int frame) const
  {
    const auto k = static_cast<std::size_t>(frame - this->Begin);
    return this->Center + this->Shifts[k] + this->Turns[k] * (place - this->Center);
  }

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.IsGroup...);
    visit(of.Number...);
    visit(of.Begin...);
    visit(of.End...);
    visit(of.Center...);
    visit(of.Shifts...);
    visit(of.Turns...);
  }
};

/// The one that a row belongs to, or null.
const Formation* FindFormation(const std::vector<Formation>& all, const Constraint& row);

/// One body of a form.
struct FormationPlace
{
  Vec3 Place = Vec3::Zero();
  double SettlingSpeed = 0.0; // m/s
  double Room = 0.0;          // m, that its place keeps from walls and obstacles
};

/// Its motion in an air: at each step that of least squares of the velocities that the places lack
/// of what the air and settling would do, taken up over FormationTime from rest. It sinks by at
/// most 0.15 m/s anywhere, its strain is at most a tenth, and where it would come too near to a
/// wall or an obstacle it waits.
void MoveFormation(const std::vector<FormationPlace>& places, const AirSampler& air,
                   const ObstacleSet& obstacles, const SceneInfo& scene, Formation& formation);

} // namespace waft
