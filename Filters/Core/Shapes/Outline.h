// SPDX-License-Identifier: BSD-3-Clause
// Plan views of leaves, feathers and petals as formulas: meshes and textures are made from the same
// outline. All lengths are in units of the body's length.
#pragma once

#include "Base/Result.h"

#include <functional>
#include <string>
#include <vector>

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
  /// How the plan is painted.
  enum class Skin
  {
    Leaf,
    Feather,
    Down,
    Petal
  };
  struct Rib
  {
    double Angle;     // rad from +x
    double Reach;     // of its tip from the centre
    double HalfAngle; // rad, of the lobe about it
  };
  Kind Type = Kind::Strip;
  Skin Paint = Skin::Leaf;
  double BladeStart = 0.0; // x of the blade's base; the stem runs from StemStart to it
  double BladeEnd = 1.0;
  double StemStart = 0.0;
  double StemWidth = 0.0;               // full width; 0: no stem
  double Width = 1.0;                   // stretches the plan across
  std::function<double(double)> Left;   // half width at Along, strip, before the stretch
  std::function<double(double)> Right;  // the same on the other side
  std::function<double(double)> Middle; // y of the middle line at Along, strip
  std::function<double(double)> Radius; // at an angle from +x, star
  double CenterX = 0.5;                 // of a star
  std::vector<Rib> Ribs;                // of a star's lobes
  double Teeth = 0.0; // depth of teeth that the texture cuts, share of the half width
  double Fluff = 0.0; // share of a feather's vane whose barbs are loose

  /// A point of the plan: along as above, across from -1 to 1 (star: 0 to 1).
  void PointAt(const OutlinePlace& place, double& x, double& y) const;
  /// The place of a point; |Across| > 1 outside.
  OutlinePlace PlaceOf(double x, double y) const;
  /// The stem's middle line, from its end (0) to the blade (1).
  void StemAt(double s, double& x, double& y) const;
  /// x of the place where the stem ends in the blade.
  double StemEnd() const { return this->Type == Kind::Star ? this->CenterX : this->BladeStart; }
};

enum class LeafKind
{
  Ovate = 0, // toothed, as a beech's or cherry's
  Maple = 1,
  Oak = 2,
  Willow = 3,
  Birch = 4,
  Aspen = 5 // nearly round
};

/// A leaf's plan; 1 is what the kind has by nature.
struct LeafForm
{
  LeafKind Kind = LeafKind::Ovate;
  double Width = 1.0;      // 0.3..3
  double StemLength = 1.0; // 0 (none)..3
  double Lobing = 1.0;     // depth of lobes and teeth, 0..1.5
  double Bend = 1.0;       // of the middle line, -5..5

  Result Validate() const;
};

enum class FeatherKind
{
  Flight = 0,  // a wing's: stiff, one vane narrower
  Contour = 1, // a body's: broad, even, downy at its base
  Down = 2     // wisps about a point
};

/// A feather's plan; 1 is what the kind has by nature. Down has neither shaft nor vanes.
struct FeatherForm
{
  FeatherKind Kind = FeatherKind::Flight;
  double Width = 1.0;       // 0.3..3
  double ShaftLength = 1.0; // of the bare shaft, 0 (none)..3
  double Asymmetry = 1.0;   // of the two vanes, -2..2
  double Bend = 1.0;        // of the shaft, -5..5

  Result Validate() const;
};

Result OutlineOfLeaf(const LeafForm& form, Outline& outline);
Result OutlineOfFeather(const FeatherForm& form, Outline& outline);

/// The outline of a built-in thin shape: leaf, maple, oak, willow, aspen, feather, down, petal,
/// disc.
Result OutlineOf(const std::string& builtin, Outline& outline);

} // namespace waft
