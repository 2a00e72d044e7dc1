// SPDX-License-Identifier: BSD-3-Clause
// What a run keeps in its folder while it goes, so that another can go on from it.
#pragma once

#include "Base/Types.h"
#include "Bridge/Run/ResultPlace.h"
#include "Bridge/Run/StateStore.h"
#include "Planning/Planner.h"

#include <string>
#include <vector>

namespace waft
{

/// The folder `checkpoint` of a place for results: the plan (planned.vtp, constraints.vtp,
/// vortices.vtp; `key` with its report, what it came to, and the manifest of them), and the states
/// of the stages after it as they were last written.
class FlightCheckpoint
{
public:
  /// key: of the run; two of one key go the same way.
  FlightCheckpoint(ResultPlace& place, std::string key) : Place(place), Key(std::move(key)) {}

  /// Fails when the folder holds what no run wrote.
  Result Look();
  /// Where stages write their states.
  std::string Folder() const { return this->Place.Root() + "/" + Name; }
  std::string AirFile() const { return this->Folder() + "/" + AirState; }
  std::string PlannedFile() const { return this->Folder() + "/planned.vtp"; }
  /// Reads the plan that is there, and goes on from it. lack: what keeps a run from that, in words;
  /// empty when nothing does.
  void TakePlan(const SceneInfo& info, PlanOutput& plan, std::string& lack);
  /// The place, which is held from now on, has the plan of this run in the stead of whatever
  /// another left.
  Result KeepPlan(const SceneInfo& info, const PlanOutput& plan);
  /// The state of the air, done, is kept for later edits.
  void HandOn(const StateStore& store) const;
  /// Removes what runs left; what someone put beside it meanwhile stays.
  Result Clear() const;

private:
  static constexpr const char* Name = "checkpoint";
  static constexpr const char* AirState = "assimilated.state";

  Result ReadKept(const FolderBelow& folder, SceneJson& kept, std::string& damage) const;
  Result ReadPlan(const FolderBelow& folder, const SceneJson& kept, const SceneInfo& info,
                  PlanOutput& plan) const;

  ResultPlace& Place;
  std::string Key;
};

} // namespace waft
