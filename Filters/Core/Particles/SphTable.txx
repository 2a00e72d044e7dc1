// SPDX-License-Identifier: BSD-3-Clause
// The table of one instruction set: a choice between the two widths of the lists' indices.
void DensityAny(const SphConstants& c, const SphRecord* records, const SphNeighbours& list,
                std::size_t n, const SphPairs& pairs, float* density)
{
  list.Narrow ? DensitySum(c, records, list.Starts, list.Narrow, n, pairs, density)
              : DensitySum(c, records, list.Starts, list.Wide, n, pairs, density);
}

double DotProduct(std::size_t n, const float* a, const float* b)
{
  DoubleSum sum;
  std::size_t i = 0;
  for (; i + 8 <= n; i += 8)
  {
    sum.AddProduct(Lanes::Load(a + i), Lanes::Load(b + i));
  }
  double total = sum.Total();
  for (; i < n; ++i)
  {
    total += static_cast<double>(a[i]) * b[i];
  }
  return total;
}

double AddAndDot(std::size_t n, float factor, const float* x, float* y, const float* z)
{
  const Lanes f = Lanes::Set(factor);
  DoubleSum sum;
  std::size_t i = 0;
  for (; i + 8 <= n; i += 8)
  {
    const Lanes value = Fma(f, Lanes::Load(x + i), Lanes::Load(y + i));
    value.Store(y + i);
    sum.AddProduct(value, Lanes::Load(z + i));
  }
  double total = sum.Total();
  for (; i < n; ++i)
  {
    y[i] += factor * x[i];
    total += static_cast<double>(y[i]) * z[i];
  }
  return total;
}

SphKernelTable MakeTable(const char* name)
{
  return { name,      DensityAny, AccelerationSum, AdjointPressureSum, AdjointStateSum,
           WallTerms, RestTerms,  VortexTerms,     SplineTerms,        NearPoints,
           { DotProduct, AddAndDot } };
}
