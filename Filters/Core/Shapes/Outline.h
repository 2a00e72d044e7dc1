// SPDX-License-Identifier: BSD-3-Clause
// Plan views of leaves, feathers and petals as formulas: meshes and textures are made from the same
// outline. All lengths are in units of the body's length.
#pragma once

#include "Base/OptionFields.h"
#include "Base/Result.h"

#include <functional>
#include <string>
#include <vector>

namespace waft
{

/// A point of the plan in the outline's own coordinates.
struct OutlineCoordinates
{
  double Along = 0.0;  // 0 at the blade's base, 1 at its tip (strip); angle [rad] (star)
  double Across = 0.0; // -1 right edge, 0 middle, 1 left edge (strip); 0 centre, 1 edge (star)
};

/// A strip at an x.
struct OutlineStation
{
  double Along = 0.0;
  double Middle = 0.0;
  double Left = 0.0, Right = 0.0; // half widths
};

/// From -pi to pi, as std::remainder has it of angles up to three times that, and sooner.
double SmallestAngle(double angle);

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
  double Teeth = 0.0; // depth of teeth that the texture cuts, fraction of the half width
  double Fluff = 0.0; // fraction of a feather's vane whose barbs are loose

  /// A point of the plan: along as above, across from -1 to 1 (star: 0 to 1).
  void PointAt(const OutlineCoordinates& at, double& x, double& y) const;
  /// The coordinates of a point; |Across| > 1 outside.
  OutlineCoordinates CoordinatesOf(double x, double y) const;
  /// The same of a strip, for many points at one x.
  OutlineStation StationAt(double x) const;
  OutlineCoordinates CoordinatesOf(const OutlineStation& station, double y) const;
  /// The stem's middle line, from its end (0) to the blade (1).
  void StemAt(double s, double& x, double& y) const;
  /// x of the point where the stem ends in the blade.
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

/// What the plans of leaves and feathers share; 1 is what the kind has by nature.
struct PlanForm
{
  double Width = 1.0;
  double Bend = 1.0; // of the middle line or the shaft

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(
      OptionField{
        "Width", { 0.3, 3 }, "", "Width of the outline; 1 is what the kind has by nature." },
      of.Width...);
    visit(
      OptionField{
        "Bend", { -5, 5 }, "", "Bend of the middle line; 1 is what the kind has by nature." },
      of.Bend...);
  }
};

/// A leaf's plan; 1 is what the kind has by nature.
struct LeafForm : PlanForm
{
  LeafKind Kind = LeafKind::Ovate;
  double StemLength = 1.0;
  double Lobing = 1.0;

  Result Validate() const { return ValidateFields<LeafForm>(*this); }

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(OptionField{ "Kind", { 0, 5 }, "", "Whose outline: Ovate is toothed as a beech's." },
          of.Kind...);
    visit(OptionField{ "StemLength",
                       { 0, 3 },
                       "",
                       "Length of the stem; 1 is what the kind has by nature, 0 none." },
          of.StemLength...);
    visit(
      OptionField{
        "Lobing", { 0, 1.5 }, "", "Depth of lobes and teeth; 1 is what the kind has by nature." },
      of.Lobing...);
    PlanForm::Visit(visit, of...);
  }
};

enum class FeatherKind
{
  Flight = 0,  // a wing's: stiff, one vane narrower
  Contour = 1, // a body's: broad, even, downy at its base
  Down = 2     // wisps about a point
};

/// A feather's plan; 1 is what the kind has by nature. Down has neither shaft nor vanes.
struct FeatherForm : PlanForm
{
  FeatherKind Kind = FeatherKind::Flight;
  double ShaftLength = 1.0;
  double Asymmetry = 1.0;

  Result Validate() const { return ValidateFields<FeatherForm>(*this); }

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(
      OptionField{
        "Kind",
        { 0, 2 },
        "",
        "Flight is a wing's, Contour a body's with down at its base, Down wisps about a point." },
      of.Kind...);
    visit(OptionField{ "ShaftLength",
                       { 0, 3 },
                       "",
                       "Length of the bare shaft; 1 is what the kind has by nature, 0 none." },
          of.ShaftLength...);
    visit(OptionField{ "Asymmetry",
                       { -2, 2 },
                       "",
                       "How unlike the two vanes are; 1 is what the kind has by nature." },
          of.Asymmetry...);
    PlanForm::Visit(visit, of...);
  }
};

Result OutlineOfLeaf(const LeafForm& form, Outline& outline);
Result OutlineOfFeather(const FeatherForm& form, Outline& outline);

/// The outline of a built-in thin shape: leaf, maple, oak, willow, aspen, feather, down, petal,
/// disc.
Result OutlineOf(const std::string& builtin, Outline& outline);

} // namespace waft
