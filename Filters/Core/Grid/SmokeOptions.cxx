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

Result AirRun::ValidateRun() const
{
  WAFT_RETURN_IF_FAILED(ValidateFields<AirRun>(*this));
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(this->Bounds.Size()[axis] > 0.0))
    {
      return Result::Error("Bounds: the volume has no extent along axis " + std::to_string(axis));
    }
  }
  const limits::Range allowed = limits::UpTo(limits::Frames.High / this->FramesPerSecond);
  return allowed.Holds(this->WarmUpSeconds)
           ? Result::Ok()
           : Result::Error("WarmUpSeconds: expected " + allowed.Text() +
                           ", no more frames than a scene may have");
}

Result SmokeOptions::Validate() const
{
  WAFT_RETURN_IF_FAILED(this->ValidateRun());
  WAFT_RETURN_IF_FAILED(ValidateFields<SmokeOptions>(*this));
  if (this->Spacing().maxCoeff() > 8.0 * this->Spacing().minCoeff())
  {
    return Result::Error("Resolution: voxels longer than 8 times their width");
  }
  if (this->MaximumSubsteps < 1 || this->MaximumIterations < 1)
  {
    return Result::Error("MaximumSubsteps, MaximumIterations: expected positive numbers");
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
