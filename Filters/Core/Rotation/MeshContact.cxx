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

Box BoxAbout(const TriangleCorners& triangle)
{
  return { triangle[0].cwiseMin(triangle[1]).cwiseMin(triangle[2]),
           triangle[0].cwiseMax(triangle[1]).cwiseMax(triangle[2]) };
}

bool Overlap(const Box& a, const Box& b)
{
  return (a.Min.array() <= b.Max.array()).all() && (b.Min.array() <= a.Max.array()).all();
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
  if (!Overlap(boxA, BoxAbout(boxB, this->Turn, this->Apart, reach)) ||
      !Overlap(boxB, BoxAbout(boxA, this->Turn.transpose(), -(this->Turn.transpose() * this->Apart),
                              reach)))
  {
    return;
  }
  for (const Vec3& point : b.Shape->Mesh().Points)
  {
    this->Points.push_back(this->Turn * point + this->Apart);
  }
  const int count = static_cast<int>(b.Shape->Mesh().Triangles.size());
  for (int t = 0; t < count; ++t)
  {
    const Box own = BoxAbout(this->OfB(t, Vec3::Zero()));
    const Vec3 more = Vec3::Constant(reach);
    const Box box = { own.Min - more, own.Max + more };
    if (!Overlap(boxA, box))
    {
      continue;
    }
    this->Found.clear();
    a.Shape->Tree().AddInBox(box, this->Found);
    for (const int found : this->Found)
    {
      const Box other = BoxAbout(this->OfA(found));
      this->Candidates.push_back({ found, t, other.Min - own.Max, other.Max - own.Min });
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

bool MeshPair::Cut(const Vec3& shift)
{
  for (std::size_t k = 0; k < this->Candidates.size(); ++k)
  {
    const Touching& both = this->Candidates[k];
    if ((shift.array() >= both.Low.array()).all() && (shift.array() <= both.High.array()).all() &&
        TrianglesMeet(this->OfA(both.A), this->OfB(both.B, shift)))
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
