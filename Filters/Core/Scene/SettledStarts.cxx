// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/SettledStarts.h"

#include "Base/NumberText.h"
#include "Constraints/Rest.h"

#include <cmath>
#include <set>
#include <utility>

namespace waft
{
namespace
{

constexpr double SamePlace = 1e-6;     // m, along the surface
constexpr double LeastReported = 1e-9; // m, from which a shift is reported

// Where rests that wait for their objects are, at frame 0: x and y in steps of SamePlace.
using Places = std::set<std::pair<long long, long long>>;

std::pair<long long, long long> PlaceOf(const Vec3& value)
{
  return { std::llround(value.x() / SamePlace), std::llround(value.y() / SamePlace) };
}

bool IsNear(const Places& places, const Vec3& value)
{
  const auto [x, y] = PlaceOf(value);
  for (long long i = -1; i <= 1; ++i)
  {
    for (long long j = -1; j <= 1; ++j)
    {
      if (places.count({ x + i, y + j }) > 0)
      {
        return true;
      }
    }
  }
  return false;
}

} // namespace

Result SettleStarts(const std::vector<ObstacleMesh>& obstacles, const std::vector<Constraint>& rows,
                    std::vector<MotionObject>& objects, std::string& moved)
{
  std::set<int> held;
  Places waiting;
  for (const Constraint& row : rows)
  {
    if (IsRest(row.Kind) && row.Frame == 0 && row.ObjectId >= 0)
    {
      held.insert(row.ObjectId);
    }
    else if (IsRest(row.Kind) && row.Frame == 0)
    {
      waiting.insert(PlaceOf(row.Value));
    }
  }
  if (held.empty() && waiting.empty())
  {
    return Result::Ok();
  }
  ObstacleSet set;
  WAFT_RETURN_IF_FAILED(set.Build(obstacles));
  std::size_t count = 0;
  double farthest = 0.0;
  int who = -1;
  for (MotionObject& object : objects)
  {
    if (held.count(object.ObjectId) == 0 && !IsNear(waiting, object.Position))
    {
      continue;
    }
    // From above it, since a start may be a little below the surface as well.
    const Vec3 above = object.Position + Vec3(0.0, 0.0, object.ClearanceRadius);
    Vec3 centre;
    SurfaceHit hit;
    if (!RestingPosition(set, above, 0.0, object.RestHeight, centre, hit))
    {
      continue;
    }
    const double shift = std::abs(centre.z() - object.Position.z());
    if (shift > object.ClearanceRadius)
    {
      continue;
    }
    object.Position = centre;
    if (shift > LeastReported)
    {
      ++count;
      who = shift > farthest ? object.ObjectId : who;
      farthest = std::max(farthest, shift);
    }
  }
  if (count > 0)
  {
    moved = std::to_string(count) + (count == 1 ? " object that rests" : " objects that rest") +
            " from frame 0 on " + (count == 1 ? "is" : "are") +
            " put on the surface below the start, " + (count == 1 ? "" : "at most ") +
            NumberText(farthest) + " m away (object " + std::to_string(who) + ")";
  }
  return Result::Ok();
}

} // namespace waft
