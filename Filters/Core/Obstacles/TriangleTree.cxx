// SPDX-License-Identifier: BSD-3-Clause
#include "Obstacles/TriangleTree.h"

#include "Obstacles/TriangleDistance.h"

#include <CGAL/AABB_tree.h>
#include <CGAL/version.h>
#if CGAL_VERSION_MAJOR < 6
#include <CGAL/AABB_traits.h>
#else
#include <CGAL/AABB_traits_3.h>
#endif
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/intersections.h>

#include <numeric>

namespace waft
{

namespace
{

using Kernel = CGAL::Simple_cartesian<double>;

/// A triangle by its index in a mesh, which the tree shares: triangles of the kernel's own would
/// take twice what the mesh does.
class Primitive
{
public:
  using Id = int;
  using Point = Kernel::Point_3;
  using Datum = Kernel::Triangle_3;
  using Point_reference = Point;
  using Datum_reference = Datum;
  using Shared_data = const TriangleMesh*;

  Primitive(std::vector<int>::const_iterator triangle, Shared_data /*mesh*/) : Triangle(*triangle)
  {
  }

  static Shared_data construct_shared_data(Shared_data mesh) { return mesh; }
  Id id() const { return this->Triangle; }
  Datum datum(Shared_data mesh) const
  {
    return Datum(this->Corner(mesh, 0), this->Corner(mesh, 1), this->Corner(mesh, 2));
  }
  Point reference_point(Shared_data mesh) const { return this->Corner(mesh, 0); }

private:
  Point Corner(Shared_data mesh, std::size_t corner) const
  {
    const Vec3& p = mesh->Points[mesh->Triangles[this->Triangle][corner]];
    return Point(p.x(), p.y(), p.z());
  }

  int Triangle;
};

#if CGAL_VERSION_MAJOR < 6
using Traits = CGAL::AABB_traits<Kernel, Primitive>;
#else
using Traits = CGAL::AABB_traits_3<Kernel, Primitive>;
#endif
using Tree = CGAL::AABB_tree<Traits>;
using Node = CGAL::AABB_node<Traits>;
using Exact = CGAL::Exact_predicates_inexact_constructions_kernel;

double SquaredDistanceToBox(const Vec3& x, const CGAL::Bbox_3& box)
{
  const double dx = std::max({ box.xmin() - x.x(), x.x() - box.xmax(), 0.0 });
  const double dy = std::max({ box.ymin() - x.y(), x.y() - box.ymax(), 0.0 });
  const double dz = std::max({ box.zmin() - x.z(), x.z() - box.zmax(), 0.0 });
  return dx * dx + dy * dy + dz * dz;
}

/// Does the segment p + t d, 0 <= t <= 1, meet the box grown by radius on all sides?
bool SegmentMeetsBox(const Vec3& p, const Vec3& d, double radius, const CGAL::Bbox_3& box)
{
  double first = 0.0;
  double last = 1.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = box.min(axis) - radius - p[axis];
    const double high = box.max(axis) + radius - p[axis];
    if (std::abs(d[axis]) < 1e-300)
    {
      if (low > 0.0 || high < 0.0)
      {
        return false;
      }
      continue;
    }
    const double t0 = low / d[axis];
    const double t1 = high / d[axis];
    first = std::max(first, std::min(t0, t1));
    last = std::min(last, std::max(t0, t1));
  }
  return first <= last + 1e-12;
}

/// Sign of the area of (a, b, p) in the plane z = 0, p shifted by (e, e^2), e infinitesimal.
int ShiftedOrientation(const Vec3& a, const Vec3& b, const Vec3& p)
{
  const auto sign = CGAL::orientation(Exact::Point_2(a.x(), a.y()), Exact::Point_2(b.x(), b.y()),
                                      Exact::Point_2(p.x(), p.y()));
  if (sign != CGAL::COLLINEAR)
  {
    return sign == CGAL::LEFT_TURN ? 1 : -1;
  }
  if (a.y() != b.y())
  {
    return a.y() > b.y() ? 1 : -1;
  }
  return a.x() == b.x() ? 0 : (b.x() > a.x() ? 1 : -1);
}

double SignedArea(const Vec3& a, const Vec3& b, const Vec3& p)
{
  return (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
}

} // namespace

struct TriangleTree::Internals
{
  TriangleMesh Mesh;
  Tree AABB;
  Box Bounds;

  const Vec3& Corner(int triangle, int corner) const
  {
    return this->Mesh.Points[this->Mesh.Triangles[triangle][corner]];
  }
  int Index(const Primitive& primitive) const { return primitive.id(); }
};

namespace
{

/// Visits nearer boxes first and shrinks the sphere of search.
template <class Surface>
struct ClosestVisitor
{
  using Priority = double;
  const Surface& S;
  Vec3 X;
  TriangleTree::Closest Best;

  bool go_further() const { return true; }
  void intersection(const Vec3&, const Primitive& primitive)
  {
    const int t = this->S.Index(primitive);
    const Vec3 point =
      ClosestOnTriangle(this->X, this->S.Corner(t, 0), this->S.Corner(t, 1), this->S.Corner(t, 2));
    const double d2 = (point - this->X).squaredNorm();
    if (d2 < this->Best.SquaredDistance)
    {
      this->Best = { d2, point, t };
    }
  }
  bool do_intersect(const Vec3&, const Node& node) const
  {
    return SquaredDistanceToBox(this->X, node.bbox()) < this->Best.SquaredDistance;
  }
  std::pair<bool, Priority> do_intersect_with_priority(const Vec3&, const Node& node) const
  {
    const double d2 = SquaredDistanceToBox(this->X, node.bbox());
    return { d2 < this->Best.SquaredDistance, -d2 };
  }
};

template <class Surface>
struct SweepVisitor
{
  const Surface& S;
  Vec3 A, B, D;
  double Radius;
  bool Found = false;

  bool go_further() const { return !this->Found; }
  void intersection(const Vec3&, const Primitive& primitive)
  {
    const int t = this->S.Index(primitive);
    this->Found = SegmentNearTriangle(this->A, this->B, this->Radius, this->S.Corner(t, 0),
                                      this->S.Corner(t, 1), this->S.Corner(t, 2));
  }
  bool do_intersect(const Vec3&, const Node& node) const
  {
    return SegmentMeetsBox(this->A, this->D, this->Radius, node.bbox());
  }
};

template <class Surface>
struct VerticalVisitor
{
  const Surface& S;
  Vec3 P;
  std::vector<VerticalCrossing> Found;

  bool go_further() const { return true; }
  void intersection(const Vec3&, const Primitive& primitive)
  {
    const int t = this->S.Index(primitive);
    const Vec3& a = this->S.Corner(t, 0);
    const Vec3& b = this->S.Corner(t, 1);
    const Vec3& c = this->S.Corner(t, 2);
    const int side = ShiftedOrientation(a, b, this->P);
    if (side == 0 || ShiftedOrientation(b, c, this->P) != side ||
        ShiftedOrientation(c, a, this->P) != side)
    {
      return;
    }
    Vec3 weights(SignedArea(b, c, this->P), SignedArea(c, a, this->P), SignedArea(a, b, this->P));
    weights = (side * weights).cwiseMax(0.0);
    const double sum = weights.sum();
    const Vec3 heights(a.z(), b.z(), c.z());
    const double z = sum > 0.0 ? weights.dot(heights) / sum : heights.mean();
    this->Found.push_back({ std::clamp(z, heights.minCoeff(), heights.maxCoeff()), t, side > 0 });
  }
  bool do_intersect(const Vec3&, const Node& node) const
  {
    const CGAL::Bbox_3& box = node.bbox();
    return box.xmin() <= this->P.x() && this->P.x() <= box.xmax() && box.ymin() <= this->P.y() &&
           this->P.y() <= box.ymax();
  }
};

} // namespace

bool TrianglesMeet(const TriangleCorners& a, const TriangleCorners& b)
{
  const auto triangle = [](const TriangleCorners& corners)
  {
    const auto point = [](const Vec3& p) { return Exact::Point_3(p.x(), p.y(), p.z()); };
    return Exact::Triangle_3(point(corners[0]), point(corners[1]), point(corners[2]));
  };
  return CGAL::do_intersect(triangle(a), triangle(b));
}

TriangleTree::TriangleTree(const TriangleMesh& mesh) : Impl(std::make_unique<Internals>())
{
  Internals& impl = *this->Impl;
  impl.Mesh = mesh;
  Eigen::AlignedBox3d bounds;
  std::vector<int> triangles(mesh.Triangles.size());
  std::iota(triangles.begin(), triangles.end(), 0);
  for (const auto& triangle : mesh.Triangles)
  {
    for (const int corner : triangle)
    {
      bounds.extend(mesh.Points[corner]);
    }
  }
  impl.Bounds = Box{ bounds.min(), bounds.max() };
  const TriangleMesh* own = &impl.Mesh;
  impl.AABB.insert(triangles.cbegin(), triangles.cend(), own);
  impl.AABB.build(); // not lazily: queries come from many threads
}

TriangleTree::~TriangleTree() = default;
TriangleTree::TriangleTree(TriangleTree&&) noexcept = default;
TriangleTree& TriangleTree::operator=(TriangleTree&&) noexcept = default;

const Box& TriangleTree::Bounds() const
{
  return this->Impl->Bounds;
}

Vec3 TriangleTree::Normal(int triangle) const
{
  const Internals& impl = *this->Impl;
  const Vec3& a = impl.Corner(triangle, 0);
  const Vec3 normal = (impl.Corner(triangle, 1) - a).cross(impl.Corner(triangle, 2) - a);
  const double length = normal.norm();
  return length > 0.0 ? Vec3(normal / length) : Vec3(Vec3::Zero());
}

TriangleTree::Closest TriangleTree::ClosestPoint(const Vec3& x, double limit2) const
{
  ClosestVisitor<Internals> visitor{ *this->Impl, x, {} };
  visitor.Best.SquaredDistance = limit2;
  this->Impl->AABB.traversal_with_priority(x, visitor);
  return visitor.Best;
}

bool TriangleTree::IsSegmentNear(const Vec3& a, const Vec3& b, double radius) const
{
  const CGAL::Bbox_3 box = this->Impl->AABB.bbox();
  if (!SegmentMeetsBox(a, b - a, radius, box))
  {
    return false;
  }
  SweepVisitor<Internals> visitor{ *this->Impl, a, b, b - a, radius };
  this->Impl->AABB.traversal(a, visitor);
  return visitor.Found;
}

std::vector<VerticalCrossing> TriangleTree::Crossings(double x, double y) const
{
  const Box& box = this->Impl->Bounds;
  if (x < box.Min.x() || x > box.Max.x() || y < box.Min.y() || y > box.Max.y())
  {
    return {};
  }
  VerticalVisitor<Internals> visitor{ *this->Impl, Vec3(x, y, 0.0), {} };
  this->Impl->AABB.traversal(visitor.P, visitor);
  // Rounded heights may tie at a sharp edge: then the entry comes before the exit.
  std::stable_sort(visitor.Found.begin(), visitor.Found.end(),
                   [](const VerticalCrossing& l, const VerticalCrossing& r)
                   { return l.Z != r.Z ? l.Z < r.Z : l.Upwards < r.Upwards; });
  return std::move(visitor.Found);
}

bool TriangleTree::IsInside(const Vec3& x) const
{
  if (!this->Impl->Bounds.Contains(x))
  {
    return false;
  }
  int depth = 0;
  for (const VerticalCrossing& crossing : this->Crossings(x.x(), x.y()))
  {
    if (crossing.Z > x.z())
    {
      depth += crossing.Upwards ? 1 : -1;
    }
  }
  return depth > 0;
}

} // namespace waft
