// SPDX-License-Identifier: BSD-3-Clause
// What loops over numbers need of a processor: functions for AVX2 that are chosen at run time, and
// four numbers side by side.
#pragma once

#include <cstring>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

/// A function compiled for every processor and for AVX2, chosen when the program starts. No fused
/// multiply-add in either, so that both give the same bits. Not under the thread sanitizer, which
/// does not run yet when the choice is made.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && !defined(__SANITIZE_THREAD__)
#define WAFT_SIMD_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define WAFT_SIMD_CLONES
#endif

/// What such a function calls in its loops, compiled for what its caller is.
#if defined(__GNUC__)
#define WAFT_INLINE inline __attribute__((always_inline))
#else
#define WAFT_INLINE inline
#endif

namespace waft
{

/// Four floats in the vector extension that GCC and Clang have.
typedef float Float4 __attribute__((vector_size(16)));
/// And four doubles, at places that are multiples of 32 bytes whatever a function is compiled for.
typedef double Double4 __attribute__((vector_size(32), aligned(32)));

inline Float4 Load4(const float* p)
{
  Float4 v;
  std::memcpy(&v, p, sizeof(v));
  return v;
}

/// The lesser and the greater of floats, or of vectors lane by lane, as the instructions MINPS and
/// MAXPS have them: of equal ones, and beside what is no number, the second.
template <typename Values>
inline Values Lesser(const Values& a, const Values& b)
{
  return a < b ? a : b;
}
template <typename Values>
inline Values Greater(const Values& a, const Values& b)
{
  return a > b ? a : b;
}
#if defined(__SSE2__)
// Written out: from the expression GCC makes them in part alone, which costs cubic samples a tenth.
template <>
inline Float4 Lesser(const Float4& a, const Float4& b)
{
  return _mm_min_ps(a, b);
}
template <>
inline Float4 Greater(const Float4& a, const Float4& b)
{
  return _mm_max_ps(a, b);
}
#endif

} // namespace waft
