// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Field/AirSampler.h"

#include "Base/Simd.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace waft
{
namespace
{

// Four half floats side by side as they lie in a list of threes.
typedef std::uint16_t Halves __attribute__((vector_size(8)));
typedef std::uint32_t Bits4 __attribute__((vector_size(16)));

// As of single ones: Base/Half.h.
WAFT_INLINE Float4 FromHalves(const Halves& halves)
{
  const Bits4 bits = __builtin_convertvector(halves, Bits4);
  const Float4 size = (Float4)((bits & 0x7fffu) << 13) * 0x1p112f;
  return (Float4)((Bits4)size | ((bits & 0x8000u) << 16));
}

// The values of two neighbours in a list, the fourth of each being of the other one: the second is
// read from two bytes before it, so that nothing after it is.
WAFT_INLINE void ReadPair(const Half3* values, std::size_t next, Float4& low, Float4& high)
{
  const std::array<Half3, 2> alone = { values[0], values[0] };
  values = next == 1 ? values : alone.data(); // a lattice of one point along x
  const auto* bytes = reinterpret_cast<const unsigned char*>(values);
  Halves first, second;
  std::memcpy(&first, bytes, sizeof(first));
  std::memcpy(&second, bytes + 2 * sizeof(Half3) - sizeof(second), sizeof(second));
  low = FromHalves(first);
  high = FromHalves(__builtin_shufflevector(second, second, 1, 2, 3, 0));
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

// Along x, then y, then z, with what each step changes. corners(i, low, high): at the i-th point
// and its neighbour along x.
template <class Corners>
Vec3 AirSampler::Interpolate(const Voxel& voxel, const Corners& corners, Mat3* gradient)
{
  Double4 faces[2], alongX[2], alongY[2];
  for (std::size_t k = 0; k < 2; ++k)
  {
    Double4 edges[2], along[2];
    for (std::size_t j = 0; j < 2; ++j)
    {
      const std::size_t at = voxel.Corner + j * voxel.Next[1] + k * voxel.Next[2];
      Double4 low, high;
      corners(at, low, high);
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
  const Half3* before = this->Air.Values[static_cast<std::size_t>(k)].data();
  const Half3* after = this->Air.Values[static_cast<std::size_t>(k) + 1].data();
  const Voxel voxel = this->Find(x);
  const auto means = [&](std::size_t i, Double4& low, Double4& high)
  {
    Float4 lows[2], highs[2];
    ReadPair(before + i, voxel.Next[0], lows[0], highs[0]);
    ReadPair(after + i, voxel.Next[0], lows[1], highs[1]);
    low = 0.5 * __builtin_convertvector(lows[0] + lows[1], Double4);
    high = 0.5 * __builtin_convertvector(highs[0] + highs[1], Double4);
  };
  return Interpolate(voxel, means, gradient);
}

Vec3 AirSampler::At(int frame, const Vec3& x, Mat3* gradient) const
{
  const Half3* values = this->Air.Values[static_cast<std::size_t>(frame)].data();
  const Voxel voxel = this->Find(x);
  const auto corners = [&](std::size_t i, Double4& low, Double4& high)
  {
    Float4 lows, highs;
    ReadPair(values + i, voxel.Next[0], lows, highs);
    low = __builtin_convertvector(lows, Double4);
    high = __builtin_convertvector(highs, Double4);
  };
  return Interpolate(voxel, corners, gradient);
}

} // namespace waft
