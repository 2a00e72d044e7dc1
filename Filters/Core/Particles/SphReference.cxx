// SPDX-License-Identifier: BSD-3-Clause
#include "Particles/SphReference.h"

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

void Plane(const SphFluid& fluid, double d, double& q, double& q1, double& q2)
{
  const double inverse = 1.0 / fluid.Support();
  const double s = std::max(0.0, 1.0 - std::abs(d) * inverse);
  const double psi = std::pow(s, 6) * (3.5 - 4.5 * s + 1.5 * s * s);
  q = d < 0.0 ? psi : 1.0 - psi;
  q1 = inverse * std::pow(s, 5) * (21.0 - 31.5 * s + 12.0 * s * s);
  q2 = (d < 0.0 ? 1.0 : -1.0) * inverse * inverse * std::pow(s, 4) *
       (105.0 - 189.0 * s + 84.0 * s * s);
}

struct Densities
{
  std::vector<double> Rho, P, Slope, Psi;
  std::vector<Vec3> Gradient;
  std::vector<Mat3> Hessian;
};

Densities ComputeDensities(const SphFluid& fluid, const Vec3& size, const SphState& state)
{
  const std::size_t n = state.Positions.size();
  Densities d;
  d.Rho.assign(n, 0.0);
  d.Gradient.resize(n);
  d.Hessian.resize(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    d.Rho[i] = WallFraction(fluid, size, state.Positions[i], d.Gradient[i], d.Hessian[i]);
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

double WallFraction(const SphFluid& fluid, const Vec3& size, const Vec3& x, Vec3& gradient,
                    Mat3& hessian)
{
  Vec3 q, q1, q2;
  for (int a = 0; a < 3; ++a)
  {
    double low, low1, low2, high, high1, high2;
    Plane(fluid, x[a], low, low1, low2);
    Plane(fluid, size[a] - x[a], high, high1, high2);
    q[a] = low * high;
    q1[a] = low1 * high - low * high1;
    q2[a] = low2 * high + low * high2 - 2.0 * low1 * high1;
  }
  for (int a = 0; a < 3; ++a)
  {
    const int b = (a + 1) % 3;
    const int c = (a + 2) % 3;
    gradient[a] = -q1[a] * q[b] * q[c];
    hessian(a, a) = -q2[a] * q[b] * q[c];
    hessian(a, b) = hessian(b, a) = -q1[a] * q1[b] * q[c];
  }
  return 1.0 - q.prod();
}

void EvaluateSph(const SphFluid& fluid, const Vec3& size, const SphState& state, SphRates& rates)
{
  const std::size_t n = state.Positions.size();
  const Densities d = ComputeDensities(fluid, size, state);
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

void TangentSph(const SphFluid& fluid, const Vec3& size, const SphState& state,
                const SphState& change, SphRates& rates)
{
  const std::size_t n = state.Positions.size();
  const Densities d = ComputeDensities(fluid, size, state);
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

void AdjointSph(const SphFluid& fluid, const Vec3& size, const SphState& state,
                const SphRates& weights, SphState& adjoint)
{
  const std::size_t n = state.Positions.size();
  const Densities d = ComputeDensities(fluid, size, state);
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
