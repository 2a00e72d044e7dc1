// SPDX-License-Identifier: BSD-3-Clause
// What the air does to panels that are there: foreshortened area, force and torque.
#include "Rotation/PanelBody.h"

#include "Base/Simd.h"

#include <cmath>
#include <cstring>

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

constexpr double CreepingFriction = 2.0 / 3.0;
constexpr double FastDiscDrag = 1.17;

/// cd of a disc broadside (Clift, Grace, Weber 1978, Bubbles, Drops, and Particles, section 6.II).
double DiscDrag(double reynolds)
{
  const double least = std::max(reynolds, 1e-6);
  return std::max(FastDiscDrag,
                  64.0 / (std::acos(-1.0) * least) * (1.0 + 0.138 * std::pow(least, 0.792)));
}

/// A number of four panels. By itself the type would be aligned as far as the processor needs, to
/// another number of bytes in each clone.
typedef double Lanes __attribute__((vector_size(32), aligned(32)));

WAFT_INLINE void Load(const double* from, Lanes& lanes)
{
  std::memcpy(&lanes, from, sizeof(lanes));
}

/// Of a flow, what the load of a panel takes: PanelBody::Evaluate.
struct PanelFlow
{
  Vec3 Velocity, Normal;
  Mat3 Gradient;
  double Drag, Friction, Lift;
};

/// Four panels: places and normals, the velocity there, its part along the normals, visible areas.
struct PanelAir
{
  Lanes Place[3], Normal[3], Velocity[3], Along, Area;
};

WAFT_INLINE void Meet(const PanelPack& pack, const PanelFlow& flow, const float* const* corners,
                      const double* weights, std::size_t panel, PanelAir& air)
{
  Load(pack.X, air.Place[0]);
  Load(pack.Y, air.Place[1]);
  Load(pack.Z, air.Place[2]);
  Load(pack.NX, air.Normal[0]);
  Load(pack.NY, air.Normal[1]);
  Load(pack.NZ, air.Normal[2]);
  Load(pack.Area, air.Area);
  for (int c = 0; c < 3; ++c)
  {
    air.Velocity[c] = flow.Velocity[c] + flow.Gradient(c, 0) * air.Place[0] +
                      flow.Gradient(c, 1) * air.Place[1] + flow.Gradient(c, 2) * air.Place[2];
  }
  air.Along = air.Velocity[0] * air.Normal[0] + air.Velocity[1] * air.Normal[1] +
              air.Velocity[2] * air.Normal[2];
  if (corners != nullptr)
  {
    Lanes part = {};
    for (int k = 0; k < 4; ++k)
    {
      part += weights[k] * __builtin_convertvector(Load4(corners[k] + panel), Lanes);
    }
    air.Area *= part;
  }
}

/// Sums over panels, lane by lane until the end.
struct LoadSums
{
  Lanes Force[3] = {}, Torque[3] = {};
};

WAFT_INLINE void AddLoad(const PanelAir& air, const Lanes (&force)[3], LoadSums& sums)
{
  const Lanes(&p)[3] = air.Place;
  for (int c = 0; c < 3; ++c)
  {
    sums.Force[c] += force[c];
  }
  sums.Torque[0] += p[1] * force[2] - p[2] * force[1];
  sums.Torque[1] += p[2] * force[0] - p[0] * force[2];
  sums.Torque[2] += p[0] * force[1] - p[1] * force[0];
}

WAFT_INLINE void Total(const LoadSums& sums, Wrench& total)
{
  for (int c = 0; c < 3; ++c)
  {
    const Lanes& f = sums.Force[c];
    const Lanes& t = sums.Torque[c];
    total.Force[c] = (f[0] + f[2]) + (f[1] + f[3]);
    total.Torque[c] = (t[0] + t[2]) + (t[1] + t[3]);
  }
}

/// Normal force cd sin(alpha) (1 + lift cos^2(alpha)), friction along the surface. Lift is a matter
/// of how the flow meets the body as a whole: a panel that leans in a flow that comes broadside has
/// no more pressure than its neighbours.
WAFT_SIMD_CLONES void SumPlateLoads(const PanelPack* packs, std::size_t count,
                                    const PanelFlow& flow, const float* const* corners,
                                    const double* weights, Wrench& total)
{
  const Vec3& n = flow.Normal;
  LoadSums sums;
  for (std::size_t i = 0; i < count; ++i)
  {
    PanelAir air;
    Meet(packs[i], flow, corners, weights, PanelPack::Width * i, air);
    const Lanes(&w)[3] = air.Velocity;
    Lanes speed = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
    for (std::size_t lane = 0; lane < PanelPack::Width; ++lane)
    {
      speed[lane] = __builtin_sqrt(speed[lane]);
    }
    speed += 1e-12;
    const Lanes across = w[0] * n.x() + w[1] * n.y() + w[2] * n.z();
    const Lanes rub = -flow.Friction * air.Area * speed;
    const Lanes push = -flow.Drag * air.Area * air.Along *
                         (speed * (1.0 + flow.Lift) - flow.Lift * across * across / speed) -
                       rub * air.Along;
    const Lanes force[3] = { push * air.Normal[0] + rub * w[0], push * air.Normal[1] + rub * w[1],
                             push * air.Normal[2] + rub * w[2] };
    AddLoad(air, force, sums);
  }
  Total(sums, total);
}

/// Paper, Eq. 5: speed^2 times the foreshortened area is speed |w.n| times the area.
WAFT_SIMD_CLONES void SumPaperLoads(const PanelPack* packs, std::size_t count,
                                    const PanelFlow& flow, const float* const* corners,
                                    const double* weights, Wrench& total)
{
  LoadSums sums;
  for (std::size_t i = 0; i < count; ++i)
  {
    PanelAir air;
    Meet(packs[i], flow, corners, weights, PanelPack::Width * i, air);
    const Lanes push = -flow.Drag * air.Area * (air.Along < 0.0 ? -air.Along : air.Along);
    const Lanes force[3] = { push * air.Velocity[0], push * air.Velocity[1],
                             push * air.Velocity[2] };
    AddLoad(air, force, sums);
  }
  Total(sums, total);
}
} // namespace

double AirCoefficients::DragRatio(double speed) const
{
  return this->StickySpeed > 0.0
           ? DiscDrag(speed / this->StickySpeed) / DiscDrag(this->DragSpeed / this->StickySpeed)
           : 1.0;
}

AirCoefficients AirCoefficients::At(double speed) const
{
  AirCoefficients here = *this;
  if (this->StickySpeed > 0.0)
  {
    const double fast = FastDiscDrag / DiscDrag(speed / this->StickySpeed);
    here.Drag *= this->DragRatio(speed);
    here.Friction = fast * this->Friction + (1.0 - fast) * CreepingFriction;
    here.Lift *= fast;
    here.RotationalLift *= fast;
    here.Autorotation *= fast;
  }
  return here;
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

double PanelBody::ForeshortenedArea(const Vec3& direction) const
{
  const Vec3 d = direction.normalized();
  const Mixture mixture = this->HidesItself() ? this->Mix(d) : Mixture{};
  double area = 0.0;
  for (std::size_t i = 0; i < this->Panels.size(); ++i)
  {
    const Panel& panel = this->Panels[i];
    double part = this->HidesItself() ? 0.0 : 1.0;
    for (int k = 0; k < 4 && this->HidesItself(); ++k)
    {
      part += mixture.Weights[k] * static_cast<double>(mixture.Corners[k][i]);
    }
    area += std::abs(panel.NX * d.x() + panel.NY * d.y() + panel.NZ * d.z()) * panel.Area * part;
  }
  return area;
}

Wrench PanelBody::Evaluate(const Vec3& velocity, const Mat3& gradient,
                           const AirCoefficients& given) const
{
  AirCoefficients coefficients = given;
  if (given.StickySpeed > 0.0)
  {
    const double turning = 0.5 * gradient.squaredNorm() * this->Spread.trace();
    coefficients = given.At(std::sqrt(velocity.squaredNorm() + turning));
  }
  const bool hides = this->HidesItself();
  const Mixture mixture = hides ? this->Mix(velocity) : Mixture{};
  const bool plate = coefficients.Model == AirModel::Plate;
  PanelFlow flow;
  flow.Velocity = velocity;
  flow.Gradient = gradient;
  flow.Normal = this->PlateNormal;
  flow.Drag = 0.5 * coefficients.Drag;
  flow.Friction = flow.Drag * coefficients.Friction;
  flow.Lift = coefficients.Lift * this->PlateFlatness;
  Wrench total;
  (plate ? SumPlateLoads : SumPaperLoads)(this->Packs.data(), this->Packs.size(), flow,
                                          hides ? mixture.Corners : nullptr, mixture.Weights,
                                          total);
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
