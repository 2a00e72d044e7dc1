// SPDX-License-Identifier: BSD-3-Clause
#include "EddiesRun.h"

#include "Particles/GasLattice.h"
#include "Particles/SphSurfaces.h"
#include "Spacetime/Scene/Rollout.h"
#include "StandardProblem.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

namespace waft
{
namespace
{

constexpr double FrameRate = 30.0;
constexpr double Spacing = 0.3;    // m: 2500 particles in 4 x 4 x 4 m
constexpr double Speed = 0.05;     // of the vortices [dx / frame]: 0.45 m/s
constexpr int Frames = 16;         // of a state; it is run on from its last one
constexpr double LongestRun = 8.5; // s
constexpr int FramesAtRest = 1000;
constexpr std::size_t NodesPerSpacing = 4;

/// Vortices in a box of gas whose walls they run along, or a shear wave.
struct Eddies
{
  double Length = 6.0; // of the wave [dx]
  int Side = 12;       // of the box [dx]: whole half waves

  double WaveNumber() const { return 2.0 * M_PI / this->Length; }
  Vec3 Vortices(const Vec3& x) const
  {
    const double k = this->WaveNumber();
    return Speed * Vec3(std::sin(k * x.x()) * std::cos(k * x.y()),
                        -std::cos(k * x.x()) * std::sin(k * x.y()), 0.0);
  }
  Vec3 Shear(const Vec3& x) const
  {
    return { Speed * std::cos(this->WaveNumber() * x.z()), 0.0, 0.0 };
  }
};

SpacetimeSetup MakeGas(const Eddies& eddies, const EddyGas& kind)
{
  StandardProblem problem;
  problem.Gas = { eddies.Side, eddies.Side, eddies.Side };
  problem.NumberOfObjects = 0;
  problem.NumberOfFrames = Frames;
  problem.Build();
  SpacetimeModel& model = problem.Setup.Model;
  model.Fields.Vortices.clear();
  const GasLattice lattice = GasLattice::Make({ Vec3::Zero(), Vec3::Ones() }, problem.Gas);
  model.Fluid.Viscosity = kind.Viscosity;
  model.Fluid.SmoothingLength = kind.SmoothingLength;
  model.Fluid.SoundSpeed = kind.CourantNumber * kind.SmoothingLength;
  model.Fluid.GasMass = lattice.ParticleMass(model.Fluid);
  model.Rest.Build(lattice, model.Fluid);
  return std::move(problem.Setup);
}

Vec3 RowOf(const float* rows, std::size_t stride, std::size_t i)
{
  return { rows[i], rows[stride + i], rows[2 * stride + i] };
}

// nu = - a.u / (k^2 u.u) of the gas farther from the walls than a kernel reaches, on the lattice
// [dx^2 / frame].
double ShearViscosity(const Eddies& eddies, const EddyGas& kind)
{
  const SpacetimeSetup setup = MakeGas(eddies, kind);
  const SpacetimeModel& model = setup.Model;
  const std::size_t stride = model.Stride();
  StateVector state = setup.Start;
  for (std::size_t i = 0; i < model.NumberOfGas; ++i)
  {
    state[3 * stride + i] = static_cast<float>(eddies.Shear(RowOf(state.data(), stride, i)).x());
  }
  const TimeLevel level = TimeLevel::Full(Frames, 1);
  SpacetimeObjective objective(model, model.Fields, level, SerialFor(), FastestSphKernels(), false);
  FrameTerms& terms = objective.ForwardFrame(state, 0);
  double work = 0.0, energy = 0.0;
  for (std::size_t i = 0; i < model.NumberOfGas; ++i)
  {
    const Vec3 x = RowOf(state.data(), stride, i);
    const double wall = std::min(x.minCoeff(), (model.Size - x).minCoeff());
    if (wall > model.Fluid.Support())
    {
      const double u = state[3 * stride + i];
      work += terms.Acceleration(0)[i] * u;
      energy += u * u;
    }
  }
  return -work / (eddies.WaveNumber() * eddies.WaveNumber() * energy);
}

FieldSeries AirOf(const Eddies& eddies)
{
  const auto count = static_cast<int>(NodesPerSpacing) * eddies.Side + 1;
  FieldSeries air;
  air.Meaning = FieldMeaning::Velocity;
  air.Dimensions = { count, count, 2 };
  const double step = Spacing / NodesPerSpacing;
  air.Spacing = Vec3(step, step, Spacing * eddies.Side);
  air.Times = { 0.0 };
  air.Values.emplace_back();
  const double unit = Spacing * FrameRate;
  for (int n = 0; n < count * count * 2; ++n)
  {
    const Vec3 x(n % count, n / count % count, 0.0);
    const Vec3 u = unit * eddies.Vortices(x / NodesPerSpacing);
    air.Values.back().push_back({ static_cast<float>(u.x()), static_cast<float>(u.y()), 0.0f });
  }
  return air;
}

struct Decay
{
  double Half = -1.0; // s until the vortices have half their energy; -1: later
  double AfterThree = 0.0, AfterEight = 0.0; // shares of it, means of the second about that time
};

// The energy is that of the gas' velocity along the vortices', where the gas is.
double EnergyOf(const Eddies& eddies, const SpacetimeModel& model, const float* state)
{
  const std::size_t stride = model.Stride();
  double along = 0.0, all = 0.0;
  for (std::size_t i = 0; i < model.NumberOfGas; ++i)
  {
    const Vec3 u = eddies.Vortices(RowOf(state, stride, i));
    along += u.dot(RowOf(state + 3 * stride, stride, i));
    all += u.squaredNorm();
  }
  return all > 0.0 ? std::pow(std::max(0.0, along / all), 2) : 0.0;
}

/// The gas run forward; as many frames as are kept are over, it goes on from the last one.
class Forward
{
public:
  Forward(const SpacetimeSetup& setup, double walls) :
    Model(setup.Model), Level(TimeLevel::Full(Frames, 1)), State(setup.Start),
    Objective(Model, Model.Fields, Level, SerialFor(), FastestSphKernels(), false),
    Spared(2.0 - walls)
  {
  }
  float* Here() { return this->State.data() + this->Frame * this->Model.FrameSize(); }

  /// The next frame's state.
  const float* Step()
  {
    const std::size_t stride = this->Model.Stride();
    if (this->Frame + 1 == Frames)
    {
      std::copy_n(this->Here(), this->Model.FrameSize(), this->State.begin());
      this->Frame = 0;
    }
    FrameTerms& terms = this->Objective.ForwardFrame(this->State, this->Frame);
    const std::vector<FrameTerms::AirAt> air = terms.Air();
    const float* here = this->Here();
    float* next = this->Here() + this->Model.FrameSize();
    SphVolume volume(this->Model.Size);
    volume.Rest = &this->Model.Rest;
    for (std::size_t i = 0; i < this->Model.NumberOfGas; ++i)
    {
      const Vec3 x = RowOf(here, stride, i);
      const double p = air[i].Pressure / (air[i].Density * air[i].Density);
      const Vec3 pull = this->Spared * p * SurfaceDensity(this->Model.Fluid, volume, x).Gradient;
      const Vec3 v = NextVelocity(this->Model, this->Level, terms, this->Frame, i, x,
                                  RowOf(here + 3 * stride, stride, i), pull);
      MoveBody(this->Model, i, 1.0, x, v, next);
    }
    ++this->Frame;
    return next;
  }

private:
  const SpacetimeModel& Model;
  TimeLevel Level;
  StateVector State;
  SpacetimeObjective Objective;
  double Spared; // of the walls' force as the model has it
  std::size_t Frame = 0;
};

// How far the farthest of the lattice is from where it was at rest [dx].
double MovedAtRest(const Eddies& eddies, const EddyGas& kind)
{
  const SpacetimeSetup setup = MakeGas(eddies, kind);
  const SpacetimeModel& model = setup.Model;
  const std::size_t stride = model.Stride();
  Forward run(setup, kind.Walls);
  const float* last = run.Here();
  for (int frame = 0; frame < FramesAtRest; ++frame)
  {
    last = run.Step();
  }
  double moved = 0.0;
  for (std::size_t i = 0; i < model.NumberOfGas; ++i)
  {
    const Vec3 x = RowOf(setup.Start.data(), stride, i);
    moved = std::max(moved, (RowOf(last, stride, i) - x).norm());
  }
  return moved;
}

Decay RunVortices(const Eddies& eddies, const EddyGas& kind, bool isDrawn)
{
  SpacetimeSetup setup = MakeGas(eddies, kind);
  SpacetimeModel& model = setup.Model;
  const FieldSeries air = AirOf(eddies);
  if (isDrawn)
  {
    model.Air = GivenAir(air, Vec3::Zero(), Spacing, 1.0 / FrameRate, model.NumberOfGas, {}, {});
    model.AirDrag = static_cast<float>(SpacetimeOptions().AirDrag / FrameRate);
  }
  const std::size_t stride = model.Stride();
  Forward run(setup, kind.Walls);
  float* first = run.Here();
  for (std::size_t i = 0; i < model.NumberOfGas; ++i)
  {
    const Vec3 u = eddies.Vortices(RowOf(first, stride, i));
    for (std::size_t c = 0; c < 3; ++c)
    {
      first[(3 + c) * stride + i] = static_cast<float>(u[static_cast<int>(c)]);
    }
  }
  Decay decay;
  for (int frame = 1; frame <= static_cast<int>(LongestRun * FrameRate); ++frame)
  {
    const double energy = EnergyOf(eddies, model, run.Step());
    const double time = frame / FrameRate;
    decay.Half = decay.Half < 0.0 && energy < 0.5 ? time : decay.Half;
    decay.AfterThree += std::abs(time - 3.0) <= 0.5 ? energy / (FrameRate + 1.0) : 0.0;
    decay.AfterEight += std::abs(time - 8.0) <= 0.5 ? energy / (FrameRate + 1.0) : 0.0;
  }
  return decay;
}

} // namespace

int RunEddies(const EddyGas& kind)
{
  std::printf(
    "gas of %.2f m between particles, %.0f frames a second, viscosity %.2f, smoothing length %.2f "
    "dx, Courant number %.2f, walls %.1f\n\n"
    "| wave, dx | m | shear wave: nu, m^2/s | at rest, moved after %d frames, dx | vortices of gas "
    "alone: half after, s | left after 3 s, 8 s | of a sampled air: left after 3 s, 8 s |\n"
    "|---|---|---|---|---|---|---|\n",
    Spacing, FrameRate, kind.Viscosity, kind.SmoothingLength, kind.CourantNumber, kind.Walls,
    FramesAtRest);
  const double unit = Spacing * Spacing * FrameRate;
  for (const Eddies& eddies : { Eddies{ 4.0, 12 }, Eddies{ 6.0, 12 }, Eddies{ 10.0, 10 } })
  {
    const Decay alone = RunVortices(eddies, kind, false);
    const Decay drawn = RunVortices(eddies, kind, true);
    std::printf("| %.0f | %.1f | %.4f | %.2g | %s%.1f | %.2f, %.2f | %.2f, %.2f |\n", eddies.Length,
                Spacing * eddies.Length, unit * ShearViscosity(eddies, kind),
                MovedAtRest(eddies, kind), alone.Half > 0.0 ? "" : "> ",
                alone.Half > 0.0 ? alone.Half : LongestRun, alone.AfterThree, alone.AfterEight,
                drawn.AfterThree, drawn.AfterEight);
    std::fflush(stdout);
  }
  return 0;
}

} // namespace waft
