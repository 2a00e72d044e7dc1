// SPDX-License-Identifier: BSD-3-Clause
// Quarter turns about the vertical and mirror images of an air in a volume of square ground: each
// is an air, too.
#pragma once

#include "Base/HalfSeries.h"
#include "Base/Types.h"
#include "Grid/SmokeOptions.h"

namespace waft
{

/// p -> c + M (p - c) with c the middle of the volume.
struct AirSymmetry
{
  int QuarterTurns = 0;
  bool Mirrored = false; // x -> -x, before the turns

  Mat3 Matrix() const;
  std::string Text() const; // "turned by 90 degrees, mirrored", "as drawn"
};

/// All eight, the identity first; four where the ground is not square.
std::vector<AirSymmetry> AirSymmetries(const Box& volume);

/// The image of a field whose lattice the symmetry maps onto itself, to the bit; in the memory that
/// `image` has.
void SetImage(const AirSymmetry& symmetry, const HalfSeries& field, HalfSeries& image);
/// The image of vortices and winds in closed form.
SmokeForces Image(const AirSymmetry& symmetry, const Box& volume, const SmokeForces& forces);

} // namespace waft
