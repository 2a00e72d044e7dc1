// SPDX-License-Identifier: BSD-3-Clause
#include "Obstacles/ObstacleSet.h"

#include "Obstacles/SurfaceRepair.h"
#include "Obstacles/TriangleTree.h"

#include <cmath>
#include <exception>
#include <limits>
#include <set>
#include <string>

namespace waft
{

struct ObstacleSet::Internals
{
  std::vector<ObstacleMesh> Meshes;
  std::vector<TriangleTree> Trees;
  bool Moving = false;

  /// Straight above or below a face its normal tells the side, which is cheaper than counting
  /// crossings; next to edges and on the surface they are counted.
  static bool IsInside(const TriangleTree& tree, const Vec3& q,
                       const TriangleTree::Closest& closest)
  {
    const double distance = std::sqrt(closest.SquaredDistance);
    if (closest.Triangle >= 0 && distance > 1e-9 * (tree.Bounds().Max - tree.Bounds().Min).norm())
    {
      const double height = (q - closest.Point).dot(tree.Normal(closest.Triangle));
      if (std::abs(height) > (1.0 - 1e-9) * distance)
      {
        return height < 0.0;
      }
    }
    return tree.IsInside(q);
  }
  /// Signed distance to obstacle k when it is below `limit`, else `limit`.
  double Signed(std::size_t k, const Vec3& x, double frame, double limit, SurfaceHit* hit) const
  {
    const Vec3 offset = this->Meshes[k].Offset(frame);
    const Vec3 q = x - offset;
    const TriangleTree& tree = this->Trees[k];
    const Box& box = tree.Bounds();
    const double outside2 = (box.Min - q).cwiseMax(q - box.Max).cwiseMax(0.0).squaredNorm();
    if (limit > 0.0 && outside2 >= limit * limit)
    {
      return limit;
    }
    TriangleTree::Closest closest;
    if (limit > 0.0)
    {
      closest = tree.ClosestPoint(q, std::min(limit * limit, std::numeric_limits<double>::max()));
    }
    const bool inside = outside2 == 0.0 && IsInside(tree, q, closest);
    if (!inside && limit <= 0.0)
    {
      return limit;
    }
    if (inside && closest.Triangle < 0)
    {
      closest = tree.ClosestPoint(q);
    }
    if (closest.Triangle < 0)
    {
      return limit;
    }
    const double distance = std::sqrt(closest.SquaredDistance) * (inside ? -1.0 : 1.0);
    if (distance >= limit)
    {
      return limit;
    }
    if (hit)
    {
      hit->ObstacleId = this->Meshes[k].ObstacleId;
      hit->Point = closest.Point + offset;
      const double scale = (box.Max - box.Min).norm();
      hit->Normal = std::abs(distance) > 1e-12 * scale ? Vec3((q - closest.Point) / distance)
                                                       : tree.Normal(closest.Triangle);
    }
    return distance;
  }

  /// Obstacle k against the ball on the straight way from a to b.
  bool IsClear(std::size_t k, const Vec3& a, double frameA, const Vec3& b, double frameB,
               double radius) const
  {
    const ObstacleMesh& mesh = this->Meshes[k];
    const TriangleTree& tree = this->Trees[k];
    const Vec3 start = a - mesh.Offset(frameA);
    if (!mesh.IsMoving() || frameA == frameB)
    {
      return !tree.IsSegmentNear(start, b - mesh.Offset(frameB), radius) && !tree.IsInside(start);
    }
    // Between whole frames the obstacle moves straight, so the ball does too as seen from it.
    const double direction = frameB > frameA ? 1.0 : -1.0;
    const double last = static_cast<double>(mesh.Offsets.size() - 1);
    Vec3 from = start;
    double at = frameA;
    while (at != frameB)
    {
      double next = direction > 0.0 ? std::floor(at) + 1.0 : std::ceil(at) - 1.0;
      if (next < 0.0 || next > last)
      {
        next = frameB; // it stands still before its first and after its last frame
        if ((direction > 0.0 && at < 0.0) || (direction < 0.0 && at > last))
        {
          next = direction > 0.0 ? std::min(0.0, frameB) : std::max(last, frameB);
        }
      }
      next = direction > 0.0 ? std::min(next, frameB) : std::max(next, frameB);
      const double part = (next - frameA) / (frameB - frameA);
      const Vec3 to = a + part * (b - a) - mesh.Offset(next);
      if (tree.IsSegmentNear(from, to, radius))
      {
        return false;
      }
      from = to;
      at = next;
    }
    return !tree.IsInside(start);
  }
};

ObstacleSet::ObstacleSet() : Impl(std::make_unique<Internals>()) {}
ObstacleSet::~ObstacleSet() = default;
ObstacleSet::ObstacleSet(ObstacleSet&&) noexcept = default;
ObstacleSet& ObstacleSet::operator=(ObstacleSet&&) noexcept = default;

Result ObstacleSet::Build(std::vector<ObstacleMesh> obstacles)
{
  try
  {
    auto impl = std::make_unique<Internals>();
    std::set<int> ids;
    for (ObstacleMesh& obstacle : obstacles)
    {
      const std::string name = "obstacle " + std::to_string(obstacle.ObstacleId);
      if (obstacle.ObstacleId < 0 || !ids.insert(obstacle.ObstacleId).second)
      {
        return Result::Error(name + ": expected ids from 0, each used once");
      }
      for (std::size_t frame = 0; frame < obstacle.Offsets.size(); ++frame)
      {
        if (!obstacle.Offsets[frame].allFinite())
        {
          return Result::Error(name + ": its displacement at frame " + std::to_string(frame) +
                               " is not finite");
        }
      }
      if (Result result = RepairSurface(name, obstacle.Mesh); !result)
      {
        return result;
      }
      if (Result result = CheckSelfIntersection(name, obstacle.Mesh); !result)
      {
        return result;
      }
      impl->Trees.emplace_back(obstacle.Mesh);
      impl->Moving = impl->Moving || obstacle.IsMoving();
    }
    impl->Meshes = std::move(obstacles);
    this->Impl = std::move(impl);
    return Result::Ok();
  }
  catch (const std::exception& error)
  {
    return Result::Error(std::string("obstacles: ") + error.what());
  }
}

bool ObstacleSet::IsEmpty() const
{
  return this->Impl->Meshes.empty();
}

bool ObstacleSet::HasMoving() const
{
  return this->Impl->Moving;
}

const std::vector<ObstacleMesh>& ObstacleSet::Obstacles() const
{
  return this->Impl->Meshes;
}

const ObstacleMesh* ObstacleSet::Find(int obstacleId) const
{
  const std::vector<ObstacleMesh>& all = this->Impl->Meshes;
  const auto found =
    std::find_if(all.begin(), all.end(),
                 [obstacleId](const ObstacleMesh& mesh) { return mesh.ObstacleId == obstacleId; });
  return found != all.end() ? &*found : nullptr;
}

double ObstacleSet::SignedDistance(const Vec3& x, double frame, double limit, int ignored) const
{
  double best = limit;
  for (std::size_t k = 0; k < this->Impl->Meshes.size(); ++k)
  {
    if (ignored < 0 || this->Impl->Meshes[k].ObstacleId != ignored)
    {
      best = this->Impl->Signed(k, x, frame, best, nullptr);
    }
  }
  return best;
}

double ObstacleSet::SignedDistance(const Vec3& x, double frame, double limit, SurfaceHit& hit,
                                   int ignored) const
{
  hit = SurfaceHit();
  double best = limit;
  for (std::size_t k = 0; k < this->Impl->Meshes.size(); ++k)
  {
    if (ignored < 0 || this->Impl->Meshes[k].ObstacleId != ignored)
    {
      best = this->Impl->Signed(k, x, frame, best, &hit);
    }
  }
  return best;
}

double ObstacleSet::SignedDistanceTo(int obstacleId, const Vec3& x, double frame, double limit,
                                     SurfaceHit& hit) const
{
  hit = SurfaceHit();
  for (std::size_t k = 0; k < this->Impl->Meshes.size(); ++k)
  {
    if (this->Impl->Meshes[k].ObstacleId == obstacleId)
    {
      return this->Impl->Signed(k, x, frame, limit, &hit);
    }
  }
  return limit;
}

bool ObstacleSet::IsClear(const Vec3& a, double frameA, const Vec3& b, double frameB, double radius,
                          int ignored) const
{
  for (std::size_t k = 0; k < this->Impl->Meshes.size(); ++k)
  {
    if ((ignored < 0 || this->Impl->Meshes[k].ObstacleId != ignored) &&
        !this->Impl->IsClear(k, a, frameA, b, frameB, radius))
    {
      return false;
    }
  }
  return true;
}

bool ObstacleSet::SurfaceBelow(const Vec3& x, double frame, SurfaceHit& hit) const
{
  struct Span
  {
    double Low = 0.0;
    double High = 0.0;
    std::size_t Obstacle = 0;
    int Top = -1; // the triangle it ends at
  };
  std::vector<Span> spans;
  for (std::size_t k = 0; k < this->Impl->Meshes.size(); ++k)
  {
    const Vec3 offset = this->Impl->Meshes[k].Offset(frame);
    const auto crossings = this->Impl->Trees[k].Crossings(x.x() - offset.x(), x.y() - offset.y());
    // The n-th entry belongs to the n-th exit, also where rounded heights have changed their order.
    std::vector<double> entries;
    std::size_t used = 0;
    for (const VerticalCrossing& crossing : crossings)
    {
      if (!crossing.Upwards)
      {
        entries.push_back(crossing.Z + offset.z());
      }
    }
    for (const VerticalCrossing& crossing : crossings)
    {
      if (crossing.Upwards && used < entries.size())
      {
        spans.push_back({ entries[used++], crossing.Z + offset.z(), k, crossing.Triangle });
      }
    }
  }
  std::sort(spans.begin(), spans.end(),
            [](const Span& l, const Span& r)
            { return l.Low != r.Low ? l.Low < r.Low : l.Obstacle < r.Obstacle; });
  // Solids that overlap or touch count as one: nobody lands in the joint between two boxes.
  const Span* top = nullptr; // of the solid seen last, going up
  for (const Span& span : spans)
  {
    if (span.Low > x.z() && (!top || span.Low > top->High))
    {
      break;
    }
    if (!top || span.High > top->High || span.Low > top->High)
    {
      top = &span;
    }
  }
  if (!top)
  {
    return false;
  }
  hit.ObstacleId = this->Impl->Meshes[top->Obstacle].ObstacleId;
  hit.Point = Vec3(x.x(), x.y(), top->High);
  hit.Normal = this->Impl->Trees[top->Obstacle].Normal(top->Top);
  return true;
}

} // namespace waft
