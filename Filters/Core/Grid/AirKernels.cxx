// SPDX-License-Identifier: BSD-3-Clause
#include "Grid/AirKernels.h"

#include "Base/Simd.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace waft
{

WAFT_SIMD_CLONES
void CenterVelocityPlane(const StaggeredLayout& layout, const ConstVectorArrays& faces,
                         const VectorArrays& cells, int k)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::ptrdiff_t next = layout.Stride(axis);
    for (int j = 0; j < layout.N[1]; ++j)
    {
      const float* in = faces[axis] + layout.Index(0, j, k);
      float* out = cells[axis] + layout.Index(0, j, k);
#pragma GCC ivdep
      for (int i = 0; i < layout.N[0]; ++i)
      {
        out[i] = 0.5f * (in[i] + in[i + next]);
      }
    }
  }
}

WAFT_SIMD_CLONES
void VorticityPlane(const StaggeredLayout& layout, const std::array<float, 3>& spacing,
                    const ConstVectorArrays& cells, const VectorArrays& vorticity, float* size,
                    int k)
{
  const std::ptrdiff_t sy = layout.StrideY;
  const std::ptrdiff_t sz = layout.StrideZ;
  const float cx = 0.5f / spacing[0];
  const float cy = 0.5f / spacing[1];
  const float cz = 0.5f / spacing[2];
  for (int j = 0; j < layout.N[1]; ++j)
  {
    const std::ptrdiff_t row = layout.Index(0, j, k);
    const float* u = cells[0] + row;
    const float* v = cells[1] + row;
    const float* w = cells[2] + row;
    float* ox = vorticity[0] + row;
    float* oy = vorticity[1] + row;
    float* oz = vorticity[2] + row;
    float* length = size + row;
#pragma GCC ivdep
    for (int i = 0; i < layout.N[0]; ++i)
    {
      const float x = cy * (w[i + sy] - w[i - sy]) - cz * (v[i + sz] - v[i - sz]);
      const float y = cz * (u[i + sz] - u[i - sz]) - cx * (w[i + 1] - w[i - 1]);
      const float z = cx * (v[i + 1] - v[i - 1]) - cy * (u[i + sy] - u[i - sy]);
      ox[i] = x;
      oy[i] = y;
      oz[i] = z;
      length[i] = std::sqrt(x * x + (y * y + z * z));
    }
  }
}

WAFT_SIMD_CLONES
void ConfinePlane(const StaggeredLayout& layout, const std::array<float, 3>& spacing,
                  float strength, const ConstVectorArrays& vorticity, const float* size,
                  const VectorArrays& acceleration, int k)
{
  const std::ptrdiff_t sy = layout.StrideY;
  const std::ptrdiff_t sz = layout.StrideZ;
  const float cx = 0.5f / spacing[0];
  const float cy = 0.5f / spacing[1];
  const float cz = 0.5f / spacing[2];
  for (int j = 0; j < layout.N[1]; ++j)
  {
    const std::ptrdiff_t row = layout.Index(0, j, k);
    const float* ox = vorticity[0] + row;
    const float* oy = vorticity[1] + row;
    const float* oz = vorticity[2] + row;
    const float* s = size + row;
    float* ax = acceleration[0] + row;
    float* ay = acceleration[1] + row;
    float* az = acceleration[2] + row;
#pragma GCC ivdep
    for (int i = 0; i < layout.N[0]; ++i)
    {
      const float gx = cx * (s[i + 1] - s[i - 1]);
      const float gy = cy * (s[i + sy] - s[i - sy]);
      const float gz = cz * (s[i + sz] - s[i - sz]);
      const float scale = strength / std::sqrt((gx * gx + (gy * gy + gz * gz)) + 1e-12f);
      ax[i] += scale * (gy * oz[i] - gz * oy[i]);
      ay[i] += scale * (gz * ox[i] - gx * oz[i]);
      az[i] += scale * (gx * oy[i] - gy * ox[i]);
    }
  }
}

WAFT_SIMD_CLONES
void AddVortexPlane(const StaggeredLayout& layout, const std::array<float, 3>& origin,
                    const std::array<float, 3>& spacing, const VortexNow& vortex,
                    const VectorArrays& acceleration, int k)
{
  const float rx = vortex.R0[0];
  const float ry = vortex.R0[1];
  const float rz = vortex.R0[2];
  const float scale = vortex.Scale;
  const float core = vortex.Core;
  const float h = spacing[0];
  const float x1 = origin[0] - vortex.P1[0];
  const float x2 = origin[0] - vortex.P2[0];
  const float z = origin[2] + static_cast<float>(k) * spacing[2];
  const float z1 = z - vortex.P1[2];
  const float z2 = z - vortex.P2[2];
  for (int j = 0; j < layout.N[1]; ++j)
  {
    const std::ptrdiff_t row = layout.Index(0, j, k);
    const float y = origin[1] + static_cast<float>(j) * spacing[1];
    const float y1 = y - vortex.P1[1];
    const float y2 = y - vortex.P2[1];
    float* ax = acceleration[0] + row;
    float* ay = acceleration[1] + row;
    float* az = acceleration[2] + row;
    const float crossX = ry * z1 - rz * y1; // r1 x r2 = r0 x r1
#pragma GCC ivdep
    for (int i = 0; i < layout.N[0]; ++i)
    {
      const float dx = static_cast<float>(i) * h;
      const float a = x1 + dx;
      const float b = x2 + dx;
      const float crossY = rz * a - rx * z1;
      const float crossZ = rx * y1 - ry * a;
      const float n1 = std::sqrt((a * a + (y1 * y1 + z1 * z1)) + 1e-20f);
      const float n2 = std::sqrt((b * b + (y2 * y2 + z2 * z2)) + 1e-20f);
      const float along = (rx * a + (ry * y1 + rz * z1)) / n1 - (rx * b + (ry * y2 + rz * z2)) / n2;
      const float q = (crossX * crossX + (crossY * crossY + crossZ * crossZ)) + core;
      const float factor = scale * along / q;
      ax[i] += factor * crossX;
      ay[i] += factor * crossY;
      az[i] += factor * crossZ;
    }
  }
}

WAFT_SIMD_CLONES
void AddSeparablePlane(const StaggeredLayout& layout, const std::array<float, 3>& vector,
                       const float* x, const float* y, const float* z,
                       const VectorArrays& acceleration, int k)
{
  for (int j = 0; j < layout.N[1]; ++j)
  {
    const float factor = y[j] * z[k];
    for (int axis = 0; axis < 3; ++axis)
    {
      const float scale = factor * vector[axis];
      float* a = acceleration[axis] + layout.Index(0, j, k);
#pragma GCC ivdep
      for (int i = 0; i < layout.N[0]; ++i)
      {
        a[i] += scale * x[i];
      }
    }
  }
}

WAFT_SIMD_CLONES
float LargestSize(const float* values, std::size_t count)
{
  // Sizes of floats are in the order of their bits, which the compiler compares many at once.
  std::int32_t largest = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    std::int32_t bits;
    std::memcpy(&bits, values + i, sizeof(bits));
    largest = std::max(largest, bits & 0x7fffffff);
  }
  float size;
  std::memcpy(&size, &largest, sizeof(size));
  return size;
}

WAFT_SIMD_CLONES
void AccelerateFacesPlane(const StaggeredLayout& layout, int axis, float dt,
                          const float* acceleration, float* faces, int k)
{
  const std::ptrdiff_t back = layout.Stride(axis);
  const int count = layout.Count(0, axis);
  const float half = 0.5f * dt;
  for (int j = 0; j < layout.Count(1, axis); ++j)
  {
    const float* a = acceleration + layout.Index(0, j, k);
    float* u = faces + layout.Index(0, j, k);
#pragma GCC ivdep
    for (int i = 0; i < count; ++i)
    {
      u[i] += half * (a[i] + a[i - back]);
    }
  }
}

WAFT_SIMD_CLONES
double EnergyPlane(const StaggeredLayout& layout, int axis, const float* fractions,
                   const float* faces, bool skipLast, int k)
{
  constexpr int lanes = 16; // sums of their own, added in a fixed order
  const int count = layout.Count(0, axis) - (skipLast && axis == 0 ? 1 : 0);
  const int rows = layout.Count(1, axis) - (skipLast && axis == 1 ? 1 : 0);
  const int whole = count / lanes * lanes;
  if (skipLast && axis == 2 && k == layout.N[2])
  {
    return 0.0;
  }
  double total = 0.0;
  for (int j = 0; j < rows; ++j)
  {
    const float* f = fractions + layout.Index(0, j, k);
    const float* u = faces + layout.Index(0, j, k);
    float lane[lanes] = {};
    for (int i = 0; i < whole; i += lanes)
    {
      for (int l = 0; l < lanes; ++l)
      {
        lane[l] += f[i + l] * u[i + l] * u[i + l];
      }
    }
    for (int i = whole; i < count; ++i)
    {
      lane[i - whole] += f[i] * u[i] * u[i];
    }
    for (const float part : lane)
    {
      total += part;
    }
  }
  return total;
}

WAFT_SIMD_CLONES
void DivergencePlane(const StaggeredLayout& layout, const std::array<float, 3>& spacing,
                     const ConstVectorArrays& faces, const ConstVectorArrays& fractions,
                     const PaddedCells& cells, float* minusDivergence, int k)
{
  const std::ptrdiff_t sy = layout.StrideY;
  const std::ptrdiff_t sz = layout.StrideZ;
  const float cx = 1.0f / spacing[0];
  const float cy = 1.0f / spacing[1];
  const float cz = 1.0f / spacing[2];
  for (int j = 0; j < layout.N[1]; ++j)
  {
    const std::ptrdiff_t row = layout.Index(0, j, k);
    const float* u = faces[0] + row;
    const float* v = faces[1] + row;
    const float* w = faces[2] + row;
    const float* fu = fractions[0] + row;
    const float* fv = fractions[1] + row;
    const float* fw = fractions[2] + row;
    float* out = minusDivergence + cells.Index(0, j, k);
#pragma GCC ivdep
    for (int i = 0; i < layout.N[0]; ++i)
    {
      out[i] = (cx * (fu[i] * u[i] - fu[i + 1] * u[i + 1]) +
                cy * (fv[i] * v[i] - fv[i + sy] * v[i + sy])) +
               cz * (fw[i] * w[i] - fw[i + sz] * w[i + sz]);
    }
  }
}

WAFT_SIMD_CLONES
void ProjectPlane(const StaggeredLayout& layout, int axis, float spacing, const float* fractions,
                  const PaddedCells& cells, const float* phi, float* faces, int k)
{
  const std::ptrdiff_t back = axis == 0 ? 1 : axis == 1 ? cells.StrideY : cells.StrideZ;
  const int count = layout.Count(0, axis);
  const float scale = 1.0f / spacing;
  for (int j = 0; j < layout.Count(1, axis); ++j)
  {
    const float* f = fractions + layout.Index(0, j, k);
    float* u = faces + layout.Index(0, j, k);
    const float* p = phi + cells.Index(0, j, k);
#pragma GCC ivdep
    for (int i = 0; i < count; ++i)
    {
      const float value = u[i] - scale * (p[i] - p[i - back]);
      u[i] = f[i] > 0.0f ? value : 0.0f;
    }
  }
}

} // namespace waft
