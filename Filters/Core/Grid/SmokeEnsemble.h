// SPDX-License-Identifier: BSD-3-Clause
// Random scenes of smoke: vortices, decaying winds and simple obstacles (Shi et al. 2005, sections
// 3.1 and 7).
#pragma once

#include "Base/Mesh.h"
#include "Grid/SmokeOptions.h"

#include <cstdint>

namespace waft
{

struct Range
{
  double Low = 0.0;
  double High = 1.0;
};

/// Numbers and ranges; lengths are in widths of the volume, so that the ranges serve any volume.
struct EnsembleOptions
{
  std::uint64_t Seed = 1;
  Box Bounds;
  Timeline Time;
  double WarmUpSeconds = 3.0; // forces begin this long before time 0
  int NumberOfVortices = 10;
  int NumberOfWinds = 6;
  int NumberOfObstacles = 2;
  int NumberOfEmitters = 3; // balls that give off smoke

  /// Diameter: twice the radius where the acceleration at mid-segment falls to half its maximum.
  Range VortexDiameter{ 0.22, 0.44 };
  Range VortexLength{ 0.3, 0.8 };
  Range VortexAcceleration{ 0.23, 0.92 }; // m/s^2, the largest at mid-segment
  Range VortexDuration{ 2.0, 4.0 };       // s, standard deviation
  Range WindRadius{ 0.2, 0.5 };
  Range WindAcceleration{ 0.18, 0.72 }; // m/s^2
  Range WindDuration{ 0.7, 2.0 };       // s, standard deviation
  Range ObstacleSize{ 0.08, 0.25 };     // full extent across
  Range EmitterRadius{ 0.05, 0.1 };

  Result Validate() const;
};

struct Ensemble
{
  SmokeForces Forces;
  std::vector<ObstacleMesh> Obstacles; // closed; boxes, cylinders, spheres
};

/// Size of the acceleration of Eq. 13 (Shi et al. 2005), regularised, per strength [1/m], at a
/// distance [m] from the middle of a vortex of this length and core radius [m].
double VortexProfile(double length, double coreRadius, double distance);
/// The core radius [m] that gives a vortex of this length [m] this diameter [m].
double CoreRadiusForDiameter(double length, double diameter);
/// The largest value of VortexProfile over the distances [1/m].
double LargestVortexProfile(double length, double coreRadius);

/// The scene of a seed: the same on every machine.
Result MakeEnsemble(const EnsembleOptions& options, Ensemble& ensemble);

} // namespace waft
