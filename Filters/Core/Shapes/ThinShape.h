// SPDX-License-Identifier: BSD-3-Clause
// Curved sheets from outlines, the built-in shapes, and a user's own meshes put on their body axes.
#pragma once

#include "Base/Result.h"
#include "Base/Shape.h"
#include "Shapes/FlatSheet.h"
#include "Shapes/Outline.h"

#include <string>
#include <vector>

namespace waft
{

/// How an outline is cut into triangles and bent.
struct SheetOptions : Bending
{
  int Rows = 28;   // along a strip; sectors of a star are twice as many
  int Columns = 8; // across a strip, even; rings of a star are half as many

  /// The fields, and an even number of columns: a source rounds a user's up.
  Result Validate() const;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    Bending::Visit(visit, of...);
    visit(OptionField{ "Rows", { 4, 200 }, "", "Rows of the mesh along its length." }, of.Rows...);
    visit(OptionField{ "Columns",
                       { 2, 64 },
                       "",
                       "Columns of the mesh across; an odd number counts as the next even one." },
          of.Columns...);
  }
};

/// What a thin body is made of.
struct ThinBody
{
  double AreaDensity = 0.1;
  double Thickness = 0.0004;
  double DragCoefficient = 1.2;
  double SettlingSpeed = 0.8;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(OptionField{ "AreaDensity", limits::AreaDensity, "kg/m^2",
                       "Mass of a square metre, in kilograms." },
          of.AreaDensity...);
    visit(OptionField{ "Thickness", limits::Length, "m", "Thickness in metres." }, of.Thickness...);
    visit(OptionField{ "DragCoefficient", limits::Coefficient, "", "Drag coefficient, broadside." },
          of.DragCoefficient...);
    visit(OptionField{ "SettlingSpeed", limits::Above(0, limits::Speed.High), "m/s",
                       "Terminal fall speed in still air, in metres per second." },
          of.SettlingSpeed...);
  }
};

/// What a feather starts with; the defaults are a leaf's.
SheetOptions FeatherSheet();
ThinBody FeatherBody();

/// One of the names that a scene may give to `builtin`, with its numbers.
struct BuiltinShape
{
  std::string Name;
  double Size;          // m, largest extent
  double SettlingSpeed; // m/s
  double AreaDensity;   // kg/m^2
  double Thickness;     // m
  double DragCoefficient;
  double Damping; // 1/s, viscous: 8 pi mu R^3 / I of the sphere, 32/3 mu R^3 / I of a disc
  std::array<double, 3> Color;
};

const std::vector<BuiltinShape>& BuiltinShapes();

/// The sheet of an outline with texture coordinates (the plan's bounding box with a margin of 2 %),
/// centred on its centre of mass: x along the length, y across, z along the normal, edges up.
/// Numbers of `shape` other than the mesh are left alone.
Result MakeSheet(const Outline& outline, const SheetOptions& options, Shape& shape);

/// A built-in shape with its numbers. size: largest extent [m], 0 the default one. The bubble is a
/// closed sphere, all others are sheets.
Result MakeBuiltinShape(const std::string& name, double size, Shape& shape);

/// Puts a mesh on its body axes: centre of mass of the shell at the origin, the axis of largest
/// spread along x, of least spread along z, edges up (the third moment along z is not negative),
/// the heavier end towards -x; then scales it to the size (largest extent [m], 0 leaves it). Fails
/// on a mesh without area or with numbers that are not finite.
Result AlignShape(double size, TriangleMesh& mesh);

/// The plan's bounding box, for textures: u = (x - x0) / (x1 - x0), v = (y - y0) / (y1 - y0), in
/// units of the outline.
struct PlanBox
{
  double X0, Y0, X1, Y1;
};
PlanBox TextureBox(const Outline& outline);

} // namespace waft
