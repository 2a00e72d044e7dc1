// SPDX-License-Identifier: BSD-3-Clause
// How long the gas keeps its eddies: shear waves and Taylor and Green's vortices.
#pragma once

namespace waft
{

/// What the gas is made of; members have the filter's defaults.
struct EddyGas
{
  double Viscosity = 0.2;
  double SmoothingLength = 1.2; // [dx]
  double CourantNumber = 0.5;   // c0 = CourantNumber h
  /// Of the force of walls, - Walls p_i grad Psi: as much again as neighbours give, or the gradient
  /// of what all densities cost.
  double Walls = 2.0;
};

/// Prints a row a wave length: viscosity by a shear wave; how far the lattice at rest has come
/// after 1000 frames; how long Taylor and Green's vortices keep half their energy in such gas
/// alone, and the share of it that is left after three and eight seconds there and in a sampled air
/// of these vortices. Returns a process' exit status.
int RunEddies(const EddyGas& kind);

} // namespace waft
