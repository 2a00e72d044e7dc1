// SPDX-License-Identifier: BSD-3-Clause
// What acts on the air in a substep, a plane at a time over the staggered layout.
#pragma once

#include "Grid/MultigridKernels.h"
#include "Grid/StaggeredLayout.h"

#include <array>

namespace waft
{

/// Three arrays of one vector field.
using VectorArrays = std::array<float*, 3>;
using ConstVectorArrays = std::array<const float*, 3>;

/// Cell-centred velocities of plane k: means of opposite faces.
void CenterVelocityPlane(const StaggeredLayout& layout, const ConstVectorArrays& faces,
                         const VectorArrays& cells, int k);
/// Vorticity and its length by central differences of cell-centred velocities [1/s].
void VorticityPlane(const StaggeredLayout& layout, const std::array<float, 3>& spacing,
                    const ConstVectorArrays& cells, const VectorArrays& vorticity, float* size,
                    int k);
/// Adds strength * (N x omega), N = grad |omega| / |grad |omega|| (Fedkiw et al. 2001, Eq. 11, with
/// the voxel's size in the strength [m/s]).
void ConfinePlane(const StaggeredLayout& layout, const std::array<float, 3>& spacing,
                  float strength, const ConstVectorArrays& vorticity, const float* size,
                  const VectorArrays& acceleration, int k);

/// A vortex at one time: strength with the factors of time and 1 / 4 pi, square of the core's term.
struct VortexNow
{
  float P1[3], P2[3], R0[3];
  float Scale = 0.0f;
  float Core = 0.0f;
};
/// Adds Eq. 13 of Shi et al. 2005 at the cell centres of plane k; origin: the first centre [m].
void AddVortexPlane(const StaggeredLayout& layout, const std::array<float, 3>& origin,
                    const std::array<float, 3>& spacing, const VortexNow& vortex,
                    const VectorArrays& acceleration, int k);
/// Adds vector * X[i] * Y[j] * Z[k]: a Gaussian is a product of one factor per axis.
void AddSeparablePlane(const StaggeredLayout& layout, const std::array<float, 3>& vector,
                       const float* x, const float* y, const float* z,
                       const VectorArrays& acceleration, int k);

/// The largest absolute value; not a number where one of the values is none.
float LargestSize(const float* values, std::size_t count);
/// Adds dt times the mean acceleration of the two cells of each face.
void AccelerateFacesPlane(const StaggeredLayout& layout, int axis, float dt,
                          const float* acceleration, float* faces, int k);
/// Sum of open part times squared velocity over the faces of plane k; `skipLast`: without the last
/// face of each row or column, which on a periodic axis is the first again.
double EnergyPlane(const StaggeredLayout& layout, int axis, const float* fractions,
                   const float* faces, bool skipLast, int k);
/// -div u in the pressure's layout, fluxes through the open parts of faces [1/s].
void DivergencePlane(const StaggeredLayout& layout, const std::array<float, 3>& spacing,
                     const ConstVectorArrays& faces, const ConstVectorArrays& fractions,
                     const PaddedCells& cells, float* minusDivergence, int k);
/// u -= grad phi where a face is open; 0 where it is not.
void ProjectPlane(const StaggeredLayout& layout, int axis, float spacing, const float* fractions,
                  const PaddedCells& cells, const float* phi, float* faces, int k);

} // namespace waft
