// SPDX-License-Identifier: BSD-3-Clause
// Compiled with -mavx2 -mfma where the compiler targets x86-64; it must include nothing whose
// inline functions could be picked up by code that runs on other machines.
#include "Particles/SphKernels.h"

#if defined(__AVX2__) && defined(__FMA__)
#include <immintrin.h>

namespace waft
{
namespace
{
#include "Particles/SphLanes256.txx"

#include "Particles/SphMasksAvx2.txx"

#include "Particles/SphPairSums.txx"

#include "Particles/SphPointTerms.txx"

#include "Particles/SphTable.txx"
} // namespace

const SphKernelTable* Avx2SphKernels()
{
  static const SphKernelTable table = MakeTable("AVX2");
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? &table : nullptr;
}

} // namespace waft
#else
const waft::SphKernelTable* waft::Avx2SphKernels()
{
  return nullptr;
}
#endif
