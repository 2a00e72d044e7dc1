// SPDX-License-Identifier: BSD-3-Clause
#include "Grid/SmokeOptions.h"

#include "Base/Limits.h"

#include <cmath>
#include <string>

namespace waft
{
namespace
{

bool IsPositive(double value)
{
  return std::isfinite(value) && value > 0.0;
}

bool IsNotNegative(double value)
{
  return std::isfinite(value) && value >= 0.0;
}

} // namespace

Vec3 SmokeOptions::Spacing() const
{
  return this->Bounds.Size().cwiseQuotient(
    Vec3(this->Resolution[0], this->Resolution[1], this->Resolution[2]));
}

std::size_t SmokeOptions::NumberOfCells() const
{
  return static_cast<std::size_t>(this->Resolution[0]) * this->Resolution[1] * this->Resolution[2];
}

std::size_t SmokeOptions::NumberOfNodes() const
{
  return static_cast<std::size_t>(this->Resolution[0] + 1) * (this->Resolution[1] + 1) *
         (this->Resolution[2] + 1);
}

Result CheckWarmUp(double seconds, double framesPerSecond)
{
  const limits::Range allowed = limits::UpTo(limits::Frames.High / framesPerSecond);
  return allowed.Holds(seconds) ? Result::Ok()
                                : Result::Error("WarmUpSeconds: expected " + allowed.Text() +
                                                ", no more frames than a scene may have");
}

Result SmokeOptions::Validate() const
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const int n = this->Resolution[axis];
    if (n < 4 || n > 1024)
    {
      return Result::Error("Resolution: " + std::to_string(n) + " voxels along axis " +
                           std::to_string(axis) + ", expected 4 to 1024");
    }
    if (!IsPositive(this->Bounds.Size()[axis]))
    {
      return Result::Error("Bounds: the volume has no extent along axis " + std::to_string(axis));
    }
  }
  if (this->Spacing().maxCoeff() > 8.0 * this->Spacing().minCoeff())
  {
    return Result::Error("Resolution: voxels longer than 8 times their width");
  }
  if (!IsPositive(this->FramesPerSecond))
  {
    return Result::Error("FramesPerSecond: expected a positive number");
  }
  WAFT_RETURN_IF_FAILED(CheckWarmUp(this->WarmUpSeconds, this->FramesPerSecond));
  if (!IsPositive(this->CourantNumber) || this->MaximumSubsteps < 1)
  {
    return Result::Error("CourantNumber, MaximumSubsteps: expected positive numbers");
  }
  if (!IsPositive(this->Tolerance) || this->MaximumIterations < 1)
  {
    return Result::Error("Tolerance, MaximumIterations: expected positive numbers");
  }
  if (!IsNotNegative(this->Confinement) || !IsNotNegative(this->Dissipation) ||
      !IsNotNegative(this->WindDrag))
  {
    return Result::Error("Confinement, Dissipation, WindDrag: expected numbers not below 0");
  }
  if (!std::isfinite(this->BuoyancyTemperature) || !std::isfinite(this->BuoyancyDensity))
  {
    return Result::Error("BuoyancyTemperature, BuoyancyDensity: expected finite numbers");
  }
  if (!IsPositive(this->AirDensity))
  {
    return Result::Error("AirDensity: expected a positive number");
  }
  return Result::Ok();
}

Result SmokeForces::Validate() const
{
  for (std::size_t v = 0; v < this->Vortices.size(); ++v)
  {
    const Vortex& vortex = this->Vortices[v];
    if (!vortex.P1.allFinite() || !vortex.P2.allFinite() || vortex.P1 == vortex.P2 ||
        !std::isfinite(vortex.Strength) || !std::isfinite(vortex.CenterTime) ||
        !IsPositive(vortex.Duration) || !IsPositive(vortex.CoreRadius))
    {
      return Result::Error("Vortices: row " + std::to_string(v) +
                           ": expected two distinct poles, a finite strength and time, a positive "
                           "duration and core radius");
    }
  }
  for (std::size_t w = 0; w < this->Winds.size(); ++w)
  {
    const AnalyticWind& wind = this->Winds[w];
    if (!wind.Direction.allFinite() || !wind.Center.allFinite() || !std::isfinite(wind.Strength) ||
        !std::isfinite(wind.CenterTime) || !IsPositive(wind.Radius) || !IsPositive(wind.Duration))
    {
      return Result::Error("Winds: row " + std::to_string(w) +
                           ": expected finite numbers, a positive radius and duration");
    }
  }
  for (std::size_t e = 0; e < this->Emitters.size(); ++e)
  {
    const SmokeEmitter& emitter = this->Emitters[e];
    if (!emitter.Center.allFinite() || !IsPositive(emitter.Radius) ||
        !IsNotNegative(emitter.Density) || !std::isfinite(emitter.Temperature))
    {
      return Result::Error("Emitters: row " + std::to_string(e) +
                           ": expected a finite centre, a positive radius, a density not below 0");
    }
  }
  return this->Wind.IsEmpty() ? Result::Ok() : this->Wind.Validate("Wind");
}

} // namespace waft
