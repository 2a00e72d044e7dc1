// SPDX-License-Identifier: BSD-3-Clause
// A flat cut-out on its way to become a curved body: built-in outlines and photographs share it.
#pragma once

#include "Base/OptionFields.h"
#include "Base/Result.h"
#include "Base/Shape.h"
#include "Shapes/Outline.h"

#include <array>
#include <vector>

namespace waft
{

/// How a flat sheet is bent.
struct Bending
{
  double Length = 0.1;
  double Curl = 0.3;
  double Camber = 0.05;
  double Twist = 0.0;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(OptionField{ "Length", limits::Length, "m", "Largest extent in metres." }, of.Length...);
    visit(OptionField{ "Curl", { 0, 2 }, "", "Rise of the edges over half the local width." },
          of.Curl...);
    visit(OptionField{ "Camber", { 0, 0.5 }, "", "Rise of both ends over the length." },
          of.Camber...);
    visit(OptionField{ "Twist", { -1, 1 }, "rad", "Turn of the tip against the base, in radians." },
          of.Twist...);
  }
};

/// A plan cut into triangles, in units of the outline: x along the length from about 0 to 1.
struct FlatSheet
{
  std::vector<std::array<double, 2>> Points;
  std::vector<double> Rise; // height per unit of curl
  std::vector<std::array<int, 3>> Triangles;
};

/// rows: along a strip (sectors of a star are twice as many); columns: across a strip, even (rings
/// of a star are half as many).
FlatSheet FlattenOutline(const Outline& outline, int rows, int columns);

/// The bent sheet as the mesh of `shape`, centred on its mass: x along the length, y across, z
/// along the normal, edges up. Its other members are left alone.
void BendSheet(const FlatSheet& sheet, const Bending& bending, Shape& shape);

} // namespace waft
