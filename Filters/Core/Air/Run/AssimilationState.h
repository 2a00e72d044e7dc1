// SPDX-License-Identifier: BSD-3-Clause
// How far an assimilation has come: what it goes on from after a stop, or after an edit.
#pragma once

#include "Air/Drift/Formation.h"
#include "Air/Run/AirAssimilation.h"
#include "Grid/SmokeSolver.h"
#include "Store/StateFile.h"

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

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Surroundings...);
    visit(of.Ids...);
    visit(of.Wanted...);
    visit(of.Planned...);
  }

  bool IsOfSameAir(const AssimilationKey& other) const
  {
    return this->Surroundings == other.Surroundings && this->Ids == other.Ids;
  }
};

/// What an air is drawn from: the input without objects and rows, with the seed of its air.
MotionProblem SurroundingsOf(const AssimilationInput& input, const AssimilationOptions& options);
/// rows: the input's, of which some may have other objects.
AssimilationKey KeyOf(const AssimilationInput& input, const AssimilationOptions& options,
                      const std::vector<Constraint>& rows);
inline AssimilationKey KeyOf(const AssimilationInput& input, const AssimilationOptions& options)
{
  return KeyOf(input, options, input.Constraints);
}

struct AssimilationState
{
  AssimilationKey Key;
  bool IsSimulated = false; // with the wind correction
  bool IsFinished = false;
  std::string Candidate;
  SmokeForces Forces; // but for the wind, which is the input's
  std::shared_ptr<const SampledAir> Air = std::make_shared<SampledAir>();
  /// Before the correction that waits to be simulated, of a run that goes on; or empty.
  std::shared_ptr<const HalfSeries> Plain = std::make_shared<HalfSeries>();
  std::vector<std::vector<Vec3>> Paths;
  std::vector<PoseTrack> Poses;             // or empty
  std::vector<std::vector<int>> TouchDowns; // one a landing
  std::vector<std::vector<int>> LiftOffs;   // likewise
  std::vector<AssimilationRound> Table;
  std::vector<int> Who;                 // WhoOf(run)
  std::vector<std::vector<Vec3>> Plans; // of tracks that are not planned as the input has it
  std::vector<Formation> Formations;

  /// All but the airs, whose bytes are packed.
  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Key...);
    visit(of.IsSimulated...);
    visit(of.IsFinished...);
    visit(of.Candidate...);
    visit(of.Forces.Vortices...);
    visit(of.Forces.Winds...);
    visit(of.Paths...);
    visit(of.Poses...);
    visit(of.TouchDowns...);
    visit(of.LiftOffs...);
    visit(of.Table...);
    visit(of.Who...);
    visit(of.Plans...);
    visit(of.Formations...);
  }

  bool IsEmpty() const { return this->Air->Velocity.IsEmpty(); }
};

inline constexpr StateKind AssimilationKind = { "assimilation", 11 };

void WriteSeries(StateArchive& stream, const HalfSeries& series, const ParallelFor& parallel);
void ReadSeries(StateArchive& stream, HalfSeries& series);
void WriteState(StateArchive& file, const AssimilationState& state, const ParallelFor& parallel);
void ReadState(StateArchive& file, AssimilationState& state);
/// A file whole or not at all; errors name the path and the reason.
Result WriteState(const std::string& path, const AssimilationState& state,
                  const ParallelFor& parallel);
/// What keeps the file from being a state, in words; empty when nothing does. The state is empty
/// then, and where there is no file.
std::string ReadState(const std::string& path, AssimilationState& state);

} // namespace waft
