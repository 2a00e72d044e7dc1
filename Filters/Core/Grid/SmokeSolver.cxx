// SPDX-License-Identifier: BSD-3-Clause
#include "Grid/SmokeSolver.h"

#include "Grid/SmokeInternals.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace waft
{

SmokeSolver::SmokeSolver() : Impl(std::make_unique<Internals>()) {}
SmokeSolver::~SmokeSolver() = default;
SmokeSolver::SmokeSolver(SmokeSolver&&) noexcept = default;
SmokeSolver& SmokeSolver::operator=(SmokeSolver&&) noexcept = default;

void SmokeSolver::Internals::Prepare()
{
  const SmokeOptions& options = this->Options;
  this->Layout = StaggeredLayout(options.Resolution);
  const Vec3 spacing = options.Spacing();
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Spacing[axis] = static_cast<float>(spacing[axis]);
    this->FirstCenter[axis] = static_cast<float>(options.Bounds.Min[axis] + 0.5 * spacing[axis]);
    const BoundaryKind kind = options.Boundary[axis];
    const EndKind end = kind == BoundaryKind::Closed ? EndKind::Wall
                        : kind == BoundaryKind::Open ? EndKind::Outside
                                                     : EndKind::Wrap;
    this->Ends[axis] = { end, end };
    if (axis == 2 && kind == BoundaryKind::Open && options.ClosedFloor)
    {
      this->Ends[axis][0] = EndKind::Wall;
    }
    for (int side = 0; side < 2; ++side)
    {
      const EndKind own = this->Ends[axis][side];
      this->DerivedEnds[axis][side] = own == EndKind::Outside ? EndKind::Wall : own;
    }
  }
  const std::size_t size = this->Layout.Size();
  for (std::array<FloatArray, 3>* field :
       { &this->NewVelocity, &this->Center, &this->Vorticity, &this->Acceleration })
  {
    for (FloatArray& component : *field)
    {
      component.assign(size, 0.0f);
    }
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Velocity[axis].assign(size, this->Outside(axis));
  }
  const bool goesBothWays = options.Advection == AdvectionScheme::MacCormack;
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Backwards[axis].assign(size, 0.0f);
    this->Forwards[axis].assign(goesBothWays ? size : 0, 0.0f);
  }
  for (FloatArray* field :
       { &this->Density, &this->Temperature, &this->VorticitySize, &this->NewScalar })
  {
    field->assign(size, 0.0f);
  }
  const std::size_t padded = PaddedCells(options.Resolution).Size();
  this->Potential.assign(padded, 0.0f);
  this->RightHandSide.assign(padded, 0.0f);
  this->PotentialStep = 0.0;
  this->Frame = -1;
  this->Time = 0.0;
  this->Statistics = SmokeStatistics();
  this->HasSmoke = !this->Forces.Emitters.empty();
  this->HasWarmth = std::any_of(this->Forces.Emitters.begin(), this->Forces.Emitters.end(),
                                [](const SmokeEmitter& e) { return e.Temperature != 0.0; });
}

void SmokeSolver::Internals::BuildSolids(const FloatArray& distances,
                                         const std::vector<std::array<float, 3>>& velocities)
{
  this->Solids.Build(this->Layout, this->Options, distances, velocities);
  const PaddedCells cells(this->Options.Resolution);
  std::array<FloatArray, 3> weights;
  std::array<bool, 3> periodic;
  for (int axis = 0; axis < 3; ++axis)
  {
    periodic[axis] = this->Options.Boundary[axis] == BoundaryKind::Periodic;
    weights[axis].assign(cells.Size(), 0.0f);
    const float scale = 1.0f / (this->Spacing[axis] * this->Spacing[axis]);
    for (int k = 0; k < this->Layout.Count(2, axis); ++k)
    {
      for (int j = 0; j < this->Layout.Count(1, axis); ++j)
      {
        for (int i = 0; i < this->Layout.Count(0, axis); ++i)
        {
          weights[axis][cells.Index(i, j, k)] =
            scale * this->Solids.Fractions(axis)[this->Layout.Index(i, j, k)];
        }
      }
    }
  }
  this->Pressure.Build(cells, std::move(weights), periodic);
  this->FinishVelocity();
}

Result SmokeSolver::Begin(const SmokeOptions& options, SmokeForces forces)
{
  if (Result valid = options.Validate(); !valid)
  {
    return valid;
  }
  if (Result valid = forces.Validate(); !valid)
  {
    return valid;
  }
  this->Impl->Options = options;
  this->Impl->Forces = std::move(forces);
  this->Impl->Prepare();
  this->Impl->BuildSolids({}, {});
  return Result::Ok();
}

void SmokeSolver::SetSteering(FieldSeries acceleration)
{
  this->Impl->Steering = std::move(acceleration);
}

Result SmokeSolver::SetSolids(const std::vector<float>& distances,
                              const std::vector<std::array<float, 3>>& velocities)
{
  const std::size_t nodes = this->Impl->Options.NumberOfNodes();
  if (this->Impl->Velocity[0].empty())
  {
    return Result::Error("Solids: the solver has not begun");
  }
  if (!distances.empty() && distances.size() != nodes)
  {
    return Result::Error("Solids: " + std::to_string(distances.size()) +
                         " distances, expected one at each of the " + std::to_string(nodes) +
                         " nodes");
  }
  if (!velocities.empty() && velocities.size() != distances.size())
  {
    return Result::Error("Solids: " + std::to_string(velocities.size()) +
                         " velocities, expected as many as distances or none");
  }
  for (const float d : distances)
  {
    if (!std::isfinite(d))
    {
      return Result::Error("Solids: a distance is not finite");
    }
  }
  this->Impl->BuildSolids(distances, velocities);
  return Result::Ok();
}

Result SmokeSolver::Step(const ParallelFor& threads, Monitor& monitor)
{
  Internals& s = *this->Impl;
  if (s.Velocity[0].empty())
  {
    return Result::Error("The solver has not begun");
  }
  SmokeState& before = s.Before;
  this->Save(before);
  // Threads hear later of a loop over a small grid than it takes.
  const bool isSmall = s.Options.NumberOfCells() < FewestCellsForThreads;
  const ParallelFor parallelFor = isSmall ? SerialFor() : threads;
  s.Statistics = SmokeStatistics();
  const double frame = 1.0 / s.Options.FramesPerSecond;
  int steps = 1;
  double start = s.Time;
  if (s.Frame < 0)
  {
    steps = static_cast<int>(std::lround(s.Options.WarmUpSeconds / frame));
    start = -steps * frame;
  }
  for (int step = 0; step < steps; ++step)
  {
    const double fraction = static_cast<double>(step) / steps;
    const auto goOn = [&] { return monitor.Tick(fraction, "Moving the air"); };
    if (!s.Advance(start + step * frame, frame, parallelFor, goOn))
    {
      if (Result restored = this->Restore(before); !restored)
      {
        return restored;
      }
      return Result::Stopped();
    }
  }
  ++s.Frame;
  s.Time = s.Frame * frame;
  if (!std::isfinite(s.LargestSpeed()))
  {
    return Result::Error("The air's velocity is not finite at frame " + std::to_string(s.Frame));
  }
  return Result::Ok();
}

int SmokeSolver::Frame() const
{
  return this->Impl->Frame;
}
double SmokeSolver::Time() const
{
  return this->Impl->Time;
}
const SmokeOptions& SmokeSolver::Options() const
{
  return this->Impl->Options;
}
const SmokeForces& SmokeSolver::Forces() const
{
  return this->Impl->Forces;
}
const SmokeStatistics& SmokeSolver::Statistics() const
{
  return this->Impl->Statistics;
}

SmokeState SmokeSolver::Save() const
{
  SmokeState state;
  this->Save(state);
  return state;
}

void SmokeSolver::Save(SmokeState& state) const
{
  const Internals& s = *this->Impl;
  state.Frame = s.Frame;
  state.Time = s.Time;
  state.PotentialStep = s.PotentialStep;
  state.Arrays.resize(6);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    state.Arrays[axis] = s.Velocity[axis];
  }
  state.Arrays[3] = s.Potential;
  state.Arrays[4] = s.HasSmoke ? s.Density : FloatArray();
  state.Arrays[5] = s.HasWarmth ? s.Temperature : FloatArray();
}

Result SmokeSolver::Restore(const SmokeState& state)
{
  Internals& s = *this->Impl;
  if (state.Arrays.size() != 6 || state.Arrays[0].size() != s.Velocity[0].size() ||
      state.Arrays[3].size() != s.Potential.size() || state.Arrays[0].empty())
  {
    return Result::Error("The state is not one of this grid");
  }
  s.Frame = state.Frame;
  s.Time = state.Time;
  s.PotentialStep = state.PotentialStep;
  for (int axis = 0; axis < 3; ++axis)
  {
    s.Velocity[axis] = state.Arrays[axis];
  }
  s.Potential = state.Arrays[3];
  s.HasSmoke = !state.Arrays[4].empty();
  s.HasWarmth = !state.Arrays[5].empty();
  if (s.HasSmoke)
  {
    s.Density = state.Arrays[4];
  }
  if (s.HasWarmth)
  {
    s.Temperature = state.Arrays[5];
  }
  return Result::Ok();
}

} // namespace waft
