// SPDX-License-Identifier: BSD-3-Clause
// Random scenes of smoke: vortices, decaying winds and simple obstacles (Shi et al. 2005, sections
// 3.1 and 7).
#pragma once

#include "Base/Mesh.h"
#include "Base/SceneFrame.h"
#include "Grid/SmokeOptions.h"

#include <array>
#include <cstdint>

namespace waft
{

/// The lowest and the highest.
using Range = std::array<double, 2>;

/// Numbers and ranges; lengths are in widths of the volume, so that the ranges serve any volume.
/// The forces begin with the warm-up.
struct EnsembleOptions : AirRun
{
  std::uint64_t Seed = 1;
  int NumberOfFrames = 300;
  int NumberOfVortices = 10;
  int NumberOfWinds = 6;
  int NumberOfObstacles = 2;
  int NumberOfEmitters = 3;

  Range VortexDiameter{ 0.22, 0.44 };
  Range VortexLength{ 0.3, 0.8 };
  Range VortexAcceleration{ 0.23, 0.92 };
  Range VortexDuration{ 2.0, 4.0 };
  Range WindRadius{ 0.2, 0.5 };
  Range WindAcceleration{ 0.18, 0.72 };
  Range WindDuration{ 0.7, 2.0 };
  Range ObstacleSize{ 0.08, 0.25 };
  Range EmitterRadius{ 0.05, 0.1 };
  double EmitterTemperature = 0.0;

  Result Validate() const;

  /// What drives the air.
  template <class Visitor, class... Holder>
  static void VisitAir(Visitor&& visit, Holder&... of)
  {
    visit(OptionField{ "NumberOfVortices", { 0, 1000 }, "", "Random vortices of a run." },
          of.NumberOfVortices...);
    visit(OptionField{ "NumberOfWinds",
                       { 0, 1000 },
                       "",
                       "Random winds of a run, parallel, decaying in space and time." },
          of.NumberOfWinds...);
    visit(OptionField{ "NumberOfObstacles",
                       { 0, 1000 },
                       "",
                       "Random obstacles of a run: boxes, cylinders and spheres." },
          of.NumberOfObstacles...);
    visit(
      OptionField{ "VortexDiameter", limits::Above(0, 1e6), "widths",
                   "Range of the diameters of the random vortices, in widths of the volume: twice "
                   "the radius where the acceleration at mid-segment falls to half its maximum." },
      of.VortexDiameter...);
    visit(OptionField{ "VortexLength", limits::Above(0, 1e6), "widths",
                       "Range of the lengths of the random vortices, in widths of the volume." },
          of.VortexLength...);
    visit(OptionField{ "VortexAcceleration", limits::Above(0, 1e9), "m/s^2",
                       "Range of the largest acceleration at mid-segment of the random vortices, "
                       "in metres per second squared." },
          of.VortexAcceleration...);
    visit(OptionField{ "VortexDuration", limits::Above(0, 1e9), "s",
                       "Range of the durations of the random vortices, in seconds: the standard "
                       "deviation of the Gaussian in time." },
          of.VortexDuration...);
    visit(OptionField{ "WindRadius", limits::Above(0, 1e6), "widths",
                       "Range of the radii of the random winds, in widths of the volume." },
          of.WindRadius...);
    visit(
      OptionField{
        "WindAcceleration", limits::Above(0, 1e9), "m/s^2",
        "Range of the accelerations of the random winds, in metres per second squared." },
      of.WindAcceleration...);
    visit(OptionField{ "WindDuration", limits::Above(0, 1e9), "s",
                       "Range of the durations of the random winds, in seconds." },
          of.WindDuration...);
    visit(OptionField{ "ObstacleSize", limits::Above(0, 1e6), "widths",
                       "Range of the extents of the random obstacles, in widths of the volume." },
          of.ObstacleSize...);
  }

  /// What a user sets besides the run.
  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(SeedField(), of.Seed...);
    visit(NumberOfFramesField(1), of.NumberOfFrames...);
    VisitAir(visit, of...);
    visit(OptionField{ "NumberOfEmitters", { 0, 1000 }, "", "Random balls that give off smoke." },
          of.NumberOfEmitters...);
    visit(OptionField{ "EmitterTemperature", limits::Around0(1e9), "K",
                       "Warmth of the smoke that is given off, in kelvins above the ambient." },
          of.EmitterTemperature...);
  }
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

/// Of the times of an air that is stirred by accelerations as the defaults have them, in a volume
/// of a width [m]: the square root of the width over 4 m.
double TimeScaleOf(double width);

/// What of its peak a force that stirs has to have at a time to be felt then (the smoke's
/// NegligibleForce), and so many standard deviations from its middle it has that.
inline constexpr double StirringLeast = 0.01;
inline constexpr double StirringReach = 3.0348542587702927;

/// The forces that are felt between two times [s] of an air that is stirred from long before time 0
/// on, for ever: the defaults' vortices and winds by their rate, times as TimeScaleOf has them.
/// What a seed has at a time does not hang on the stretch that is asked for. The same on every
/// machine.
SmokeForces StirringForces(const Box& volume, std::uint64_t seed, double from, double to);

/// The scene of a seed: the same on every machine.
Result MakeEnsemble(const EnsembleOptions& options, Ensemble& ensemble);

} // namespace waft
