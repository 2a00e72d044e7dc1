// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Base/Types.h"

#include <array>
#include <vector>

namespace waft
{

/// Triangles in a list of points. Counter-clockwise seen from outside.
struct TriangleMesh
{
  std::vector<Vec3> Points;                  // m
  std::vector<std::array<int, 3>> Triangles; // indices into Points

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Points...);
    visit(of.Triangles...);
  }
};

/// A closed obstacle that may move without turning.
struct ObstacleMesh
{
  int ObstacleId = 0;
  TriangleMesh Mesh;         // where it stands at frame 0
  std::vector<Vec3> Offsets; // displacement from frame 0, one a frame; empty: it stands still

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.ObstacleId...);
    visit(of.Mesh...);
    visit(of.Offsets...);
  }

  bool IsMoving() const { return !this->Offsets.empty(); }
  /// Displacement at a frame, linear between frames.
  Vec3 Offset(double frame) const
  {
    if (this->Offsets.empty())
    {
      return Vec3::Zero();
    }
    const double last = static_cast<double>(this->Offsets.size() - 1);
    const double f = std::clamp(frame, 0.0, last);
    const auto k = static_cast<std::size_t>(f);
    const std::size_t next = std::min(k + 1, this->Offsets.size() - 1);
    return this->Offsets[k] +
           (f - static_cast<double>(k)) * (this->Offsets[next] - this->Offsets[k]);
  }
};

/// A place at a frame that goes along with an obstacle.
struct CarriedPlace
{
  Vec3 Place = Vec3::Zero(); // m
  double Frame = 0.0;
  const ObstacleMesh* On = nullptr; // null: it stays where it is

  bool IsMoving() const { return this->On != nullptr && this->On->IsMoving(); }
  Vec3 At(double frame) const
  {
    return this->IsMoving()
             ? Vec3(this->Place + (this->On->Offset(frame) - this->On->Offset(this->Frame)))
             : this->Place;
  }
  /// [m/s], as by central differences.
  Vec3 Velocity(double frame, double framesPerSecond) const
  {
    return this->IsMoving() ? Vec3((this->On->Offset(frame + 0.5) - this->On->Offset(frame - 0.5)) *
                                   framesPerSecond)
                            : Vec3(Vec3::Zero());
  }
};

} // namespace waft
