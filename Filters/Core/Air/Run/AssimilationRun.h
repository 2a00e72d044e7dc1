// SPDX-License-Identifier: BSD-3-Clause
// A run of the assimilation: what its parts share.
#pragma once

#include "Air/Drift/Drifter.h"
#include "Air/Field/AirSimulation.h"
#include "Air/Field/AirStatistics.h"
#include "Air/Run/AirAssimilation.h"
#include "Air/Run/AssimilationState.h"

#include <chrono>
#include <cmath>
#include <functional>

namespace waft
{

inline constexpr int DriftIterations = 60;
inline constexpr int LandingIterations = 24; // of a path that is good but for its end
inline constexpr double DrawEnd = 0.25;      // of a run, about
inline constexpr double DriftEnd = 0.4;
inline constexpr double WindEnd = 0.15; // of a round, about
inline constexpr double SimulationEnd = 0.85;
inline constexpr double DriftingEnd = 0.92;
inline constexpr int WindStride = 3; // frames between samples of the common wind

class AssimilationRun
{
public:
  AssimilationRun(const AssimilationInput& input, const AssimilationOptions& options,
                  const SolidsOn& solids, const ParallelFor& parallel, Monitor& monitor,
                  AssimilationOutput& output);
  Result Run(AssimilationState* memory);

  /// Random forces, and how bodies move in the coarse air that they make.
  struct ForceDraw
  {
    std::uint64_t Seed = 0;
    double Scale = 1.0;
    double Misfit = 1e300;
    SmokeForces Forces;
    AirStatistics Found;
  };

private:
  // AssimilationDraw.cxx
  void SetUpScene();
  /// The ground is mostly a slab below the volume, which the air does not meet.
  bool HasSolidsInside() const;
  bool IsSymmetric() const;
  /// scale: of the random forces, not of the scene's own.
  Result ForcesOf(std::uint64_t seed, double scale, SmokeForces& forces) const;
  double TypicalSettlingSpeed() const;
  AirScene CoarseScene() const;
  Result SimulateSideBySide(std::size_t count, double begin, double end,
                            const std::function<AirScene(std::size_t)>& sceneOf,
                            const std::function<void(std::size_t, HalfSeries&)>& use);
  /// Draws by coarse simulations, those first in whose closed box bodies move most as they do in
  /// the open boxes of the databases (Wanted), each scaled to be as strong.
  Result DrawForces(std::vector<ForceDraw>& draws);
  /// The air in whose coarse run the objects come to their marks with the least control, and move
  /// as wanted.
  Result Draw();
  double Try(const HalfSeries& series, AssimilationRound& row) const;
  /// Towards the air with the common wind, by what its motion asks for beside what drives it now.
  Result SimulateAgain(HalfSeries plain, int round);

  // AssimilationDrift.cxx
  DriftWeights Weights() const;
  Result FirstDrift();
  /// From several starts, with several touch-downs and lift-offs; the least control is kept, that
  /// so far among them. False: stopped.
  bool Seek(const std::vector<char>& which, Monitor& monitor);
  void SeekPath(std::size_t o, const AirSampler& air, Monitor& monitor);
  struct FramesToTry
  {
    int First = 0, Last = 0, Step = 1; // First: as it is
  };
  /// Another frame for the end or the beginning of a flight: set gives it to the drifter, retimed
  /// brings a path from the frame that it has to the one that is set.
  using Retiming = std::function<std::vector<Vec3>(const std::vector<Vec3>& path, int frame)>;
  void SeekTime(std::size_t o, const AirSampler& air, const FramesToTry& frames,
                const std::function<void(int)>& set, const Retiming& retimed, Monitor& monitor);
  /// Those whom the air as it has become does not take to their marks.
  bool SeekAgain(Monitor& monitor);
  /// Of two paths the one that judges less goes on.
  struct Judgement
  {
    bool PassesThrough = false; // an obstacle: barriers ask at frames alone, a wall may be thinner
    double Cost = 0.0; // a step flown: lying costs nothing, and would end each flight early
    bool operator<(const Judgement& other) const
    {
      return this->PassesThrough != other.PassesThrough ? other.PassesThrough
                                                        : this->Cost < other.Cost;
    }
  };
  Judgement JudgementOf(const Drifter& drifter, double cost, const std::vector<Vec3>& path) const;
  double CostOf(const Drifter& drifter, const AirSampler& air, std::vector<Vec3> path) const;
  /// The best path that a search from one of `paths` comes to.
  std::vector<Vec3> BestDrift(const Drifter& drifter, const AirSampler& air,
                              std::vector<std::vector<Vec3>> paths) const;
  /// Tells each drifter what is too near to it; who has such neighbours.
  std::vector<char> FindNeighbours();
  /// False: stopped, and some have not drifted.
  bool Drift(int iterations, const DriftWeights& weights, const std::vector<char>& which,
             Monitor& monitor);
  bool DriftOn(int iterations, Monitor& monitor);
  /// Those that are too near to each other give way, pass by pass harder.
  void KeepApart();
  /// The air without and then with the wind that the controls have in common.
  Result FindWind(const HalfSeries& plain, int round);
  /// The air as it was without, with the common wind. False: stopped, at some frames.
  bool AddWind(const HalfSeries& plain, const CommonWind& common, Monitor& monitor);
  /// The wind that would have made the controls needless: what it is at the bodies, and they.
  bool FitWind(CommonWind& common, Monitor& monitor) const;
  /// What keeps too near to something is pushed harder first; only what that does not help is moved
  /// out of the way without a look at the air.
  bool FinishPath(std::size_t o, const AirSampler& air);
  /// What nothing asks for any more and sinks to a surface lies there to the end.
  void LandFreeBodies();

  // AssimilationResume.cxx
  /// All but the fields.
  AssimilationState State() const;
  void Take(AssimilationState& state);
  void TakePath(std::size_t o, const AssimilationState& state);
  bool HasPaths(const AssimilationState& state) const;
  void KeepCheckpoint(int rounds, const Result& result);
  /// rounds: that the run which left the checkpoint had done.
  bool Resume(int& rounds);
  /// The air and what did not change from the last run, or from EditOf; only the rest drifts.
  bool Edit(AssimilationState* memory);
  /// For the next run.
  void Leave(AssimilationState* memory);
  /// An object that an edit leaves as it was.
  bool IsKept(std::size_t o) const { return !this->IsOld.empty() && this->IsOld[o]; }

  Result Solve();
  bool GoesOn() const;
  Result SetUpDrifters();
  /// Paths exactly through what is asked for, and what else is given out. Who stops does not wait
  /// until objects give way to each other.
  void Finish(bool isStopped);
  void KeepPlan();
  /// Where a round begins, and a fraction of it is done, in the progress of a run.
  double ProgressOf(int round, double fraction) const
  {
    return DriftEnd + (round + fraction) * (1.0 - DriftEnd) / std::max(1, this->Options.Rounds);
  }
  /// The motion so far, for a monitor that shows it.
  void ShowPaths();
  /// Sums over the steps of free flight.
  struct HandOf
  {
    double Control = 0.0; // of squares [m^2/s^2]
    double Flow = 0.0;    // of squares of the air's velocity there
    std::size_t Steps = 0;
    double Rms(double sum) const
    {
      return this->Steps > 0 ? std::sqrt(sum / static_cast<double>(this->Steps)) : 0.0;
    }
  };
  HandOf Hand(std::size_t o, const AirSampler& air) const;
  double WindAlong(std::size_t o, const CommonWind& common, const AirSampler& air) const;
  void Note(const std::string& stage, const CommonWind* common);
  /// Warns of objects that the air does not take to their marks.
  void TellLargeHands();
  double Seconds() const;

  const AssimilationInput& Input;
  const AssimilationOptions& Options;
  const SolidsOn& Solids;
  const ParallelFor& Parallel;
  Monitor& Caller;
  AssimilationOutput& Output;
  ObstacleSet Obstacles;
  DriftScene Around;
  std::vector<Drifter> Drifters;
  std::vector<std::vector<Vec3>> Paths;
  AirScene Scene;
  SmokeState Begun; // the air of the first frame, before any wind of ours
  DrawnAir Drawn;
  AirStatistics Wanted;
  std::string Candidate;
  AssimilationKey Key;
  std::vector<char> IsOld; // by object; empty: no edit
  bool HasCheckpointFailed = false;
  std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
};

} // namespace waft
