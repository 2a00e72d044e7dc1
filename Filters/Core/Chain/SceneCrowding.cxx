// SPDX-License-Identifier: BSD-3-Clause
#include "Chain/SceneCrowding.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace waft
{
namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr double Crowded = 0.05;            // share of the volume that balls of clearance may take
constexpr std::size_t MostPoints = 2000;    // of a surface that are measured from
constexpr std::size_t MostPairs = 10000000; // of marks at one frame that are looked at
constexpr std::size_t Named = 3;            // of the pairs, the nearest
constexpr double LeastGap = 1e-6;           // m; nearer ones touch

/// An obstacle where it stands at frame 0, in its box.
struct BoxedObstacle
{
  int Id = 0;
  std::vector<Vec3> Points;
  Box Bounds;

  explicit BoxedObstacle(const ObstacleMesh& obstacle) :
    Id(obstacle.ObstacleId), Points(obstacle.Mesh.Points), Bounds(Box::Nothing())
  {
    for (const Vec3& point : this->Points)
    {
      this->Bounds.Add(point);
    }
  }
  double Far(const Vec3& x) const
  {
    return (this->Bounds.Min - x).cwiseMax(x - this->Bounds.Max).cwiseMax(0.0).norm();
  }
  double Far(const BoxedObstacle& other) const
  {
    return (this->Bounds.Min - other.Bounds.Max)
      .cwiseMax(other.Bounds.Min - this->Bounds.Max)
      .cwiseMax(0.0)
      .norm();
  }
};

/// Smallest distance of one surface's points from the other one, where less than `wide`, and there.
double GapFrom(const BoxedObstacle& one, const BoxedObstacle& other, const ObstacleSet& obstacles,
               double wide, Vec3& place)
{
  double gap = wide;
  const std::size_t step = std::max<std::size_t>(1, one.Points.size() / MostPoints);
  for (std::size_t i = 0; i < one.Points.size(); i += step)
  {
    SurfaceHit hit;
    if (other.Far(one.Points[i]) < gap)
    {
      const double distance = obstacles.SignedDistanceTo(other.Id, one.Points[i], 0, gap, hit);
      if (distance < gap)
      {
        gap = distance;
        place = 0.5 * (one.Points[i] + hit.Point);
      }
    }
  }
  return gap;
}

/// Obstacles between which no body passes, though there is room.
void FindGaps(const std::vector<BoxedObstacle>& boxes, const ObstacleSet& obstacles, double wide,
              std::vector<Finding>& findings)
{
  for (auto one = boxes.begin(); one != boxes.end(); ++one)
  {
    for (auto other = one + 1; other != boxes.end(); ++other)
    {
      if (one->Far(*other) >= wide)
      {
        continue;
      }
      Vec3 place, back;
      double gap = GapFrom(*one, *other, obstacles, wide, place);
      if (const double own = GapFrom(*other, *one, obstacles, gap, back); own < gap)
      {
        gap = own;
        place = back;
      }
      if (LeastGap < gap && gap < wide)
      {
        Finding finding;
        finding.Kind = "too narrow";
        finding.Text = Format("too narrow: obstacles %d and %d are %.3g m apart, the widest body "
                              "needs %.3g m to pass",
                              one->Id, other->Id, gap, wide);
        finding.Place = place;
        findings.push_back(std::move(finding));
      }
    }
  }
}

using ClearanceOf = std::map<int, double>; // by object [m]

/// Marks nearer to an obstacle than their body is wide.
void FindTightMarks(const std::vector<BoxedObstacle>& boxes, const ObstacleSet& obstacles,
                    const std::vector<Constraint>& rows, const ClearanceOf& clearance, double wide,
                    std::vector<Finding>& findings)
{
  for (const Constraint& row : rows)
  {
    const auto own = clearance.find(row.ObjectId);
    const double needed = own != clearance.end() ? own->second : 0.5 * wide;
    for (const BoxedObstacle& obstacle : boxes)
    {
      if (!IsPassing(row.Kind) || obstacle.Far(row.Value) + row.Radius >= needed)
      {
        continue;
      }
      SurfaceHit hit;
      const double room =
        obstacles.SignedDistanceTo(obstacle.Id, row.Value, 0, needed, hit) + row.Radius;
      if (0.0 <= room && room < needed)
      {
        findings.push_back(
          AboutRow("too narrow", row,
                   Format(" lies %.3g m from obstacle %d, the body's clearance radius is %.3g m: "
                          "move the mark of object %d at frame %d away by %.2g m, or give it that "
                          "radius",
                          room, obstacle.Id, needed, row.ObjectId, row.Frame, needed - room)));
      }
    }
  }
}

struct Pair
{
  double Apart, Wide; // m
  const Constraint* Marks[2];
};

/// Marks at one frame that are nearer than both their bodies have room. Along the axis of their
/// largest extent only neighbours can be, of which so many are looked at that the time is bounded.
struct NearMarks
{
  std::size_t Count = 0;
  bool IsAll = true;
  std::vector<Pair> Nearest; // of each mark, the nearest first

  NearMarks(std::vector<const Constraint*> marks, const ClearanceOf& clearance)
  {
    Box box = Box::Nothing();
    double widest = 0.0;
    for (const Constraint* mark : marks)
    {
      box.Add(mark->Value);
      widest = std::max(widest, clearance.at(mark->ObjectId));
    }
    int axis = 0;
    box.Size().maxCoeff(&axis);
    std::sort(marks.begin(), marks.end(),
              [axis](const Constraint* a, const Constraint* b)
              {
                for (int k = 0; k < 3; ++k) // those at one place stand side by side
                {
                  const int along = (axis + k) % 3;
                  if (a->Value[along] != b->Value[along])
                  {
                    return a->Value[along] < b->Value[along];
                  }
                }
                return a->ObjectId < b->ObjectId;
              });
    const std::size_t most = std::max<std::size_t>(1, MostPairs / marks.size());
    for (std::size_t i = 0; i < marks.size(); ++i)
    {
      Pair nearest{ 1e300, 0.0, { nullptr, nullptr } };
      for (std::size_t j = i + 1;
           j < marks.size() && marks[j]->Value[axis] <= marks[i]->Value[axis] + 2.0 * widest; ++j)
      {
        if (j > i + most)
        {
          this->IsAll = false;
          break;
        }
        const double wide = clearance.at(marks[i]->ObjectId) + clearance.at(marks[j]->ObjectId);
        const double apart =
          (marks[i]->Value - marks[j]->Value).norm() + marks[i]->Radius + marks[j]->Radius;
        if (marks[i]->ObjectId != marks[j]->ObjectId && apart < wide)
        {
          ++this->Count;
          nearest = apart < nearest.Apart ? Pair{ apart, wide, { marks[i], marks[j] } } : nearest;
        }
      }
      if (nearest.Wide > 0.0)
      {
        this->Nearest.push_back(nearest);
      }
    }
    std::stable_sort(this->Nearest.begin(), this->Nearest.end(),
                     [](const Pair& a, const Pair& b) { return a.Apart < b.Apart; });
  }
};

/// Frames at which objects are asked to be nearer to one another than they are wide.
void FindNearMarks(const std::vector<Constraint>& rows, const ClearanceOf& clearance,
                   std::vector<Finding>& findings)
{
  std::map<int, std::vector<const Constraint*>> at; // by frame
  for (const Constraint& row : rows)
  {
    if (IsPassing(row.Kind) && CanBe(row) && clearance.count(row.ObjectId) > 0)
    {
      at[row.Frame].push_back(&row);
    }
  }
  for (const auto& [frame, marks] : at)
  {
    const NearMarks near(marks, clearance);
    if (near.Count == 0)
    {
      continue;
    }
    std::string named;
    for (std::size_t i = 0; i < std::min(Named, near.Nearest.size()); ++i)
    {
      const Pair& pair = near.Nearest[i];
      const int ids[2] = { pair.Marks[0]->ObjectId, pair.Marks[1]->ObjectId };
      named += Format("%s%.3g m (objects %d and %d%s)", i > 0 ? ", " : "", pair.Apart,
                      std::min(ids[0], ids[1]), std::max(ids[0], ids[1]),
                      pair.Apart == 0.0 ? ", at one place" : "");
    }
    const Pair& first = near.Nearest.front();
    Finding finding;
    finding.Kind = "too near";
    finding.Text = Format(
      "too near: %s%zu pairs of the %zu marks at frame %d are nearer than bodies are wide "
      "(%.3g m), the nearest %s: bodies will overlap there; take fewer, smaller ones, or a "
      "wider figure, or ask for one of them at another frame",
      near.IsAll ? "" : "at least ", near.Count, marks.size(), frame, first.Wide, named.c_str());
    finding.ObjectId = first.Marks[0]->ObjectId;
    finding.Frame = frame;
    finding.Row = first.Marks[0]->Row;
    finding.Target = first.Marks[0]->Target;
    finding.Place = first.Marks[0]->Value;
    findings.push_back(std::move(finding));
  }
}

void FindCrowd(const Scene& scene, std::vector<Finding>& findings)
{
  const double share =
    std::accumulate(scene.Objects.begin(), scene.Objects.end(), 0.0,
                    [](double sum, const MotionObject& object)
                    { return sum + 4.0 / 3.0 * Pi * std::pow(object.ClearanceRadius, 3); }) /
    scene.Info.Bounds.Size().prod();
  if (share > Crowded)
  {
    findings.emplace_back();
    findings.back().Kind = "too many";
    findings.back().Text =
      Format("too many: the balls of clearance of %zu bodies take %.0f %% of the volume, %.0f %% "
             "is what flies well",
             scene.Objects.size(), 100.0 * share, 100.0 * Crowded);
  }
}

} // namespace

void FindCrowding(const Scene& scene, const ObstacleSet& obstacles,
                  const std::vector<Constraint>& rows, std::vector<Finding>& findings)
{
  ClearanceOf clearance;
  double wide = 0.0;
  for (const MotionObject& object : scene.Objects)
  {
    clearance[object.ObjectId] = object.ClearanceRadius;
    wide = std::max(wide, 2.0 * object.ClearanceRadius);
  }
  std::vector<BoxedObstacle> boxes;
  for (const ObstacleMesh& obstacle : obstacles.Obstacles())
  {
    boxes.emplace_back(obstacle);
  }
  FindGaps(boxes, obstacles, wide, findings);
  FindTightMarks(boxes, obstacles, rows, clearance, wide, findings);
  FindNearMarks(rows, clearance, findings);
  FindCrowd(scene, findings);
}

} // namespace waft
