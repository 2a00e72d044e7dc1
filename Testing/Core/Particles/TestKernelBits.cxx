// SPDX-License-Identifier: BSD-3-Clause
// What one machine computes is what another does: the vector versions give the same bits.
#include "FastGas.h"

#include <gtest/gtest.h>

#include <cstring>

using namespace waft;

namespace
{

constexpr std::size_t N = 8 * 40;

struct Part
{
  const char* Name;
  std::vector<unsigned char> Bits;
};

template <typename T>
Part Bits(const char* name, const std::vector<T>& values)
{
  Part part{ name, std::vector<unsigned char>(values.size() * sizeof(T)) };
  std::memcpy(part.Bits.data(), values.data(), part.Bits.size());
  return part;
}

std::vector<float> Normals(Random& random, std::size_t count)
{
  std::vector<float> values(count);
  for (float& value : values)
  {
    value = static_cast<float>(random.Normal());
  }
  return values;
}

/// The four sums over the pairs, crowded ones among them.
void PairSums(const SphKernelTable& table, std::vector<Part>& parts)
{
  RandomGas gas(9, 20, 0.15, 5);
  gas.State.Positions[0] = gas.State.Positions[1]; // at one place
  FastGas fast(gas, table);
  const std::size_t n = fast.N, all = n + SphFarRecords;
  Random random(6);
  std::vector<SphAdjointRecord> bars(all, SphAdjointRecord{});
  for (std::size_t k = 0; k < n; ++k)
  {
    const std::vector<float> r = Normals(random, 8);
    bars[k] = { r[0], r[1], r[2], r[3], r[4], r[5], r[6], 0.0f };
    fast.Records[k].Pressure = r[7];
  }
  const SphPairs pairs = fast.Pairs();
  std::vector<float> density(all), pressure(all);
  std::vector<SphPairSum> rates(all, SphPairSum{}), adjoints(all, SphPairSum{});
  const SphRecord* records = fast.Records.data();
  table.Density(fast.Constants, records, fast.List.View(), n, pairs, density.data());
  table.Accelerate(fast.Constants, records, pairs, n, rates.data());
  table.AdjointPressure(fast.Constants, records, bars.data(), pairs, n, pressure.data());
  table.AdjointState(fast.Constants, records, bars.data(), pairs, n, adjoints.data());
  parts.push_back(Bits("order", fast.List.Order()));
  parts.push_back(Bits("density", density));
  parts.push_back(Bits("nearest", fast.Nearest));
  parts.push_back(Bits("rates", rates));
  parts.push_back(Bits("pressure", pressure));
  parts.push_back(Bits("adjoints", adjoints));
}

/// Walls, rest density, a vortex and a spline field.
void PointTerms(const SphKernelTable& table, std::vector<Part>& parts)
{
  const RandomGas gas({ 5, 6, 5 }, 0, 0.1);
  Random random(3);
  std::vector<float> x[3];
  SphBox box;
  for (int c = 0; c < 3; ++c)
  {
    box.Min[c] = 0.0f;
    box.Max[c] = static_cast<float>(gas.Size[c]);
    for (std::size_t i = 0; i < N; ++i)
    {
      x[c].push_back(static_cast<float>(random.Uniform(-1.0, gas.Size[c] + 1.0)));
    }
  }
  const float *px = x[0].data(), *py = x[1].data(), *pz = x[2].data();
  std::vector<float> psi(N), gradient(3 * N), hessian(6 * N);
  table.Walls(gas.Fluid.Constants(), box, N, px, py, pz, psi.data(), { gradient.data(), N },
              { hessian.data(), N });
  table.Rest(gas.Rest.View(), N, px, py, pz, psi.data(), { gradient.data(), N },
             { hessian.data(), N });
  const SphVortex vortex{ { 1.0f, 2.0f, 0.5f }, { 2.0f, 1.5f, 6.0f }, -0.8f, 37.0f };
  std::vector<float> force(3 * N), jacobian(9 * N);
  table.Vortices(&vortex, 1, N, px, py, pz, { force.data(), N }, { jacobian.data(), N });
  const std::vector<float> coefficients = Normals(random, 4 * 5 * 6 * 4);
  const SphSplineField field{
    { 5, 6, 4 }, { -1.0f, -1.0f, -1.0f }, { 0.5f, 0.6f, 0.4f }, coefficients.data()
  };
  table.Spline(field, 0.3f, N, px, py, pz, { force.data(), N }, { jacobian.data(), N });
  parts.push_back(Bits("psi", psi));
  parts.push_back(Bits("its gradient", gradient));
  parts.push_back(Bits("its Hessian", hessian));
  parts.push_back(Bits("force", force));
  parts.push_back(Bits("its Jacobian", jacobian));
}

void Vectors(const SphKernelTable& table, std::vector<Part>& parts)
{
  Random random(8);
  const std::vector<float> a = Normals(random, N + 3), b = Normals(random, N + 3);
  std::vector<float> y = Normals(random, N + 3);
  const double dot = table.Vectors.Dot(N + 3, a.data(), b.data());
  const double sum = table.Vectors.AddDot(N + 3, 0.7f, a.data(), y.data(), b.data());
  parts.push_back(Bits("vector", y));
  parts.push_back(Bits("dot products", std::vector<double>{ dot, sum }));
}

} // namespace

TEST(SphKernels, AreTheSameBitsWithAvx2AndAvx512)
{
  const SphKernelTable* tables[2] = { Avx2SphKernels(), Avx512SphKernels() };
  if (tables[0] == nullptr || tables[1] == nullptr)
  {
    GTEST_SKIP() << "this machine does not have both";
  }
  std::vector<Part> parts[2];
  for (int t = 0; t < 2; ++t)
  {
    PairSums(*tables[t], parts[t]);
    PointTerms(*tables[t], parts[t]);
    Vectors(*tables[t], parts[t]);
  }
  for (std::size_t k = 0; k < parts[0].size(); ++k)
  {
    EXPECT_TRUE(parts[0][k].Bits == parts[1][k].Bits) << parts[0][k].Name;
  }
}
