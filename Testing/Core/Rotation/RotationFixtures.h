// SPDX-License-Identifier: BSD-3-Clause
// Bodies and paths whose answers are known.
#pragma once

#include "Base/Primitives.h"
#include "Base/ShapeMeasures.h"
#include "Constraints/Constraint.h"
#include "Rotation/RigidBody.h"
#include "Rotation/RotationRefine.h"

#include <cmath>

namespace waft::fixtures
{

/// A flat sheet in the x-y plane, cells x cells quads, centred.
inline Shape Sheet(double length, double width, int cells = 4)
{
  Shape shape;
  shape.Name = "sheet";
  shape.Thickness = 0.0;
  for (int j = 0; j <= cells; ++j)
  {
    for (int i = 0; i <= cells; ++i)
    {
      shape.Mesh.Points.emplace_back(length * (static_cast<double>(i) / cells - 0.5),
                                     width * (static_cast<double>(j) / cells - 0.5), 0.0);
      if (i < cells && j < cells)
      {
        const int p = j * (cells + 1) + i;
        shape.Mesh.Triangles.push_back({ p, p + 1, p + cells + 2 });
        shape.Mesh.Triangles.push_back({ p, p + cells + 2, p + cells + 1 });
      }
    }
  }
  return shape;
}

/// A leaf bent about its length and across, edges towards +z, centred on its mass.
inline Shape CurledLeaf(double length = 0.1)
{
  Shape shape = Sheet(length, 0.6 * length, 8);
  shape.Name = "leaf";
  for (Vec3& p : shape.Mesh.Points)
  {
    p.y() *= 1.0 - 2.0 * std::pow(p.x() / length, 2);
    p.z() = 3.0 * p.x() * p.x() + 6.0 * p.y() * p.y();
  }
  const Vec3 center = ShellCentroid(shape.Mesh);
  for (Vec3& p : shape.Mesh.Points)
  {
    p -= center;
  }
  return shape;
}

/// A round closed body.
inline Shape Ball(double radius, int rows = 24)
{
  Shape shape;
  shape.Name = "ball";
  const double pi = std::acos(-1.0);
  const int columns = 2 * rows;
  for (int j = 0; j <= rows; ++j)
  {
    for (int i = 0; i < columns; ++i)
    {
      const double a = pi * j / rows;
      const double b = 2.0 * pi * i / columns;
      shape.Mesh.Points.push_back(
        radius * Vec3(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), -std::cos(a)));
    }
  }
  for (int j = 0; j < rows; ++j)
  {
    for (int i = 0; i < columns; ++i)
    {
      const int p = j * columns + i;
      const int q = j * columns + (i + 1) % columns;
      shape.Mesh.Triangles.push_back({ p, q, q + columns });
      shape.Mesh.Triangles.push_back({ p, q + columns, p + columns });
    }
  }
  return shape;
}

/// One object of one shape on a path.
inline RotationInput OneObject(const Shape& shape, const std::vector<Vec3>& path)
{
  RotationInput input;
  input.Scene.Time.NumberOfFrames = static_cast<int>(path.size());
  input.Shapes = { shape };
  MotionObject object;
  object.Mass = std::max(ShellMass(shape), 1e-6);
  object.RestHeight = RestHeight(shape);
  object.ClearanceRadius = ClearanceRadius(shape);
  object.Position = path[0];
  input.Objects = { object };
  Track track;
  track.Positions = path;
  input.Tracks = { track };
  return input;
}

inline std::vector<Vec3> StraightPath(const Vec3& from, const Vec3& velocity, int frames,
                                      double step = 1.0 / 30.0)
{
  std::vector<Vec3> path;
  for (int k = 0; k < frames; ++k)
  {
    path.push_back(from + k * step * velocity);
  }
  return path;
}

/// A fall that swings and slows down to lie still at `landing` from frame `rest` on.
inline std::vector<Vec3> LandingPath(const Vec3& landing, int rest, int frames, double phase = 0.0)
{
  std::vector<Vec3> path;
  for (int k = 0; k < frames; ++k)
  {
    const double left = std::max(0, rest - k) / 30.0;
    const double sway = 0.25 * left / (1.0 + left);
    // Height grows as left^2 near the ground and at 0.8 m/s far from it.
    path.push_back(landing + Vec3(sway * std::sin(3.0 * left + phase),
                                  sway * std::cos(2.0 * left + phase) * std::min(1.0, left),
                                  0.8 * left * left / (0.7 + left)));
  }
  return path;
}

/// A fall that sways, 0.8 m/s.
inline std::vector<Vec3> SwayingPath(int frames, double phase = 0.0)
{
  std::vector<Vec3> path;
  for (int k = 0; k < frames; ++k)
  {
    const double t = k / 30.0;
    path.emplace_back(0.4 * std::sin(1.7 * t + phase), 0.3 * std::cos(1.1 * t), 9.0 - 0.8 * t);
  }
  return path;
}

/// Object 0 has this pose at a frame, or one within `radius` [rad].
inline Constraint OrientationRow(int frame, const Quat& pose, double radius = 0.0)
{
  Constraint row;
  row.ObjectId = 0;
  row.Kind = ConstraintKind::Orientation;
  row.Frame = frame;
  row.Row = frame;
  row.Orientation = pose;
  row.Radius = radius;
  return row;
}

/// Object 0 lies still from a frame to another.
inline Constraint RestRow(int frame, int until, const Vec3& place)
{
  Constraint row;
  row.ObjectId = 0;
  row.Kind = ConstraintKind::Rest;
  row.Frame = frame;
  row.Until = until;
  row.Value = place;
  return row;
}

inline double Angle(const Quat& a, const Quat& b)
{
  return LogMap(a * b.conjugate()).norm();
}

} // namespace waft::fixtures
