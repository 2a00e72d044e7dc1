// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Field/AirSampler.h"

#include "Base/Simd.h"

#include <algorithm>
#include <cstdint>

namespace waft
{
namespace
{

// The three values and a 0, side by side.
typedef std::uint32_t Bits4 __attribute__((vector_size(16)));

// As of single ones: Base/Half.h.
WAFT_INLINE Float4 FromHalf(const Half3& half)
{
  const Bits4 bits = { half[0], half[1], half[2], 0 };
  const Float4 size = (Float4)((bits & 0x7fffu) << 13) * 0x1p112f;
  return (Float4)((Bits4)size | ((bits & 0x8000u) << 16));
}

} // namespace

AirSampler::AirSampler(const HalfSeries& air) : Air(air) {}

AirSampler::Voxel AirSampler::Find(const Vec3& x) const
{
  Voxel voxel;
  std::size_t stride = 1;
  for (int c = 0; c < 3; ++c)
  {
    const int count = this->Air.Dimensions[static_cast<std::size_t>(c)];
    const double last = count - 1;
    const double coordinate = (x[c] - this->Air.Origin[c]) / this->Air.Spacing[c];
    const double held = std::clamp(coordinate, 0.0, last);
    const int low = std::min(static_cast<int>(held), std::max(0, count - 2));
    voxel.Slope[c] = coordinate == held && last > 0.0 ? 1.0 / this->Air.Spacing[c] : 0.0;
    voxel.Part[c] = held - low;
    voxel.Next[c] = count > 1 ? stride : 0;
    voxel.Corner += static_cast<std::size_t>(low) * stride;
    stride *= static_cast<std::size_t>(count);
  }
  return voxel;
}

// Along x, then y, then z, with what each step changes. corner(i, values): at the i-th point.
template <class Corner>
Vec3 AirSampler::Interpolate(const Voxel& voxel, const Corner& corner, Mat3* gradient)
{
  Double4 faces[2], alongX[2], alongY[2];
  for (std::size_t k = 0; k < 2; ++k)
  {
    Double4 edges[2], along[2];
    for (std::size_t j = 0; j < 2; ++j)
    {
      const std::size_t at = voxel.Corner + j * voxel.Next[1] + k * voxel.Next[2];
      Double4 low, high;
      corner(at, low);
      corner(at + voxel.Next[0], high);
      along[j] = high - low;
      edges[j] = low + voxel.Part[0] * along[j];
    }
    alongY[k] = edges[1] - edges[0];
    faces[k] = edges[0] + voxel.Part[1] * alongY[k];
    alongX[k] = along[0] + voxel.Part[1] * (along[1] - along[0]);
  }
  const Double4 alongZ = faces[1] - faces[0];
  const Double4 value = faces[0] + voxel.Part[2] * alongZ;
  if (gradient != nullptr)
  {
    const Double4 slopes[3] = {
      voxel.Slope[0] * (alongX[0] + voxel.Part[2] * (alongX[1] - alongX[0])),
      voxel.Slope[1] * (alongY[0] + voxel.Part[2] * (alongY[1] - alongY[0])),
      voxel.Slope[2] * alongZ
    };
    for (int c = 0; c < 3; ++c)
    {
      gradient->col(c) = Vec3(slopes[c][0], slopes[c][1], slopes[c][2]);
    }
  }
  return Vec3(value[0], value[1], value[2]);
}

Vec3 AirSampler::Between(int k, const Vec3& x, Mat3* gradient) const
{
  const auto& before = this->Air.Values[static_cast<std::size_t>(k)];
  const auto& after = this->Air.Values[static_cast<std::size_t>(k) + 1];
  const auto mean = [&](std::size_t i, Double4& value)
  { value = 0.5 * __builtin_convertvector(FromHalf(before[i]) + FromHalf(after[i]), Double4); };
  return Interpolate(this->Find(x), mean, gradient);
}

Vec3 AirSampler::At(int frame, const Vec3& x) const
{
  const auto& values = this->Air.Values[static_cast<std::size_t>(frame)];
  const auto corner = [&](std::size_t i, Double4& value)
  { value = __builtin_convertvector(FromHalf(values[i]), Double4); };
  return Interpolate(this->Find(x), corner, nullptr);
}

} // namespace waft
