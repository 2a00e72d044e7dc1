// SPDX-License-Identifier: BSD-3-Clause
// How far an assimilation has come: what it goes on from after a stop, or after an edit.
#pragma once

#include "Air/Run/AirAssimilation.h"
#include "Base/StateArchive.h"
#include "Grid/SmokeOptions.h"

#include <cstdint>
#include <string>
#include <vector>

namespace waft
{

/// Digests of what a run is made from.
struct AssimilationKey
{
  std::uint64_t Surroundings = 0;    // scene, obstacles, vortices, wind, options
  std::vector<int> Ids;              // of the objects, as all lists here in the order of the tracks
  std::vector<std::uint64_t> Wanted; // objects with their rows
  std::vector<std::uint64_t> Planned; // their tracks

  bool IsSame(const AssimilationKey& other) const
  {
    return this->IsOfSameAir(other) && this->Wanted == other.Wanted &&
           this->Planned == other.Planned;
  }
  bool IsOfSameAir(const AssimilationKey& other) const
  {
    return this->Surroundings == other.Surroundings && this->Ids == other.Ids;
  }
};

AssimilationKey KeyOf(const AssimilationInput& input, const AssimilationOptions& options);

struct AssimilationState
{
  AssimilationKey Key;
  int Rounds = 0; // simulations with the common wind that are done
  bool IsFinished = false;
  std::string Candidate;
  SmokeForces Forces; // but for the wind, which is the input's
  std::shared_ptr<const DrawnAir> Air = std::make_shared<DrawnAir>();
  std::vector<std::vector<Vec3>> Paths;
  std::vector<std::vector<int>> TouchDowns; // one a landing
  std::vector<std::vector<int>> LiftOffs;   // likewise
  std::vector<AssimilationRound> Table;

  bool IsEmpty() const { return this->Air->Velocity.IsEmpty(); }
};

/// Writes a state whole or not at all; errors name the path and the reason.
Result WriteState(const std::string& path, AssimilationState& state, const ParallelFor& parallel);
/// What keeps the file from being a state, in words; empty when nothing does. A file that is not
/// there leaves the state empty.
std::string ReadState(const std::string& path, AssimilationState& state);

} // namespace waft
