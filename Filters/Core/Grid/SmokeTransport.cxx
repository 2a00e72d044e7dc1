// SPDX-License-Identifier: BSD-3-Clause
// How the air carries itself and the smoke, and how it is kept free of divergence.
#include "Grid/AdvectionKernels.h"
#include "Grid/SmokeInternals.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

namespace waft
{
namespace
{

/// Less smoke or warmth than this is none: denormal numbers are slow.
constexpr float Nothing = 1e-12f;

double Seconds()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

} // namespace

void SmokeSolver::Internals::Trace(double dt, const ParallelFor& parallelFor,
                                   std::array<FloatArray, 3>& displacement) const
{
  CarrierFlow flow;
  flow.Layout = &this->Layout;
  flow.Ends = this->Ends;
  flow.Velocity = ConstPointers(this->Velocity);
  for (int axis = 0; axis < 3; ++axis)
  {
    flow.Scale[axis] = static_cast<float>(dt) / this->Spacing[axis];
  }
  const VectorArrays out = Pointers(displacement);
  ForPlanes(parallelFor, this->Layout.N[2], [&](int k) { TracePlane(flow, k, out); });
  for (float* component : out)
  {
    FillGhosts(this->Layout, this->DerivedEnds, -1, component);
  }
}

void SmokeSolver::Internals::Advect(int faceAxis, const FloatArray& source, FloatArray& target,
                                    const ParallelFor& parallelFor)
{
  const StaggeredLayout& layout = this->Layout;
  const AdvectionScheme scheme = this->Options.Advection;
  const int count = layout.Count(0, faceAxis);
  const int rows = layout.Count(1, faceAxis);
  const int planes = layout.Count(2, faceAxis);
  const auto forEachRow = [&](const std::array<FloatArray, 3>& displacement, const auto& body)
  {
    const ConstVectorArrays d = ConstPointers(displacement);
    parallelFor(static_cast<std::size_t>(planes),
                [&](std::size_t begin, std::size_t end)
                {
                  FootRow feet;
                  feet.Resize(count);
                  for (int k = static_cast<int>(begin); k < static_cast<int>(end); ++k)
                  {
                    for (int j = 0; j < rows; ++j)
                    {
                      FindFeet(layout, this->Ends, d, faceAxis, j, k, feet);
                      body(layout.Index(0, j, k), feet);
                    }
                  }
                });
  };
  forEachRow(this->Backwards,
             [&](std::ptrdiff_t row, const FootRow& feet)
             {
               const bool cubic = scheme == AdvectionScheme::MonotoneCubic;
               (cubic ? SampleCubicRow : SampleLinearRow)(layout, source.data(), row, feet, count,
                                                          target.data() + row);
             });
  if (scheme != AdvectionScheme::MacCormack)
  {
    return;
  }
  FillGhosts(layout, this->Ends, faceAxis, target.data(), this->Outside(faceAxis));
  this->Returned.resize(layout.Size());
  forEachRow(
    this->Forwards, [&](std::ptrdiff_t row, const FootRow& feet)
    { SampleLinearRow(layout, target.data(), row, feet, count, this->Returned.data() + row); });
  forEachRow(this->Backwards,
             [&](std::ptrdiff_t row, const FootRow& feet)
             {
               CorrectMacCormackRow(layout, source.data(), row, feet, count, target.data() + row,
                                    this->Returned.data() + row, target.data() + row);
             });
}

double SmokeSolver::Internals::Energy(const std::array<FloatArray, 3>& faces,
                                      const ParallelFor& parallelFor) const
{
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    std::vector<double> planes(this->Layout.Count(2, axis));
    ForPlanes(parallelFor, this->Layout.Count(2, axis),
              [&](int k)
              {
                planes[k] =
                  EnergyPlane(this->Layout, axis, this->Solids.Fractions(axis).data(),
                              faces[axis].data(), this->Ends[axis][0] == EndKind::Wrap, k);
              });
    sum = std::accumulate(planes.begin(), planes.end(), sum);
  }
  return 0.5 * sum * this->Options.Spacing().prod();
}

void SmokeSolver::Internals::AdvectVelocity(double dt, const ParallelFor& parallelFor)
{
  this->Trace(dt, parallelFor, this->Backwards);
  if (this->Options.Advection == AdvectionScheme::MacCormack)
  {
    this->Trace(-dt, parallelFor, this->Forwards);
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Advect(axis, this->Velocity[axis], this->NewVelocity[axis], parallelFor);
  }
  // Transport alone makes no energy but what a breeze brings. The limited MacCormack scheme may
  // make a little; that is taken back, so that without forces the energy never grows (the
  // projection only removes some).
  const double before = this->Energy(this->Velocity, parallelFor);
  const double after = this->Energy(this->NewVelocity, parallelFor);
  if (after > before && this->Options.Breeze.isZero())
  {
    const float scale = static_cast<float>(std::sqrt(before / after));
    for (FloatArray& component : this->NewVelocity)
    {
      for (float& value : component)
      {
        value *= scale;
      }
    }
  }
}

void SmokeSolver::Internals::FinishScalar(FloatArray& values) const
{
  if (this->Solids.HasSolids())
  {
    this->Solids.ExtendCells(values.data());
  }
  FillGhosts(this->Layout, this->Ends, -1, values.data());
}

void SmokeSolver::Internals::AdvectScalars(double time, double dt, const ParallelFor& parallelFor)
{
  const float kept = static_cast<float>(std::exp(-this->Options.Dissipation * dt));
  const auto carry = [&](FloatArray& values)
  {
    this->Advect(-1, values, this->NewScalar, parallelFor);
    std::swap(values, this->NewScalar);
    for (float& value : values)
    {
      const float left = value * kept;
      value = std::abs(left) < Nothing ? 0.0f : left;
    }
  };
  if (this->HasSmoke)
  {
    carry(this->Density);
  }
  if (this->HasWarmth)
  {
    carry(this->Temperature);
  }
  this->Emit(time);
  if (this->HasSmoke)
  {
    this->FinishScalar(this->Density);
  }
  if (this->HasWarmth)
  {
    this->FinishScalar(this->Temperature);
  }
}

void SmokeSolver::Internals::FinishVelocity()
{
  if (this->Solids.HasSolids())
  {
    this->Solids.ExtendVelocities(Pointers(this->Velocity));
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    FillGhosts(this->Layout, this->Ends, axis, this->Velocity[axis].data(), this->Outside(axis));
  }
}

bool SmokeSolver::Internals::Project(double dt, const ParallelFor& parallelFor,
                                     const std::function<bool()>& goOn)
{
  const StaggeredLayout& layout = this->Layout;
  const PaddedCells& cells = this->Pressure.Cells();
  const ConstVectorArrays fractions = { this->Solids.Fractions(0).data(),
                                        this->Solids.Fractions(1).data(),
                                        this->Solids.Fractions(2).data() };
  const ConstVectorArrays faces = ConstPointers(this->Velocity);
  const FloatArray& swept = this->Solids.SolidDivergence();
  ForPlanes(parallelFor, layout.N[2],
            [&](int k)
            {
              DivergencePlane(layout, this->Spacing, faces, fractions, cells,
                              this->RightHandSide.data(), k);
              for (int j = 0; !swept.empty() && j < layout.N[1]; ++j)
              {
                for (int i = 0; i < layout.N[0]; ++i)
                {
                  this->RightHandSide[cells.Index(i, j, k)] -= swept[layout.Index(i, j, k)];
                }
              }
            });
  if (this->PotentialStep > 0.0 && this->PotentialStep != dt)
  {
    const float ratio = static_cast<float>(dt / this->PotentialStep);
    for (float& value : this->Potential)
    {
      value *= ratio;
    }
  }
  this->PotentialStep = dt;
  // Against the time of a frame, the longest step: a little below what is promised, for rounding.
  const double step = 1.0 / this->Options.FramesPerSecond;
  const float tolerance = static_cast<float>(0.9 * this->Options.Tolerance / step);
  const PressureOutcome outcome =
    this->Pressure.Solve(this->RightHandSide, this->Potential, tolerance,
                         this->Options.MaximumIterations, parallelFor, goOn);
  this->Pressure.FillGhosts(this->Potential);
  for (int axis = 0; axis < 3; ++axis)
  {
    ForPlanes(parallelFor, layout.Count(2, axis),
              [&](int k)
              {
                ProjectPlane(layout, axis, this->Spacing[axis], fractions[axis], cells,
                             this->Potential.data(), this->Velocity[axis].data(), k);
              });
  }
  this->Statistics.PressureIterations += outcome.Iterations;
  this->Statistics.Divergence = outcome.LargestResidual * step;
  return !outcome.Stopped;
}

bool SmokeSolver::Internals::Substep(double start, double dt, const ParallelFor& parallelFor,
                                     const std::function<bool()>& goOn)
{
  const double begin = Seconds();
  for (FloatArray& component : this->Acceleration)
  {
    std::fill(component.begin(), component.end(), 0.0f);
  }
  const double middle = start + 0.5 * dt;
  this->ComputeCenters(parallelFor, this->Center);
  this->AddVortices(middle, parallelFor, Pointers(this->Acceleration));
  this->AddWinds(middle, dt, parallelFor, ConstPointers(this->Center),
                 Pointers(this->Acceleration));
  this->AddConfinementAndBuoyancy(parallelFor);
  const double forced = Seconds();

  this->AdvectVelocity(dt, parallelFor);
  this->AdvectScalars(start + dt, dt, parallelFor);
  const double advected = Seconds();
  if (!goOn())
  {
    return false;
  }

  std::swap(this->Velocity, this->NewVelocity);
  for (int axis = 0; axis < 3; ++axis)
  {
    FillGhosts(this->Layout, this->DerivedEnds, -1, this->Acceleration[axis].data());
    ForPlanes(parallelFor, this->Layout.Count(2, axis),
              [&](int k)
              {
                AccelerateFacesPlane(this->Layout, axis, static_cast<float>(dt),
                                     this->Acceleration[axis].data(), this->Velocity[axis].data(),
                                     k);
              });
  }
  const double accelerated = Seconds();
  const bool whole = this->Project(dt, parallelFor, goOn);
  const double projected = Seconds();
  this->FinishVelocity();
  this->Statistics.ForceSeconds += (forced - begin) + (accelerated - advected);
  this->Statistics.AdvectionSeconds += (advected - forced) + (Seconds() - projected);
  this->Statistics.PressureSeconds += projected - accelerated;
  return whole;
}

double SmokeSolver::Internals::LargestSpeed() const
{
  float largest = 0.0f;
  for (int axis = 0; axis < 3; ++axis)
  {
    const float size =
      LargestSize(this->Velocity[axis].data(), this->Velocity[axis].size()) / this->Spacing[axis];
    if (!std::isfinite(size)) // std::max passes over what is no number
    {
      return size;
    }
    largest = std::max(largest, size);
  }
  return largest;
}

bool SmokeSolver::Internals::Advance(double start, double duration, const ParallelFor& parallelFor,
                                     const std::function<bool()>& goOn)
{
  const double wanted = this->LargestSpeed() * duration / this->Options.CourantNumber;
  const int most = this->Options.MaximumSubsteps; // also where the speed is not finite
  const int substeps = wanted < most ? std::max(1, static_cast<int>(std::ceil(wanted))) : most;
  this->Statistics.Substeps += substeps;
  const double dt = duration / substeps;
  for (int s = 0; s < substeps; ++s)
  {
    if (!this->Substep(start + s * dt, dt, parallelFor, goOn))
    {
      return false;
    }
    if (substeps == most && !std::isfinite(this->LargestSpeed()))
    {
      return true; // nowhere to trace to; the frame's end tells
    }
  }
  return true;
}

} // namespace waft
