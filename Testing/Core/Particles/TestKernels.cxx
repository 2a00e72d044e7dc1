// SPDX-License-Identifier: BSD-3-Clause
// The fast single-precision sums against the plain double ones, for each instruction set.
#include "Base/ForceFields.h"
#include "FastGas.h"

#include <gtest/gtest.h>

#include <functional>

using namespace waft;

namespace
{

std::vector<const SphKernelTable*> Tables()
{
  std::vector<const SphKernelTable*> tables{ &PortableSphKernels() };
  for (const SphKernelTable* table : { Avx2SphKernels(), Avx512SphKernels() })
  {
    if (table != nullptr)
    {
      tables.push_back(table);
    }
  }
  return tables;
}

/// sums: by place; which: of their two vectors.
void ExpectNear(const std::vector<Vec3>& expected, const std::vector<std::uint32_t>& order,
                const std::vector<SphPairSum>& sums, float (SphPairSum::*which)[3],
                double tolerance, const char* what)
{
  double error = 0.0, scale = 0.0;
  for (std::size_t k = 0; k < expected.size(); ++k)
  {
    for (int c = 0; c < 3; ++c)
    {
      error = std::max(error, std::abs(expected[order[k]][c] - (sums[k].*which)[c]));
      scale = std::max(scale, std::abs(expected[k][c]));
    }
  }
  EXPECT_LT(error, tolerance * scale) << what;
  EXPECT_GT(scale, 0.0) << what;
}

/// Away from walls. tolerance: of densities.
void CompareWithReference(RandomGas gas, double tolerance)
{
  for (Vec3& x : gas.State.Positions)
  {
    x += Vec3::Constant(5.0);
  }
  const Vec3 size = gas.Size + Vec3::Constant(10.0);
  SphRates rates;
  EvaluateSph(gas.Fluid, size, gas.State, rates);
  const SphState other = gas.RandomChange(4);
  SphRates weights;
  weights.Accelerations = other.Positions;
  weights.Averages = other.Velocities;
  SphState adjoint;
  AdjointSph(gas.Fluid, size, gas.State, weights, adjoint);
  for (const SphKernelTable* table : Tables())
  {
    FastGas fast(gas, *table);
    const std::size_t n = fast.N;
    const SphNeighbours list = fast.List.View();
    const std::vector<std::uint32_t>& order = fast.List.Order();
    const SphPairs pairs = fast.Pairs();
    const std::size_t all = n + SphFarRecords;
    std::vector<float> density(all), pressure(all);
    std::vector<SphPairSum> rateSums(all, SphPairSum{}), barSums(all, SphPairSum{});
    table->Density(fast.Constants, fast.Records.data(), list, n, pairs, density.data());
    for (std::size_t k = 0; k < n; ++k)
    {
      const std::size_t i = order[k];
      const bool isGas = i < gas.State.NumberOfGas;
      const double rho = density[k] + (isGas ? gas.Fluid.GasMass * gas.Fluid.Kernel(0.0) : 0.0);
      EXPECT_NEAR(rho, rates.Densities[i], tolerance);
      fast.Records[k].Pressure = static_cast<float>(gas.Fluid.Pressure(rates.Densities[i]));
    }
    table->Accelerate(fast.Constants, fast.Records.data(), pairs, n, rateSums.data());
    ExpectNear(rates.Accelerations, order, rateSums, &SphPairSum::First, 2e-5, table->Name);
    ExpectNear(rates.Averages, order, rateSums, &SphPairSum::Second, 2e-5, table->Name);

    std::vector<SphAdjointRecord> bars(all, SphAdjointRecord{});
    for (std::size_t k = 0; k < n; ++k)
    {
      const Vec3& p = weights.Accelerations[order[k]];
      const Vec3& q = weights.Averages[order[k]];
      bars[k] = { float(p.x()), float(p.y()), float(p.z()), 0.0f,
                  float(q.x()), float(q.y()), float(q.z()), 0.0f };
    }
    table->AdjointPressure(fast.Constants, fast.Records.data(), bars.data(), pairs, n,
                           pressure.data());
    for (std::size_t k = 0; k < n; ++k)
    {
      bars[k].Density =
        pressure[k] * static_cast<float>(gas.Fluid.PressureSlope(rates.Densities[order[k]]));
    }
    table->AdjointState(fast.Constants, fast.Records.data(), bars.data(), pairs, n, barSums.data());
    ExpectNear(adjoint.Positions, order, barSums, &SphPairSum::First, 5e-5, table->Name);
    ExpectNear(adjoint.Velocities, order, barSums, &SphPairSum::Second, 5e-5, table->Name);
  }
}

} // namespace

TEST(SphKernels, EqualTheReferenceAwayFromWalls)
{
  CompareWithReference(RandomGas(7, 20, 0.12), 2e-6);
}

TEST(SphKernels, EqualTheReferenceWhereGasIsCrowded)
{
  RandomGas gas(9, 20, 0.12);
  for (Vec3& x : gas.State.Positions)
  {
    x *= 0.45; // more than a hundred pairs at one particle
  }
  CompareWithReference(gas, 5e-5);
}

TEST(SphKernels, WallsAndTheRestDensityEqualTheReference)
{
  const RandomGas gas({ 5, 6, 5 }, 0, 0.1);
  const SphVolume volume = gas.Volume();
  Random random(3);
  constexpr std::size_t n = 160;
  std::vector<float> x[3];
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < n; ++i)
  {
    points.push_back(random.InBox({ Vec3::Constant(-1.0), gas.Size + Vec3::Constant(1.0) }));
    for (int c = 0; c < 3; ++c)
    {
      x[c].push_back(static_cast<float>(points.back()[c]));
    }
  }
  SphBox box;
  for (int c = 0; c < 3; ++c)
  {
    box.Min[c] = 0.0f;
    box.Max[c] = static_cast<float>(gas.Size[c]);
  }
  for (const SphKernelTable* table : Tables())
  {
    std::vector<float> psi(n), gradient(3 * n), hessian(6 * n);
    table->Walls(gas.Fluid.Constants(), box, n, x[0].data(), x[1].data(), x[2].data(), psi.data(),
                 { gradient.data(), n }, { hessian.data(), n });
    table->Rest(gas.Rest.View(), n, x[0].data(), x[1].data(), x[2].data(), psi.data(),
                { gradient.data(), n }, { hessian.data(), n });
    for (std::size_t i = 0; i < n; ++i)
    {
      const SurfaceDensityPart expected = SurfaceDensity(gas.Fluid, volume, points[i]);
      EXPECT_NEAR(psi[i], expected.Value, 3e-6);
      constexpr int First[6] = { 0, 0, 0, 1, 1, 2 };
      constexpr int Second[6] = { 0, 1, 2, 1, 2, 2 };
      for (int k = 0; k < 6; ++k)
      {
        EXPECT_NEAR(hessian[k * n + i], expected.Hessian(First[k], Second[k]), 2e-5) << k;
      }
      for (int c = 0; c < 3; ++c)
      {
        EXPECT_NEAR(gradient[c * n + i], expected.Gradient[c], 1e-5);
      }
    }
  }
}

TEST(SphKernels, VorticesEqualTheirClosedForm)
{
  Vortex vortex;
  vortex.P1 = Vec3(1.0, 2.0, 0.5);
  vortex.P2 = Vec3(2.0, 1.5, 6.0);
  vortex.Strength = -0.8;
  vortex.CoreRadius = 1.1;
  vortex.CenterTime = 10.0;
  vortex.Duration = 20.0;
  const double time = 17.0;
  SphVortex v;
  for (int c = 0; c < 3; ++c)
  {
    v.P1[c] = static_cast<float>(vortex.P1[c]);
    v.P2[c] = static_cast<float>(vortex.P2[c]);
  }
  v.Strength = static_cast<float>(vortex.Strength * vortex.TimeFactor(time) / (4.0 * M_PI));
  v.Core = static_cast<float>(1.1 * 1.1 * (vortex.P2 - vortex.P1).squaredNorm());
  Random random(3);
  constexpr std::size_t n = 64;
  std::vector<float> x[3];
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < n; ++i)
  {
    points.push_back(random.InBox({ Vec3::Constant(-1.0), Vec3::Constant(7.0) }));
    for (int c = 0; c < 3; ++c)
    {
      x[c].push_back(static_cast<float>(points.back()[c]));
    }
  }
  for (const SphKernelTable* table : Tables())
  {
    std::vector<float> force(3 * n, 0.0f), jacobian(9 * n, 0.0f);
    table->Vortices(&v, 1, n, x[0].data(), x[1].data(), x[2].data(), { force.data(), n },
                    { jacobian.data(), n });
    for (std::size_t i = 0; i < n; ++i)
    {
      Mat3 j;
      const Vec3 f = vortex.Acceleration(points[i], time, j);
      for (int a = 0; a < 3; ++a)
      {
        EXPECT_NEAR(force[a * n + i], f[a], 1e-6);
        for (int b = 0; b < 3; ++b)
        {
          EXPECT_NEAR(jacobian[(3 * a + b) * n + i], j(a, b), 1e-5);
        }
      }
    }
  }
}

TEST(SphKernels, SplinesReproduceALinearFieldAndTheirOwnSlope)
{
  SphSplineField field;
  const int dimensions[3] = { 5, 6, 4 };
  std::vector<float> linear, rough;
  Random random(11);
  for (int k = 0; k < 4; ++k)
  {
    for (int j = 0; j < 6; ++j)
    {
      for (int i = 0; i < 5; ++i)
      {
        linear.insert(linear.end(), { 2.0f * i - j, 0.5f * k + 1.0f, float(i + j + k), 0.0f });
        rough.insert(rough.end(), { float(random.Normal()), float(random.Normal()),
                                    float(random.Normal()), 0.0f });
      }
    }
  }
  for (int a = 0; a < 3; ++a)
  {
    field.Dimensions[a] = dimensions[a];
    field.Origin[a] = -1.0f;
    field.InverseSpacing[a] = 0.5f;
  }
  for (const SphKernelTable* table : Tables())
  {
    for (int sample = 0; sample < 40; ++sample)
    {
      const Vec3 u = random.InBox({ Vec3::Constant(0.6), Vec3(3.4, 4.4, 2.4) });
      const auto value = [&](const std::vector<float>& c, const Vec3& node, std::vector<float>& j)
      {
        field.Coefficients = c.data();
        const float p[3] = { float(2.0 * node.x() - 1.0), float(2.0 * node.y() - 1.0),
                             float(2.0 * node.z() - 1.0) };
        std::vector<float> f(3, 0.0f);
        j.assign(9, 0.0f);
        table->Spline(field, 1.0f, 1, p, p + 1, p + 2, { f.data(), 1 }, { j.data(), 1 });
        return Vec3(f[0], f[1], f[2]);
      };
      std::vector<float> j, unused;
      const Vec3 expected(2.0 * u.x() - u.y(), 0.5 * u.z() + 1.0, u.x() + u.y() + u.z());
      EXPECT_LT((value(linear, u, j) - expected).norm(), 1e-5);
      EXPECT_NEAR(j[0], 1.0, 1e-5); // 2 a node, half a node a length
      (void)value(rough, u, j);
      for (int b = 0; b < 3; ++b)
      {
        const Vec3 h = 1e-2 * Vec3::Unit(b);
        const Vec3 slope =
          (value(rough, u + h, unused) - value(rough, u - h, unused)) / (2.0 * 1e-2 * 2.0);
        for (int a = 0; a < 3; ++a)
        {
          EXPECT_NEAR(j[3 * a + b], slope[a], 2e-2);
        }
      }
    }
  }
}
