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

// Eight half floats, and what they are.
typedef std::uint16_t Halves8 __attribute__((vector_size(16)));
typedef std::uint32_t Bits8 __attribute__((vector_size(32)));
typedef float Float8 __attribute__((vector_size(32)));

// The values of two neighbours in a list, which are six: the first four, and the last four, so that
// nothing after them is read.
WAFT_INLINE void ReadPair(const Half3* values, Float8& floats)
{
  const auto* bytes = reinterpret_cast<const unsigned char*>(values);
  Halves8 halves;
  std::memcpy(&halves, bytes, 8);
  std::memcpy(reinterpret_cast<unsigned char*>(&halves) + 8, bytes + 2 * sizeof(Half3) - 8, 8);
  // As of single ones: Base/Half.h.
  const Bits8 bits = __builtin_convertvector(halves, Bits8);
  const Float8 size = (Float8)((bits & 0x7fffu) << 13) * 0x1p112f;
  floats = (Float8)((Bits8)size | ((bits & 0x8000u) << 16));
}

// Of these the first one's and the second one's, the fourth of each being of the other one.
WAFT_INLINE void SplitPair(const Float8& floats, Double4& low, Double4& high)
{
  low = __builtin_convertvector(__builtin_shufflevector(floats, floats, 0, 1, 2, 3), Double4);
  high = __builtin_convertvector(__builtin_shufflevector(floats, floats, 5, 6, 7, 4), Double4);
}

} // namespace

AirSampler::AirSampler(const HalfSeries& air) : Air(air), Slopes(air.Spacing.cwiseInverse()) {}

WAFT_INLINE AirSampler::Voxel AirSampler::Find(const Vec3& x) const
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
    voxel.Slope[c] = coordinate == held && last > 0.0 ? this->Slopes[c] : 0.0;
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
WAFT_INLINE Vec3 AirSampler::Interpolate(const Voxel& voxel, const Corners& corners, Mat3* gradient)
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

WAFT_SIMD_CLONES Vec3 AirSampler::Between(int k, const Vec3& x, Mat3* gradient) const
{
  const Half3* before = this->Air.Values[static_cast<std::size_t>(k)].data();
  const Half3* after = this->Air.Values[static_cast<std::size_t>(k) + 1].data();
  const Voxel voxel = this->Find(x);
  const auto means = [&](std::size_t i, Double4& low, Double4& high)
  {
    Float8 first, second;
    ReadPair(before + i, first);
    ReadPair(after + i, second);
    SplitPair(0.5f * (first + second), low, high);
  };
  return Interpolate(voxel, means, gradient);
}

WAFT_SIMD_CLONES Vec3 AirSampler::At(int frame, const Vec3& x, Mat3* gradient) const
{
  const Half3* values = this->Air.Values[static_cast<std::size_t>(frame)].data();
  const Voxel voxel = this->Find(x);
  const auto corners = [&](std::size_t i, Double4& low, Double4& high)
  {
    Float8 floats;
    ReadPair(values + i, floats);
    SplitPair(floats, low, high);
  };
  return Interpolate(voxel, corners, gradient);
}

} // namespace waft
