// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/PartingFreedom.h"

#include "Base/SmoothStep.h"
#include "Rotation/MeshCuts.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

constexpr double GivenEase = 0.4;     // s from a frame that is given until a body is free
constexpr int DerivativeReach = 3;    // frames about a row of a derivative of the path
constexpr double SurfaceDepth = 1e-6; // m, of a vertex: rounding

/// Frames at which a row leaves the place or the pose alone.
struct Given
{
  int First = 0, Last = -1;
  bool Place = false, Pose = false;
};

Given GivenBy(const Constraint& row)
{
  const bool rests = IsRest(row.Kind);
  const bool moves = !IsAttitude(row.Kind) && !IsPositional(row.Kind);
  Given given{ FirstContact(row), LastFrame(row) };
  given.First -= moves ? DerivativeReach : 0;
  given.Last += moves ? DerivativeReach : 0;
  given.Place = rests || moves || (IsPositional(row.Kind) && !(row.Radius > 0.0));
  given.Pose = rests || IsAttitude(row.Kind) || !row.Facing.isZero();
  return given;
}

/// Eases off towards the frames that are given.
void EaseOff(const std::vector<char>& given, double ease, std::vector<double>& freedom)
{
  const int frames = static_cast<int>(given.size());
  const int reach = static_cast<int>(std::ceil(ease));
  freedom.assign(given.size(), 1.0);
  for (int f = 0; f < frames; ++f)
  {
    if (!given[static_cast<std::size_t>(f)])
    {
      continue;
    }
    for (int k = std::max(f - reach, 0); k <= std::min(f + reach, frames - 1); ++k)
    {
      double& now = freedom[static_cast<std::size_t>(k)];
      now = std::min(now, SmoothStep(std::abs(k - f) / ease));
    }
  }
}

bool KeepsBalls(const std::vector<Constraint>& rows, const std::vector<std::size_t>& places,
                const ChangedBody& changed)
{
  return std::all_of(places.begin(), places.end(),
                     [&](std::size_t place)
                     {
                       const Constraint& row = rows[place];
                       return row.Frame != changed.Frame || !IsPassing(row.Kind) ||
                              row.Status != ConstraintStatus::Met ||
                              (changed.After - row.Value).norm() <= row.Radius;
                     });
}

} // namespace

PartingFreedom FreedomOf(const MotionObject& object, const std::vector<Constraint>& rows,
                         const std::vector<std::size_t>& places, const Timeline& time)
{
  std::vector<char> position(static_cast<std::size_t>(time.NumberOfFrames), 0);
  std::vector<char> pose = position;
  const int begins = std::min(object.Released(), time.NumberOfFrames - 1);
  std::fill_n(position.begin(), begins + 1, 1);
  std::fill_n(pose.begin(), begins + 1, begins > 0 || object.OrientationGiven != 0 ? 1 : 0);
  for (const std::size_t place : places)
  {
    const Given given = GivenBy(rows[place]);
    for (int f = std::max(given.First, 0); f <= std::min(given.Last, time.NumberOfFrames - 1); ++f)
    {
      const auto k = static_cast<std::size_t>(f);
      position[k] = given.Place ? 1 : position[k];
      pose[k] = given.Pose ? 1 : pose[k];
    }
  }
  PartingFreedom freedom;
  EaseOff(pose, GivenEase * time.FramesPerSecond, freedom.Turn);
  EaseOff(position, GivenEase * time.FramesPerSecond, freedom.Shift);
  return freedom;
}

bool IsAllowed(const RotationInput& input, const std::vector<std::size_t>& places,
               const ChangedBody& changed)
{
  const bool isMoved = changed.After != changed.Before;
  if (isMoved && !KeepsBalls(input.Constraints, places, changed))
  {
    return false;
  }
  const double clearance = changed.Object->ClearanceRadius;
  if (isMoved && input.Scene.Bounds.InnerDistance(changed.After) <
                   std::min(clearance, input.Scene.Bounds.InnerDistance(changed.Before)))
  {
    return false;
  }
  if (input.Obstacles == nullptr)
  {
    return true;
  }
  const double reach = std::max(clearance, changed.Radius);
  const double now = input.Obstacles->SignedDistance(changed.After, changed.Frame, reach);
  if (isMoved && now < std::min(clearance, input.Obstacles->SignedDistance(changed.Before,
                                                                           changed.Frame, reach)))
  {
    return false;
  }
  const std::vector<Vec3>& points = changed.Body->Mesh.Points;
  const auto isAbove = [&](const Vec3& point)
  {
    // No farther than what tells: a vertex in the open is not held against any triangle.
    return input.Obstacles->SignedDistance(changed.Pose * point + changed.After, changed.Frame,
                                           SurfaceDepth) >= -SurfaceDepth;
  };
  return now >= changed.Radius || std::all_of(points.begin(), points.end(), isAbove);
}

} // namespace waft
