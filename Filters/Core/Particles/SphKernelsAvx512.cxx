// SPDX-License-Identifier: BSD-3-Clause
// As SphKernelsAvx2.cxx with twice the registers, and masks in registers of their own; the same
// bits.
#include "Particles/SphKernels.h"

#if defined(__AVX512VL__) && defined(__AVX512DQ__) && defined(__FMA__)
#include <immintrin.h>

namespace waft
{
namespace
{
#include "Particles/SphLanes256.txx"

#include "Particles/SphMasksAvx512.txx"

#include "Particles/SphPairSums.txx"

#include "Particles/SphPointTerms.txx"

#include "Particles/SphTable.txx"
} // namespace

const SphKernelTable* Avx512SphKernels()
{
  static const SphKernelTable table = MakeTable("AVX-512");
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
             __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
             __builtin_cpu_supports("fma")
           ? &table
           : nullptr;
}

} // namespace waft
#else
const waft::SphKernelTable* waft::Avx512SphKernels()
{
  return nullptr;
}
#endif
