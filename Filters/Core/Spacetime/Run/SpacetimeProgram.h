// SPDX-License-Identifier: BSD-3-Clause
// What a run does, step by step: known before it begins, so that it can be left and taken up again
// at any step.
#pragma once

#include "Spacetime/Model/TimeLevel.h"
#include "Spacetime/Scene/SpacetimeSetup.h"

#include <string>
#include <vector>

namespace waft
{

/// Either minimises E or estimates the force fields anew.
struct SpacetimeStep
{
  int Coarseness = 0;    // of its level of time: 0: all frames, else of SpacetimeProgram
  bool IsUpdate = false; // of the fields
  bool FitsVortices = false;
  int Pass = 1;
  std::string Name;   // of a minimisation: its stage in Convergence
  int Iterations = 0; // at most
  double Leash = 0.0; // m; 0: none
};

struct SpacetimeProgram
{
  /// Frames of the coarse levels, of Coarseness 1 first; those that are not worth while are left
  /// out.
  std::vector<std::vector<int>> CoarseFrames;
  std::vector<SpacetimeStep> Steps;

  int Coarsest() const { return static_cast<int>(this->CoarseFrames.size()); }
  /// window: w of Eq. 4 [frames].
  TimeLevel LevelOf(int coarseness, int numberOfFrames, int window) const;
  /// Iterations at full resolution that steps from `first` on may take.
  double Work(std::size_t first, int numberOfFrames) const;
  /// The first step at full resolution, and the step of a name (as a last resort the former).
  std::size_t FirstFine() const;
  std::size_t Find(const std::string& name) const;
};

/// From planned tracks: leash and passes, coarse to fine.
SpacetimeProgram PlanProgram(const SpacetimeSetup& setup, const SpacetimeOptions& options,
                             double width);
/// From a motion that was solved before, under conditions that may have changed.
SpacetimeProgram PlanAgain(const SpacetimeOptions& options, bool fitVortices);
/// From a motion that was solved before, some of it changed: the fields stay as they are.
SpacetimeProgram PlanEdit(const SpacetimeOptions& options);

} // namespace waft
