// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/Solids.h"

#include "Base/Primitives.h"
#include "Scene/ObstacleOptions.h"

namespace waft
{

namespace
{

SceneField Point(const char* name, const char* sentence)
{
  return SceneField(name, SceneValue::Vector, limits::Coordinate, sentence).Required();
}

SceneField Radius()
{
  return SceneField("radius", SceneValue::Number, limits::Length, "m").Required();
}

Vec3 FirstPoint(const PlainSolid& solid)
{
  return solid.Points[0];
}

SolidKind BoxKind()
{
  return { "box",
           { Point("min", "lowest corner, m"), Point("max", "highest corner, m") },
           [](const PlainSolid& box) -> Vec3 { return 0.5 * (box.Points[0] + box.Points[1]); },
           [](const PlainSolid& box) { return (box.Points[1] - box.Points[0]).minCoeff() > 0.0; },
           "a corner above `min` along each axis",
           "Size: expected extents above 0",
           [](const PlainSolid& box) {
             return MakeBox({ box.Points[0], box.Points[1] });
           },
           [](const ObstacleSourceOptions& options) {
             return PlainSolid{ { options.Corner, options.Corner + options.Size } };
           } };
}

SolidKind SphereKind()
{
  return { "sphere",
           { Point("center", "m"), Radius() },
           &FirstPoint,
           [](const PlainSolid&) { return true; },
           "",
           "",
           [](const PlainSolid& sphere) { return MakeSphere(sphere.Points[0], sphere.Radius); },
           [](const ObstacleSourceOptions& options) {
             return PlainSolid{ { options.Center }, options.Radius };
           } };
}

SolidKind CylinderKind()
{
  return { "cylinder",
           { Point("base", "middle of the lower disc, m"),
             Point("top", "middle of the upper disc, m"), Radius() },
           &FirstPoint,
           [](const PlainSolid& bar) { return (bar.Points[1] - bar.Points[0]).norm() > 0.0; },
           "a point apart from `base`",
           "Top: expected another place than Base",
           [](const PlainSolid& bar)
           { return MakeCylinder(bar.Points[0], bar.Points[1], bar.Radius); },
           [](const ObstacleSourceOptions& options) {
             return PlainSolid{ { options.Base, options.Top }, options.Radius };
           } };
}

} // namespace

const std::vector<SolidKind>& SolidKinds()
{
  static const std::vector<SolidKind> kinds = { BoxKind(), SphereKind(), CylinderKind() };
  return kinds;
}

PlainSolid MovedTo(const SolidKind& kind, const PlainSolid& solid, const Vec3& place)
{
  const Vec3 reference = kind.Reference(solid);
  PlainSolid moved = solid;
  for (Vec3& point : moved.Points)
  {
    point = point == reference ? place : Vec3(point + (place - reference));
  }
  return moved;
}

} // namespace waft
