// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/DrawnAir.h"

#include <algorithm>
#include <utility>

namespace waft
{
namespace
{

// Of the midpoint rule; a step changes v by some hundredths, so that three are exact enough.
constexpr int Corrections = 3;

} // namespace

DrawnAir::DrawnAir(const FieldSeries& series, const Vec3& origin, double spacing, double frameStep,
                   std::size_t numberOfGas, std::vector<double> settling) :
  Series(&series),
  Origin(origin), Spacing(spacing), FrameStep(frameStep), NumberOfGas(numberOfGas),
  Settling(std::move(settling))
{
}

Vec3 DrawnAir::Velocity(const Vec3& x, double frame, Mat3* jacobian) const
{
  const Vec3 world = this->Origin + this->Spacing * x;
  const double time = frame * this->FrameStep;
  const Vec3 u = jacobian != nullptr ? this->Series->Sample(world, time, *jacobian)
                                     : this->Series->Sample(world, time);
  if (jacobian != nullptr)
  {
    *jacobian *= this->FrameStep;
  }
  return (this->FrameStep / this->Spacing) * u;
}

Vec3 DrawnAir::Deviation(std::size_t body, const Vec3& x, const Vec3& v, double frame, double step,
                         Mat3* jacobian) const
{
  Vec3 w = v - this->Velocity(x - 0.5 * step * v, frame - 0.5 * step, jacobian);
  w.z() += body < this->NumberOfGas ? 0.0 : this->Settling[body - this->NumberOfGas];
  return w;
}

Vec3 DrawnAir::Carried(std::size_t body, const Vec3& x, const Vec3& w, double frame,
                       double step) const
{
  Vec3 beside = w;
  beside.z() -= body < this->NumberOfGas ? 0.0 : this->Settling[body - this->NumberOfGas];
  Vec3 v = beside + this->Velocity(x, frame - 0.5 * step);
  for (int k = 0; k < Corrections; ++k)
  {
    v = beside + this->Velocity(x + 0.5 * step * v, frame - 0.5 * step);
  }
  return v;
}

void DrawnAir::Deviations(const float* state, std::size_t bodies, std::size_t stride, double frame,
                          double step, float* out, float* jacobians) const
{
  std::copy(state, state + 6 * stride, out);
  for (std::size_t i = 0; i < bodies; ++i)
  {
    const auto row = [&](int c) { return static_cast<double>(state[c * stride + i]); };
    Mat3 jacobian;
    const Vec3 w = this->Deviation(i, Vec3(row(0), row(1), row(2)), Vec3(row(3), row(4), row(5)),
                                   frame, step, jacobians ? &jacobian : nullptr);
    for (int c = 0; c < 3; ++c)
    {
      out[(3 + c) * stride + i] = static_cast<float>(w[c]);
      for (int k = 0; k < 3 && jacobians; ++k)
      {
        jacobians[(3 * c + k) * stride + i] = static_cast<float>(jacobian(c, k));
      }
    }
  }
}

void DrawnAir::ToVelocities(const float* jacobians, const float* direct, std::size_t bodies,
                            std::size_t stride, double step, float* gradient)
{
  const auto half = static_cast<float>(0.5 * step);
  for (int k = 0; k < 3; ++k)
  {
    float* gx = gradient + k * stride;
    const float* j[3] = { jacobians + k * stride, jacobians + (3 + k) * stride,
                          jacobians + (6 + k) * stride };
    const float* gv[3] = { gradient + 3 * stride, gradient + 4 * stride, gradient + 5 * stride };
    const float* by[3] = { direct, direct + stride, direct + 2 * stride };
    for (std::size_t i = 0; i < bodies; ++i)
    {
      gx[i] -= j[0][i] * (gv[0][i] - by[0][i]) + j[1][i] * (gv[1][i] - by[1][i]) +
               j[2][i] * (gv[2][i] - by[2][i]);
    }
  }
  for (std::size_t i = 0; i < bodies; ++i)
  {
    float w[3];
    for (int c = 0; c < 3; ++c)
    {
      w[c] = gradient[(3 + c) * stride + i] - direct[c * stride + i];
    }
    for (int k = 0; k < 3; ++k)
    {
      gradient[(3 + k) * stride + i] +=
        half * (jacobians[k * stride + i] * w[0] + jacobians[(3 + k) * stride + i] * w[1] +
                jacobians[(6 + k) * stride + i] * w[2]);
    }
  }
}

} // namespace waft
