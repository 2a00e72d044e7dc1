// SPDX-License-Identifier: BSD-3-Clause
#include "Particles/SphReference.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

struct Pair
{
  Vec3 X, V;
  double MassI, MassJ;
  double W, F, G;
  double Kappa;
  double Guard; // 1 / (r^2 + 0.01 h^2)
};

double Mass(const SphFluid& fluid, const SphState& state, std::size_t i)
{
  return i < state.NumberOfGas ? fluid.GasMass : fluid.ObjectMass;
}

// Calls function(i, j, pair) for each ordered pair within the support, objects among each other
// left out.
template <typename Function>
void ForPairs(const SphFluid& fluid, const SphState& state, Function function)
{
  const double h = fluid.SmoothingLength;
  const double sigma = fluid.KernelScale();
  const std::size_t n = state.Positions.size();
  for (std::size_t i = 0; i < n; ++i)
  {
    for (std::size_t j = 0; j < n; ++j)
    {
      const bool objects = i >= state.NumberOfGas || j >= state.NumberOfGas;
      if (i == j || (i >= state.NumberOfGas && j >= state.NumberOfGas))
      {
        continue;
      }
      Pair p;
      p.X = state.Positions[i] - state.Positions[j];
      const double r = p.X.norm();
      const double s = 1.0 - r / (2.0 * h);
      if (s <= 0.0)
      {
        continue;
      }
      p.V = state.Velocities[i] - state.Velocities[j];
      p.MassI = Mass(fluid, state, i);
      p.MassJ = Mass(fluid, state, j);
      p.W = sigma * s * s * s * s * (5.0 - 4.0 * s);
      p.F = -5.0 * sigma / (h * h) * s * s * s;
      p.G = 7.5 * sigma / (h * h * h) * s * s / std::max(r, 1e-6);
      p.Kappa = fluid.Kappa() * (objects ? fluid.ObjectViscosity : 1.0);
      p.Guard = 1.0 / (r * r + 0.01 * h * h);
      function(i, j, p);
    }
  }
}

struct Densities
{
  std::vector<double> Rho, P, Slope;
  std::vector<Vec3> Gradient;
  std::vector<Mat3> Hessian;
};

Densities ComputeDensities(const SphFluid& fluid, const SphVolume& volume, const SphState& state)
{
  const std::size_t n = state.Positions.size();
  Densities d;
  d.Rho.assign(n, 0.0);
  d.Gradient.resize(n);
  d.Hessian.resize(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    const SurfaceDensityPart surfaces = SurfaceDensity(fluid, volume, state.Positions[i]);
    d.Rho[i] = surfaces.Value;
    d.Gradient[i] = surfaces.Gradient;
    d.Hessian[i] = surfaces.Hessian;
    d.Rho[i] += i < state.NumberOfGas ? fluid.GasMass * fluid.Kernel(0.0) : 0.0;
  }
  ForPairs(fluid, state,
           [&](std::size_t i, std::size_t, const Pair& p) { d.Rho[i] += p.MassJ * p.W; });
  for (const double rho : d.Rho)
  {
    d.P.push_back(fluid.Pressure(rho));
    d.Slope.push_back(fluid.PressureSlope(rho));
  }
  return d;
}

} // namespace

void EvaluateSph(const SphFluid& fluid, const SphVolume& volume, const SphState& state,
                 SphRates& rates)
{
  const std::size_t n = state.Positions.size();
  const Densities d = ComputeDensities(fluid, volume, state);
  rates.Densities = d.Rho;
  rates.Averages.assign(n, Vec3::Zero());
  rates.Accelerations.resize(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    rates.Accelerations[i] = -2.0 * d.P[i] * d.Gradient[i];
  }
  ForPairs(fluid, state,
           [&](std::size_t i, std::size_t j, const Pair& p)
           {
             const double tension = d.P[i] + d.P[j] - p.Kappa * p.V.dot(p.X) * p.Guard;
             rates.Accelerations[i] -= (p.MassJ * tension * p.F) * p.X;
             rates.Averages[i] -= (p.MassJ * p.W) * p.V;
           });
}

void TangentSph(const SphFluid& fluid, const SphVolume& volume, const SphState& state,
                const SphState& change, SphRates& rates)
{
  const std::size_t n = state.Positions.size();
  const Densities d = ComputeDensities(fluid, volume, state);
  const auto dx = [&](std::size_t i, std::size_t j)
  { return Vec3(change.Positions[i] - change.Positions[j]); };
  const auto dv = [&](std::size_t i, std::size_t j)
  { return Vec3(change.Velocities[i] - change.Velocities[j]); };
  rates.Densities.resize(n);
  rates.Averages.assign(n, Vec3::Zero());
  rates.Accelerations.assign(n, Vec3::Zero());
  for (std::size_t i = 0; i < n; ++i)
  {
    rates.Densities[i] = d.Gradient[i].dot(change.Positions[i]);
  }
  ForPairs(fluid, state,
           [&](std::size_t i, std::size_t j, const Pair& p)
           { rates.Densities[i] += p.MassJ * p.F * p.X.dot(dx(i, j)); });
  std::vector<double> dp(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    dp[i] = d.Slope[i] * rates.Densities[i];
    rates.Accelerations[i] =
      -2.0 * (dp[i] * d.Gradient[i] + d.P[i] * (d.Hessian[i] * change.Positions[i]));
  }
  ForPairs(fluid, state,
           [&](std::size_t i, std::size_t j, const Pair& p)
           {
             const Vec3 x = dx(i, j);
             const Vec3 v = dv(i, j);
             const double approach = p.V.dot(p.X) * p.Guard;
             const double tension = d.P[i] + d.P[j] - p.Kappa * approach;
             const double viscous =
               -p.Kappa * p.Guard * (v.dot(p.X) + p.V.dot(x) - 2.0 * approach * p.X.dot(x));
             rates.Accelerations[i] -= p.MassJ * ((dp[i] + dp[j] + viscous) * p.F * p.X +
                                                  tension * (p.F * x + p.G * p.X.dot(x) * p.X));
             rates.Averages[i] -= p.MassJ * (p.F * p.X.dot(x) * p.V + p.W * v);
           });
}

void AdjointSph(const SphFluid& fluid, const SphVolume& volume, const SphState& state,
                const SphRates& weights, SphState& adjoint)
{
  const std::size_t n = state.Positions.size();
  const Densities d = ComputeDensities(fluid, volume, state);
  adjoint.NumberOfGas = state.NumberOfGas;
  adjoint.Positions.resize(n);
  adjoint.Velocities.assign(n, Vec3::Zero());
  std::vector<double> bar(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    bar[i] = -2.0 * d.Gradient[i].dot(weights.Accelerations[i]);
    adjoint.Positions[i] = -2.0 * d.P[i] * (d.Hessian[i] * weights.Accelerations[i]);
  }
  const auto b = [&](std::size_t i, std::size_t j, const Pair& p) -> Vec3
  { return p.MassJ * weights.Accelerations[i] - p.MassI * weights.Accelerations[j]; };
  ForPairs(fluid, state,
           [&](std::size_t i, std::size_t j, const Pair& p)
           { bar[i] -= p.F * b(i, j, p).dot(p.X); });
  for (std::size_t i = 0; i < n; ++i)
  {
    bar[i] *= d.Slope[i];
    adjoint.Positions[i] += bar[i] * d.Gradient[i];
  }
  ForPairs(fluid, state,
           [&](std::size_t i, std::size_t j, const Pair& p)
           {
             const Vec3 a = b(i, j, p);
             const Vec3 B = p.MassJ * weights.Averages[i] - p.MassI * weights.Averages[j];
             const double approach = p.V.dot(p.X) * p.Guard;
             const double tension = d.P[i] + d.P[j] - p.Kappa * approach;
             const double viscous = p.Kappa * p.F * a.dot(p.X) * p.Guard;
             adjoint.Positions[i] += -tension * (p.F * a + p.G * a.dot(p.X) * p.X) +
                                     viscous * (p.V - 2.0 * approach * p.X) -
                                     p.F * B.dot(p.V) * p.X +
                                     (p.MassJ * bar[i] + p.MassI * bar[j]) * p.F * p.X;
             adjoint.Velocities[i] += viscous * p.X - p.W * B;
           });
}

} // namespace waft
