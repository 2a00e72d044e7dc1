// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/SceneComparison.h"

#include <algorithm>
#include <cmath>

namespace waft
{

namespace
{

// What is less than this apart stands still for who gathers moving obstacles.
constexpr double ObstacleTolerance = 1e-9; // m

bool IsNear(double a, double b)
{
  return std::abs(a - b) <= 1e-12 * std::max(1.0, std::abs(a));
}

bool IsNear(const Vec3& a, const Vec3& b)
{
  return (a - b).norm() <= 1e-12 * std::max(1.0, a.norm());
}

bool IsNear(const Quat& a, const Quat& b)
{
  return (a.coeffs() - b.coeffs()).norm() <= 1e-12;
}

bool IsNear(const std::array<double, 3>& a, const std::array<double, 3>& b)
{
  return IsNear(Vec3(a[0], a[1], a[2]), Vec3(b[0], b[1], b[2]));
}

template <typename List, typename Same>
bool AreSame(const List& a, const List& b, const Same& same)
{
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), same);
}

bool IsSameMesh(const TriangleMesh& a, const TriangleMesh& b, double tolerance)
{
  return a.Triangles == b.Triangles &&
         AreSame(a.Points, b.Points,
                 [&](const Vec3& x, const Vec3& y) { return (x - y).norm() <= tolerance; });
}

Vec3 OffsetAt(const ObstacleMesh& obstacle, std::size_t frame)
{
  const std::vector<Vec3>& offsets = obstacle.Offsets;
  return offsets.empty() ? Vec3(Vec3::Zero()) : offsets[std::min(frame, offsets.size() - 1)];
}

} // namespace

bool IsSameBody(const Shape& a, const Shape& b)
{
  return IsSameMesh(a.Mesh, b.Mesh, 1e-12) &&
         AreSame(a.TextureCoordinates, b.TextureCoordinates,
                 [](const auto& u, const auto& v)
                 { return float(u[0]) == float(v[0]) && float(u[1]) == float(v[1]); });
}

bool IsSameShape(const Shape& a, const Shape& b)
{
  return IsSameBody(a, b) && a.ClassId == b.ClassId && a.Texture == b.Texture && a.Skin == b.Skin &&
         IsNear(a.Color, b.Color) && IsNear(a.Tint, b.Tint) &&
         IsNear(a.DragCoefficient, b.DragCoefficient) && IsNear(a.AreaDensity, b.AreaDensity) &&
         IsNear(a.Thickness, b.Thickness) && IsNear(a.SettlingSpeed, b.SettlingSpeed) &&
         IsNear(a.Damping, b.Damping);
}

bool AreAlike(const Leaving& a, const Leaving& b)
{
  return a.From == b.From && IsNear(a.Away, b.Away) && a.Fade == b.Fade &&
         a.HasPlace == b.HasPlace && IsNear(a.Place, b.Place);
}

bool IsSameObject(const MotionObject& a, const MotionObject& b)
{
  return a.ObjectId == b.ObjectId && a.ShapeId == b.ShapeId && a.ClassId == b.ClassId &&
         (a.VelocityGiven != 0) == (b.VelocityGiven != 0) &&
         (a.OrientationGiven != 0) == (b.OrientationGiven != 0) && IsNear(a.Position, b.Position) &&
         IsNear(a.Velocity, b.Velocity) && IsNear(a.Orientation, b.Orientation) &&
         IsNear(a.AngularVelocity, b.AngularVelocity) && IsNear(a.Mass, b.Mass) &&
         IsNear(a.SettlingSpeed, b.SettlingSpeed) && IsNear(a.ClearanceRadius, b.ClearanceRadius) &&
         IsNear(a.RestHeight, b.RestHeight) && a.Released() == b.Released() &&
         a.FirstPresent() == b.FirstPresent() && AreAlike(a.Goes, b.Goes) && a.On == b.On;
}

bool IsSameRow(const Constraint& a, const Constraint& b, bool mindsObject)
{
  return a.Kind == b.Kind && a.Frame == b.Frame && a.FrameFrom == b.FrameFrom &&
         a.IsOpenWindow == b.IsOpenWindow && a.Target == b.Target && a.ClassId == b.ClassId &&
         (a.Group < 0) == (b.Group < 0) && (a.ObjectId == b.ObjectId || !mindsObject) &&
         a.Side == b.Side && IsNear(a.Facing, b.Facing) &&
         (a.Facing.isZero() || IsNear(a.FacingTolerance, b.FacingTolerance)) &&
         IsNear(a.Radius, b.Radius) && (a.Until == b.Until || !IsLasting(a)) && a.Hold == b.Hold &&
         a.Drifts == b.Drifts && IsNear(a.HoldRadius, b.HoldRadius) && AreAlike(a.Goes, b.Goes) &&
         a.On == b.On &&
         (IsAttitude(a.Kind) ? IsNear(a.Orientation, b.Orientation) : IsNear(a.Value, b.Value));
}

bool IsSameObstacle(const ObstacleMesh& a, const ObstacleMesh& b)
{
  bool isSame = IsSameMesh(a.Mesh, b.Mesh, ObstacleTolerance);
  const std::size_t frames = std::max(a.Offsets.size(), b.Offsets.size());
  for (std::size_t frame = 0; isSame && frame < frames; ++frame)
  {
    isSame = (OffsetAt(a, frame) - OffsetAt(b, frame)).norm() <= ObstacleTolerance;
  }
  return isSame;
}

bool AreSameWinds(const Scene& a, const Scene& b)
{
  const auto isSame = [](const AnalyticWind& u, const AnalyticWind& v)
  {
    return IsNear(u.Direction, v.Direction) && IsNear(u.Strength, v.Strength) &&
           IsNear(u.Center, v.Center) && IsNear(u.Radius, v.Radius) &&
           IsNear(u.CenterTime, v.CenterTime) && IsNear(u.Duration, v.Duration);
  };
  const auto isSameFront = [](const WindFront& u, const WindFront& v)
  {
    return IsNear(u.Direction, v.Direction) && IsNear(u.Speed, v.Speed) &&
           IsNear(u.Strength, v.Strength) && IsNear(u.Width, v.Width) &&
           IsNear(u.StartTime, v.StartTime) && IsNear(u.Origin, v.Origin);
  };
  return AreSame(a.Winds, b.Winds, isSame) && AreSame(a.Fronts, b.Fronts, isSameFront) &&
         AreSame(a.WindFiles, b.WindFiles,
                 [](const WindFile& u, const WindFile& v)
                 {
                   return u.Path == v.Path && u.Array == v.Array && u.IsYUp == v.IsYUp &&
                          u.FirstFrame == v.FirstFrame && IsNear(u.Scale, v.Scale);
                 });
}

} // namespace waft
