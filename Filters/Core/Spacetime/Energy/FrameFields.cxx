// SPDX-License-Identifier: BSD-3-Clause
// What acts on a frame's bodies beside the gas: vortices, winds and the damping of landings.
#include "Spacetime/Energy/FrameTerms.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

constexpr double LeastTimeFactor = 1e-3; // a vortex weaker than this fraction of itself is left out

} // namespace

void FrameTerms::ActivateVortices(int frame)
{
  this->Active.clear();
  for (const Vortex& vortex : this->Fields.Vortices)
  {
    const double factor = vortex.TimeFactor(frame);
    if (factor < LeastTimeFactor)
    {
      continue;
    }
    SphVortex v;
    for (int a = 0; a < 3; ++a)
    {
      v.P1[a] = static_cast<float>(vortex.P1[a]);
      v.P2[a] = static_cast<float>(vortex.P2[a]);
    }
    v.Strength = static_cast<float>(vortex.Strength * factor / (4.0 * M_PI));
    v.Core = static_cast<float>(vortex.CoreRadius * vortex.CoreRadius *
                                (vortex.P2 - vortex.P1).squaredNorm());
    this->Active.push_back(v);
  }
}

void FrameTerms::AddWinds(const float* state, std::size_t begin, std::size_t end)
{
  const std::size_t s = this->BodyStride;
  const float* x = state + begin;
  const SphRows force = this->BodyRows(this->Force, begin);
  const SphRows jacobian = this->BodyRows(this->Jacobian, begin);
  const SplineWind& wind = this->Fields.Wind;
  if (!wind.IsEmpty())
  {
    this->Kernels.Spline(wind.Field(this->WindCoefficients), 1.0f, end - begin, x, x + s, x + 2 * s,
                         force, jacobian);
  }
  const SplineWind& background = this->Model.Background;
  if (background.IsEmpty())
  {
    return;
  }
  const float factor = this->BackgroundDrag > 0.0f ? this->BackgroundDrag : 1.0f;
  this->Kernels.Spline(background.Field(this->BackgroundCoefficients), factor, end - begin, x,
                       x + s, x + 2 * s, force, jacobian);
  for (int c = 0; c < 3 && this->BackgroundDrag > 0.0f; ++c)
  {
    for (std::size_t i = 0; i < end - begin; ++i)
    {
      force.Row(c)[i] -= this->BackgroundDrag * x[(3 + c) * s + i];
    }
  }
}

void FrameTerms::AddFields(const float* state, int frame)
{
  const std::size_t s = this->BodyStride;
  const SplineWind& background = this->Model.Background;
  this->ActivateVortices(frame);
  this->HasWinds = !this->Fields.Wind.IsEmpty() || !background.IsEmpty();
  this->BackgroundDrag = 0.0f;
  if (!this->Fields.Wind.IsEmpty())
  {
    this->Fields.Wind.At(frame, this->WindCoefficients);
  }
  if (!background.IsEmpty())
  {
    background.At(frame, this->BackgroundCoefficients);
    this->BackgroundDrag = static_cast<float>(std::max(0.0, background.Drag));
  }
  for (std::size_t begin = 0; begin < s; begin += Block)
  {
    const std::size_t size = std::min(s - begin, Block);
    const SphRows force = this->BodyRows(this->Force, begin);
    const SphRows jacobian = this->BodyRows(this->Jacobian, begin);
    for (int c = 0; c < 3; ++c)
    {
      std::fill_n(force.Row(c), size, 0.0f);
    }
    for (int c = 0; c < 9; ++c)
    {
      std::fill_n(jacobian.Row(c), size, 0.0f);
    }
    const float* x = state + begin;
    this->Kernels.Vortices(this->Active.data(), this->Active.size(), size, x, x + s, x + 2 * s,
                           force, jacobian);
    if (!this->HasWinds)
    {
      continue;
    }
    for (int c = 0; c < 3; ++c)
    {
      std::copy_n(force.Row(c), size, this->BodyRows(this->VortexForce, begin).Row(c));
    }
    this->AddWinds(state, begin, std::min(begin + size, this->Model.NumberOfBodies()));
  }
}

void FrameTerms::AddLandingDamping(const float* state, int frame, double step)
{
  const std::size_t s = this->BodyStride;
  for (std::size_t o = 0; o < this->Model.NumberOfObjects; ++o)
  {
    const std::size_t i = this->Model.NumberOfGas + o;
    const auto row = [&](int c) { return static_cast<double>(state[c * s + i]); };
    this->Damping[o] = LandingDamping(this->Model, frame, step, o, Vec3(row(0), row(1), row(2)),
                                      Vec3(row(3), row(4), row(5)));
    for (int c = 0; c < 3; ++c)
    {
      this->Acceleration(c)[i] += static_cast<float>(this->Damping[o].Acceleration[c]);
    }
  }
}

} // namespace waft
