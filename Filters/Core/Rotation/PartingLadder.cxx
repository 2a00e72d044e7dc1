// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/PartingLadder.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace waft
{
namespace
{

constexpr double AlongLine = 1e-6; // sine of an angle that asks for no axis
constexpr double SamePlace = 1e-9; // m: bodies nearer than this have no line between them
constexpr std::array<double, 6> Angles = { 4.0, 8.0, 13.0, 20.0, 30.0, 40.0 }; // degrees
constexpr std::array<double, 5> Lengths = { 0.03, 0.06, 0.1, 0.15, 0.25 };     // of a body

Vec3 LineOf(const PosedMesh& a, const PosedMesh& b)
{
  const Vec3 apart = b.Position - a.Position;
  const double distance = apart.norm();
  return distance > SamePlace ? Vec3(apart / distance) : Vec3(Vec3::UnitZ());
}

Vec3 NormalOf(const PosedMesh& body)
{
  return body.Orientation * Vec3::UnitZ();
}

/// The turn of a body, of at most an angle, that brings its normal along a line, either way.
Vec3 FlatAgainst(const Vec3& line, const PosedMesh& body, double angle)
{
  const Vec3 axis =
    NormalOf(body).dot(line) < 0.0 ? line.cross(NormalOf(body)) : NormalOf(body).cross(line);
  const double sine = std::min(axis.norm(), 1.0);
  return sine > AlongLine ? Vec3(axis.normalized() * std::min(angle, std::asin(sine)))
                          : Vec3(Vec3::Zero());
}

PartingChange Turn(const Vec3& a, const Vec3& b)
{
  PartingChange change;
  change.TurnA = a;
  change.TurnB = b;
  return change;
}

} // namespace

std::vector<PartingChange> TurnLadder(const PosedMesh& a, const PosedMesh& b)
{
  std::vector<PartingChange> ladder;
  const Vec3 none = Vec3::Zero();
  const auto add = [&](const Vec3& one, const Vec3& other)
  {
    ladder.push_back(Turn(one, other));
    ladder.push_back(Turn(one, none));
    ladder.push_back(Turn(none, other));
  };
  for (const double degrees : Angles)
  {
    const double angle = degrees / 180.0 * std::acos(-1.0);
    add(FlatAgainst(LineOf(a, b), a, angle), FlatAgainst(LineOf(a, b), b, angle));
    for (int axis = 0; axis < 3; ++axis)
    {
      const Vec3 about = angle * Vec3::Unit(axis);
      add(about, -about);
      add(-about, about);
    }
  }
  return ladder;
}

std::vector<PartingChange> ShiftLadder(const PosedMesh& a, const PosedMesh& b,
                                       const PartingChange& turned)
{
  std::vector<PartingChange> ladder;
  for (const double lengths : Lengths)
  {
    const double amount = lengths * std::min(a.Shape->Length(), b.Shape->Length());
    for (const Vec3& along : { LineOf(a, b), NormalOf(a), NormalOf(b) })
    {
      for (const double way : { amount, -amount })
      {
        for (const double share : { 0.5, 1.0, 0.0 })
        {
          PartingChange change = turned;
          change.ShiftA = -way * share * along;
          change.ShiftB = way * (1.0 - share) * along;
          ladder.push_back(change);
        }
      }
    }
  }
  return ladder;
}

double FarthestShift()
{
  return Lengths.back();
}

} // namespace waft
