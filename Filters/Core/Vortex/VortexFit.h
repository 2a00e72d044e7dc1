// SPDX-License-Identifier: BSD-3-Clause
// Spacetime vortices fitted to the accelerations of objects (Shi et al. 2005, section 5 and
// Appendix C), jointly over all tracks that pass the same region of space and time.
#pragma once

#include "Base/ForceFields.h"
#include "Base/Monitor.h"
#include "Base/Result.h"
#include "Base/SceneFrame.h"
#include "Base/Types.h"

#include <cstdint>
#include <vector>

namespace waft
{

/// The acceleration that an object felt at one frame.
struct VortexSample
{
  int Track = 0; // samples of one Track value are one witness
  int Frame = 0;
  double Time = 0.0;                // s
  Vec3 Position = Vec3::Zero();     // m
  Vec3 Acceleration = Vec3::Zero(); // m/s^2, vortex plus wind
  double Weight = 1.0;              // from 0; 0 leaves the sample out
  int VortexId = -1;                // the prior that the annotation claims it for, -1: none
};

/// The volume gives the scales: L is its width.
struct VortexFitOptions
{
  enum
  {
    Force,
    AirAcceleration
  };

  Box Bounds;
  int Quantity = Force;
  std::uint64_t Seed = 1;
  int NumberOfStarts = 4; // the prior's among them
  int Sweeps = 2;
  int MaximumNewVortices = 4;
  double MinimumGain = 0.2;
  bool UniformBackground = true;
  int MaximumSamples = 450; // from 30, for each vortex, thinned evenly along the tracks

  // Bounds of the parameters; poles stay within a quarter of L of the volume.
  double MinimumDuration = 0.15;   // s, standard deviation
  double MaximumDuration = 20.0;   // s
  double MinimumCoreRadius = 0.01; // of L
  double MaximumCoreRadius = 0.3;  // of L
  double MinimumLength = 0.05;     // of L, pole to pole
  double MaximumLength = 2.0;      // of L
  double MaximumStrength = 200.0;  // m^2/s^2

  // How far the truth may lie from a prior: standard deviations.
  double CenterDeviation = 0.1;   // of L
  double AxisDeviation = 0.35;    // rad
  double StrengthDeviation = 0.5; // of the prior's strength
  double TimeDeviation = 0.5;     // s
  double ShapeDeviation = 0.5;    // of ln duration, ln core radius, ln length

  // Two vortices nearer than all of these are one.
  double MergeDistance = 0.05; // of L, between centres
  double MergeAngle = 0.3;     // rad, between axes
  double MergeTime = 0.5;      // of the shorter duration, between centre times

  Result Validate() const;

  /// What a user sets.
  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(OptionField{ "Quantity",
                       { 0, 1 },
                       "",
                       "What is fitted: the array Force, or the rate at which AirVelocity changes "
                       "along the paths." },
          of.Quantity...);
    visit(OptionField{ "MaximumNewVortices",
                       { 0, 1000 },
                       "",
                       "Vortices that may be added to the given ones, strongest first." },
          of.MaximumNewVortices...);
    visit(OptionField{ "MinimumGain",
                       { 0, 1 },
                       "",
                       "Fraction of the energy in its region that a new vortex must explain." },
          of.MinimumGain...);
    visit(
      FlagField("UniformBackground",
                "Let a uniform acceleration beside each vortex take up wind that is not known."),
      of.UniformBackground...);
    visit(OptionField{ "NumberOfStarts", { 1, 64 }, "", "Local searches for each vortex." },
          of.NumberOfStarts...);
    visit(OptionField{ "Sweeps",
                       { 1, 20 },
                       "",
                       "Rounds in which each vortex is fitted to what the others leave." },
          of.Sweeps...);
    visit(SeedField(), of.Seed...);
  }
};

/// Fits each prior to the samples that its VortexId claims and to all others that pass its region
/// (where its field is felt). fitted: the priors in their order with their VortexIds, less those
/// merged into an earlier one, then new vortices with ids above all in use. Each carries
///   Confidence: fraction of the energy explained x precision x witnesses, all 0..1; the precision
///     falls as the standard deviations (from the data alone) of axis, centre, strength and time
///     reach 15 degrees, 0.1 L, 30 % and 0.4 s; one track counts 0.3, two 0.7, three or more 1;
///   ObjectCount: tracks with at least 5 samples that felt it.
/// A prior without enough samples is handed back as it came, ObjectCount 0. Search: several seeded
/// starts, Levenberg-Marquardt (Ceres, one thread: results are bit-identical), bounds, Cauchy loss.
/// Errors: a sample or prior that is not finite, a prior whose poles coincide or whose duration or
/// core radius is not positive, two priors of one VortexId. Stopped: fitted holds the best so far.
Result FitVortices(const std::vector<VortexSample>& samples, const std::vector<Vortex>& priors,
                   const VortexFitOptions& options, Monitor& monitor, std::vector<Vortex>& fitted);

} // namespace waft
