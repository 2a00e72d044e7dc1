// SPDX-License-Identifier: BSD-3-Clause
// The fluid of Shi et al. 2005, Appendix B, in lengths of the gas spacing dx, times in frames and
// rho0 = 1: parameters, kernel, equation of state.
#pragma once

#include "Base/Result.h"
#include "Base/Types.h"
#include "Particles/SphKernels.h"

namespace waft
{

struct SphFluid
{
  double SmoothingLength = 1.2; // h [dx]; the kernel's support is 2h
  double SoundSpeed = 0.6;      // c0 [dx / frame]
  double Viscosity = 0.3;       // alpha of the artificial viscosity
  double Gamma = 1.0;           // exponent of the equation of state, Eq. 12
  double ObjectViscosity = 0.0; // factor of the viscosity between gas and objects
  double GasMass = 1.0;         // [rho0 dx^3], from the lattice
  double ObjectMass = 0.1;      // of one object particle [rho0 dx^3]

  Result Validate() const;

  double Support() const { return 2.0 * this->SmoothingLength; }
  double KernelScale() const; // sigma = 21 / (16 pi h^3)
  /// W at distance r.
  double Kernel(double r) const;
  double Kappa() const { return this->Viscosity * this->SoundSpeed * this->SmoothingLength; }

  /// P / rho^2 with P = (c0^2 / gamma) (rho^gamma - 1); below half the rest density it goes on as a
  /// straight line, so that an object in a hole of the gas feels a finite pull.
  double Pressure(double density) const;
  /// Its derivative by the density.
  double PressureSlope(double density) const;

  SphConstants Constants() const;
};

} // namespace waft
