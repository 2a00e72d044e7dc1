// SPDX-License-Identifier: BSD-3-Clause
// Words that every library of Waft shares: vectors, the volume, the time line. Metres, seconds,
// kilograms, radians; z is up.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstdint>

namespace waft
{

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond; // body to world, unit; written (w, x, y, z) outside

/// Standard gravity [m/s^2]; used where a real mass falls, never for the reduced gravity of
/// objects.
constexpr double StandardGravity = 9.80665;

/// The volume: an axis-aligned box [m]. Sides and top are walls, the floor is the ground.
struct Box
{
  Vec3 Min{ -2.0, -2.0, 0.0 };
  Vec3 Max{ 2.0, 2.0, 4.0 };

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Min...);
    visit(of.Max...);
  }

  /// Of no point: what is added to it alone counts.
  static Box Nothing() { return { Vec3::Constant(1e30), Vec3::Constant(-1e30) }; }
  void Add(const Vec3& point)
  {
    this->Min = this->Min.cwiseMin(point);
    this->Max = this->Max.cwiseMax(point);
  }
  void Add(const Box& other)
  {
    this->Min = this->Min.cwiseMin(other.Min);
    this->Max = this->Max.cwiseMax(other.Max);
  }

  Vec3 Size() const { return this->Max - this->Min; }
  Vec3 Center() const { return 0.5 * (this->Min + this->Max); }
  /// L: the larger horizontal side [m].
  double Width() const { return std::max(this->Size().x(), this->Size().y()); }
  /// Distance from x to the nearest face [m]; negative outside.
  double InnerDistance(const Vec3& x) const
  {
    return std::min((x - this->Min).minCoeff(), (this->Max - x).minCoeff());
  }
  bool Contains(const Vec3& x) const { return this->InnerDistance(x) >= 0.0; }
  /// From x inside along a unit direction to the face there; axis, unless null: of that face.
  double WayOut(const Vec3& x, const Vec3& direction, int* axis = nullptr) const
  {
    double way = 1e300;
    for (int c = 0; c < 3; ++c)
    {
      const double d = direction[c];
      const double own = (d > 0.0 ? this->Max[c] - x[c] : x[c] - this->Min[c]) / std::abs(d);
      if (std::abs(d) > 1e-9 && own < way)
      {
        way = own;
        if (axis != nullptr)
        {
          *axis = c;
        }
      }
    }
    return way;
  }
};

/// Of points, or of boxes.
template <class List>
Box BoxAbout(const List& list)
{
  Box box = Box::Nothing();
  for (const auto& item : list)
  {
    box.Add(item);
  }
  return box;
}

/// Frames are numbered from 0; frame k is at time k / FramesPerSecond [s].
struct Timeline
{
  int NumberOfFrames = 300;
  double FramesPerSecond = 30.0;

  double Step() const { return 1.0 / this->FramesPerSecond; }
  double Time(double frame) const { return frame / this->FramesPerSecond; }
};

/// Sizes of the volume by which its open sides are farther away.
inline constexpr double FarOutside = 1000.0;

/// What every data set of a scene carries as field data.
struct SceneInfo
{
  Box Bounds;
  /// Whether bodies and air pass both ends of x, both of y, and the top; the floor is closed.
  std::array<int, 3> Open{ 0, 0, 0 };
  Vec3 Breeze = Vec3::Zero(); // m/s, the mean flow, along axes that are open at both ends
  Timeline Time;
  int Loops = 0;           // 1: the step from the last frame to the first is a step like any
  double AirDensity = 1.2; // kg/m^3
  std::uint64_t Seed = 1;

  bool IsOpen() const { return this->Open[0] + this->Open[1] + this->Open[2] > 0; }
  /// The Bounds without the sides that are open.
  Box Beyond() const
  {
    Box box = this->Bounds;
    for (int axis = 0; axis < 3; ++axis)
    {
      if (this->Open[static_cast<std::size_t>(axis)] != 0)
      {
        const double far = FarOutside * this->Bounds.Size().maxCoeff();
        box.Min[axis] -= axis < 2 ? far : 0.0;
        box.Max[axis] += far;
      }
    }
    return box;
  }

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Bounds...);
    visit(of.Open[0]...);
    visit(of.Open[1]...);
    visit(of.Open[2]...);
    visit(of.Breeze...);
    visit(of.Time.NumberOfFrames...);
    visit(of.Time.FramesPerSecond...);
    visit(of.Loops...);
    visit(of.AirDensity...);
    visit(of.Seed...);
  }
};

} // namespace waft
