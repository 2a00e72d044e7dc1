// SPDX-License-Identifier: BSD-3-Clause
#include "Particles/SphKernels.h"

namespace waft
{
namespace
{
#include "Particles/SphLanesPortable.txx"

#include "Particles/SphPairSums.txx"

#include "Particles/SphPointTerms.txx"

#include "Particles/SphTable.txx"
} // namespace

const SphKernelTable& PortableSphKernels()
{
  static const SphKernelTable table = MakeTable("portable");
  return table;
}

const SphKernelTable& FastestSphKernels()
{
  const SphKernelTable* avx512 = Avx512SphKernels();
  const SphKernelTable* avx2 = Avx2SphKernels();
  return avx512 ? *avx512 : avx2 ? *avx2 : PortableSphKernels();
}

} // namespace waft
