// SPDX-License-Identifier: BSD-3-Clause
// What a run of the chain gives.
#pragma once

#include "Air/Run/AirAssimilation.h"
#include "Base/Effort.h"
#include "Chain/ChainTable.h"
#include "Chain/JoinedReport.h"
#include "Planning/Takes.h"
#include "Rotation/RotationRefine.h"
#include "Spacetime/Scene/SpacetimeOutput.h"
#include "Vortex/AirVortexFit.h"

#include <map>
#include <string>
#include <vector>

namespace waft
{

/// Outputs of stages that did not run are empty.
struct Motion
{
  PlanOutput Plan;
  std::vector<TakeScore> Takes;
  AssimilationOutput Air;
  SpacetimeOutput Optimised;
  RotationOutput Turned;
  AirVortexFit Fit;

  std::vector<Track> Tracks; // where bodies are: the paths, laid on surfaces
  std::vector<double> Laid;  // by how much at most, by track [m]
  std::vector<JoinedRow> Report;
  /// Of the stages that ran, a sentence each.
  std::map<ChainStage, std::vector<std::string>> Warnings;
  std::map<ChainStage, Effort> Efforts;     // of the stages that worked in this run
  bool IsStopped = false;                   // by the caller or the TimeLimit: the best so far
  ChainStage StoppedIn = ChainStage::Scene; // the first stage that was, where it is

  /// The last stage that moved the objects, in the end or so far.
  ChainStage MovedBy() const;
  /// The paths that a stage begins with, or all stages end with.
  const std::vector<Track>& PathsBefore(ChainStage stage) const;
  const std::vector<Track>& Paths() const;
  /// A stage's lines; of the planner where it has none.
  const std::vector<ReportRow>& ReportOf(ChainStage stage) const;
  /// With their touch-downs where there was an air; the planner's else.
  const std::vector<Constraint>& RowsBefore(ChainStage stage) const;
  const std::vector<Constraint>& Rows() const;
  /// With the touch-downs of poses where they are turned.
  const std::vector<Constraint>& RowsAtLast() const;
};

} // namespace waft
