// SPDX-License-Identifier: BSD-3-Clause
#include "Grid/AdvectionKernels.h"

#include "Base/Simd.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

// Where a sample may be looked up along one axis, in its own index space.
struct Reach
{
  float Low = 0.0f;
  float High = 0.0f;
  float Period = 0.0f; // 0: not periodic
};

Reach ReachOf(const StaggeredLayout& layout, const AxisEnds& ends, int faceAxis, int axis)
{
  const int n = layout.N[axis];
  const bool onFaces = axis == faceAxis;
  if (ends[axis][0] == EndKind::Wrap)
  {
    return { 0.0f, static_cast<float>(n), static_cast<float>(n) };
  }
  // Up to a wall, and one voxel into the outside, where everything is zero.
  const float wall = onFaces ? 0.0f : -0.5f;
  const auto end = static_cast<float>(n);
  Reach reach;
  reach.Low = ends[axis][0] == EndKind::Outside ? -1.0f : wall;
  reach.High = ends[axis][1] == EndKind::Outside ? (onFaces ? end + 1.0f : end)
                                                 : end + (onFaces ? 0.0f : wall);
  return reach;
}

// The displacement d from the point `at` that stays within reach, whatever d is: of two numbers of
// which the second is none, std::max takes the first.
inline float Limit(const Reach& reach, float at, float d)
{
  return std::min(std::max(reach.Low - at, d), reach.High - at);
}

// The same on a periodic axis.
inline float Wrapped(const Reach& reach, float at, float d)
{
  return Limit(reach, at, d - reach.Period * std::floor((at + d) / reach.Period));
}

// Displacements are multiples of 2^-18 voxels (up to 16 voxels): sums with halves and complements
// to one are then exact, so that a mirror image of the air is carried to the same bits.
inline float Quantise(float d)
{
  constexpr float grain = 48.0f;
  return (d + grain) - grain;
}

// d becomes its fraction; its floor times the stride is added to corner.
inline void Split(float& d, std::ptrdiff_t stride, int& corner)
{
  const int whole = static_cast<int>(d);
  const int floor = whole - (d < static_cast<float>(whole) ? 1 : 0);
  corner += floor * static_cast<int>(stride);
  d -= static_cast<float>(floor);
}

// Feet of a row from displacements dx, dy, dz [voxels] of the samples at index (i, j, k) + shift of
// the index space of the faces of faceAxis, which are relative to (i, j, k) again afterwards.
inline void __attribute__((always_inline))
RowFeet(const StaggeredLayout& layout, const AxisEnds& ends, int faceAxis, const float* shift,
        int j, int k, const float* dx, const float* dy, const float* dz, int count, FootRow& feet)
{
  const Reach rx = ReachOf(layout, ends, faceAxis, 0);
  const Reach ry = ReachOf(layout, ends, faceAxis, 1);
  const Reach rz = ReachOf(layout, ends, faceAxis, 2);
  const float y = static_cast<float>(j) + shift[1];
  const float z = static_cast<float>(k) + shift[2];
  int* corner = feet.Corner.data();
  float* tx = feet.Tx.data();
  float* ty = feet.Ty.data();
  float* tz = feet.Tz.data();
  const bool wraps = rx.Period > 0.0f || ry.Period > 0.0f || rz.Period > 0.0f;
  if (wraps)
  {
    for (int i = 0; i < count; ++i)
    {
      const float x = static_cast<float>(i) + shift[0];
      tx[i] = (rx.Period > 0.0f ? Wrapped(rx, x, dx[i]) : Limit(rx, x, dx[i])) + shift[0];
      ty[i] = (ry.Period > 0.0f ? Wrapped(ry, y, dy[i]) : Limit(ry, y, dy[i])) + shift[1];
      tz[i] = (rz.Period > 0.0f ? Wrapped(rz, z, dz[i]) : Limit(rz, z, dz[i])) + shift[2];
    }
  }
  else
  {
#pragma GCC ivdep
    for (int i = 0; i < count; ++i)
    {
      const float x = static_cast<float>(i) + shift[0];
      tx[i] = Limit(rx, x, dx[i]) + shift[0];
      ty[i] = Limit(ry, y, dy[i]) + shift[1];
      tz[i] = Limit(rz, z, dz[i]) + shift[2];
    }
  }
#pragma GCC ivdep
  for (int i = 0; i < count; ++i)
  {
    int at = i;
    Split(tx[i], 1, at);
    Split(ty[i], layout.StrideY, at);
    Split(tz[i], layout.StrideZ, at);
    corner[i] = at;
  }
}

struct Foot
{
  std::ptrdiff_t Corner;
  float Tx, Ty, Tz;
};

inline Foot FootAt(const FootRow& feet, std::ptrdiff_t row, int i)
{
  return { row + feet.Corner[i], feet.Tx[i], feet.Ty[i], feet.Tz[i] };
}

inline float Linear(const StaggeredLayout& layout, const float* values, const Foot& foot)
{
  const float* p = values + foot.Corner;
  const Float4 a = Load4(p);
  const Float4 b = Load4(p + layout.StrideY);
  const Float4 c = Load4(p + layout.StrideZ);
  const Float4 d = Load4(p + layout.StrideZ + layout.StrideY);
  const Float4 ab = (1.0f - foot.Ty) * a + foot.Ty * b;
  const Float4 cd = (1.0f - foot.Ty) * c + foot.Ty * d;
  const Float4 all = (1.0f - foot.Tz) * ab + foot.Tz * cd;
  return (1.0f - foot.Tx) * all[0] + foot.Tx * all[1];
}

} // namespace

WAFT_SIMD_CLONES
void TracePlane(const CarrierFlow& flow, int k, const std::array<float*, 3>& displacement)
{
  const StaggeredLayout& layout = *flow.Layout;
  const int count = layout.N[0];
  FootRow feet;
  feet.Resize(count);
  std::vector<float> half[3];
  for (std::vector<float>& h : half)
  {
    h.resize(count);
  }
  for (int j = 0; j < layout.N[1]; ++j)
  {
    const std::ptrdiff_t row = layout.Index(0, j, k);
    for (int axis = 0; axis < 3; ++axis)
    {
      const float* v = flow.Velocity[axis] + row;
      const float* next = v + layout.Stride(axis);
      float* h = half[axis].data();
      const float scale = -0.25f * flow.Scale[axis];
#pragma GCC ivdep
      for (int i = 0; i < count; ++i)
      {
        h[i] = Quantise(scale * (v[i] + next[i]));
      }
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      // A cell's centre lies half a face's distance above its lower face.
      float shift[3] = { 0.0f, 0.0f, 0.0f };
      shift[axis] = 0.5f;
      RowFeet(layout, flow.Ends, axis, shift, j, k, half[0].data(), half[1].data(), half[2].data(),
              count, feet);
      float* out = displacement[axis] + row;
      for (int i = 0; i < count; ++i)
      {
        out[i] =
          Quantise(-flow.Scale[axis] * Linear(layout, flow.Velocity[axis], FootAt(feet, row, i)));
      }
    }
  }
}

WAFT_SIMD_CLONES
void FindFeet(const StaggeredLayout& layout, const AxisEnds& ends,
              const std::array<const float*, 3>& displacement, int faceAxis, int j, int k,
              FootRow& feet)
{
  const int count = layout.Count(0, faceAxis);
  const std::ptrdiff_t row = layout.Index(0, j, k);
  const float* d[3] = { displacement[0] + row, displacement[1] + row, displacement[2] + row };
  const float none[3] = { 0.0f, 0.0f, 0.0f };
  if (faceAxis < 0)
  {
    RowFeet(layout, ends, faceAxis, none, j, k, d[0], d[1], d[2], count, feet);
    return;
  }
  const std::ptrdiff_t back = layout.Stride(faceAxis);
  float* mean[3] = { feet.Tx.data(), feet.Ty.data(), feet.Tz.data() };
  for (int axis = 0; axis < 3; ++axis)
  {
    const float* here = d[axis];
    const float* before = here - back;
    float* out = mean[axis];
#pragma GCC ivdep
    for (int i = 0; i < count; ++i)
    {
      out[i] = 0.5f * (here[i] + before[i]);
    }
  }
  RowFeet(layout, ends, faceAxis, none, j, k, mean[0], mean[1], mean[2], count, feet);
}

void SampleLinearRow(const StaggeredLayout& layout, const float* values, std::ptrdiff_t row,
                     const FootRow& feet, int count, float* out)
{
  for (int i = 0; i < count; ++i)
  {
    out[i] = Linear(layout, values, FootAt(feet, row, i));
  }
}

void CorrectMacCormackRow(const StaggeredLayout& layout, const float* source, std::ptrdiff_t row,
                          const FootRow& feet, int count, const float* forward,
                          const float* backward, float* out)
{
  for (int i = 0; i < count; ++i)
  {
    const Foot foot = FootAt(feet, row, i);
    const float* p = source + foot.Corner;
    float low = p[0];
    float high = p[0];
    for (int corner = 1; corner < 8; ++corner)
    {
      const float value =
        p[(corner & 1) + ((corner >> 1) & 1) * layout.StrideY + (corner >> 2) * layout.StrideZ];
      low = std::min(low, value);
      high = std::max(high, value);
    }
    const float corrected = forward[i] + 0.5f * (source[row + i] - backward[i]);
    out[i] = std::min(std::max(corrected, low), high);
  }
}

} // namespace waft
