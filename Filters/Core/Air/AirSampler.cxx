// SPDX-License-Identifier: BSD-3-Clause
#include "Air/AirSampler.h"

#include <algorithm>

namespace waft
{

AirSampler::AirSampler(const FieldSeries& air) : Air(air) {}

AirSampler::Voxel AirSampler::Find(const Vec3& x) const
{
  Voxel voxel;
  std::size_t stride = 1;
  for (int c = 0; c < 3; ++c)
  {
    const int count = this->Air.Dimensions[static_cast<std::size_t>(c)];
    const double last = count - 1;
    const double place = (x[c] - this->Air.Origin[c]) / this->Air.Spacing[c];
    const double held = std::clamp(place, 0.0, last);
    const int low = std::min(static_cast<int>(held), std::max(0, count - 2));
    voxel.Slope[c] = place == held && last > 0.0 ? 1.0 / this->Air.Spacing[c] : 0.0;
    voxel.Part[c] = held - low;
    voxel.Next[c] = count > 1 ? stride : 0;
    voxel.Corner += static_cast<std::size_t>(low) * stride;
    stride *= static_cast<std::size_t>(count);
  }
  return voxel;
}

// corner(i): the values at the i-th sample. Along x, then y, then z, with what each step changes.
template <class Corner>
Vec3 AirSampler::Interpolate(const Voxel& voxel, const Corner& corner, Mat3* gradient)
{
  Vec3 value;
  for (int c = 0; c < 3; ++c)
  {
    double faces[2], alongX[2], alongY[2];
    for (std::size_t k = 0; k < 2; ++k)
    {
      double edges[2], along[2];
      for (std::size_t j = 0; j < 2; ++j)
      {
        const std::size_t at = voxel.Corner + j * voxel.Next[1] + k * voxel.Next[2];
        const double low = corner(at, c);
        along[j] = corner(at + voxel.Next[0], c) - low;
        edges[j] = low + voxel.Part[0] * along[j];
      }
      alongY[k] = edges[1] - edges[0];
      faces[k] = edges[0] + voxel.Part[1] * alongY[k];
      alongX[k] = along[0] + voxel.Part[1] * (along[1] - along[0]);
    }
    value[c] = faces[0] + voxel.Part[2] * (faces[1] - faces[0]);
    if (gradient != nullptr)
    {
      (*gradient)(c, 0) = voxel.Slope[0] * (alongX[0] + voxel.Part[2] * (alongX[1] - alongX[0]));
      (*gradient)(c, 1) = voxel.Slope[1] * (alongY[0] + voxel.Part[2] * (alongY[1] - alongY[0]));
      (*gradient)(c, 2) = voxel.Slope[2] * (faces[1] - faces[0]);
    }
  }
  return value;
}

Vec3 AirSampler::Between(int k, const Vec3& x, Mat3* gradient) const
{
  const auto& before = this->Air.Values[static_cast<std::size_t>(k)];
  const auto& after = this->Air.Values[static_cast<std::size_t>(k) + 1];
  const auto mean = [&](std::size_t i, int c)
  {
    const auto axis = static_cast<std::size_t>(c);
    return 0.5 * (static_cast<double>(before[i][axis]) + static_cast<double>(after[i][axis]));
  };
  return Interpolate(this->Find(x), mean, gradient);
}

Vec3 AirSampler::At(int frame, const Vec3& x) const
{
  const auto& values = this->Air.Values[static_cast<std::size_t>(frame)];
  return Interpolate(
    this->Find(x),
    [&](std::size_t i, int c)
    { return static_cast<double>(values[i][static_cast<std::size_t>(c)]); },
    nullptr);
}

} // namespace waft
