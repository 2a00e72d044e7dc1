// SPDX-License-Identifier: BSD-3-Clause
#include "Particles/SphSurfaces.h"

#include "Particles/RestDensity.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

// 1 - psi of a plane at distance d and its derivatives: psi(d) = s^6 (3.5 - 4.5 s + 1.5 s^2),
// s = 1 - |d| / 2h; psi(-d) = 1 - psi(d).
void PlaneComplement(const SphFluid& fluid, double d, double& q, double& q1, double& q2)
{
  const double inverse = 1.0 / fluid.Support();
  const double s = std::max(0.0, 1.0 - std::abs(d) * inverse);
  const double s4 = s * s * s * s;
  const double psi = s4 * s * s * (3.5 - 4.5 * s + 1.5 * s * s);
  q = d < 0.0 ? psi : 1.0 - psi;
  q1 = inverse * s4 * s * (21.0 - 31.5 * s + 12.0 * s * s);
  q2 = (d < 0.0 ? 1.0 : -1.0) * inverse * inverse * s4 * (105.0 - 189.0 * s + 84.0 * s * s);
}

SurfaceDensityPart Walls(const SphFluid& fluid, const Vec3& size, const Vec3& x)
{
  Vec3 q, q1, q2;
  for (int a = 0; a < 3; ++a)
  {
    double low, low1, low2, high, high1, high2;
    PlaneComplement(fluid, x[a], low, low1, low2);
    PlaneComplement(fluid, size[a] - x[a], high, high1, high2);
    q[a] = low * high;
    q1[a] = low1 * high - low * high1;
    q2[a] = low2 * high + low * high2 - 2.0 * low1 * high1;
  }
  SurfaceDensityPart part;
  part.Value = 1.0 - q.prod();
  for (int a = 0; a < 3; ++a)
  {
    const int b = (a + 1) % 3;
    const int c = (a + 2) % 3;
    part.Gradient[a] = -q1[a] * q[b] * q[c];
    part.Hessian(a, a) = -q2[a] * q[b] * q[c];
    part.Hessian(a, b) = part.Hessian(b, a) = -q1[a] * q1[b] * q[c];
  }
  return part;
}

} // namespace

void SurfaceDensityPart::Add(const SphFluid& fluid, double d, const Vec3& normal,
                             const Mat3& curvature)
{
  double q, q1, q2;
  PlaneComplement(fluid, d, q, q1, q2);
  const double open = 1.0 - this->Value;
  const Mat3 mixed = this->Gradient * normal.transpose();
  this->Hessian = q * this->Hessian + q1 * (mixed + mixed.transpose()) -
                  open * (q2 * normal * normal.transpose() + q1 * curvature);
  this->Gradient = q * this->Gradient - open * q1 * normal;
  this->Value = 1.0 - open * q;
}

SurfaceDensityPart SurfaceDensity(const SphFluid& fluid, const SphVolume& volume, const Vec3& x)
{
  SurfaceDensityPart part = Walls(fluid, volume.Size, x);
  if (volume.Obstacles != nullptr && !volume.Obstacles->IsEmpty())
  {
    Vec3 normal;
    Mat3 curvature;
    const double d = volume.Obstacles->Evaluate(x, volume.Frame, normal, curvature);
    part.Add(fluid, d, normal, curvature);
  }
  if (volume.Rest != nullptr)
  {
    Vec3 gradient;
    Mat3 hessian;
    part.Value += volume.Rest->Evaluate(x, gradient, hessian);
    part.Gradient += gradient;
    part.Hessian += hessian;
  }
  return part;
}

} // namespace waft
