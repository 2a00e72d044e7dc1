// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/MeshContact.h"

#include "Base/ShapeMeasures.h"
#include "Obstacles/PointWelding.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace waft
{
namespace
{

constexpr int NumberOfDirections = 64;
constexpr double ClearlyApart = 1e-9; // of a body's radius: what is nearer is looked at exactly

/// Evenly all around: a spiral from pole to pole by the golden angle.
std::array<Vec3, NumberOfDirections> AllAround()
{
  std::array<Vec3, NumberOfDirections> directions;
  const double golden = std::acos(-1.0) * (3.0 - std::sqrt(5.0));
  for (int k = 0; k < NumberOfDirections; ++k)
  {
    const double z = 1.0 - (2.0 * k + 1.0) / NumberOfDirections;
    const double r = std::sqrt(1.0 - z * z);
    directions[static_cast<std::size_t>(k)] =
      Vec3(r * std::cos(golden * k), r * std::sin(golden * k), z);
  }
  return directions;
}

const std::array<Vec3, NumberOfDirections> Directions = AllAround();

/// Closed where seams of texture are, too.
bool HasInside(const TriangleMesh& mesh)
{
  const std::vector<int> same = NearPoints(mesh.Points, SeamTolerance(mesh.Points));
  TriangleMesh welded;
  for (std::array<int, 3> corners : mesh.Triangles)
  {
    for (int& corner : corners)
    {
      corner = same[static_cast<std::size_t>(corner)];
    }
    if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
    {
      welded.Triangles.push_back(corners);
    }
  }
  return IsClosed(welded);
}

bool Overlap(const Box& a, const Box& b)
{
  return (a.Min.array() <= b.Max.array()).all() && (b.Min.array() <= a.Max.array()).all();
}

Box Grown(const Box& box, double more)
{
  return { box.Min - Vec3::Constant(more), box.Max + Vec3::Constant(more) };
}

template <class Boxed>
Box BoxAbout(const std::vector<Boxed>& some)
{
  Box about = Box::Nothing();
  for (const Boxed& one : some)
  {
    about.Add(one.Around);
  }
  return about;
}

/// Whether a plane through a triangle, by its normal, leaves another one clearly on one side.
bool IsBeside(const TriangleCorners& triangle, const Vec3& normal, const TriangleCorners& other,
              double rounding)
{
  const double first = normal.dot(other[0] - triangle[0]);
  const double second = normal.dot(other[1] - triangle[0]);
  const double third = normal.dot(other[2] - triangle[0]);
  return std::min({ first, second, third }) > rounding ||
         std::max({ first, second, third }) < -rounding;
}

/// The box about another body's box, which is turned and shifted.
Box BoxAbout(const Box& own, const Mat3& turn, const Vec3& shift, double more)
{
  const Vec3 center = turn * own.Center() + shift;
  const Vec3 half = turn.cwiseAbs() * (0.5 * own.Size()) + Vec3::Constant(more);
  return { center - half, center + half };
}

} // namespace

ContactMesh::ContactMesh(const TriangleMesh& mesh) :
  Surface(&mesh), Triangles(mesh), Farthest(0.0), Extent(LargestExtent(mesh)),
  Closed(HasInside(mesh))
{
  for (const Vec3& point : mesh.Points)
  {
    this->Farthest = std::max(this->Farthest, point.norm());
  }
  for (std::size_t t = 0; t < mesh.Triangles.size(); ++t)
  {
    const auto& corners = mesh.Triangles[t];
    const auto at = [&](std::size_t k) -> const Vec3&
    { return mesh.Points[static_cast<std::size_t>(corners[k])]; };
    // As at a ball's poles.
    const bool isFlat = this->Triangles.Normal(static_cast<int>(t)).isZero();
    this->Around.push_back(isFlat ? Box::Nothing()
                                  : BoxAbout(TriangleCorners{ at(0), at(1), at(2) }));
    if (t % ClusterSize == 0)
    {
      this->AroundSome.push_back(Box::Nothing());
    }
    this->AroundSome.back().Add(this->Around.back());
    this->Upright.push_back(this->Triangles.Normal(static_cast<int>(t)));
  }
}

TriangleCorners MeshPair::OfA(int triangle) const
{
  const TriangleMesh& mesh = this->A.Shape->Mesh();
  const auto& corners = mesh.Triangles[static_cast<std::size_t>(triangle)];
  return { mesh.Points[static_cast<std::size_t>(corners[0])],
           mesh.Points[static_cast<std::size_t>(corners[1])],
           mesh.Points[static_cast<std::size_t>(corners[2])] };
}

TriangleCorners MeshPair::OfB(int triangle, const Vec3& shift) const
{
  const auto& corners = this->B.Shape->Mesh().Triangles[static_cast<std::size_t>(triangle)];
  return { this->Points[static_cast<std::size_t>(corners[0])] + shift,
           this->Points[static_cast<std::size_t>(corners[1])] + shift,
           this->Points[static_cast<std::size_t>(corners[2])] + shift };
}

void MeshPair::Place(const PosedMesh& a, const PosedMesh& b, double reach)
{
  this->A = a;
  this->B = b;
  this->Candidates.clear();
  this->Points.clear();
  const Mat3 back = a.Orientation.toRotationMatrix().transpose();
  this->Turn = back * b.Orientation.toRotationMatrix();
  this->Apart = back * (b.Position - a.Position);
  const Box& boxA = a.Shape->Tree().Bounds();
  const Box& boxB = b.Shape->Tree().Bounds();
  const double more = reach + ClearlyApart * (a.Shape->Radius() + b.Shape->Radius());
  if (!Overlap(boxA, BoxAbout(boxB, this->Turn, this->Apart, more)) ||
      !Overlap(boxB, BoxAbout(boxA, this->Turn.transpose(), -(this->Turn.transpose() * this->Apart),
                              more)))
  {
    return;
  }
  for (const Vec3& point : b.Shape->Mesh().Points)
  {
    this->Points.push_back(this->Turn * point + this->Apart);
  }
  this->ChooseOfB(Grown(boxA, reach));
  this->ChooseOfA(Grown(BoxAbout(this->SomeB), reach), reach);
  this->PairUp(reach);
}

/// Those of the chosen triangles whose boxes are near to each other, by a sweep along the longest
/// side of where they are.
void MeshPair::PairUp(double reach)
{
  const Box near = Grown(BoxAbout(this->SomeA), reach);
  this->SomeB.erase(std::remove_if(this->SomeB.begin(), this->SomeB.end(),
                                   [&](const Boxed& one) { return !Overlap(one.Around, near); }),
                    this->SomeB.end());
  Eigen::Index axis = 0;
  near.Size().maxCoeff(&axis);
  const auto isBefore = [&](const Boxed& one, const Boxed& other)
  { return one.Around.Min[axis] < other.Around.Min[axis]; };
  std::sort(this->SomeA.begin(), this->SomeA.end(), isBefore);
  std::sort(this->SomeB.begin(), this->SomeB.end(), isBefore);
  double widest = 0.0;
  for (const Boxed& one : this->SomeA)
  {
    widest = std::max(widest, one.Around.Size()[axis]);
  }
  auto first = this->SomeA.begin();
  for (const Boxed& one : this->SomeB)
  {
    const Box grown = Grown(one.Around, reach);
    for (; first != this->SomeA.end() && first->Around.Min[axis] + widest < grown.Min[axis];
         ++first)
    {
    }
    for (auto other = first;
         other != this->SomeA.end() && other->Around.Min[axis] <= grown.Max[axis]; ++other)
    {
      if (Overlap(other->Around, grown))
      {
        this->Candidates.push_back({ other->Triangle, one.Triangle,
                                     other->Around.Min - one.Around.Max,
                                     other->Around.Max - one.Around.Min });
      }
    }
  }
}

/// Triangles of b that are near a box in the axes of a.
void MeshPair::ChooseOfB(const Box& near)
{
  this->SomeB.clear();
  const ContactMesh& mesh = *this->B.Shape;
  const double more = ClearlyApart * (this->A.Shape->Radius() + mesh.Radius());
  for (std::size_t c = 0; c < mesh.Clusters().size(); ++c)
  {
    if (!Overlap(BoxAbout(mesh.Clusters()[c], this->Turn, this->Apart, more), near))
    {
      continue;
    }
    const std::size_t first = c * ContactMesh::ClusterSize;
    const std::size_t end = std::min(first + ContactMesh::ClusterSize, mesh.Boxes().size());
    for (std::size_t t = first; t < end; ++t)
    {
      const Box own = BoxAbout(this->OfB(static_cast<int>(t), Vec3::Zero()));
      if (!mesh.Normals()[t].isZero() && Overlap(own, near))
      {
        this->SomeB.push_back({ static_cast<int>(t), own });
      }
    }
  }
}

/// Triangles of a that are near a box in its axes, and b's in those of b, which is the narrower
/// one of a thin body.
void MeshPair::ChooseOfA(const Box& near, double reach)
{
  this->SomeA.clear();
  const ContactMesh& mesh = *this->A.Shape;
  const Mat3 back = this->Turn.transpose();
  const Vec3 apart = -(back * this->Apart);
  const double more = reach + ClearlyApart * (mesh.Radius() + this->B.Shape->Radius());
  const Box& boxB = this->B.Shape->Tree().Bounds();
  const auto isNear = [&](const Box& box)
  { return Overlap(box, near) && Overlap(BoxAbout(box, back, apart, more), boxB); };
  for (std::size_t c = 0; c < mesh.Clusters().size(); ++c)
  {
    if (!isNear(mesh.Clusters()[c]))
    {
      continue;
    }
    const std::size_t first = c * ContactMesh::ClusterSize;
    const std::size_t end = std::min(first + ContactMesh::ClusterSize, mesh.Boxes().size());
    for (std::size_t t = first; t < end; ++t)
    {
      if (isNear(mesh.Boxes()[t]))
      {
        this->SomeA.push_back({ static_cast<int>(t), mesh.Boxes()[t] });
      }
    }
  }
}

bool MeshPair::Contains(const Vec3& shift) const
{
  if (this->Points.empty())
  {
    return false;
  }
  const Mat3 back = this->Turn.transpose();
  return (this->A.Shape->IsClosed() && this->A.Shape->Tree().IsInside(this->Points[0] + shift)) ||
         (this->B.Shape->IsClosed() &&
          this->B.Shape->Tree().IsInside(back *
                                         (this->A.Shape->Mesh().Points[0] - this->Apart - shift)));
}

bool MeshPair::DoMeet(const Touching& both, const Vec3& shift) const
{
  const TriangleCorners a = this->OfA(both.A);
  const TriangleCorners b = this->OfB(both.B, shift);
  const auto normal = [](const ContactMesh& mesh, int triangle) -> const Vec3&
  { return mesh.Normals()[static_cast<std::size_t>(triangle)]; };
  const double rounding = ClearlyApart * (this->A.Shape->Radius() + this->B.Shape->Radius());
  return !IsBeside(a, normal(*this->A.Shape, both.A), b, rounding) &&
         !IsBeside(b, this->Turn * normal(*this->B.Shape, both.B), a, rounding) &&
         TrianglesMeet(a, b);
}

bool MeshPair::Cut(const Vec3& shift)
{
  for (std::size_t k = 0; k < this->Candidates.size(); ++k)
  {
    const Touching& both = this->Candidates[k];
    if ((shift.array() >= both.Low.array()).all() && (shift.array() <= both.High.array()).all() &&
        this->DoMeet(both, shift))
    {
      // Where they meet they mostly do after the next shift, too.
      std::swap(this->Candidates[0], this->Candidates[k]);
      return true;
    }
  }
  return this->Contains(shift);
}

bool MeshPair::IsDeeper(double depth)
{
  if (!this->Cut())
  {
    return false;
  }
  for (const Vec3& normal : { Vec3(Vec3::UnitZ()), Vec3(this->Turn.col(2)) })
  {
    if (!this->Cut(depth * normal) || !this->Cut(-depth * normal))
    {
      return false;
    }
  }
  return std::all_of(Directions.begin(), Directions.end(),
                     [&](const Vec3& direction) { return this->Cut(depth * direction); });
}

} // namespace waft
