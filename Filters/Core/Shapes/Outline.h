// SPDX-License-Identifier: BSD-3-Clause
// Plan views of leaves, feathers and petals as formulas: meshes and textures are made from the same
// outline. All lengths are in units of the body's length.
#pragma once

#include "Base/Result.h"

#include <functional>
#include <string>

namespace waft
{

/// A place of the plan in the outline's own coordinates.
struct OutlinePlace
{
  double Along = 0.0;  // 0 at the blade's base, 1 at its tip (strip); angle [rad] (star)
  double Across = 0.0; // -1 right edge, 0 middle, 1 left edge (strip); 0 centre, 1 edge (star)
};

/// A strip has a middle line along x and two half widths; a star has a centre and a radius for each
/// angle. Either may have a stem.
struct Outline
{
  enum class Kind
  {
    Strip,
    Star
  };
  Kind Type = Kind::Strip;
  double BladeStart = 0.0; // x of the blade's base; the stem runs from 0 to it
  double BladeEnd = 1.0;
  double StemWidth = 0.0;               // full width; 0: no stem
  std::function<double(double)> Left;   // half width at Along, strip
  std::function<double(double)> Right;  // the same on the other side
  std::function<double(double)> Middle; // y of the middle line at Along, strip
  std::function<double(double)> Radius; // at an angle from +x, star
  double CenterX = 0.5;                 // of a star

  /// A point of the plan: along as above, across from -1 to 1 (star: 0 to 1).
  void PointAt(const OutlinePlace& place, double& x, double& y) const;
  /// The place of a point; |Across| > 1 outside.
  OutlinePlace PlaceOf(double x, double y) const;
};

/// The outline of a built-in thin shape: leaf, maple, oak, willow, feather, down, petal, disc.
Result OutlineOf(const std::string& builtin, Outline& outline);

} // namespace waft
