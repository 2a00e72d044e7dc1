// SPDX-License-Identifier: BSD-3-Clause
// Four floats side by side, in the vector extension that GCC and Clang have.
#pragma once

#include <cstring>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace waft
{

typedef float Float4 __attribute__((vector_size(16)));

inline Float4 Load4(const float* p)
{
  Float4 v;
  std::memcpy(&v, p, sizeof(v));
  return v;
}

#if defined(__SSE2__)
inline Float4 Min4(const Float4& a, const Float4& b)
{
  return _mm_min_ps(a, b);
}
inline Float4 Max4(const Float4& a, const Float4& b)
{
  return _mm_max_ps(a, b);
}
#else
inline Float4 Min4(const Float4& a, const Float4& b)
{
  Float4 v;
  for (int l = 0; l < 4; ++l)
  {
    v[l] = a[l] < b[l] ? a[l] : b[l];
  }
  return v;
}
inline Float4 Max4(const Float4& a, const Float4& b)
{
  Float4 v;
  for (int l = 0; l < 4; ++l)
  {
    v[l] = a[l] > b[l] ? a[l] : b[l];
  }
  return v;
}
#endif

} // namespace waft
