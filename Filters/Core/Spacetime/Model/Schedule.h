// SPDX-License-Identifier: BSD-3-Clause
// What a run does, stage by stage: known before it begins.
#pragma once

#include "Spacetime/Model/SpacetimeOptions.h"
#include "Spacetime/Model/TimeLevel.h"

#include <cstdint>
#include <string>
#include <vector>

namespace waft
{

enum class StageKind : std::uint8_t
{
  Leash,    // near to the plan
  Coarsest, // on the coarsest level, where it is none of the passes'
  Pass,     // of an alternation with the fields
  Fine,     // on all frames, at last
  Fields    // estimates the force fields anew; all others minimise E
};

struct Stage
{
  StageKind Kind = StageKind::Pass;
  int Coarseness = 0;        // of its level of time: 0: all frames, else of the schedule
  int Pass = 1;              // alternation
  char Part = 0;             // 'a' before and 'b' after an update of the fields; 0: whole
  int Iterations = 0;        // at most
  double Leash = 0.0;        // m; 0: none
  bool FitsVortices = false; // of Fields

  bool IsUpdate() const { return this->Kind == StageKind::Fields; }
  /// Of a minimisation, as Convergence logs it.
  std::string Name() const;
};

struct Schedule
{
  /// Frames of the coarse levels, of Coarseness 1 first; those that are not worth while are left
  /// out.
  std::vector<std::vector<int>> CoarseFrames;
  std::vector<Stage> Stages;

  int Coarsest() const { return static_cast<int>(this->CoarseFrames.size()); }
  /// window: w of Eq. 4 [frames].
  TimeLevel LevelOf(int coarseness, int numberOfFrames, int window) const;
  /// Iterations at full resolution that stages from `first` on may take.
  double Work(std::size_t first, int numberOfFrames) const;
  /// The first stage at full resolution.
  std::size_t FirstFine() const;
};

/// A stage that minimises E, on frames of a coarseness.
Stage Minimise(StageKind kind, int coarseness, int pass, char part, int iterations);
/// A stage that estimates the fields anew.
Stage Update(int coarseness, int pass, bool vortices);
/// Of a stage that follows large changes made for less work.
int LastIterations(const SpacetimeOptions& options);

} // namespace waft
