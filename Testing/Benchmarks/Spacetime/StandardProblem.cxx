// SPDX-License-Identifier: BSD-3-Clause
#include "StandardProblem.h"

#include "Base/Random.h"
#include "Particles/GasLattice.h"

#include <cmath>
#include <vector>

namespace waft
{
namespace
{

constexpr double FramesPerSecond = 30.0;

struct Path
{
  Vec3 Marks[3];
  double Span; // s
  double Helix[4], Phases[2];
  double Amplitudes[3][3], HarmonicPhases[3][3];

  Vec3 Deviation(double t) const
  {
    Vec3 d(this->Helix[0] * std::cos(2.0 * M_PI * this->Helix[1] * t + this->Phases[0]),
           this->Helix[0] * std::sin(2.0 * M_PI * this->Helix[1] * t + this->Phases[0]),
           this->Helix[2] * std::sin(2.0 * M_PI * this->Helix[3] * t + this->Phases[1]));
    for (int c = 0; c < 3; ++c)
    {
      for (int k = 0; k < 3; ++k)
      {
        d[c] += this->Amplitudes[c][k] *
                std::sin(2.0 * M_PI * 0.8 * (k + 1) * t + this->HarmonicPhases[c][k]);
      }
    }
    return d;
  }

  static Vec3 Parabola(const Vec3 p[3], double s)
  {
    return 2.0 * (s - 0.5) * (s - 1.0) * p[0] - 4.0 * s * (s - 1.0) * p[1] +
           2.0 * s * (s - 0.5) * p[2];
  }

  // The deviations are removed at the three marks.
  Vec3 At(double t) const
  {
    const Vec3 ends[3] = { this->Deviation(0.0), this->Deviation(0.5 * this->Span),
                           this->Deviation(this->Span) };
    const double s = t / this->Span;
    return Parabola(this->Marks, s) + this->Deviation(t) - Parabola(ends, s);
  }
};

Path MakePath(int index, int count, double span, std::uint64_t seed)
{
  Random random(seed, static_cast<std::uint64_t>(index));
  Path path;
  path.Span = span;
  path.Marks[0] =
    Vec3(random.Uniform(0.25, 0.75), random.Uniform(0.25, 0.75), random.Uniform(0.65, 0.85));
  const double angle = 2.0 * M_PI * index / count;
  path.Marks[1] = Vec3(0.5 + 0.22 * std::cos(angle), 0.5 + 0.22 * std::sin(angle), 0.5);
  const int side = static_cast<int>(std::ceil(std::sqrt(double(count))));
  const auto along = [side](int k) { return side > 1 ? 0.25 + 0.5 * k / (side - 1) : 0.5; };
  path.Marks[2] = Vec3(along(index % side), along(index / side), 0.2);
  path.Helix[0] = random.Uniform(0.05, 0.1);
  path.Helix[1] = random.Uniform(0.25, 0.5);
  path.Helix[2] = random.Uniform(0.02, 0.05);
  path.Helix[3] = random.Uniform(0.25, 0.6);
  for (double& phase : path.Phases)
  {
    phase = random.Uniform(0.0, 2.0 * M_PI);
  }
  for (int c = 0; c < 3; ++c)
  {
    for (int k = 0; k < 3; ++k)
    {
      path.Amplitudes[c][k] = random.Uniform(0.0, 0.012);
      path.HarmonicPhases[c][k] = random.Uniform(0.0, 2.0 * M_PI);
    }
  }
  return path;
}

} // namespace

void StandardProblem::Build()
{
  const Box box{ Vec3::Zero(), Vec3::Ones() };
  const GasLattice lattice = GasLattice::Make(box, this->Gas);
  const double unit = lattice.Spacing;
  const double step = 1.0 / FramesPerSecond;
  this->Setup = SpacetimeSetup();
  SpacetimeModel& model = this->Setup.Model;
  model.Size = lattice.SizeInSpacings();
  model.NumberOfFrames = this->NumberOfFrames;
  const std::vector<Vec3> gas = lattice.Points();
  model.NumberOfGas = gas.size();
  model.NumberOfObjects = static_cast<std::size_t>(this->NumberOfObjects);
  model.Fluid.ObjectViscosity = 1.0;
  model.Fluid.GasMass = lattice.ParticleMass(model.Fluid);
  model.Fluid.ObjectMass = 0.1 * model.Fluid.GasMass;
  model.Rest.Build(lattice, model.Fluid);
  model.Weights.PositionWeight = 1.0;
  model.Weights.VelocityWeight = 1.0;
  model.Weights.CoherenceWeight = 0.1;
  model.Weights.ObjectCoherence = 1.0;
  model.Weights.ObjectPosition = 1.0;
  model.Weights.XsphFactor = 0.3;
  model.Weights.Clearance = 0.0;
  model.Weights.Contact = 0.0;
  for (int k = 0; k < this->ParticlesPerObject; ++k)
  {
    const double angle = 2.0 * M_PI * k / this->ParticlesPerObject;
    const double radius = this->ParticlesPerObject > 1 ? 0.3 : 0.0;
    model.Offsets.push_back({ static_cast<float>(radius * std::cos(angle)),
                              static_cast<float>(radius * std::sin(angle)), 0.0f });
  }
  model.Gravities.assign(model.NumberOfObjects, static_cast<float>(0.2 * step * step / unit));
  model.DragRates.assign(model.NumberOfObjects, 0.0f);
  model.Clearances.assign(model.NumberOfObjects, ClearanceRule(0.0, 0.0));
  const std::size_t no = model.NumberOfObjects;
  model.Flags.assign(static_cast<std::size_t>(this->NumberOfFrames) * no, 0);
  Random random(this->Seed, 1u << 20);
  for (int k = 0; k < 3; ++k)
  {
    Vortex vortex;
    const double x = random.Uniform(0.3, 0.7);
    const double y = random.Uniform(0.3, 0.7);
    vortex.P1 = Vec3(x, y, 0.15) / unit;
    vortex.P2 = Vec3(x, y, 0.85) / unit;
    vortex.Strength = (k % 2 ? -0.12 : 0.12) * step * step / (unit * unit);
    vortex.Duration = 2.0 * FramesPerSecond;
    vortex.CenterTime = (this->NumberOfFrames - 1) * (2 * k + 1) / 6.0;
    vortex.CoreRadius = 1.5;
    model.Fields.Vortices.push_back(vortex);
  }

  this->Setup.Table.Planned.resize(model.Flags.size());
  this->Setup.Table.FixedPositions.assign(model.Flags.size(), Vec3::Zero());
  this->Setup.Start.assign(static_cast<std::size_t>(this->NumberOfFrames) * model.FrameSize(),
                           0.0f);
  const double span = (this->NumberOfFrames - 1) * step;
  const std::size_t stride = model.Stride();
  for (int frame = 0; frame < this->NumberOfFrames; ++frame)
  {
    float* state = this->Setup.Start.data() + frame * model.FrameSize();
    for (std::size_t i = 0; i < gas.size(); ++i)
    {
      for (int c = 0; c < 3; ++c)
      {
        state[c * stride + i] = static_cast<float>(gas[i][c]);
      }
    }
  }
  for (std::size_t o = 0; o < no; ++o)
  {
    const Path path = MakePath(static_cast<int>(o), this->NumberOfObjects, span, this->Seed);
    for (int frame = 0; frame < this->NumberOfFrames; ++frame)
    {
      const double t = frame * step;
      const Vec3 x = path.At(t) / unit;
      const Vec3 v = (path.At(t) - path.At(t - step)) / unit;
      const std::size_t index = static_cast<std::size_t>(frame) * no + o;
      this->Setup.Table.Planned[index] = x;
      if (frame == 0 || 2 * frame == this->NumberOfFrames - 1 || frame == this->NumberOfFrames - 1)
      {
        this->Setup.Table.FixedPositions[index] = x;
        model.Flags[index] = FixedPosition;
      }
      float* state = this->Setup.Start.data() + frame * model.FrameSize() + gas.size() + o;
      for (int c = 0; c < 3; ++c)
      {
        state[c * stride] = static_cast<float>(x[c]);
        state[(3 + c) * stride] = static_cast<float>(v[c]);
      }
    }
  }
}

} // namespace waft
