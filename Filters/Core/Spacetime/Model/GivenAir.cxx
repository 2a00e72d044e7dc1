// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Model/GivenAir.h"

#include <algorithm>
#include <utility>

namespace waft
{
namespace
{

// Of the midpoint rule; a step changes v by some hundredths, so that three are exact enough.
constexpr int Corrections = 3;

// Places to sample a node, below which a field's values are taken where they are asked for instead
// of everywhere.
constexpr std::size_t NodesPerPlace = 64;

} // namespace

GivenAir::GivenAir(const FieldSeries& series, const Vec3& origin, double spacing, double frameStep,
                   std::size_t numberOfGas, std::vector<BodyLaw> laws,
                   std::vector<GroundEffect> ground) :
  Series(&series),
  Origin(origin), Spacing(spacing), FrameStep(frameStep), NumberOfGas(numberOfGas),
  Laws(std::move(laws)), Ground(std::move(ground))
{
}

Vec3 GivenAir::Velocity(const Vec3& x, double frame) const
{
  const Vec3 u = this->Series->Sample(this->Origin + this->Spacing * x, frame * this->FrameStep);
  return (this->FrameStep / this->Spacing) * u;
}

void GivenAir::SetSlips(const std::vector<std::vector<Vec3>>& slips)
{
  this->PoseSlips = slips;
  for (std::vector<Vec3>& ofObject : this->PoseSlips)
  {
    for (Vec3& slip : ofObject)
    {
      slip *= -this->FrameStep / this->Spacing;
    }
  }
}

Vec3 GivenAir::SlipOf(std::size_t object, double frame) const
{
  if (this->PoseSlips.empty() || this->PoseSlips[object].empty())
  {
    return this->Laws[object].Slip;
  }
  const std::vector<Vec3>& slips = this->PoseSlips[object];
  const double held = std::clamp(frame, 0.0, static_cast<double>(slips.size() - 1));
  const auto before = static_cast<std::size_t>(held);
  const std::size_t after = std::min(before + 1, slips.size() - 1);
  return slips[before] + (held - static_cast<double>(before)) * (slips[after] - slips[before]);
}

Vec3 GivenAir::Slips(std::size_t object, const Vec3& x, double frame, Mat3* slopes) const
{
  const Vec3 slip = this->SlipOf(object, frame);
  Vec3 slope;
  const double factor = this->Ground[object].Factor(this->Origin + this->Spacing * x, frame,
                                                    slopes != nullptr ? &slope : nullptr);
  if (slopes != nullptr)
  {
    const Vec3 metric = this->Spacing * slip;
    *slopes = metric * slope.transpose();
  }
  return factor * slip;
}

Vec3 GivenAir::Drift(std::size_t body, const Vec3& x, double frame) const
{
  const Vec3 u = this->Velocity(x, frame);
  return body < this->NumberOfGas ? u : Vec3(u - this->Slips(body - this->NumberOfGas, x, frame));
}

Vec3 GivenAir::Deviation(std::size_t body, const Vec3& x, const Vec3& v, double frame,
                         double step) const
{
  return v - this->Drift(body, x - 0.5 * step * v, frame - 0.5 * step);
}

Vec3 GivenAir::Carried(std::size_t body, const Vec3& x, const Vec3& w, double frame,
                       double step) const
{
  Vec3 v = w + this->Drift(body, x, frame - 0.5 * step);
  for (int k = 0; k < Corrections; ++k)
  {
    v = w + this->Drift(body, x + 0.5 * step * v, frame - 0.5 * step);
  }
  return v;
}

void GivenAir::Deviations(const float* state, std::size_t bodies, std::size_t stride, double frame,
                          double step, float* out, float* jacobians) const
{
  thread_local std::vector<float> slice;
  const Instant now = this->At(frame - 0.5 * step);
  const bool isSliced = bodies * NodesPerPlace > this->Series->NumberOfPoints();
  if (isSliced)
  {
    this->Slice(now, slice);
  }
  const auto ofSlice = [](std::size_t node, float u[4])
  { std::copy_n(slice.data() + 4 * node, 4, u); };
  const auto ofSeries = [&now](std::size_t node, float u[4]) { now.Value(node, u); };
  std::copy(state, state + 6 * stride, out);
  for (std::size_t i = 0; i < bodies; ++i)
  {
    const auto row = [&](int c) { return static_cast<double>(state[c * stride + i]); };
    const Vec3 v(row(3), row(4), row(5));
    const Vec3 x = Vec3(row(0), row(1), row(2)) - 0.5 * step * v;
    float u[4], slopes[3][4];
    float(*const jacobian)[4] = jacobians != nullptr ? slopes : nullptr;
    if (isSliced)
    {
      this->Sample(ofSlice, x, u, jacobian);
    }
    else
    {
      this->Sample(ofSeries, x, u, jacobian);
    }
    if (i >= this->NumberOfGas)
    {
      Mat3 bySlip;
      const Vec3 slip = this->Slips(i - this->NumberOfGas, x, frame - 0.5 * step,
                                    jacobians != nullptr ? &bySlip : nullptr);
      for (int c = 0; c < 3; ++c)
      {
        u[c] -= static_cast<float>(slip[c]);
        for (int k = 0; k < 3 && jacobians; ++k)
        {
          slopes[k][c] -= static_cast<float>(bySlip(c, k));
        }
      }
    }
    for (int c = 0; c < 3; ++c)
    {
      out[(3 + c) * stride + i] = static_cast<float>(v[c] - u[c]);
      for (int k = 0; k < 3 && jacobians; ++k)
      {
        jacobians[(3 * c + k) * stride + i] = slopes[k][c];
      }
    }
  }
}

GivenAir::Instant GivenAir::At(double frame) const
{
  const FieldSeries& air = *this->Series;
  const double time = frame * this->FrameStep;
  const auto after = std::upper_bound(air.Times.begin(), air.Times.end(), time);
  const auto next =
    std::min(static_cast<std::size_t>(after - air.Times.begin()), air.Times.size() - 1);
  const std::size_t before = after == air.Times.begin() ? 0 : next - (after != air.Times.end());
  const double gap = air.Times[next] - air.Times[before];
  const double part = gap > 0.0 ? std::clamp((time - air.Times[before]) / gap, 0.0, 1.0) : 0.0;
  const double unit = this->FrameStep / this->Spacing;
  return { air.Values[before].data(), air.Values[next].data(),
           static_cast<float>((1.0 - part) * unit), static_cast<float>(part * unit) };
}

void GivenAir::Slice(const Instant& now, std::vector<float>& values) const
{
  const std::size_t n = this->Series->NumberOfPoints();
  values.resize(4 * n);
  for (std::size_t i = 0; i < n; ++i)
  {
    now.Value(i, values.data() + 4 * i);
  }
}

template <class Node>
void GivenAir::Sample(const Node& node, const Vec3& x, float u[4], float jacobian[3][4]) const
{
  const FieldSeries& air = *this->Series;
  std::size_t corner = 0, next[3], stride = 1;
  float part[3], slope[3];
  for (int c = 0; c < 3; ++c)
  {
    const int count = air.Dimensions[c];
    const double s = (this->Origin[c] + this->Spacing * x[c] - air.Origin[c]) / air.Spacing[c];
    const double held = std::clamp(s, 0.0, static_cast<double>(count - 1));
    const int low = std::clamp(static_cast<int>(held), 0, std::max(0, count - 2));
    part[c] = static_cast<float>(held - low);
    slope[c] = s == held && count > 1 ? static_cast<float>(this->Spacing / air.Spacing[c]) : 0.0f;
    next[c] = count > 1 ? stride : 0;
    corner += static_cast<std::size_t>(low) * stride;
    stride *= static_cast<std::size_t>(count);
  }
  float faces[2][4], alongX[2][4], alongY[2][4];
  for (std::size_t k = 0; k < 2; ++k)
  {
    float values[4][4]; // along x, then along y
    for (std::size_t i = 0; i < 4; ++i)
    {
      node(corner + k * next[2] + i / 2 * next[1] + i % 2 * next[0], values[i]);
    }
    for (int c = 0; c < 4; ++c)
    {
      const float first = values[1][c] - values[0][c];
      const float second = values[3][c] - values[2][c];
      const float low = values[0][c] + part[0] * first;
      alongY[k][c] = values[2][c] + part[0] * second - low;
      alongX[k][c] = first + part[1] * (second - first);
      faces[k][c] = low + part[1] * alongY[k][c];
    }
  }
  for (int c = 0; c < 4; ++c)
  {
    u[c] = faces[0][c] + part[2] * (faces[1][c] - faces[0][c]);
    if (jacobian != nullptr)
    {
      jacobian[0][c] = slope[0] * (alongX[0][c] + part[2] * (alongX[1][c] - alongX[0][c]));
      jacobian[1][c] = slope[1] * (alongY[0][c] + part[2] * (alongY[1][c] - alongY[0][c]));
      jacobian[2][c] = slope[2] * (faces[1][c] - faces[0][c]);
    }
  }
}

void GivenAir::ToVelocities(const float* jacobians, const float* direct, std::size_t bodies,
                            std::size_t stride, double step, float* gradient)
{
  const auto half = static_cast<float>(0.5 * step);
  for (std::size_t i = 0; i < bodies; ++i)
  {
    float w[3];
    for (int c = 0; c < 3; ++c)
    {
      w[c] = gradient[(3 + c) * stride + i] - direct[c * stride + i];
    }
    for (int k = 0; k < 3; ++k)
    {
      const float carried = jacobians[k * stride + i] * w[0] +
                            jacobians[(3 + k) * stride + i] * w[1] +
                            jacobians[(6 + k) * stride + i] * w[2];
      gradient[k * stride + i] -= carried;
      gradient[(3 + k) * stride + i] += half * carried;
    }
  }
}

} // namespace waft
