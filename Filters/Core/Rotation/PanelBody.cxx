// SPDX-License-Identifier: BSD-3-Clause
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
constexpr std::size_t Width = 4;    // panels in a pack
constexpr double RoundFlatness = 0.3;
constexpr double CatchRatio = 0.11; // tip speed at half of the autorotation's drive
constexpr int Nodes = 7; // of the table of directions, along each side of a face of the cube

Vec3 NodeDirection(int face, int row, int column)
{
  const double a = 2.0 * column / (Nodes - 1) - 1.0;
  const double b = 2.0 * row / (Nodes - 1) - 1.0;
  const double sign = face % 2 == 0 ? 1.0 : -1.0;
  Vec3 d;
  d[face / 2] = sign;
  d[(face / 2 + 1) % 3] = a;
  d[(face / 2 + 2) % 3] = b;
  return d.normalized();
}

/// Tip speed of the fastest autorotation, in parts of the flight's speed, of a plate whose span is
/// `aspect` times its chord (Iversen 1979, heavy thin plates): 0.81 at 5, 0.35 at 0.6.
double FastestTip(double aspect)
{
  const double finite = aspect / (2.0 + std::sqrt(4.0 + aspect * aspect));
  return std::pow(finite * (2.0 - std::pow(aspect / (aspect + 0.595), 0.76)), 2.0 / 3.0);
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
    const double share = area.norm() / this->TotalArea;
    const int cuts = std::clamp(static_cast<int>(std::ceil(std::sqrt(256.0 * share))), 1, 24);
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

/// Halves the pieces at the median of their widest direction, by place and by normal, until each
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
  Pack none;
  none.X = none.Y = none.Z = none.NX = none.NY = none.NZ = none.Area = Lanes::Zero();
  this->Packs.assign((this->Panels.size() + Width - 1) / Width, none);
  for (std::size_t i = 0; i < this->Panels.size(); ++i)
  {
    const Panel& panel = this->Panels[i];
    Pack& pack = this->Packs[i / Width];
    const auto lane = static_cast<long>(i % Width);
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
               const Vec3 d = NodeDirection(face, row, static_cast<int>(node) % Nodes);
               const RasterView view = Rasterize(mesh, d, resolution);
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

PanelBody::Mixture PanelBody::Mix(const Vec3& direction) const
{
  int axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  const double major = std::max(std::abs(direction[axis]), 1e-300);
  const int face = 2 * axis + (direction[axis] >= 0.0 ? 0 : 1);
  const double a = 0.5 * (direction[(axis + 1) % 3] / major + 1.0) * (Nodes - 1);
  const double b = 0.5 * (direction[(axis + 2) % 3] / major + 1.0) * (Nodes - 1);
  const int column = std::clamp(static_cast<int>(a), 0, Nodes - 2);
  const int row = std::clamp(static_cast<int>(b), 0, Nodes - 2);
  const double fa = std::clamp(a - column, 0.0, 1.0);
  const double fb = std::clamp(b - row, 0.0, 1.0);
  const float* base =
    this->Visibility.data() +
    static_cast<std::size_t>((face * Nodes + row) * Nodes + column) * Width * this->Packs.size();
  const std::size_t right = Width * this->Packs.size();
  const std::size_t up = Nodes * right;
  return { { base, base + right, base + up, base + up + right },
           { (1.0 - fa) * (1.0 - fb), fa * (1.0 - fb), (1.0 - fa) * fb, fa * fb } };
}

PanelBody::Lanes PanelBody::VisibleParts(const Mixture& mixture, std::size_t panel) const
{
  using Floats = Eigen::Map<const Eigen::Array<float, 4, 1>>;
  if (!this->HidesItself())
  {
    return Lanes::Ones();
  }
  Lanes part = Lanes::Zero();
  for (int i = 0; i < 4; ++i)
  {
    part += mixture.Weights[i] * Floats(mixture.Nodes[i] + panel).cast<double>();
  }
  return part;
}

double PanelBody::ForeshortenedArea(const Vec3& direction) const
{
  const Vec3 d = direction.normalized();
  const Mixture mixture = this->HidesItself() ? this->Mix(d) : Mixture{};
  Lanes area = Lanes::Zero();
  for (std::size_t i = 0; i < this->Packs.size(); ++i)
  {
    const Pack& p = this->Packs[i];
    const Lanes cosine = (p.NX * d.x() + p.NY * d.y() + p.NZ * d.z()).abs();
    area += cosine * p.Area * this->VisibleParts(mixture, Width * i);
  }
  return area.sum();
}

Wrench PanelBody::Evaluate(const Vec3& velocity, const Mat3& gradient,
                           const AirCoefficients& coefficients) const
{
  const bool hides = this->HidesItself();
  const Mixture mixture = hides ? this->Mix(velocity) : Mixture{};
  const bool plate = coefficients.Model == AirModel::Plate;
  const double drag = 0.5 * coefficients.Drag;
  const double friction = drag * coefficients.Friction;
  const double lift = coefficients.Lift * this->PlateFlatness;
  const Vec3& n = this->PlateNormal;
  const Mat3& g = gradient;
  Lanes fx = Lanes::Zero(), fy = fx, fz = fx, tx = fx, ty = fx, tz = fx;
  for (std::size_t i = 0; i < this->Packs.size(); ++i)
  {
    const Pack& p = this->Packs[i];
    const Lanes wx = velocity.x() + g(0, 0) * p.X + g(0, 1) * p.Y + g(0, 2) * p.Z;
    const Lanes wy = velocity.y() + g(1, 0) * p.X + g(1, 1) * p.Y + g(1, 2) * p.Z;
    const Lanes wz = velocity.z() + g(2, 0) * p.X + g(2, 1) * p.Y + g(2, 2) * p.Z;
    const Lanes wn = wx * p.NX + wy * p.NY + wz * p.NZ;
    Lanes area = p.Area;
    if (hides)
    {
      area *= this->VisibleParts(mixture, Width * i);
    }
    Lanes x, y, z;
    if (plate)
    {
      // Normal force cd sin(alpha) (1 + lift cos^2(alpha)), friction along the surface. Lift is a
      // matter of how the flow meets the body as a whole: a panel that leans in a flow that comes
      // broadside has no more pressure than its neighbours.
      const Lanes speed = (wx * wx + wy * wy + wz * wz).sqrt() + 1e-12;
      const Lanes across = wx * n.x() + wy * n.y() + wz * n.z();
      const Lanes rub = -friction * area * speed;
      const Lanes push =
        -drag * area * wn * (speed * (1.0 + lift) - lift * across * across / speed) - rub * wn;
      x = push * p.NX + rub * wx;
      y = push * p.NY + rub * wy;
      z = push * p.NZ + rub * wz;
    }
    else
    {
      // Eq. 5: speed^2 times the foreshortened area is speed |w.n| times the area.
      const Lanes push = -drag * area * wn.abs();
      x = push * wx;
      y = push * wy;
      z = push * wz;
    }
    fx += x;
    fy += y;
    fz += z;
    tx += p.Y * z - p.Z * y;
    ty += p.Z * x - p.X * z;
    tz += p.X * y - p.Y * x;
  }
  Wrench total;
  total.Force = Vec3(fx.sum(), fy.sum(), fz.sum());
  total.Torque = Vec3(tx.sum(), ty.sum(), tz.sum());
  if (plate && this->PlateFlatness > 0.0)
  {
    const Wrench more = this->PlateCorrections(velocity, gradient, coefficients);
    total.Force += more.Force;
    total.Torque += more.Torque;
  }
  return total;
}

/// What a sum over independent panels lacks: suction at the leading edge, which moves the centre of
/// pressure ahead of the centre by PressureShift half chords times cos(alpha), and the circulation
/// of a turning plate, 0.5 C_R chord^2 omega per unit of span; and the drive of autorotation:
/// separated flow keeps a turning plate turning with tips nearly as fast as it flies, whatever its
/// inertia, and the slower the shorter its span is (Iversen 1979; Lugt 1983). Spin adds what a
/// propeller feels.
Wrench PanelBody::PlateCorrections(const Vec3& velocity, const Mat3& gradient,
                                   const AirCoefficients& coefficients) const
{
  Wrench total;
  const Vec3& n = this->PlateNormal;
  const double wn = velocity.dot(n);
  const Vec3 tangential = velocity - wn * n;
  const double slide = tangential.norm();
  const double scale = this->PlateFlatness * this->TotalArea;
  if (slide > 1e-12)
  {
    const double cosine = slide / velocity.norm();
    const double halfChord = 2.0 * std::sqrt(tangential.dot(this->Spread * tangential)) / slide;
    const double push = -0.5 * coefficients.Drag * scale * wn *
                        (1.0 + coefficients.Lift * this->PlateFlatness * cosine * cosine);
    total.Torque += coefficients.PressureShift * halfChord * push * tangential.cross(n);
  }
  // A propeller's blades lean by Spin the way round: the way it turns does not depend on the side
  // that is up.
  total.Torque -= 0.5 * coefficients.Drag * coefficients.Spin * scale *
                  std::sqrt(this->Spread.trace()) * velocity.norm() * wn * n;
  const Mat3 turning = 0.5 * (gradient - gradient.transpose());
  Vec3 spin(turning(2, 1), turning(0, 2), turning(1, 0));
  spin -= spin.dot(n) * n;
  const double rate = spin.norm();
  if (rate > 1e-12)
  {
    const Vec3 chordwise = n.cross(spin) / rate;
    const double chord = 4.0 * std::sqrt(chordwise.dot(this->Spread * chordwise));
    total.Force += 0.5 * coefficients.RotationalLift * scale * chord * spin.cross(velocity);
    const double span = 4.0 * std::sqrt(spin.dot(this->Spread * spin)) / rate;
    // Drives up to the tip speed of the fastest autorotation, but little while turning slowly.
    const double across = (velocity - velocity.dot(spin) / (rate * rate) * spin).norm();
    const double tip = 0.5 * chord * rate;
    const double caught =
      tip * tip / (tip * tip + CatchRatio * CatchRatio * across * across + 1e-30);
    const double drive = across * std::max(across - tip / FastestTip(span / chord), 0.0) * caught;
    total.Torque += 0.25 * coefficients.Autorotation * scale * chord * drive / rate * spin;
  }
  return total;
}

} // namespace waft
