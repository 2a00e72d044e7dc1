// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Drift/FreeLanding.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

constexpr double Low = 1.25;         // of the clearance radius: as low as one that glides there is
constexpr double LowMargin = 0.01;   // m, that drifting bodies keep besides
constexpr double LeastNormal = 0.8;  // z of the normal of what a body stays on, 37 degrees
constexpr double LongestSinking = 3; // s
constexpr double StandsStill = 1e-9; // m, of an obstacle

// The surface straight below a body, if it is one to lie on to the end.
bool FindGround(const ObstacleSet& obstacles, const Vec3& x, int frame, int frames, SurfaceHit& hit)
{
  if (!obstacles.SurfaceBelow(x, frame, hit) || hit.Normal.z() < LeastNormal)
  {
    return false;
  }
  const ObstacleMesh* found = obstacles.Find(hit.ObstacleId);
  for (int f = frame + 1; found->IsMoving() && f < frames; ++f)
  {
    if ((found->Offset(f) - found->Offset(frame)).norm() > StandsStill)
    {
      return false;
    }
  }
  return true;
}

// From where it is at a frame, by the air and its settling, until its centre is where it rests.
FreeLanding Sink(const DriftScene& scene, const MotionObject& body, const AirSampler& air, Vec3 x,
                 int frame, int frames)
{
  const BodyLaw law = LawOf(body);
  const double step = scene.Scene.Time.Step();
  const double reach = Low * body.ClearanceRadius + LowMargin;
  const int last =
    std::min(frames - 1, frame + static_cast<int>(std::lround(LongestSinking / step)));
  for (int f = frame; f < last; ++f)
  {
    SurfaceHit hit;
    if (!FindGround(scene.Obstacles, x, f, frames, hit))
    {
      return {};
    }
    const double height = x.z() - (hit.Point.z() + body.RestHeight / hit.Normal.z());
    if (height <= 0.0)
    {
      return { f, Vec3(x.x(), x.y(), hit.Point.z()) };
    }
    if (height > 2.0 * reach)
    {
      return {}; // the air lifts it
    }
    const double braked = std::clamp(height / reach, 0.0, 1.0);
    x += step * law.Velocity(braked * air.Between(f, x));
  }
  return {};
}

} // namespace

FreeLanding FindFreeLanding(const DriftScene& scene, const MotionObject& body,
                            const AirSampler& air, const std::vector<Vec3>& path, int first)
{
  const int frames = static_cast<int>(path.size());
  const double low = Low * body.ClearanceRadius + LowMargin;
  for (int f = std::max(first, 1); f + 1 < frames; ++f)
  {
    const Vec3& x = path[static_cast<std::size_t>(f)];
    SurfaceHit hit;
    const bool isLow = scene.Obstacles.SignedDistance(x, f, low) < low &&
                       FindGround(scene.Obstacles, x, f, frames, hit) &&
                       x.z() - hit.Point.z() < low / hit.Normal.z();
    if (isLow)
    {
      const FreeLanding landing = Sink(scene, body, air, x, f, frames);
      if (landing.Frame >= 0)
      {
        return landing;
      }
    }
  }
  return {};
}

} // namespace waft
