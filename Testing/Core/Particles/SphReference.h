// SPDX-License-Identifier: BSD-3-Clause
// The pair sums of one frame in double precision by brute force, with their tangent and adjoint:
// plain code to hold the fast kernels against, and to replay a motion as a simulation.
#pragma once

#include "Base/Types.h"
#include "Particles/SphFluid.h"
#include "Particles/SphSurfaces.h"

#include <vector>

namespace waft
{

/// Positions and velocities of all particles of a frame; the first NumberOfGas are gas.
struct SphState
{
  std::vector<Vec3> Positions;  // dx
  std::vector<Vec3> Velocities; // dx / frame
  std::size_t NumberOfGas = 0;
};

/// What the pair sums and the walls give.
struct SphRates
{
  std::vector<double> Densities;
  std::vector<Vec3> Accelerations; // pressure, viscosity, walls [dx / frame^2]
  std::vector<Vec3> Averages;      // D_i = sum_j m_j W_ij (v_j - v_i)
};

/// rho, a and D in a volume; a box alone may be given by its size (dx).
void EvaluateSph(const SphFluid& fluid, const SphVolume& volume, const SphState& state,
                 SphRates& rates);

/// Their change for a change of the state.
void TangentSph(const SphFluid& fluid, const SphVolume& volume, const SphState& state,
                const SphState& change, SphRates& rates);

/// The transpose: weights of accelerations and averages to weights of positions and velocities.
void AdjointSph(const SphFluid& fluid, const SphVolume& volume, const SphState& state,
                const SphRates& weights, SphState& adjoint);

} // namespace waft
