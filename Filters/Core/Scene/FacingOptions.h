// SPDX-License-Identifier: BSD-3-Clause
// Where bodies face that pass a mark, of rows made by hand.
#pragma once

#include "Base/OptionFields.h"
#include "Constraints/Constraint.h"

namespace waft
{

/// Half the opening of a cone [rad].
inline constexpr limits::Range FacingTolerances = { 0, 3.141592653589793 };

struct FacingOptions
{
  Vec3 Facing = Vec3::Zero(); // made unit; zero: none
  double FacingTolerance = Constraint().FacingTolerance;

  /// Asks it of a row of position; others keep what they have.
  void AskOf(Constraint& row) const
  {
    if (row.Kind == ConstraintKind::Position && !this->Facing.isZero())
    {
      row.Facing = this->Facing.normalized();
      row.FacingTolerance = this->FacingTolerance;
    }
  }

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(OptionField{ "Facing",
                       limits::Direction,
                       "",
                       "Where the upper side of a body looks at a mark: x, y, z of a "
                       "direction; 0, 0, 0: as it flies.",
                       { -1, 1 } },
          of.Facing...);
    visit(OptionField{ "FacingTolerance", FacingTolerances, "rad",
                       "Half the opening of that cone, in radians." },
          of.FacingTolerance...);
  }
};

} // namespace waft
