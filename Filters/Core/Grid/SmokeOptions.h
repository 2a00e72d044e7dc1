// SPDX-License-Identifier: BSD-3-Clause
// What describes a run of the smoke solver, and what a run gives.
#pragma once

#include "Base/FieldSeries.h"
#include "Base/ForceFields.h"
#include "Base/Result.h"
#include "Base/Types.h"

#include <array>
#include <vector>

namespace waft
{

enum class AdvectionScheme
{
  Linear,        // semi-Lagrangian, trilinear: first order
  MonotoneCubic, // semi-Lagrangian, tricubic with limited slopes (Fedkiw et al. 2001, Appendix B)
  MacCormack     // Selle et al. 2008, limited to the values around the foot point
};

/// What the two ends of an axis are.
enum class BoundaryKind
{
  Closed,  // walls that the air slides along
  Open,    // still air of zero pressure outside
  Periodic // the two ends are the same place
};

struct SmokeOptions
{
  Box Bounds;                                  // m
  std::array<int, 3> Resolution{ 64, 64, 64 }; // voxels, at least 4 along each axis
  double FramesPerSecond = 30.0;
  /// Frame 0 is this long after the air was at rest [s].
  double WarmUpSeconds = 3.0;

  AdvectionScheme Advection = AdvectionScheme::MonotoneCubic;
  std::array<BoundaryKind, 3> Boundary{ BoundaryKind::Open, BoundaryKind::Open,
                                        BoundaryKind::Open };
  /// Where the vertical axis is open, its lower end is a wall all the same.
  bool ClosedFloor = true;

  /// Strength of vorticity confinement [1/s] (Fedkiw et al. 2001, Eq. 11); 0: none.
  double Confinement = 0.5;
  /// Buoyancy: acceleration along z is BuoyancyTemperature * T - BuoyancyDensity * rho (Fedkiw et
  /// al. 2001, Eq. 8) with T above the ambient [K] and rho the smoke's density [1].
  double BuoyancyTemperature = 0.0; // m/(s^2 K)
  double BuoyancyDensity = 0.0;     // m/s^2
  /// Smoke and warmth fade at this rate [1/s].
  double Dissipation = 0.0;
  /// A user's wind that is a velocity draws the air towards it at this rate [1/s].
  double WindDrag = 1.0;

  /// A substep moves no air farther than this many voxels.
  double CourantNumber = 2.0;
  int MaximumSubsteps = 16;
  /// Largest |div u| dt left by the projection.
  double Tolerance = 1e-4;
  int MaximumIterations = 200;
  double AirDensity = 1.2; // kg/m^3; scales the reported pressure

  Result Validate() const;
  Vec3 Spacing() const; // m, of the voxels
  std::size_t NumberOfCells() const;
  std::size_t NumberOfNodes() const; // (nx + 1) (ny + 1) (nz + 1)
};

/// Whether a warm-up of `seconds` can be counted in frames: not below 0, and no more of them than a
/// scene may have.
Result CheckWarmUp(double seconds, double framesPerSecond);

/// A ball that gives off smoke and warmth.
struct SmokeEmitter
{
  Vec3 Center = Vec3::Zero();
  double Radius = 0.3;      // m
  double Density = 1.0;     // kept in the ball while it emits
  double Temperature = 0.0; // K above the ambient, likewise
  double StartTime = -1e30; // s
  double EndTime = 1e30;    // s
};

/// Everything that acts on the air besides its boundary and solids. Times are those of the frames;
/// the warm-up lies before time 0.
struct SmokeForces
{
  std::vector<Vortex> Vortices;
  std::vector<AnalyticWind> Winds;
  FieldSeries Wind; // optional; counts as wind
  std::vector<SmokeEmitter> Emitters;

  Result Validate() const;
};

/// Cell-centred values of one frame, i fastest; Origin is the centre of the first voxel.
struct SmokeFrame
{
  int Frame = 0;
  double Time = 0.0; // s
  std::array<int, 3> Dimensions{ 0, 0, 0 };
  Vec3 Origin = Vec3::Zero();                    // m
  Vec3 Spacing = Vec3::Ones();                   // m
  std::vector<std::array<float, 3>> Velocity;    // m/s
  std::vector<std::array<float, 3>> Vorticity;   // 1/s
  std::vector<std::array<float, 3>> VortexForce; // m/s^2
  std::vector<std::array<float, 3>> WindForce;   // m/s^2
  std::vector<float> Density;
  std::vector<float> Pressure;         // Pa
  std::vector<unsigned char> Obstacle; // 1: the voxel's centre is in a solid
};

} // namespace waft
