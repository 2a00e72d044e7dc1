// SPDX-License-Identifier: BSD-3-Clause
// Thin discs as they were let fall in experiments, in still and in turbulent air, against what was
// measured there. Prints the rows of the table of Documentation/RotationRefineFilter.md
// (make_nature_table.py).
#include "Refining.h"
#include "Rotation/TurningSetup.h"
#include "Shapes/ThinShape.h"
#include "StirredAir.h"

#include <cstdio>
#include <vector>

using namespace waft;
using namespace waft::fixtures;

namespace
{
const double Pi = std::acos(-1.0);
constexpr double Density = 1.2;                // kg/m^3, of the air
constexpr double Viscosity = 1.8e-5 / Density; // m^2/s
constexpr double Integral = 0.1;               // m, of the air's eddies, as in a chamber
constexpr double Level = 15.0;                 // degrees
constexpr double OftenOver = 0.05;             // of tumblers, overturns in the time of a diameter

/// cd of a disc (Clift, Grace, Weber 1978).
double DiscDrag(double reynolds)
{
  return std::max(1.17, 64.0 / (Pi * reynolds) * (1.0 + 0.138 * std::pow(reynolds, 0.792)));
}

/// What falls, with the numbers by which its flight is known.
struct Body
{
  std::string Name;
  RotationInput Input; // one object
  PreparedShape Prepared;
  double Size = 0.0;  // m
  double Speed = 0.0; // m/s, where weight and drag broadside balance

  double Reynolds() const { return this->Speed * this->Size / Viscosity; }
  /// Inertia over that of a sphere of air of its size (Field et al. 1997): of a disc pi/64 times
  /// its density over the air's and its thickness over its diameter.
  double Inertia() const
  {
    return Pi / 64.0 * this->Input.Shapes[0].AreaDensity / (Density * this->Size);
  }
};

Body BodyOf(const std::string& builtin, double size)
{
  Body body;
  body.Name = builtin;
  body.Size = size;
  body.Input.Scene.AirDensity = Density;
  body.Input.Shapes.resize(1);
  Shape& shape = body.Input.Shapes[0];
  EXPECT_TRUE(MakeBuiltinShape(builtin, size, shape));
  EXPECT_TRUE(ComputeShellProperties(shape, body.Prepared.Properties));
  EXPECT_TRUE(body.Prepared.Panels.Build(shape, body.Prepared.Properties,
                                         RotationOptions().RasterSize, SerialFor()));
  body.Prepared.IsPrepared = true;
  body.Speed = shape.SettlingSpeed;
  return body;
}

void Weigh(double areaDensity, double thickness, double drag, Body& body)
{
  Shape& shape = body.Input.Shapes[0];
  shape.AreaDensity = areaDensity;
  shape.Thickness = thickness;
  shape.DragCoefficient = drag;
  EXPECT_TRUE(ComputeShellProperties(shape, body.Prepared.Properties));
  body.Speed = std::sqrt(2.0 * areaDensity * StandardGravity / (Density * drag));
  const double mass = areaDensity * body.Prepared.Properties.Area;
  const double radius = 0.5 * body.Size;
  // The stickiness of the air over the inertia, about a diameter (Happel and Brenner 1965, 5-1).
  shape.Damping =
    32.0 / 3.0 * Density * Viscosity * std::pow(radius, 3) / (0.25 * mass * radius * radius);
}

/// A disc of polyester, aspect times as wide as thick.
Body Disc(double diameter, double aspect)
{
  Body body = BodyOf("disc", diameter);
  const double thickness = diameter / aspect;
  const double areaDensity = 1380.0 * thickness;
  double drag = 1.17;
  for (int i = 0; i < 60; ++i)
  {
    const double speed = std::sqrt(2.0 * areaDensity * StandardGravity / (Density * drag));
    drag = 0.5 * (drag + DiscDrag(speed * diameter / Viscosity));
  }
  Weigh(areaDensity, thickness, drag, body);
  char name[64];
  std::snprintf(name, sizeof(name), "disc, %.1f mm", 1e3 * diameter);
  body.Name = name;
  return body;
}

/// A disc of this Reynolds number and inertia in air.
Body DiscOf(double reynolds, double inertia)
{
  const double drag = DiscDrag(reynolds);
  const double nu = reynolds * Viscosity;
  const double diameter = std::cbrt(nu * nu * Pi * drag / (128.0 * inertia * StandardGravity));
  Body body = BodyOf("disc", diameter);
  Weigh(64.0 / Pi * Density * diameter * inertia, 0.01 * diameter, drag, body);
  return body;
}

struct Fall
{
  double Speed = 0.0;     // m/s, downwards
  double Level = 0.0;     // share of the time
  double Overturns = 0.0; // in the time in which it falls by its size
  double Drift = 0.0;     // degrees from straight down
  double Tilt = 0.0;      // degrees, the largest from level or from upside down

  bool Tumbles() const { return this->Overturns > OftenOver; }
};

/// Let go at rest in the air, turned by up to a right angle by chance; measured over the last two
/// thirds. The law is that of bodies that glide, but with the inertia that what air carries at once
/// has not: where the air about it changes by du, it meets it by so much the slower.
Fall Drop(Body& body, double fluctuation, int seed, double seconds, double step)
{
  Random random(11, static_cast<std::uint64_t>(seed));
  MotionObject object;
  object.ObjectId = seed;
  object.SettlingSpeed = body.Speed;
  object.Mass = body.Input.Shapes[0].AreaDensity * body.Prepared.Properties.Area;
  RotationOptions options;
  options.MaximumTurn = 180.0;
  const Glider glider = GliderOf(body.Input, options, body.Prepared, object);
  const FlightBody flier = glider.DrawnAt(body.Speed);
  const double moved = glider.SlippingMass(body.Speed);
  // Eddies below four diameters come to nothing over a disc.
  const double dissipation = 0.5 * std::pow(fluctuation, 3) / Integral;
  const double kolmogorov = std::pow(std::pow(Viscosity, 3) / std::max(dissipation, 1e-12), 0.25);
  const StirredAir air(fluctuation, std::max(Integral, 5.0 * body.Size),
                       std::max(8.0 * kolmogorov, 4.0 * body.Size), seed % 2 == 0 ? 1.0 : -1.0,
                       Random(77, static_cast<std::uint64_t>(seed / 2)));
  FlightPath path;
  path.Step = step;
  path.RelativeVelocities.assign(2, -body.Speed * Vec3::UnitZ());
  path.AirGradients.resize(2);
  path.AirTurning.resize(2);
  FlightState state;
  const double round = 2.0 * Pi * random.Uniform();
  state.Orientation =
    ExpMap(0.5 * Pi * random.Uniform() * Vec3(std::cos(round), std::sin(round), 0.0));
  const Vec3 normal = body.Prepared.Panels.Normal();
  const int frames = static_cast<int>(std::lround(seconds / step));
  const int first = frames / 3;
  Vec3 x = Vec3::Zero(), from = Vec3::Zero();
  Mat3 gradient;
  Vec3 wind = air.At(x, 0.0, gradient);
  Fall fall;
  double overturns = 0.0;
  bool up = true;
  for (int k = 0; k < frames; ++k)
  {
    path.AirGradients.assign(2, gradient);
    path.AirTurning.assign(2, 0.5 * Vec3(gradient(2, 1) - gradient(1, 2),
                                         gradient(0, 2) - gradient(2, 0),
                                         gradient(1, 0) - gradient(0, 1)));
    AdvanceFrame(flier, path, 0, Settling(), nullptr, state);
    x += step * (wind + state.Velocity(flier));
    const Vec3 next = air.At(x, (k + 1) * step, gradient);
    state.Momentum -= moved * (next - wind);
    wind = next;
    const double level = (state.Orientation * normal).z();
    const bool turned = std::abs(level) > 0.3 && (level > 0.0) != up;
    up = turned ? !up : up;
    if (k < first)
    {
      from = x;
      continue;
    }
    const double tilt = std::acos(std::min(1.0, std::abs(level))) * 180.0 / Pi;
    fall.Level += tilt < Level ? 1.0 / (frames - first) : 0.0;
    fall.Tilt = std::max(fall.Tilt, tilt);
    overturns += turned ? 1.0 : 0.0;
  }
  const double time = step * (frames - first);
  fall.Speed = (from.z() - x.z()) / time;
  fall.Overturns = overturns / time * body.Size / body.Speed;
  fall.Drift =
    std::atan2(std::hypot(x.x() - from.x(), x.y() - from.y()), from.z() - x.z()) * 180.0 / Pi;
  return fall;
}

struct Falls
{
  double Speed = 0.0;                 // m/s, mean
  double Level = 0.0, Tumblers = 0.0; // shares
  double TumblersDrift = 0.0;         // degrees, mean
  int Flat = 0;
};

Falls DropAll(Body& body, double fluctuation, int number, double seconds, double step)
{
  Falls falls;
  double drifts = 0.0;
  for (int seed = 0; seed < number; ++seed)
  {
    const Fall fall = Drop(body, fluctuation, seed, seconds, step);
    falls.Speed += fall.Speed / number;
    falls.Level += fall.Level / number;
    falls.Tumblers += fall.Tumbles() ? 1.0 / number : 0.0;
    drifts += fall.Tumbles() ? fall.Drift / number : 0.0;
    falls.Flat += fall.Level > 0.9 ? 1 : 0;
  }
  falls.TumblersDrift = falls.Tumblers > 0.0 ? drifts / falls.Tumblers : 0.0;
  return falls;
}

void PrintRow(const Body& body, double fluctuation, const Falls& falls, const Falls& still)
{
  std::printf("| %s | %.0f | %.2f | %.2f | %.2f | %.2f | %.2f | %.0f |\n", body.Name.c_str(),
              body.Reynolds(), body.Inertia(), fluctuation / body.Speed, falls.Speed / still.Speed,
              falls.Level, falls.Tumblers, falls.TumblersDrift);
}
} // namespace

namespace
{

struct FallingDisc
{
  double Diameter, Aspect;
  int Number;
};

/// Tinklenberg, Guala, Coletti 2023, 2024: 0.3, 1 and 3 mm; in still air flat or tumbling, with a
/// drift below 20 degrees; in turbulent air slower by 10 to 35 %, and flat falls vanish.
void ExpectSlowerAndTumbling(const std::vector<FallingDisc>& discs)
{
  std::printf("| body | Re | I* | air over fall | fall over still | level | tumblers | drift |\n"
              "|---|---|---|---|---|---|---|---|\n");
  for (const auto& [diameter, aspect, number] : discs)
  {
    Body disc = Disc(diameter, aspect);
    const Falls still = DropAll(disc, 0.0, number, 2.0, 1e-3);
    const Falls mild = DropAll(disc, 0.1, number / 2, 2.0, 1e-3);
    const Falls strong = DropAll(disc, 0.6, number, 2.0, 1e-3);
    PrintRow(disc, 0.0, still, still);
    PrintRow(disc, 0.1, mild, still);
    PrintRow(disc, 0.6, strong, still);
    EXPECT_GT(strong.Speed, 0.65 * still.Speed) << disc.Name;
    EXPECT_LT(strong.Speed, 0.9 * still.Speed) << disc.Name;
    EXPECT_GT(still.Level, 0.15) << disc.Name;
    EXPECT_LT(mild.Level, 0.5 * still.Level) << disc.Name;
    EXPECT_LT(strong.Level, 0.08) << disc.Name; // 1 - cos(15 degrees) of poses by chance: 0.03
    EXPECT_GE(mild.Tumblers, still.Tumblers) << disc.Name;
    EXPECT_GE(strong.Tumblers, std::max(0.9, mild.Tumblers)) << disc.Name;
    EXPECT_LT(still.TumblersDrift, 20.0) << disc.Name;
    if (disc.Reynolds() > 20.0) // both ways of falling, by how it is let go
    {
      EXPECT_GE(still.Flat, 2) << disc.Name;
      EXPECT_GE(still.Tumblers, 0.25) << disc.Name;
    }
    else // smaller than any that tumbles
    {
      EXPECT_EQ(still.Flat, number) << disc.Name;
    }
  }
}

} // namespace

TEST(Nature, DiscsFallSlowerInTurbulentAirAndTumble)
{
  ExpectSlowerAndTumbling({ { 3e-3, 60.0, 32 } });
}

TEST(NatureByNight, DiscsFallSlowerInTurbulentAirAndTumble)
{
  ExpectSlowerAndTumbling({ { 1e-3, 40.0, 32 }, { 3e-4, 25.0, 64 } });
  // Beside them, without a bound: what scenes are made of.
  for (const char* name : { "leaf", "petal" })
  {
    Body leaf = BodyOf(name, 0.0);
    leaf.Size = 2.0 * std::sqrt(leaf.Prepared.Properties.Area / Pi);
    const Falls still = DropAll(leaf, 0.0, 12, 9.0, 0.01);
    PrintRow(leaf, 0.0, still, still);
    PrintRow(leaf, 0.5, DropAll(leaf, 0.5, 12, 9.0, 0.01), still);
  }
  std::printf("\n");
}

TEST(Nature, DiscsAreSteadySwingOrTumbleByReynoldsNumberAndInertia)
{
  // Field, Klaus, Moore, Nori 1997: steady at Reynolds numbers below some tens whatever the
  // inertia; above, swinging, with greater inertia more, and tumbling.
  std::printf(
    "| Re | I* | largest tilt | overturns by diameter | tumblers |\n|---|---|---|---|---|\n");
  for (const double reynolds : { 10.0, 200.0, 2000.0 })
  {
    double before = 0.0;
    for (const double inertia : { 0.003, 0.02, 0.1, 0.3, 1.0 })
    {
      constexpr int Number = 4;
      Body disc = DiscOf(reynolds, inertia);
      const double time = disc.Size / disc.Speed;
      double tilt = 0.0, overturns = 0.0;
      int tumblers = 0;
      for (int seed = 0; seed < Number; ++seed)
      {
        const Fall fall = Drop(disc, 0.0, seed, 200.0 * time, 0.2 * time);
        tilt += fall.Tilt / Number;
        overturns += fall.Overturns / Number;
        tumblers += fall.Tumbles() ? 1 : 0;
      }
      std::printf("| %.0f | %.3f | %.0f | %.2f | %d of %d |\n", reynolds, inertia, tilt, overturns,
                  tumblers, Number);
      if (reynolds < 100.0)
      {
        EXPECT_LT(tilt, 6.0) << inertia;
      }
      else if (inertia < 0.2)
      {
        EXPECT_EQ(tumblers, 0) << inertia;
        EXPECT_GT(tilt, before) << inertia;
      }
      else
      {
        EXPECT_GE(tumblers, Number / 2) << inertia;
      }
      before = tilt;
    }
  }
  std::printf("\n");
}
