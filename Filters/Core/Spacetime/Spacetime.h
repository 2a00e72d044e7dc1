// SPDX-License-Identifier: BSD-3-Clause
// The spacetime optimisation of Shi et al. 2005, section 5: planned paths become the motion of
// things in one body of air, with the user's requirements met exactly.
#pragma once

#include "Base/Communicator.h"
#include "Base/FieldSeries.h"
#include "Base/ForceFields.h"
#include "Base/Mesh.h"
#include "Base/Monitor.h"
#include "Base/Motion.h"
#include "Base/Parallel.h"
#include "Base/Result.h"
#include "Base/Types.h"
#include "Constraints/Constraint.h"

#include <array>
#include <string>
#include <vector>

namespace waft
{

struct SpacetimeOptions
{
  int NumberOfGasParticles = 2500;   // 64..200000: gives the spacing dx
  int NumberOfObjectParticles = 125; // 1..: shared among the objects, one to five each
  double PositionWeight = 5.0;       // c1 of Eq. 2, from 0
  double VelocityWeight = 10.0;      // c2
  double CoherenceWeight = 0.05;     // c3: how much objects move with the air about them
  double SpatialShare = 0.5;         // c31 of Eq. 4, 0..1; c32 = 1 - c31
  double ObjectCoherence = 24.0;     // how often the air about it counts for an object, from 0
  double ObjectPosition = 30.0;      // how often a step of its own counts for an object
  int TemporalWindow = 1;            // w of Eq. 4, 1..30 frames
  double SmoothingLength = 1.2;      // h / dx, 0.8..2
  double CourantNumber = 0.5;        // c0 frame / h, 0.1..1: how stiff the gas is
  double Viscosity = 0.2;            // alpha, 0..2; below 0.18 a lattice at rest stirs itself
  double XsphFactor = 0.0;           // epsilon of Eq. 10, 0..1
  double PressureExponent = 1.0;     // gamma of Eq. 12, 1..7
  double EffectiveGravity = 0.8;     // g' of objects [m/s^2], from 0
  double ContactDistance = -1.0; // d0 [m]; negative: from the objects' sizes; 0: no contact term
  double WindDrag = 2.0;         // [1/s] with which a wind given as a velocity draws
  bool EstimateWind = true;
  bool FitVortexFields = true;
  int MaximumNumberOfVortices = 16; // kept of those that planned paths bring, 0..1000
  int Passes = 2;                   // 1..10 alternations with the force fields
  bool UseLeash = true;
  int LeashIterations = 20; // for each of the five radii
  /// A third of it on every fourth frame and in each of the last stages, two fifths in those
  /// between; see PlanProgram.
  int MaximumNumberOfIterations = 150;
  double Tolerance = 0.01; // least relative fall of E in 20 iterations; 0: none
  double TimeLimit = 0.0;  // s; 0: none. A limit may break bit-equality
  int HistorySize = 6;     // of L-BFGS, 1..20
  bool WarmStart = true;   // go on from the motion that the last run left, where there is one
  /// When only some tracks or rows changed since the last run, what is solved again: frames within
  /// EditDuration of the changed ones [s], bodies within EditRadius of the changed objects [m].
  /// Nothing else moves. One of them 0: all is solved on.
  double EditDuration = 1.0;
  double EditRadius = 1.0;
  /// MB that a run may take, besides its input; 0: no limit. Frames are solved in windows where all
  /// at once would take more.
  double MemoryLimit = 0.0;
  std::string CheckpointFile; // empty: none
  /// s between two writings, at least, and thirty times what one takes; 0: after each iteration.
  double CheckpointInterval = 10.0;

  Result Validate() const;
};

struct SpacetimeInput
{
  SceneInfo Scene;
  std::vector<Track> Tracks;           // planned, one an object, one sample a frame
  std::vector<MotionObject> Objects;   // those of the tracks
  std::vector<Constraint> Constraints; // every row assigned
  std::vector<ObstacleMesh> Obstacles; // the ground among them
  std::vector<Vortex> Vortices;        // first guesses and priors; see SelectVortices
  FieldSeries Wind;                    // the user's, or empty: a fixed background
};

/// All particles, gas first, then the objects' in the order of the tracks. World units.
struct ParticleSeries
{
  struct Frame
  {
    std::vector<float> Positions, Velocities; // three each
    std::vector<float> Densities, Pressures;  // kg/m^3, Pa
    std::vector<float> Winds, VortexForces;   // three each, m/s^2
  };
  std::vector<int> ObjectIds; // -1: gas
  std::vector<float> Masses;  // kg, as the SPH sums weigh them
  std::vector<Frame> Frames;
};

struct ConvergenceRow
{
  int Pass = 0;
  std::string Stage;
  int Iteration = 0;
  double E = 0.0, Ex = 0.0, Ev = 0.0, Ec = 0.0;
  double MaxViolation = 0.0; // m
  double Leash = 0.0;        // m; 0: released
  double Seconds = 0.0;      // since RunSpacetime began
};

struct SpacetimeOutput
{
  std::vector<Track> Tracks; // in the order of the input
  ParticleSeries Particles;
  std::vector<Vortex> Vortices;
  FieldSeries Wind; // estimated plus the user's acceleration, on the wind's lattice; zero without
  std::vector<ConvergenceRow> Convergence;
  std::vector<ReportRow> Report;
  std::vector<double> PositionResiduals; // rms of x against its prediction by object [dx]
  std::vector<double> VelocityResiduals; // the same of v [dx / frame]
  double Spacing = 0.0;                  // dx [m]
  std::vector<std::string> Warnings;
};

struct SpacetimeMemory; // SpacetimeMemory.h

/// Points of the lattice on which the wind is estimated and handed out; it spans the volume.
std::array<int, 3> WindLatticeDimensions(const Box& volume);

/// Errors: tracks that are empty, not finite or of different lengths, constraints or tracks without
/// object, a volume too small for the gas, a MemoryLimit too low for windows of a few frames.
/// Stopped (by the monitor): the output holds the best feasible motion so far; so it does at the
/// TimeLimit, which is a warning.
///
/// memory, where there is one, is what the last run left and is left anew: with WarmStart and the
/// same unknowns (objects, frames, gas) the run goes on from it, else from the planned tracks. An
/// error empties it.
///
/// CheckpointFile is written at intervals, whole or not at all, and removed when the run ends by
/// itself. One of the same input and options is gone on from, to the same bits as if the run had
/// never been ended; any other is ignored with a warning.
///
/// ranks: all of them call this together and share the frames out among them. Input, options and
/// memory are rank 0's, those given elsewhere are not read; so are the decisions of its monitor and
/// its clock, and the checkpoint, which a run of another number of ranks may go on from. The output
/// and what memory keeps are rank 0's too and empty elsewhere; the result's bits are the same for
/// any number of ranks. Null: one rank.
Result RunSpacetime(const SpacetimeInput& input, const SpacetimeOptions& options,
                    const ParallelFor& parallel, Monitor& monitor, SpacetimeOutput& output,
                    SpacetimeMemory* memory = nullptr, Communicator* ranks = nullptr);

} // namespace waft
