// SPDX-License-Identifier: BSD-3-Clause
// Where most of the time of a smoke simulation goes: cubic samples at the feet of a row, one by one
// or, where the processor has AVX2, eight at a time to the same bits.
#include "Base/Simd.h"
#include "Grid/AdvectionKernels.h"

#if defined(__GNUC__) && defined(__x86_64__)
#define WAFT_HAS_EIGHTS
#include <immintrin.h>
#endif

namespace waft
{
namespace
{

// Hermite cubic from f1 to f2 with central slopes, held between 0 and three times the difference
// (Fedkiw et al. 2001, Appendix B, with the bound that makes the cubic monotone). Written so that a
// mirror image gives the same bits. Of one sample or of four.
template <typename Values>
inline Values Cubic(const Values& f0, const Values& f1, const Values& f2, const Values& f3, float t)
{
  const Values zero{};
  const Values d = f2 - f1;
  const Values d3 = 3.0f * d;
  const Values low = Lesser(zero, d3);
  const Values high = Greater(zero, d3);
  const Values m1 = Lesser(Greater(0.5f * (f2 - f0), low), high);
  const Values m2 = Lesser(Greater(0.5f * (f3 - f1), low), high);
  const float s = 1.0f - t;
  return (s * f1 + t * f2) + (s * t) * (s * (m1 - d) - t * (m2 - d));
}

inline Float4 CubicAlongZ(const float* p, std::ptrdiff_t stride, float t)
{
  return Cubic(Load4(p - stride), Load4(p), Load4(p + stride), Load4(p + 2 * stride), t);
}

// Of the samples from `first` on.
void SampleOneByOne(const StaggeredLayout& layout, const float* values, std::ptrdiff_t row,
                    const FootRow& feet, int first, int count, float* out)
{
  const std::ptrdiff_t sy = layout.StrideY;
  const std::ptrdiff_t sz = layout.StrideZ;
  for (int i = first; i < count; ++i)
  {
    const float* p = values + row + feet.Corner[i] - 1;
    const float tz = feet.Tz[i];
    const Float4 line =
      Cubic(CubicAlongZ(p - sy, sz, tz), CubicAlongZ(p, sz, tz), CubicAlongZ(p + sy, sz, tz),
            CubicAlongZ(p + 2 * sy, sz, tz), feet.Ty[i]);
    out[i] = Cubic(line[0], line[1], line[2], line[3], feet.Tx[i]);
  }
}

#if defined(WAFT_HAS_EIGHTS)

#define WAFT_AVX2 __attribute__((target("avx2")))

// The same formula, of eight samples in two halves.
WAFT_AVX2 inline __m256 Cubic(__m256 f0, __m256 f1, __m256 f2, __m256 f3, __m256 t)
{
  const __m256 zero = _mm256_setzero_ps();
  const __m256 d = f2 - f1;
  const __m256 d3 = 3.0f * d;
  const __m256 low = _mm256_min_ps(zero, d3);
  const __m256 high = _mm256_max_ps(zero, d3);
  const __m256 m1 = _mm256_min_ps(_mm256_max_ps(0.5f * (f2 - f0), low), high);
  const __m256 m2 = _mm256_min_ps(_mm256_max_ps(0.5f * (f3 - f1), low), high);
  const __m256 s = 1.0f - t;
  return (s * f1 + t * f2) + (s * t) * (s * (m1 - d) - t * (m2 - d));
}

// Four floats at a, then four at b.
WAFT_AVX2 inline __m256 LoadTwo(const float* a, const float* b)
{
  return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(a)), _mm_loadu_ps(b), 1);
}

WAFT_AVX2 inline __m256 CubicAlongZ(const float* a, const float* b, std::ptrdiff_t stride, __m256 t)
{
  return Cubic(LoadTwo(a - stride, b - stride), LoadTwo(a, b), LoadTwo(a + stride, b + stride),
               LoadTwo(a + 2 * stride, b + 2 * stride), t);
}

WAFT_AVX2 inline __m256 SplatTwo(const float* t)
{
  return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_set1_ps(t[0])), _mm_set1_ps(t[1]), 1);
}

// As many eights as there are; how many samples that is.
WAFT_AVX2 int SampleEights(const StaggeredLayout& layout, const float* values, std::ptrdiff_t row,
                           const FootRow& feet, int count, float* out)
{
  const std::ptrdiff_t sy = layout.StrideY;
  const std::ptrdiff_t sz = layout.StrideZ;
  const int* corner = feet.Corner.data();
  int i = 0;
  for (; i + 8 <= count; i += 8)
  {
    __m256 lines[4]; // along x: of samples 0 and 1, 2 and 3, ...
    for (int pair = 0; pair < 4; ++pair)
    {
      const int at = i + 2 * pair;
      const float* a = values + row + corner[at] - 1;
      const float* b = values + row + corner[at + 1] - 1;
      const __m256 tz = SplatTwo(feet.Tz.data() + at);
      lines[pair] =
        Cubic(CubicAlongZ(a - sy, b - sy, sz, tz), CubicAlongZ(a, b, sz, tz),
              CubicAlongZ(a + sy, b + sy, sz, tz), CubicAlongZ(a + 2 * sy, b + 2 * sy, sz, tz),
              SplatTwo(feet.Ty.data() + at));
    }
    // Transposed within the halves: samples 0, 2, 4, 6 below and 1, 3, 5, 7 above.
    const __m256 ab01 = _mm256_unpacklo_ps(lines[0], lines[1]);
    const __m256 ab23 = _mm256_unpackhi_ps(lines[0], lines[1]);
    const __m256 cd01 = _mm256_unpacklo_ps(lines[2], lines[3]);
    const __m256 cd23 = _mm256_unpackhi_ps(lines[2], lines[3]);
    const __m256 f0 = _mm256_shuffle_ps(ab01, cd01, 0x44);
    const __m256 f1 = _mm256_shuffle_ps(ab01, cd01, 0xee);
    const __m256 f2 = _mm256_shuffle_ps(ab23, cd23, 0x44);
    const __m256 f3 = _mm256_shuffle_ps(ab23, cd23, 0xee);
    const __m256i split = _mm256_setr_epi32(0, 2, 4, 6, 1, 3, 5, 7);
    const __m256i merge = _mm256_setr_epi32(0, 4, 1, 5, 2, 6, 3, 7);
    const __m256 tx = _mm256_permutevar8x32_ps(_mm256_loadu_ps(feet.Tx.data() + i), split);
    _mm256_storeu_ps(out + i, _mm256_permutevar8x32_ps(Cubic(f0, f1, f2, f3, tx), merge));
  }
  return i;
}

#endif

} // namespace

void SampleCubicRow(const StaggeredLayout& layout, const float* values, std::ptrdiff_t row,
                    const FootRow& feet, int count, float* out)
{
  int done = 0;
#if defined(WAFT_HAS_EIGHTS)
  static const bool hasEights = __builtin_cpu_supports("avx2");
  done = hasEights ? SampleEights(layout, values, row, feet, count, out) : 0;
#endif
  SampleOneByOne(layout, values, row, feet, done, count, out);
}

} // namespace waft
