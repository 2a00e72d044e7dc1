// SPDX-License-Identifier: BSD-3-Clause
// What the optimiser gives besides tracks: particles, the course of the solution.
#pragma once

#include "Base/Types.h"
#include "Spacetime/Run/Spacetime.h"

class vtkPolyData;
class vtkTable;

namespace waft
{

/// All particles at one frame as vertices: `ParticleId`, `Kind` (0 gas, 1 object), `ObjectId`,
/// `Mass` [kg], `Velocity` [m/s], `Density` [kg/m^3], `Pressure` [Pa], `Wind`, `VortexForce`
/// [m/s^2].
void ParticlesToPolyData(const ParticleSeries& particles, int frame, const SceneInfo& info,
                         vtkPolyData* data);

/// Tracks with the cell data `PositionResidual`, `VelocityResidual` and, as field data, how far
/// they are a motion of the model and what was moved after solving.
void OptimisedToPolyData(const SpacetimeOutput& solution, const SceneInfo& info, vtkPolyData* data);

/// One row per iteration; see VisitConvergence for the columns.
void ConvergenceToTable(const std::vector<ConvergenceRow>& rows, const SceneInfo& info,
                        vtkTable* table);

} // namespace waft
