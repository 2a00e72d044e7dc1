// SPDX-License-Identifier: BSD-3-Clause
// The table of one instruction set: a choice between the two index widths in front of each sum.
void DensityAny(const SphConstants& c, const SphRecord* records, const SphNeighbors& list,
                std::size_t n, float* density)
{
  list.Narrow ? DensitySum(c, records, list.Starts, list.Narrow, n, density)
              : DensitySum(c, records, list.Starts, list.Wide, n, density);
}

void AccelerateAny(const SphConstants& c, const SphRecord* records, const SphNeighbors& list,
                   std::size_t n, SphRows a, SphRows d)
{
  list.Narrow ? AccelerationSum(c, records, list.Starts, list.Narrow, n, a, d)
              : AccelerationSum(c, records, list.Starts, list.Wide, n, a, d);
}

void AdjointPressureAny(const SphConstants& c, const SphRecord* records,
                        const SphAdjointRecord* adjoints, const SphNeighbors& list, std::size_t n,
                        float* p)
{
  list.Narrow ? AdjointPressureSum(c, records, adjoints, list.Starts, list.Narrow, n, p)
              : AdjointPressureSum(c, records, adjoints, list.Starts, list.Wide, n, p);
}

void AdjointStateAny(const SphConstants& c, const SphRecord* records,
                     const SphAdjointRecord* adjoints, const SphNeighbors& list, std::size_t n,
                     SphRows x, SphRows v)
{
  list.Narrow ? AdjointStateSum(c, records, adjoints, list.Starts, list.Narrow, n, x, v)
              : AdjointStateSum(c, records, adjoints, list.Starts, list.Wide, n, x, v);
}

SphKernelTable MakeTable(const char* name)
{
  return { name,      DensityAny,  AccelerateAny, AdjointPressureAny, AdjointStateAny,
           WallTerms, VortexTerms, SplineTerms,   NearPoints };
}
