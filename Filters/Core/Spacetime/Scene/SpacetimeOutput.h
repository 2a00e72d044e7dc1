// SPDX-License-Identifier: BSD-3-Clause
// What a run gives, in world units.
#pragma once

#include "Base/FieldSeries.h"
#include "Base/ForceFields.h"
#include "Base/Motion.h"
#include "Base/Types.h"
#include "Constraints/ConstraintCheck.h"
#include "Spacetime/Energy/Convergence.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace waft
{

/// All particles, gas first, then the objects' in the order of the tracks. World units.
struct ParticleSeries
{
  struct Frame
  {
    std::vector<float> Positions, Velocities; // three each
    std::vector<float> Densities, Pressures;  // kg/m^3, Pa
    std::vector<float> Winds, VortexForces;   // three each, m/s^2
    std::vector<float> Residuals;             // three each: what no term gives [m/s^2]

    template <class Visitor, class... Holder>
    static void Visit(Visitor&& visit, Holder&... of)
    {
      visit(of.Positions...);
      visit(of.Velocities...);
      visit(of.Densities...);
      visit(of.Pressures...);
      visit(of.Winds...);
      visit(of.VortexForces...);
      visit(of.Residuals...);
    }
  };
  std::vector<int> ObjectIds; // -1: gas
  std::vector<float> Masses;  // kg, as the SPH sums weigh them
  std::vector<Frame> Frames;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.ObjectIds...);
    visit(of.Masses...);
    visit(of.Frames...);
  }
};

/// Of all bodies, of objects and of gas, each by those that counted and those left out. Not a
/// number where there are none.
struct FieldsPart
{
  using Pair = std::array<double, 2>;
  Pair All{ std::nan(""), std::nan("") };
  Pair Objects{ std::nan(""), std::nan("") };
  Pair Gas{ std::nan(""), std::nan("") };

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.All...);
    visit(of.Objects...);
    visit(of.Gas...);
  }
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
  /// How far it is a motion of the model. ReplayErrors: of objects and gas, a second after they
  /// were let go (Rollout.h); GasModelResidual: rms of the gas' Residuals over that of Dv/Dt.
  /// Negative: not to be had.
  double ObjectReplayError = -1.0, GasReplayError = -1.0, GasModelResidual = -1.0;
  /// What the vortices explain of the objects' motion (PartOfVortices); not a number where that
  /// cannot be had.
  double VorticesPart = std::nan("");
  /// What fields that are solved for without one object and one gas particle in five explain of
  /// what is asked of them (PartOfFields): of those that counted, and of those left out.
  FieldsPart Explained;
  /// Of all frames of all objects, those that were moved after solving by more than 1e-5 of the
  /// volume's width, so that all that is asked for holds; and by how much at most [m].
  double RepairedFraction = 0.0, LargestRepair = 0.0;
  std::vector<std::string> Warnings;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Tracks...);
    visit(of.Particles...);
    visit(of.Vortices...);
    visit(of.Wind...);
    visit(of.Convergence...);
    visit(of.Report...);
    visit(of.PositionResiduals...);
    visit(of.VelocityResiduals...);
    visit(of.Spacing...);
    visit(of.ObjectReplayError...);
    visit(of.GasReplayError...);
    visit(of.GasModelResidual...);
    visit(of.VorticesPart...);
    visit(of.Explained...);
    visit(of.RepairedFraction...);
    visit(of.LargestRepair...);
    visit(of.Warnings...);
  }
};

} // namespace waft
