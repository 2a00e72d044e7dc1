// SPDX-License-Identifier: BSD-3-Clause
#include "Trajectory/TrajectoryTracer.h"

#include <algorithm>
#include <cmath>

namespace waft
{

namespace
{

using Samples = std::vector<std::array<float, 3>>;

/// The eight lattice points around x and their weights; clamped to the lattice.
struct Stencil
{
  Stencil(const PointLattice& lattice, const Vec3& x)
  {
    std::size_t stride = 1;
    std::array<std::array<std::size_t, 2>, 3> offsets;
    std::array<std::array<double, 2>, 3> weights;
    for (int axis = 0; axis < 3; ++axis)
    {
      const int last = lattice.Dimensions[axis] - 1;
      const double cell = std::clamp((x[axis] - lattice.Origin[axis]) / lattice.Spacing[axis], 0.0,
                                     static_cast<double>(last));
      const int low = std::min(static_cast<int>(cell), std::max(last - 1, 0));
      const int high = std::min(low + 1, last);
      offsets[axis] = { low * stride, high * stride };
      weights[axis] = { 1.0 - (cell - low), cell - low };
      stride *= static_cast<std::size_t>(lattice.Dimensions[axis]);
    }
    for (int corner = 0; corner < 8; ++corner)
    {
      const int i = corner & 1;
      const int j = (corner >> 1) & 1;
      const int k = corner >> 2;
      this->Points[corner] = offsets[0][i] + offsets[1][j] + offsets[2][k];
      this->Weights[corner] = weights[0][i] * weights[1][j] * weights[2][k];
    }
  }

  Vec3 Mean(const Samples& samples) const
  {
    Vec3 sum = Vec3::Zero();
    for (int corner = 0; corner < 8; ++corner)
    {
      const std::array<float, 3>& value = samples[this->Points[corner]];
      sum += this->Weights[corner] * Vec3(value[0], value[1], value[2]);
    }
    return sum;
  }

  std::array<std::size_t, 8> Points;
  std::array<double, 8> Weights;
};

/// Linear in time between two frames; before the first of two, the second alone.
double TimeFraction(const FlowFrame& before, const FlowFrame& now, double time)
{
  const double length = now.Time - before.Time;
  return length > 0.0 ? std::clamp((time - before.Time) / length, 0.0, 1.0) : 1.0;
}

Vec3 Blend(const Stencil& stencil, const Samples& before, const Samples& now, double fraction)
{
  if (fraction >= 1.0 || before.size() != now.size())
  {
    return stencil.Mean(now);
  }
  return (1.0 - fraction) * stencil.Mean(before) + fraction * stencil.Mean(now);
}

bool AllFinite(const Samples& samples)
{
  // The sum of the magnitudes of finite floats is a finite double.
  double sum = 0.0;
  for (const std::array<float, 3>& value : samples)
  {
    sum += std::abs(double(value[0])) + std::abs(double(value[1])) + std::abs(double(value[2]));
  }
  return std::isfinite(sum);
}

} // namespace

Result TraceOptions::Validate() const
{
  WAFT_RETURN_IF_FAILED(ValidateFields<TraceOptions>(*this));
  if (!(this->FramesPerSecond > 0.0) || !std::isfinite(this->FramesPerSecond))
  {
    return Result::Error("FramesPerSecond: expected a positive number");
  }
  if (!(this->Volume.Size().minCoeff() > 0.0) || !this->Volume.Size().allFinite())
  {
    return Result::Error("Volume: expected a box with positive sides");
  }
  return this->Annotation.Validate();
}

Result TrajectoryTracer::Begin(const PointLattice& lattice, const TraceOptions& options,
                               std::vector<Vortex> vortices, SolidTest isSolid)
{
  if (Result result = options.Validate(); !result)
  {
    return result;
  }
  if (*std::min_element(lattice.Dimensions.begin(), lattice.Dimensions.end()) < 1 ||
      !(lattice.Spacing.minCoeff() > 0.0) || !lattice.Origin.allFinite())
  {
    return Result::Error(
      "flow: expected a lattice with points along each axis and positive spacing");
  }
  *this = TrajectoryTracer();
  this->Lattice = lattice;
  this->Options = options;
  this->Law = BodyLaw::Sinking(options.SettlingSpeed);
  this->Vortices = std::move(vortices);
  this->IsSolid = std::move(isSolid);
  return Result::Ok();
}

void TrajectoryTracer::SpreadSeeds()
{
  std::array<std::vector<int>, 3> indices;
  const int stride = this->Options.SeedStride;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int points = this->Lattice.Dimensions[axis];
    const int count = std::max(1, points / stride);
    const int first = (points - 1 - (count - 1) * stride) / 2;
    for (int i = 0; i < count; ++i)
    {
      indices[axis].push_back(first + i * stride);
    }
  }
  for (const int k : indices[2])
  {
    for (const int j : indices[1])
    {
      for (const int i : indices[0])
      {
        Tracer tracer;
        tracer.Position = this->Lattice.Origin + Vec3(i, j, k).cwiseProduct(this->Lattice.Spacing);
        tracer.Path.ObjectId = static_cast<int>(this->Tracers.size());
        if (this->CanBeAt(tracer.Position, this->StartTime))
        {
          this->Tracers.push_back(std::move(tracer));
        }
      }
    }
  }
}

Result TrajectoryTracer::CheckFrame(const FlowFrame& frame) const
{
  const std::string location = "flow at " + std::to_string(frame.Time) + " s: ";
  const std::size_t points = this->Lattice.NumberOfPoints();
  if (frame.Velocity.size() != points ||
      (!frame.VortexForce.empty() && frame.VortexForce.size() != points) ||
      (!frame.WindForce.empty() && frame.WindForce.size() != points))
  {
    return Result::Error(location + "expected " + std::to_string(points) + " values in each array");
  }
  if (this->HasFrame && !(frame.Time > this->Now.Time))
  {
    return Result::Error(location + "expected a time after " + std::to_string(this->Now.Time) +
                         " s");
  }
  if (!AllFinite(frame.Velocity))
  {
    return Result::Error(location + "Velocity holds a value that is not finite");
  }
  if (!AllFinite(frame.VortexForce) || !AllFinite(frame.WindForce))
  {
    return Result::Error(location + "VortexForce or WindForce holds a value that is not finite");
  }
  return Result::Ok();
}

Result TrajectoryTracer::Feed(FlowFrame frame, const ParallelFor& parallelFor)
{
  if (Result result = this->CheckFrame(frame); !result)
  {
    return result;
  }
  if (!this->HasFrame)
  {
    this->StartTime = frame.Time;
    this->Now = std::move(frame);
    this->Before.Time = this->Now.Time;
    this->HasFrame = true;
    this->SpreadSeeds();
    for (Tracer& tracer : this->Tracers)
    {
      this->Record(tracer, this->StartTime);
    }
    this->NextSample = 1;
    return Result::Ok();
  }
  this->Before = std::move(this->Now);
  this->Now = std::move(frame);
  parallelFor(this->Tracers.size(),
              [this](std::size_t begin, std::size_t end)
              {
                for (std::size_t i = begin; i < end; ++i)
                {
                  if (this->Tracers[i].IsLiving)
                  {
                    this->Advance(this->Tracers[i]);
                  }
                }
              });
  const double elapsed = (this->Now.Time - this->StartTime) * this->Options.FramesPerSecond;
  this->NextSample = static_cast<int>(std::floor(elapsed + 1e-6)) + 1;
  return Result::Ok();
}

void TrajectoryTracer::Advance(Tracer& tracer) const
{
  const double step = 1.0 / this->Options.FramesPerSecond;
  double time = this->Before.Time;
  for (int sample = this->NextSample; tracer.IsLiving; ++sample)
  {
    const double next = this->StartTime + sample * step;
    const bool isSample = next <= this->Now.Time + 1e-6 * step;
    const double end = isSample ? std::min(next, this->Now.Time) : this->Now.Time;
    if (end > time)
    {
      tracer.Position = this->Step(tracer.Position, time, end - time);
      tracer.IsLiving = this->CanBeAt(tracer.Position, end);
      time = end;
    }
    if (!isSample)
    {
      return;
    }
    if (tracer.IsLiving)
    {
      this->Record(tracer, end);
    }
  }
}

void TrajectoryTracer::Record(Tracer& tracer, double time) const
{
  const Stencil stencil(this->Lattice, tracer.Position);
  const double fraction = TimeFraction(this->Before, this->Now, time);
  Vec3 vortexForce = Vec3::Zero();
  if (!this->Now.VortexForce.empty())
  {
    vortexForce = Blend(stencil, this->Before.VortexForce, this->Now.VortexForce, fraction);
  }
  else
  {
    for (const Vortex& vortex : this->Vortices)
    {
      vortexForce += vortex.Acceleration(tracer.Position, time);
    }
  }
  tracer.Path.Positions.push_back(tracer.Position);
  tracer.Path.VortexAccelerations.push_back(vortexForce);
  tracer.Path.WindAccelerations.push_back(
    this->Now.WindForce.empty()
      ? Vec3(Vec3::Zero())
      : Blend(stencil, this->Before.WindForce, this->Now.WindForce, fraction));
}

bool TrajectoryTracer::CanBeAt(const Vec3& x, double time) const
{
  return this->Options.Volume.Contains(x) && !(this->IsSolid && this->IsSolid(x, time));
}

Vec3 TrajectoryTracer::VelocityAt(const Vec3& x, double time) const
{
  const Stencil stencil(this->Lattice, x);
  return this->Law.Velocity(Blend(stencil, this->Before.Velocity, this->Now.Velocity,
                                  TimeFraction(this->Before, this->Now, time)));
}

Vec3 TrajectoryTracer::Step(const Vec3& x, double time, double step) const
{
  const Vec3 k1 = this->VelocityAt(x, time);
  const Vec3 k2 = this->VelocityAt(x + 0.5 * step * k1, time + 0.5 * step);
  const Vec3 k3 = this->VelocityAt(x + 0.5 * step * k2, time + 0.5 * step);
  const Vec3 k4 = this->VelocityAt(x + step * k3, time + step);
  return x + step / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
}

std::vector<Track> TrajectoryTracer::Finish()
{
  std::vector<Track> tracks;
  tracks.reserve(this->Tracers.size());
  for (Tracer& tracer : this->Tracers)
  {
    AnnotateTrack(this->Vortices, this->StartTime, this->Options.FramesPerSecond,
                  this->Options.Annotation, tracer.Path);
    tracks.push_back(std::move(tracer.Path));
    tracks.back().ObjectId = static_cast<int>(tracks.size()) - 1;
  }
  this->Tracers.clear();
  return tracks;
}

} // namespace waft
