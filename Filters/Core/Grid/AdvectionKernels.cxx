// SPDX-License-Identifier: BSD-3-Clause
#include "Grid/AdvectionKernels.h"

#include "Grid/Float4.h"
#include "Grid/Simd.h"

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

  /// The displacement d from sample i (shifted by s) that stays within reach.
  float Limit(int i, float s, float d) const
  {
    const float at = static_cast<float>(i) + s;
    if (this->Period > 0.0f)
    {
      d -= this->Period * std::floor((at + d) / this->Period);
    }
    return std::min(std::max(d, this->Low - at), this->High - at);
  }
};

std::array<Reach, 3> ReachOf(const CarrierFlow& flow, int faceAxis)
{
  std::array<Reach, 3> reach;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int n = flow.Layout->N[axis];
    const bool onFaces = axis == faceAxis;
    // Up to a wall, and one voxel into the outside, where everything is zero.
    const float wall = onFaces ? 0.0f : -0.5f;
    reach[axis].Low = flow.Ends[axis][0] == EndKind::Outside ? -1.0f : wall;
    reach[axis].High = flow.Ends[axis][1] == EndKind::Outside ? (onFaces ? n + 1.0f : n)
                                                              : n + (onFaces ? 0.0f : wall);
    if (flow.Ends[axis][0] == EndKind::Wrap)
    {
      reach[axis] = { 0.0f, static_cast<float>(n), static_cast<float>(n) };
    }
  }
  return reach;
}

// The lower corner of the voxel of samples around a point, and the place within it.
struct Foot
{
  std::ptrdiff_t Base;
  float Tx, Ty, Tz;
};

inline int FloorOf(float d)
{
  const int whole = static_cast<int>(d);
  return whole - (d < static_cast<float>(whole) ? 1 : 0);
}

// dx, dy, dz: displacements from sample (i, j, k).
inline Foot FootAt(const StaggeredLayout& layout, int i, int j, int k, float dx, float dy, float dz)
{
  const int fx = FloorOf(dx);
  const int fy = FloorOf(dy);
  const int fz = FloorOf(dz);
  return { layout.Index(i + fx, j + fy, k + fz), dx - static_cast<float>(fx),
           dy - static_cast<float>(fy), dz - static_cast<float>(fz) };
}

inline Foot FootAt(const StaggeredLayout& layout, const FootRow& feet, int i)
{
  return FootAt(layout, i, feet.J, feet.K, feet.X[i], feet.Y[i], feet.Z[i]);
}

inline float Linear(const StaggeredLayout& layout, const float* values, const Foot& foot)
{
  const float* p = values + foot.Base;
  const Float4 a = Load4(p);
  const Float4 b = Load4(p + layout.StrideY);
  const Float4 c = Load4(p + layout.StrideZ);
  const Float4 d = Load4(p + layout.StrideZ + layout.StrideY);
  const Float4 ab = (1.0f - foot.Ty) * a + foot.Ty * b;
  const Float4 cd = (1.0f - foot.Ty) * c + foot.Ty * d;
  const Float4 all = (1.0f - foot.Tz) * ab + foot.Tz * cd;
  return (1.0f - foot.Tx) * all[0] + foot.Tx * all[1];
}

// Hermite cubic from f1 to f2 with central slopes, held between 0 and three times the difference
// (Fedkiw et al. 2001, Appendix B, with the bound that makes the cubic monotone). Written so that a
// mirror image gives the same bits.
inline Float4 Cubic(const Float4& f0, const Float4& f1, const Float4& f2, const Float4& f3, float t)
{
  const Float4 zero = { 0.0f, 0.0f, 0.0f, 0.0f };
  const Float4 d = f2 - f1;
  const Float4 d3 = 3.0f * d;
  const Float4 low = Min4(zero, d3);
  const Float4 high = Max4(zero, d3);
  const Float4 m1 = Min4(Max4(0.5f * (f2 - f0), low), high);
  const Float4 m2 = Min4(Max4(0.5f * (f3 - f1), low), high);
  const float s = 1.0f - t;
  return (s * f1 + t * f2) + (s * t) * (s * (m1 - d) - t * (m2 - d));
}

inline float Cubic(float f0, float f1, float f2, float f3, float t)
{
  const float d = f2 - f1;
  const float d3 = 3.0f * d;
  const float low = std::min(0.0f, d3);
  const float high = std::max(0.0f, d3);
  const float m1 = std::min(std::max(0.5f * (f2 - f0), low), high);
  const float m2 = std::min(std::max(0.5f * (f3 - f1), low), high);
  const float s = 1.0f - t;
  return (s * f1 + t * f2) + (s * t) * (s * (m1 - d) - t * (m2 - d));
}

inline Float4 CubicAlongZ(const float* p, std::ptrdiff_t stride, float t)
{
  return Cubic(Load4(p - stride), Load4(p), Load4(p + stride), Load4(p + 2 * stride), t);
}

} // namespace

void TraceRow(const CarrierFlow& flow, int faceAxis, int j, int k, FootRow& feet)
{
  const StaggeredLayout& layout = *flow.Layout;
  const int count = layout.Count(0, faceAxis);
  const std::ptrdiff_t row = layout.Index(0, j, k);
  feet.J = j;
  feet.K = k;
  float* out[3] = { feet.X.data(), feet.Y.data(), feet.Z.data() };
  // The velocity at a sample of one axis's faces is there; of the others the mean of the nearest.
  for (int axis = 0; axis < 3; ++axis)
  {
    const float* v = flow.Velocity[axis] + row;
    const std::ptrdiff_t own = layout.Stride(axis);
    const float half = -0.5f * flow.Scale[axis];
    if (axis == faceAxis)
    {
      for (int i = 0; i < count; ++i)
      {
        out[axis][i] = half * v[i];
      }
    }
    else if (faceAxis < 0)
    {
      for (int i = 0; i < count; ++i)
      {
        out[axis][i] = half * (0.5f * (v[i] + v[i + own]));
      }
    }
    else
    {
      const std::ptrdiff_t other = layout.Stride(faceAxis);
      for (int i = 0; i < count; ++i)
      {
        out[axis][i] = half * (0.25f * ((v[i] + v[i + own]) + (v[i - other] + v[i + own - other])));
      }
    }
  }

  const std::array<Reach, 3> reach = ReachOf(flow, faceAxis);
  const std::array<Reach, 3> flowReach[3] = { ReachOf(flow, 0), ReachOf(flow, 1),
                                              ReachOf(flow, 2) };
  // From the index space of these samples to that of the faces of an axis.
  float shift[3][3];
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int c = 0; c < 3; ++c)
    {
      shift[axis][c] = (axis == c ? 0.5f : 0.0f) - (faceAxis == c ? 0.5f : 0.0f);
    }
  }
  for (int i = 0; i < count; ++i)
  {
    float step[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::array<Reach, 3>& r = flowReach[axis];
      const float* s = shift[axis];
      const Foot foot =
        FootAt(layout, i, j, k, r[0].Limit(i, s[0], out[0][i]) + s[0],
               r[1].Limit(j, s[1], out[1][i]) + s[1], r[2].Limit(k, s[2], out[2][i]) + s[2]);
      step[axis] = flow.Scale[axis] * Linear(layout, flow.Velocity[axis], foot);
    }
    out[0][i] = reach[0].Limit(i, 0.0f, -step[0]);
    out[1][i] = reach[1].Limit(j, 0.0f, -step[1]);
    out[2][i] = reach[2].Limit(k, 0.0f, -step[2]);
  }
}

void SampleLinearRow(const StaggeredLayout& layout, const float* values, const FootRow& feet,
                     int count, float* out)
{
  for (int i = 0; i < count; ++i)
  {
    out[i] = Linear(layout, values, FootAt(layout, feet, i));
  }
}

void SampleCubicRow(const StaggeredLayout& layout, const float* values, const FootRow& feet,
                    int count, float* out)
{
  const std::ptrdiff_t sy = layout.StrideY;
  const std::ptrdiff_t sz = layout.StrideZ;
  for (int i = 0; i < count; ++i)
  {
    const Foot foot = FootAt(layout, feet, i);
    const float* p = values + foot.Base - 1;
    const Float4 line =
      Cubic(CubicAlongZ(p - sy, sz, foot.Tz), CubicAlongZ(p, sz, foot.Tz),
            CubicAlongZ(p + sy, sz, foot.Tz), CubicAlongZ(p + 2 * sy, sz, foot.Tz), foot.Ty);
    out[i] = Cubic(line[0], line[1], line[2], line[3], foot.Tx);
  }
}

void CorrectMacCormackRow(const StaggeredLayout& layout, const float* source, const FootRow& feet,
                          int count, const float* values, const float* forward,
                          const float* backward, float* out)
{
  for (int i = 0; i < count; ++i)
  {
    const Foot foot = FootAt(layout, feet, i);
    const float* p = source + foot.Base;
    float low = p[0];
    float high = p[0];
    for (int corner = 1; corner < 8; ++corner)
    {
      const float value =
        p[(corner & 1) + ((corner >> 1) & 1) * layout.StrideY + (corner >> 2) * layout.StrideZ];
      low = std::min(low, value);
      high = std::max(high, value);
    }
    const float corrected = forward[i] + 0.5f * (values[i] - backward[i]);
    out[i] = std::min(std::max(corrected, low), high);
  }
}

} // namespace waft
