// SPDX-License-Identifier: BSD-3-Clause
#include "Air/AirSampler.h"

#include <algorithm>

namespace waft
{

AirSampler::AirSampler(const FieldSeries& air) : Air(air) {}

AirSampler::Voxel AirSampler::Find(const Vec3& x) const
{
  std::array<std::size_t, 3> low, high;
  Vec3 part, slope;
  for (int c = 0; c < 3; ++c)
  {
    const double last = this->Air.Dimensions[c] - 1;
    const double place = (x[c] - this->Air.Origin[c]) / this->Air.Spacing[c];
    const double held = std::clamp(place, 0.0, last);
    slope[c] = place == held && last > 0.0 ? 1.0 / this->Air.Spacing[c] : 0.0;
    const double floor = std::min(std::floor(held), std::max(0.0, last - 1.0));
    low[c] = static_cast<std::size_t>(floor);
    high[c] = std::min(low[c] + 1, static_cast<std::size_t>(last));
    part[c] = held - floor;
  }
  Voxel voxel;
  for (int corner = 0; corner < 8; ++corner)
  {
    Vec3 weight, along;
    std::array<std::size_t, 3> at;
    for (int c = 0; c < 3; ++c)
    {
      const bool up = (corner >> c & 1) != 0;
      at[c] = up ? high[c] : low[c];
      weight[c] = up ? part[c] : 1.0 - part[c];
      along[c] = up ? slope[c] : -slope[c];
    }
    const auto nx = static_cast<std::size_t>(this->Air.Dimensions[0]);
    const auto ny = static_cast<std::size_t>(this->Air.Dimensions[1]);
    voxel.Corner[corner] = (at[2] * ny + at[1]) * nx + at[0];
    voxel.Weight[corner] = weight[0] * weight[1] * weight[2];
    voxel.Slope[corner] = Vec3(along[0] * weight[1] * weight[2], weight[0] * along[1] * weight[2],
                               weight[0] * weight[1] * along[2]);
  }
  return voxel;
}

Vec3 AirSampler::Between(int k, const Vec3& x, Mat3& gradient) const
{
  const Voxel voxel = this->Find(x);
  const auto& before = this->Air.Values[static_cast<std::size_t>(k)];
  const auto& after = this->Air.Values[static_cast<std::size_t>(k) + 1];
  Vec3 value = Vec3::Zero();
  gradient.setZero();
  for (int corner = 0; corner < 8; ++corner)
  {
    const std::array<float, 3>& a = before[voxel.Corner[corner]];
    const std::array<float, 3>& b = after[voxel.Corner[corner]];
    const Vec3 v(0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2]));
    value += voxel.Weight[corner] * v;
    gradient += v * voxel.Slope[corner].transpose();
  }
  return value;
}

Vec3 AirSampler::At(int frame, const Vec3& x) const
{
  const Voxel voxel = this->Find(x);
  const auto& values = this->Air.Values[static_cast<std::size_t>(frame)];
  Vec3 value = Vec3::Zero();
  for (int corner = 0; corner < 8; ++corner)
  {
    const std::array<float, 3>& v = values[voxel.Corner[corner]];
    value += voxel.Weight[corner] * Vec3(v[0], v[1], v[2]);
  }
  return value;
}

} // namespace waft
