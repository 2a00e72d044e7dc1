// SPDX-License-Identifier: BSD-3-Clause
// An obstacle and a ground, made by hand.
#pragma once

#include "Base/Mesh.h"
#include "Base/SceneFrame.h"

#include <string>
#include <vector>

namespace waft
{

enum class ObstacleKind
{
  None = 0,
  Box = 1,
  Sphere = 2,
  Cylinder = 3
};

struct ObstacleSourceOptions : SceneFrame
{
  ObstacleKind Kind = ObstacleKind::Box;
  Vec3 Corner{ -0.5, -0.5, 0.0 };
  Vec3 Size{ 1.0, 1.0, 1.0 };
  Vec3 Center{ 0.0, 0.0, 1.0 };
  Vec3 Base{ 0.0, 0.0, 0.0 };
  Vec3 Top{ 0.0, 0.0, 2.0 };
  double Radius = 0.3;
  bool Ground = false;
  double GroundHeight = 0.0;

  /// The obstacle, then the ground; fails where there is neither, or where it has no volume.
  Result Make(std::vector<ObstacleMesh>& obstacles) const;
  /// A scene file of them alone, as AuthoredScene keeps what made obstacles.
  std::string Authored() const;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(
      OptionField{
        "Kind", { 0, 3 }, "", "What stands in the way: nothing, a box, a sphere or a cylinder." },
      of.Kind...);
    visit(OptionField{ "Corner", limits::Coordinate, "m", "Lowest corner of a box, in metres." },
          of.Corner...);
    visit(OptionField{ "Size", limits::Distance, "m", "Extents of a box, in metres." }, of.Size...);
    visit(OptionField{ "Center", limits::Coordinate, "m", "Middle of a sphere, in metres." },
          of.Center...);
    visit(
      OptionField{ "Base", limits::Coordinate, "m", "Middle of one end of a cylinder, in metres." },
      of.Base...);
    visit(OptionField{ "Top", limits::Coordinate, "m",
                       "Middle of the other end of a cylinder, in metres." },
          of.Top...);
    visit(OptionField{ "Radius", limits::Length, "m", "Of a sphere or a cylinder, in metres." },
          of.Radius...);
    visit(FlagField("Ground", "A ground to land on, all over the volume and beyond."),
          of.Ground...);
    visit(
      OptionField{ "GroundHeight", limits::Coordinate, "m", "Height of the ground, in metres." },
      of.GroundHeight...);
    SceneFrame::Visit(visit, of...);
  }
};

} // namespace waft
