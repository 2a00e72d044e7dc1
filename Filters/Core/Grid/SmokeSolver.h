// SPDX-License-Identifier: BSD-3-Clause
// The smoke solver: incompressible air on a staggered grid (Shi et al. 2005, section 3.1; Fedkiw,
// Stam, Jensen 2001).
#pragma once

#include "Base/Monitor.h"
#include "Base/Parallel.h"
#include "Grid/SmokeOptions.h"

#include <functional>
#include <memory>

namespace waft
{

/// Figures of the last frame.
struct SmokeStatistics
{
  int Substeps = 0;
  int PressureIterations = 0; // of all its substeps
  double Divergence = 0.0;    // largest |div u| dt after the last projection
  double AdvectionSeconds = 0.0;
  double ForceSeconds = 0.0;
  double PressureSeconds = 0.0;
};

/// All that a run needs to go on from a frame.
struct SmokeState
{
  int Frame = -1;
  double Time = 0.0;          // s
  double PotentialStep = 0.0; // s, of the last pressure solve
  std::vector<std::vector<float>> Arrays;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Frame...);
    visit(of.Time...);
    visit(of.PotentialStep...);
    visit(of.Arrays...);
  }
};

/// Begin, optionally SetSolids, then Step once a frame: the first Step reaches frame 0 (through the
/// warm-up), each later one the next frame. Results are the same for any number of threads.
///
///   SmokeSolver solver;
///   solver.Begin(options, forces);
///   solver.SetSolids(distances);        // optional
///   while (solver.Frame() < last) { solver.Step(parallelFor, monitor); solver.Read(frame); }
class SmokeSolver
{
public:
  SmokeSolver();
  ~SmokeSolver();
  SmokeSolver(SmokeSolver&&) noexcept;
  SmokeSolver& operator=(SmokeSolver&&) noexcept;

  /// Air at rest; no solids.
  Result Begin(const SmokeOptions& options, SmokeForces forces);
  /// Signed distances to the solids [m], negative inside, at the nodes Bounds.Min + (i, j, k) *
  /// Spacing, i fastest, (nx + 1) (ny + 1) (nz + 1) of them; empty: no solids. velocities: of the
  /// solids at the nodes [m/s], or empty when they stand still. May be called before any Step.
  Result SetSolids(const std::vector<float>& distances,
                   const std::vector<std::array<float, 3>>& velocities = {});
  /// An acceleration besides the forces, a field of one time, linear between the points of its
  /// lattice and held at its ends, from the present frame on until it is set again; not part of a
  /// SmokeState.
  void SetSteering(FieldSeries acceleration);
  /// To the next frame. When the monitor stops it, the state is that of the last frame reached.
  Result Step(const ParallelFor& parallelFor, Monitor& monitor);

  int Frame() const;   // -1 before the first Step
  double Time() const; // s
  const SmokeOptions& Options() const;
  const SmokeForces& Forces() const;
  const SmokeStatistics& Statistics() const;

  /// The fields at the present frame. Lists of `frame` are reused.
  void Read(SmokeFrame& frame) const;
  /// Of these the velocity alone, at a tenth of the time: the other lists stay as they are.
  void ReadVelocity(SmokeFrame& frame) const;

  SmokeState Save() const;
  /// Lists of `state` are reused.
  void Save(SmokeState& state) const;
  Result Restore(const SmokeState& state);

  /// Sets the air from a velocity in closed form (m -> m/s), projected when asked; for tests and
  /// for users who start from a known flow. Frame becomes 0, without a warm-up.
  Result SetVelocity(const std::function<Vec3(const Vec3&)>& velocity, bool project);
  /// As SetVelocity the smoke's density.
  void SetDensity(const std::function<double(const Vec3&)>& density);

  /// Half the sum of squared face velocities times the open volume around each face [m^5/s^2].
  double KineticEnergy() const;
  /// Half the integral of squared vorticity [m^3/s^2].
  double Enstrophy() const;
  /// Largest |div u| over the cells, fluxes through cut faces by their open part [1/s].
  double MaximumDivergence() const;
  /// Normal velocities at the faces of an axis, (n + 1) along it, i fastest [m/s].
  std::vector<float> FaceVelocities(int axis) const;
  /// Open parts of these faces, 0..1.
  std::vector<float> FaceFractions(int axis) const;

private:
  struct Internals;
  std::unique_ptr<Internals> Impl;
};

} // namespace waft
