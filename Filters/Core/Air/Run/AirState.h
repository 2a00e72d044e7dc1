// SPDX-License-Identifier: BSD-3-Clause
// All that changes in the course of a run, as one value, and what does not.
#pragma once

#include "Air/Drift/DriftSearch.h"
#include "Air/Field/AirSimulation.h"
#include "Air/Field/WindCorrection.h"
#include "Air/Run/AirAssimilation.h"
#include "Air/Run/AssimilationState.h"
#include "Grid/SmokeEnsemble.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace waft
{

/// The objects of a run, in the order of the tracks.
struct AirBodies
{
  std::vector<BodyProblem> Problems; // with their touch-downs and lift-offs
  std::vector<std::vector<Vec3>> Paths;
  std::vector<PoseTrack> Poses; // that they fly in, with the slips that the Problems have; or empty
  PreparedShapes Shapes;        // that turn; found once
  std::vector<char> IsOld;      // that an edit leaves as they were; empty: no edit

  std::size_t Size() const { return this->Problems.size(); }
  bool IsKept(std::size_t o) const { return !this->IsOld.empty() && this->IsOld[o]; }
  bool AreAllKept() const
  {
    return !this->IsOld.empty() &&
           std::find(this->IsOld.begin(), this->IsOld.end(), 0) == this->IsOld.end();
  }
};

/// A run goes from one of these to the next, stage by stage.
struct AirState
{
  bool IsSimulated = false; // with the wind correction
  std::string Candidate;    // the draw that goes on
  AirScene Scene;           // what the air is drawn from: the forces are those drawn
  SampledAir Sampled;       // the air as it is
  HalfSeries Plain;         // before the correction that waits to be simulated; or empty
  AirBodies Bodies;
};

/// In which a body that has touched the ground tips over and comes to lie [s].
inline constexpr double SettlingTime = 0.4;

/// Starts of all searches together, besides the three that each body's has.
inline constexpr std::size_t MostStarts = 8000;

/// What a run is given, and what follows from that alone.
struct AirContext
{
  AirContext(const AssimilationInput& input, const AssimilationOptions& options,
             const SolidsOn& solids, const ParallelFor& parallel, Monitor& monitor) :
    Input(input),
    Rows(input.Constraints), Options(options), Solids(solids), Parallel(parallel),
    Caller(monitor), Around{ input.Scene, this->Obstacles, options.Inertia, &this->Formations }
  {
    for (const Track& track : input.Tracks)
    {
      this->Plans.push_back(track.Positions);
    }
    const double rate = input.Scene.Time.FramesPerSecond;
    const double scale = TimeScaleOf(input.Scene.Bounds.Width());
    this->Search.Weights.Smoothness = options.Smoothness * scale * scale;
    this->Search.Starts = static_cast<int>(std::min<std::size_t>(
      options.Starts, MostStarts / std::max<std::size_t>(1, input.Objects.size())));
    this->Search.Spread = static_cast<int>(std::lround(options.TouchDownSpread * rate));
    this->Search.Settling = static_cast<int>(std::lround(SettlingTime * rate));
    this->Search.Step = std::max(1, static_cast<int>(std::lround(rate * scale / 2.0)));
  }
  AirContext(const AirContext&) = delete;
  void operator=(const AirContext&) = delete;

  double Seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - this->Start).count();
  }

  const AssimilationInput& Input;
  std::vector<Constraint> Rows;         // the input's; who goes where may be chosen by the air
  std::vector<std::vector<Vec3>> Plans; // by track, the input's or a drift to other marks
  std::vector<Formation> Formations;    // of rows that drift, once there is an air
  const AssimilationOptions& Options;
  const SolidsOn& Solids;
  const ParallelFor& Parallel;
  Monitor& Caller;
  /// Of the motion so far, to who watches.
  std::function<void(const AirBodies& bodies)> Publish;
  ObstacleSet Obstacles;
  ObstacleSet Inside;            // those of them that air meets
  DistanceFromSolids FromSolids; // to these; null: there are none
  DriftScene Around;             // of all bodies
  DriftSearch Search;
  AssimilationKey Key;
  mutable bool IsTold = false;       // to the other ranks
  mutable std::uint64_t AirSent = 0; // which air they have; 0: none
  std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
};

} // namespace waft
