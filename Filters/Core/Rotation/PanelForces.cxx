// SPDX-License-Identifier: BSD-3-Clause
// What the air does to panels that are there: foreshortened area, force and torque.
#include "Rotation/PanelBody.h"

#include <cmath>

namespace waft
{
namespace
{
constexpr double CatchRatio = 0.11; // tip speed at half of the autorotation's drive

/// Tip speed of the fastest autorotation, in parts of the flight's speed, of a plate whose span is
/// `aspect` times its chord (Iversen 1979, heavy thin plates): 0.81 at 5, 0.35 at 0.6.
double FastestTip(double aspect)
{
  const double finite = aspect / (2.0 + std::sqrt(4.0 + aspect * aspect));
  return std::pow(finite * (2.0 - std::pow(aspect / (aspect + 0.595), 0.76)), 2.0 / 3.0);
}
} // namespace

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
  using Floats = Eigen::Map<const Eigen::Array<float, Width, 1>>;
  if (!this->HidesItself())
  {
    return Lanes::Ones();
  }
  Lanes part = Lanes::Zero();
  for (int i = 0; i < 4; ++i)
  {
    part += mixture.Weights[i] * Floats(mixture.Corners[i] + panel).cast<double>();
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
