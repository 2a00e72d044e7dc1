// SPDX-License-Identifier: BSD-3-Clause
#include "Obstacles/SurfaceRepair.h"

#include "Base/NumberText.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <vector>

namespace waft
{

namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using TriangleBox = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;

Point ToPoint(const Vec3& p)
{
  return Point(p.x(), p.y(), p.z());
}

struct Pair
{
  std::array<int, 3> A, B; // rotated so that the shared points come first
  int Shared = 0;
};

Pair SharedFirst(const std::array<int, 3>& a, const std::array<int, 3>& b)
{
  Pair pair;
  std::array<int, 3> restA{}, restB{};
  int nA = 0;
  int nB = 0;
  for (const int v : a)
  {
    if (v == b[0] || v == b[1] || v == b[2])
    {
      pair.A[pair.Shared] = v;
      pair.B[pair.Shared++] = v;
    }
    else
    {
      restA[nA++] = v;
    }
  }
  for (const int v : b)
  {
    if (v != a[0] && v != a[1] && v != a[2])
    {
      restB[nB++] = v;
    }
  }
  for (int k = 0; k < nA; ++k)
  {
    pair.A[pair.Shared + k] = restA[k];
    pair.B[pair.Shared + k] = restB[k];
  }
  return pair;
}

bool MeetImproperly(const TriangleMesh& mesh, int t0, int t1)
{
  const Pair pair = SharedFirst(mesh.Triangles[t0], mesh.Triangles[t1]);
  const auto point = [&](int index) { return ToPoint(mesh.Points[index]); };
  const Point a0 = point(pair.A[0]), a1 = point(pair.A[1]), a2 = point(pair.A[2]);
  const Point b0 = point(pair.B[0]), b1 = point(pair.B[1]), b2 = point(pair.B[2]);
  if (CGAL::collinear(a0, a1, a2) || CGAL::collinear(b0, b1, b2))
  {
    return false;
  }
  switch (pair.Shared)
  {
    case 0:
      return CGAL::do_intersect(Kernel::Triangle_3(a0, a1, a2), Kernel::Triangle_3(b0, b1, b2));
    case 1: // beyond the common point, the far edge of one meets the other
      return CGAL::do_intersect(Kernel::Triangle_3(a0, a1, a2), Kernel::Segment_3(b1, b2)) ||
             CGAL::do_intersect(Kernel::Triangle_3(b0, b1, b2), Kernel::Segment_3(a1, a2));
    case 2: // folded onto each other
      return CGAL::coplanar(a0, a1, a2, b2) &&
             CGAL::coplanar_orientation(a0, a1, a2, b2) == CGAL::POSITIVE;
    default:
      return true;
  }
}

} // namespace

Result CheckSelfIntersection(const std::string& name, const TriangleMesh& mesh)
{
  std::vector<TriangleBox> boxes;
  boxes.reserve(mesh.Triangles.size());
  for (std::size_t t = 0; t < mesh.Triangles.size(); ++t)
  {
    CGAL::Bbox_3 box;
    for (const int index : mesh.Triangles[t])
    {
      box += ToPoint(mesh.Points[index]).bbox();
    }
    boxes.emplace_back(box, static_cast<int>(t));
  }
  int first = -1;
  int second = -1;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(),
                                [&](const TriangleBox& l, const TriangleBox& r)
                                {
                                  const int low = std::min(l.info(), r.info());
                                  const int high = std::max(l.info(), r.info());
                                  const bool earlier =
                                    first < 0 || low < first || (low == first && high < second);
                                  if (earlier && MeetImproperly(mesh, low, high))
                                  {
                                    first = low;
                                    second = high;
                                  }
                                });
  if (first < 0)
  {
    return Result::Ok();
  }
  const auto& corners = mesh.Triangles[first];
  const Vec3 middle =
    (mesh.Points[corners[0]] + mesh.Points[corners[1]] + mesh.Points[corners[2]]) / 3.0;
  return Result::Error(name + ": the surface cuts itself near " + PointText(middle) +
                       ", expected the boundary of a solid");
}

} // namespace waft
