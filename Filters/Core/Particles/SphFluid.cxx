// SPDX-License-Identifier: BSD-3-Clause
#include "Particles/SphFluid.h"

#include <cmath>

namespace waft
{
namespace
{

constexpr double LeastDensity = 0.5; // of rho0: below it P / rho^2 is continued linearly

double Power(double density, double gamma)
{
  return gamma == 1.0 ? density : std::pow(density, gamma);
}

double PlainPressure(double density, double gamma)
{
  return (Power(density, gamma) - 1.0) / (gamma * density * density);
}

double PlainSlope(double density, double gamma)
{
  const double power = Power(density, gamma);
  return (power - 2.0 * (power - 1.0) / gamma) / (density * density * density);
}

} // namespace

Result SphFluid::Validate() const
{
  const bool positive = this->SmoothingLength > 0.0 && this->SoundSpeed > 0.0 &&
                        this->Gamma >= 1.0 && this->GasMass > 0.0 && this->ObjectMass > 0.0;
  if (!positive || !(this->Viscosity >= 0.0) || !(this->ObjectViscosity >= 0.0))
  {
    return Result::Error(
      "SPH: smoothing length, sound speed and masses must be positive, viscosity "
      "not negative, gamma at least 1");
  }
  return Result::Ok();
}

double SphFluid::KernelScale() const
{
  return 21.0 / (16.0 * M_PI * std::pow(this->SmoothingLength, 3));
}

double SphFluid::Kernel(double r) const
{
  const double s = std::max(0.0, 1.0 - r / this->Support());
  return this->KernelScale() * s * s * s * s * (5.0 - 4.0 * s);
}

double SphFluid::Pressure(double density) const
{
  const double c2 = this->SoundSpeed * this->SoundSpeed;
  if (density < LeastDensity)
  {
    return c2 * (PlainPressure(LeastDensity, this->Gamma) +
                 (density - LeastDensity) * PlainSlope(LeastDensity, this->Gamma));
  }
  return c2 * PlainPressure(density, this->Gamma);
}

double SphFluid::PressureSlope(double density) const
{
  const double c2 = this->SoundSpeed * this->SoundSpeed;
  return c2 * PlainSlope(std::max(density, LeastDensity), this->Gamma);
}

SphConstants SphFluid::Constants() const
{
  const double h = this->SmoothingLength;
  const double sigma = this->KernelScale();
  SphConstants c;
  c.SmoothingLength = static_cast<float>(h);
  c.InverseSupport = static_cast<float>(0.5 / h);
  c.KernelScale = static_cast<float>(sigma);
  c.GradientScale = static_cast<float>(-5.0 * sigma / (h * h));
  c.SecondScale = static_cast<float>(7.5 * sigma / (h * h * h));
  c.ViscousCore = static_cast<float>(0.01 * h * h);
  c.Kappa = static_cast<float>(this->Kappa());
  c.ObjectKappa = static_cast<float>(this->Kappa() * this->ObjectViscosity);
  c.GasMass = static_cast<float>(this->GasMass);
  c.ObjectMassThreshold = static_cast<float>(0.5 * (this->GasMass + this->ObjectMass));
  return c;
}

} // namespace waft
