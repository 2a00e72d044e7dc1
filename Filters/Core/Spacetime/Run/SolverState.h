// SPDX-License-Identifier: BSD-3-Clause
// All that changes in the course of a run, as one value.
#pragma once

#include "Spacetime/Energy/Convergence.h"
#include "Spacetime/Model/AirFields.h"
#include "Spacetime/Model/Schedule.h"
#include "Spacetime/Solver/Lbfgs.h"

#include <cstdint>
#include <vector>

namespace waft
{

/// Where a minimisation by windows is.
struct WindowSweep
{
  int Sweep = 0;
  std::uint64_t Index = 0;      // of the window, in the sweep
  SpacetimeTerms Terms;         // E of the whole, now
  std::vector<double> Energies; // E of the whole after each sweep

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Sweep...);
    visit(of.Index...);
    visit(of.Terms...);
    visit(of.Energies...);
  }
};

/// A run goes from one of these to the next, stage by stage; two of the same bits go the same way.
struct SolverState
{
  Schedule Plan;
  std::uint64_t Next = 0;   // stage
  bool IsInside = false;    // Next's minimisation has begun
  int Coarseness = 0;       // of the level of Part
  double StartEnergy = 0.0; // E of what the run begins with
  double Seconds = 0.0;     // that runs took before this one
  std::vector<ConvergenceRow> Log;
  AirFields Fields;
  /// All frames [dx]; empty while a level that holds or replaces all of them is solved.
  StateVector Motion;
  /// What the run began with, unless it goes on from another motion.
  StateVector Beginning;
  /// Of the level that is solved; empty between levels.
  StateVector Part;
  LbfgsMemory Curvature; // of Part
  WindowSweep Sweep;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Plan...);
    visit(of.Next...);
    visit(of.IsInside...);
    visit(of.Coarseness...);
    visit(of.StartEnergy...);
    visit(of.Seconds...);
    visit(of.Log...);
    visit(of.Fields...);
    visit(of.Motion...);
    visit(of.Beginning...);
    visit(of.Part...);
    visit(of.Curvature...);
    visit(of.Sweep...);
  }

  bool IsDone() const { return this->Next >= this->Plan.Stages.size(); }
  const Stage& Now() const { return this->Plan.Stages[this->Next]; }
};

} // namespace waft
