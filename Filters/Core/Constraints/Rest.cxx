// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/Rest.h"

#include <algorithm>
#include <cmath>

namespace waft
{

namespace
{

constexpr double SteepestNormal = 0.1;   // z of the normal, 84 degrees
constexpr double LeastSinkingTime = 0.2; // s
constexpr double SinkingRatio = 0.5;     // of the settling speed, in the mean

/// Samples of the centre against the obstacle it lands on.
bool StaysAbove(const ObstacleSet& obstacles, int obstacleId, double distance, const Vec3& a,
                double frameA, const Vec3& b, double frameB)
{
  const int steps = std::max(4, static_cast<int>(std::ceil(8.0 * (frameB - frameA))));
  for (int k = 0; k <= steps; ++k)
  {
    const double part = static_cast<double>(k) / steps;
    SurfaceHit hit;
    if (obstacles.SignedDistanceTo(obstacleId, a + part * (b - a),
                                   frameA + part * (frameB - frameA),
                                   hit) < distance - LandingSlack)
    {
      return false;
    }
  }
  return true;
}

} // namespace

bool RestingPosition(const ObstacleSet& obstacles, const Vec3& value, double frame,
                     double restHeight, Vec3& centre, SurfaceHit& hit)
{
  if (!obstacles.SurfaceBelow(value, frame, hit))
  {
    return false;
  }
  const double slope = std::max(hit.Normal.z(), SteepestNormal);
  centre = Vec3(value.x(), value.y(), hit.Point.z() + restHeight / slope);
  return true;
}

bool WantedPlace(const Constraint& row, double restHeight, const ObstacleSet& obstacles,
                 CarriedPlace& place)
{
  place.Frame = row.Frame;
  SurfaceHit hit;
  switch (row.Kind)
  {
    case ConstraintKind::Position:
      place.Place = row.Value;
      place.On = row.On >= 0 ? obstacles.Find(row.On) : nullptr;
      return true;
    case ConstraintKind::Rest:
      if (!RestingPosition(obstacles, row.Value, row.Frame, restHeight, place.Place, hit))
      {
        return false;
      }
      place.On = obstacles.Find(hit.ObstacleId);
      return true;
    case ConstraintKind::Velocity:
    case ConstraintKind::Acceleration:
    case ConstraintKind::Orientation:
      break;
  }
  return false;
}

Vec3 ValueAt(const Constraint& row, int frame, const ObstacleSet& obstacles)
{
  const ObstacleMesh* on = row.On >= 0 ? obstacles.Find(row.On) : nullptr;
  return CarriedPlace{ row.Value, static_cast<double>(row.Frame), on }.At(frame);
}

CarriedPlace StartPlace(const MotionObject& object, const ObstacleSet& obstacles)
{
  return { object.Position, 0.0, object.On >= 0 ? obstacles.Find(object.On) : nullptr };
}

double SinkingFrames(const MotionObject& object, double framesPerSecond)
{
  const double time =
    std::max(LeastSinkingTime, object.ClearanceRadius / (SinkingRatio * object.SettlingSpeed));
  return std::min(time, 1.0) * framesPerSecond;
}

std::vector<LandingWindow> LandingWindows(const MotionObject& object,
                                          const std::vector<Constraint>& rows,
                                          const ObstacleSet& obstacles, double framesPerSecond)
{
  std::vector<LandingWindow> windows;
  for (const Constraint& row : rows)
  {
    SurfaceHit hit;
    Vec3 centre;
    if (row.ObjectId != object.ObjectId || !IsRest(row.Kind) ||
        !RestingPosition(obstacles, row.Value, row.Frame, object.RestHeight, centre, hit))
    {
      continue;
    }
    LandingWindow window;
    window.ObstacleId = hit.ObstacleId;
    window.Frame = FirstFrame(row);
    window.Until = LastFrame(row);
    window.First = window.Frame - framesPerSecond;
    window.Last = window.Until + framesPerSecond;
    const ObstacleMesh* below = obstacles.Find(hit.ObstacleId);
    window.Centre = { centre, static_cast<double>(row.Frame), below };
    window.Point = { hit.Point, window.Centre.Frame, below };
    window.Normal = hit.Normal;
    window.Room = obstacles.SignedDistance(centre, row.Frame, 1e30, hit.ObstacleId);
    const double least =
      obstacles.SignedDistanceTo(hit.ObstacleId, centre, row.Frame, hit) - LandingSlack;
    if (least < object.RestHeight - 2.0 * LandingSlack) // in a hollow
    {
      window.Least = std::max(0.0, least);
    }
    window.Row = row.Row;
    window.Target = row.Target;
    windows.push_back(window);
  }
  std::stable_sort(windows.begin(), windows.end(),
                   [](const LandingWindow& l, const LandingWindow& r)
                   { return l.Frame < r.Frame; });
  return windows;
}

bool HangingWindow(const MotionObject& object, const ObstacleSet& obstacles, double framesPerSecond,
                   LandingWindow& window)
{
  if (!object.Hangs())
  {
    return false;
  }
  SurfaceHit hit;
  const double distance =
    obstacles.SignedDistance(object.Position, 0.0, object.ClearanceRadius, hit);
  if (hit.ObstacleId < 0)
  {
    return false;
  }
  window = LandingWindow();
  window.ObstacleId = hit.ObstacleId;
  window.Until = object.Release;
  window.First = -framesPerSecond;
  window.Last = object.Release + framesPerSecond;
  window.Centre = StartPlace(object, obstacles);
  window.Point = { hit.Point, 0.0, window.Centre.On };
  window.Normal = hit.Normal;
  window.Room = obstacles.SignedDistance(object.Position, 0.0, 1e30, hit.ObstacleId);
  window.Least = std::max(0.0, distance - LandingSlack);
  window.Row = window.Target = OfNoRow;
  return true;
}

Clearance RequiredClearance(const ClearanceRule& rule, const std::vector<LandingWindow>& windows,
                            double frame)
{
  Clearance clearance;
  clearance.Radius = rule.Radius;
  double nearest = 0.0; // frames to the rest itself: where windows overlap, the nearer one counts
  for (const LandingWindow& window : windows)
  {
    const double away = std::max({ window.Frame - frame, frame - window.Until, 0.0 });
    if (frame >= window.First && frame <= window.Last && (clearance.Exempt < 0 || away < nearest))
    {
      nearest = away;
      clearance.Exempt = window.ObstacleId;
      clearance.LandingDistance = std::min(rule.RestHeight, window.Least);
      clearance.Radius = std::min(rule.Radius, std::max(0.0, window.Room - LandingSlack));
    }
  }
  return clearance;
}

bool IsMotionClear(const ObstacleSet& obstacles, const ClearanceRule& rule,
                   const std::vector<LandingWindow>& windows, const Vec3& a, double frameA,
                   const Vec3& b, double frameB)
{
  std::vector<double> cuts{ frameA, frameB };
  for (std::size_t w = 0; w < windows.size(); ++w)
  {
    cuts.push_back(windows[w].First);
    cuts.push_back(windows[w].Last);
    if (w > 0)
    {
      cuts.push_back(0.5 * (windows[w - 1].Until + windows[w].Frame));
    }
  }
  std::sort(cuts.begin(), cuts.end());
  const auto at = [&](double frame)
  { return frameB > frameA ? Vec3(a + (frame - frameA) / (frameB - frameA) * (b - a)) : b; };
  double from = frameA;
  Vec3 x = a;
  for (const double cut : cuts)
  {
    if (cut <= from || cut > frameB)
    {
      continue;
    }
    const Vec3 y = cut == frameB ? b : at(cut);
    const Clearance clearance = RequiredClearance(rule, windows, 0.5 * (from + cut));
    if (!obstacles.IsClear(x, from, y, cut, clearance.Radius, clearance.Exempt) ||
        (clearance.Exempt >= 0 &&
         !StaysAbove(obstacles, clearance.Exempt, clearance.LandingDistance, x, from, y, cut)))
    {
      return false;
    }
    from = cut;
    x = y;
  }
  if (frameA == frameB)
  {
    const Clearance clearance = RequiredClearance(rule, windows, frameA);
    return obstacles.IsClear(a, frameA, b, frameB, clearance.Radius, clearance.Exempt) &&
           (clearance.Exempt < 0 || StaysAbove(obstacles, clearance.Exempt,
                                               clearance.LandingDistance, a, frameA, b, frameB));
  }
  return true;
}

bool KeepsInside(const Box& volume, const Clearance& clearance, const Vec3& x)
{
  const double r = clearance.Radius;
  const double floor = clearance.Exempt >= 0 ? clearance.LandingDistance - LandingSlack : r;
  return x.x() - volume.Min.x() >= r && volume.Max.x() - x.x() >= r &&
         x.y() - volume.Min.y() >= r && volume.Max.y() - x.y() >= r &&
         volume.Max.z() - x.z() >= r && x.z() - volume.Min.z() >= floor;
}

} // namespace waft
