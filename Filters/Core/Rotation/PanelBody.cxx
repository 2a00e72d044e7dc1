// SPDX-License-Identifier: BSD-3-Clause
// From a mesh to panels: which they are, what hides what, and the air that moves with them.
#include "Rotation/PanelBody.h"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace waft
{
namespace
{
// Powers of two: halves of halves then have equal shares, and the mirror image of a body has the
// mirror images of its panels.
constexpr int MaxPanels = 128;
constexpr int MaxRoundPanels = 512; // a closed body's outline needs finer ones
constexpr double RoundFlatness = 0.3;

/// A node of the table of directions: nodes x nodes on each face of the cube.
Vec3 NodeDirection(int nodes, int face, int row, int column)
{
  const double a = 2.0 * column / (nodes - 1) - 1.0;
  const double b = 2.0 * row / (nodes - 1) - 1.0;
  const double sign = face % 2 == 0 ? 1.0 : -1.0;
  Vec3 d;
  d[face / 2] = sign;
  d[(face / 2 + 1) % 3] = a;
  d[(face / 2 + 2) % 3] = b;
  return d.normalized();
}
} // namespace

Result PanelBody::Build(const Shape& shape, const ShellProperties& properties, int resolution,
                        const ParallelFor& parallel)
{
  if (resolution < 8 || resolution > 1024)
  {
    return Result::Error("RasterSize must be from 8 to 1024, found " + std::to_string(resolution));
  }
  this->Panels.clear();
  this->Visibility.clear();
  this->TotalArea = properties.Area;
  this->Spread = properties.SecondMoment;
  const Eigen::SelfAdjointEigenSolver<Mat3> normals(properties.NormalTensor);
  this->PlateNormal = normals.eigenvectors().col(2);
  if (this->PlateNormal.z() < 0.0)
  {
    this->PlateNormal = -this->PlateNormal;
  }
  this->PlateFlatness = std::clamp(normals.eigenvalues()[2] - normals.eigenvalues()[1], 0.0, 1.0);
  this->SetAddedMass(properties);

  std::vector<Piece> pieces;
  this->SplitMesh(shape.Mesh, pieces);
  std::vector<int> panelOfPiece(pieces.size(), 0);
  this->Gather(pieces, 0, pieces.size(),
               this->PlateFlatness < RoundFlatness ? MaxRoundPanels : MaxPanels, panelOfPiece);
  this->PackPanels();
  this->LookFromAllAround(shape.Mesh, pieces, panelOfPiece, resolution, parallel);
  return Result::Ok();
}

/// Large triangles are cut so that a sum over centroids is a good integral of the damping.
void PanelBody::SplitMesh(const TriangleMesh& mesh, std::vector<Piece>& pieces) const
{
  for (std::size_t t = 0; t < mesh.Triangles.size(); ++t)
  {
    const Vec3& a = mesh.Points[mesh.Triangles[t][0]];
    const Vec3& b = mesh.Points[mesh.Triangles[t][1]];
    const Vec3& c = mesh.Points[mesh.Triangles[t][2]];
    const Vec3 area = 0.5 * (b - a).cross(c - a);
    const double fraction = area.norm() / this->TotalArea;
    const int cuts = std::clamp(static_cast<int>(std::ceil(std::sqrt(256.0 * fraction))), 1, 24);
    const Vec3 u = (b - a) / cuts;
    const Vec3 v = (c - a) / cuts;
    for (int i = 0; i < cuts; ++i)
    {
      for (int j = 0; j < cuts - i; ++j)
      {
        Piece piece;
        piece.VectorArea = area / (cuts * cuts);
        piece.Triangle = static_cast<int>(t);
        piece.Centroid = a + (i + 1.0 / 3.0) * u + (j + 1.0 / 3.0) * v;
        pieces.push_back(piece);
        if (j < cuts - i - 1)
        {
          piece.Centroid = a + (i + 2.0 / 3.0) * u + (j + 2.0 / 3.0) * v;
          pieces.push_back(piece);
        }
      }
    }
  }
}

/// Halves the pieces at the median of their widest direction, by position and by normal, until each
/// group is one panel of the budget.
void PanelBody::Gather(std::vector<Piece>& pieces, std::size_t begin, std::size_t end, int budget,
                       std::vector<int>& panelOfPiece)
{
  if (budget <= 1 || end - begin <= 1)
  {
    Vec3 center = Vec3::Zero();
    Vec3 vectorArea = Vec3::Zero();
    double area = 0.0;
    for (std::size_t i = begin; i < end; ++i)
    {
      const double part = pieces[i].VectorArea.norm();
      center += part * pieces[i].Centroid;
      vectorArea += pieces[i].VectorArea;
      area += part;
      panelOfPiece[i] = static_cast<int>(this->Panels.size());
    }
    if (area > 0.0)
    {
      center /= area;
      const double size = vectorArea.norm();
      const Vec3 normal = size > 0.0 ? Vec3(vectorArea / size) : this->PlateNormal;
      this->Panels.push_back(
        { center.x(), center.y(), center.z(), normal.x(), normal.y(), normal.z(), size });
    }
    else
    {
      this->Panels.push_back({ 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0 });
    }
    return;
  }
  const double reach = std::sqrt(this->Spread.trace());
  const auto feature = [&](const Piece& piece, int axis) {
    return axis < 3 ? piece.Centroid[axis] : 0.5 * reach * piece.VectorArea.normalized()[axis - 3];
  };
  int widest = 0;
  double width = -1.0;
  for (int axis = 0; axis < 6; ++axis)
  {
    double low = 1e300;
    double high = -1e300;
    for (std::size_t i = begin; i < end; ++i)
    {
      const double value = feature(pieces[i], axis);
      low = std::min(low, value);
      high = std::max(high, value);
    }
    if (high - low > width)
    {
      width = high - low;
      widest = axis;
    }
  }
  std::stable_sort(
    pieces.begin() + static_cast<long>(begin), pieces.begin() + static_cast<long>(end),
    [&](const Piece& a, const Piece& b) { return feature(a, widest) < feature(b, widest); });
  const std::size_t middle = begin + (end - begin) / 2;
  this->Gather(pieces, begin, middle, budget / 2, panelOfPiece);
  this->Gather(pieces, middle, end, budget - budget / 2, panelOfPiece);
}

void PanelBody::PackPanels()
{
  this->Packs.assign((this->Panels.size() + Width - 1) / Width, PanelPack{});
  for (std::size_t i = 0; i < this->Panels.size(); ++i)
  {
    const Panel& panel = this->Panels[i];
    PanelPack& pack = this->Packs[i / Width];
    const std::size_t lane = i % Width;
    pack.X[lane] = panel.X;
    pack.Y[lane] = panel.Y;
    pack.Z[lane] = panel.Z;
    pack.NX[lane] = panel.NX;
    pack.NY[lane] = panel.NY;
    pack.NZ[lane] = panel.NZ;
    pack.Area[lane] = panel.Area;
  }
}

void PanelBody::LookFromAllAround(const TriangleMesh& mesh, const std::vector<Piece>& pieces,
                                  const std::vector<int>& panelOfPiece, int resolution,
                                  const ParallelFor& parallel)
{
  if (this->PlateFlatness > 1.0 - 1e-9)
  {
    return; // a plane hides nothing of itself
  }
  const std::size_t panels = this->Panels.size();
  const std::size_t lanes = Width * this->Packs.size();
  this->Visibility.assign(static_cast<std::size_t>(6) * Nodes * Nodes * lanes, 1.0F);
  parallel(static_cast<std::size_t>(6) * Nodes * Nodes,
           [&](std::size_t begin, std::size_t end)
           {
             std::vector<double> seen(panels);
             std::vector<double> all(panels);
             for (std::size_t node = begin; node < end; ++node)
             {
               const int face = static_cast<int>(node) / (Nodes * Nodes);
               const int row = static_cast<int>(node) / Nodes % Nodes;
               const Vec3 d = NodeDirection(Nodes, face, row, static_cast<int>(node) % Nodes);
               const RasterView view = Rasterise(mesh, d, resolution);
               std::fill(seen.begin(), seen.end(), 0.0);
               std::fill(all.begin(), all.end(), 0.0);
               for (std::size_t i = 0; i < pieces.size(); ++i)
               {
                 const int covered = view.Covered[pieces[i].Triangle];
                 if (covered > 0)
                 {
                   const double area = std::abs(pieces[i].VectorArea.dot(d));
                   all[panelOfPiece[i]] += area;
                   seen[panelOfPiece[i]] += area * view.Visible[pieces[i].Triangle] / covered;
                 }
               }
               for (std::size_t p = 0; p < panels; ++p)
               {
                 this->Visibility[node * lanes + p] =
                   all[p] > 0.0 ? static_cast<float>(seen[p] / all[p]) : 1.0F;
               }
             }
           });
}

/// Air that moves with an elliptic plate of the same second moments (semi-axes a >= b): the disc
/// and the long strip are exact (Lamb 1932, sections 71 and 105), between them it is linear in b/a.
/// A round body: half the air that it displaces.
void PanelBody::SetAddedMass(const ShellProperties& properties)
{
  const Mat3 across = Mat3::Identity() - this->PlateNormal * this->PlateNormal.transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(across * properties.SecondMoment * across);
  const double a = 2.0 * std::sqrt(std::max(axes.eigenvalues()[2], 0.0));
  const double b = 2.0 * std::sqrt(std::max(axes.eigenvalues()[1], 0.0));
  const Vec3 along = axes.eigenvectors().col(2);
  const Vec3 side = this->PlateNormal.cross(along);
  const double slender = a > 0.0 ? 1.0 - b / a : 0.0;
  const double pi = std::acos(-1.0);
  const double mass = a * b * b * (8.0 / 3.0 + (4.0 / 3.0 * pi - 8.0 / 3.0) * slender);
  const double roll = a * b * b * b * b * (16.0 / 45.0 + (2.0 * pi / 15.0 - 16.0 / 45.0) * slender);
  const double pitch =
    a * a * a * b * b * (16.0 / 45.0 + (4.0 * pi / 15.0 - 16.0 / 45.0) * slender);
  this->AirInertia =
    this->PlateFlatness * (roll * along * along.transpose() + pitch * side * side.transpose());
  const double radius = std::sqrt(properties.SecondMoment.trace());
  this->AirMass =
    this->PlateFlatness * mass * this->PlateNormal * this->PlateNormal.transpose() +
    (1.0 - this->PlateFlatness) * 2.0 / 3.0 * pi * radius * radius * radius * Mat3::Identity();
}

} // namespace waft
