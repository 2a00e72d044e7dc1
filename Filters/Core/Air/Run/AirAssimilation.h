// SPDX-License-Identifier: BSD-3-Clause
// One sampled air in which all objects drift to their marks with the least control.
//
// Not of Shi et al. 2005: there plans are drawn one by one and one gas is fitted to them. Here one
// air is drawn first, as the simulations of the database are; the objects drift in it with the
// least control that meets their rows; what their controls have in common becomes a smooth wind;
// the force that makes it goes into the simulation, which is run again (incremental 4D-Var with an
// ensemble of one, Courtier, Thepaut, Hollingsworth 1994).
#pragma once

#include "Base/Communicator.h"
#include "Base/HalfSeries.h"
#include "Base/Monitor.h"
#include "Base/OptionFields.h"
#include "Base/Parallel.h"
#include "Constraints/MotionProblem.h"
#include "Grid/SmokeSeries.h"
#include "Obstacles/ObstacleSet.h"
#include "Rotation/RotationRefine.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace waft
{

struct AssimilationOptions
{
  int Resolution = 64;
  int LatticeResolution = 48;
  int Candidates = 32;
  int Starts = 8;
  int Rounds = 2;
  int WindRounds = 5;
  double WindSpacing = 0.0;
  double WindTimeSpacing = 0.5;
  double WindStiffness = 1.0;
  double Smoothness = 0.005;
  double TouchDownSpread = 2.0;
  double Glide = 1.0;
  bool Inertia = false;
  int Seed = -1;
  double TimeLimit = 0.0;
  bool WarmStart = true;
  std::string CheckpointFile;
  std::string StateFile;
  std::string EditOf;

  Result Validate() const { return ValidateFields<AssimilationOptions>(*this); }

  /// What the motion depends on.
  template <class Visitor, class... Holder>
  static void VisitAir(Visitor&& visit, Holder&... of)
  {
    visit(OptionField{ "Resolution",
                       { 16, 256 },
                       "",
                       "Voxels of the simulation along the longest side of the volume." },
          of.Resolution...);
    visit(OptionField{ "LatticeResolution",
                       { 8, 256 },
                       "",
                       "Points of the lattice of the air that objects drift in and that is given "
                       "out, along the longest side." },
          of.LatticeResolution...);
    visit(OptionField{ "Candidates",
                       { 1, 256 },
                       "",
                       "Quarter turns and mirror images of the drawn air that are tried, at most "
                       "eight; the one that needs the least help is flown in." },
          of.Candidates...);
    visit(OptionField{ "Starts",
                       { 0, 1000 },
                       "",
                       "Paths that each object's search begins with besides its plan, the straight "
                       "line and free drift; of many objects fewer, 8000 of all together." },
          of.Starts...);
    visit(
      OptionField{
        "Rounds",
        { 0, 10 },
        "",
        "0: the wind correction is added to the air as it is drawn; else it is drawn on half the "
        "resolution, and simulated once with the force of that correction." },
      of.Rounds...);
    visit(OptionField{ "WindRounds",
                       { 0, 100 },
                       "",
                       "Alternations of fitting the correction with drifting in it, in a round." },
          of.WindRounds...);
    visit(OptionField{ "WindSpacing",
                       { 0.0, 1e6 },
                       "m",
                       "Spacing of the splines of the wind correction's middle scale in "
                       "space; one has twice, one half of it." }
            .Or("a tenth of the volume's longest side"),
          of.WindSpacing...);
    visit(
      OptionField{
        "WindTimeSpacing", { 1e-3, 1e3 }, "s", "Spacing of these splines in time, in seconds." },
      of.WindTimeSpacing...);
    visit(OptionField{ "WindStiffness",
                       { 1e-3, 1e3 },
                       "",
                       "Factor of what the wind correction costs over what it may be off at the "
                       "objects." },
          of.WindStiffness...);
    visit(OptionField{ "Smoothness",
                       { 0, 10 },
                       "s^2",
                       "Cost of changes of the control over that of the control, in s^2." },
          of.Smoothness...);
    visit(
      OptionField{
        "TouchDownSpread",
        { 0, 60 },
        "s",
        "Seconds that an object may lie before and after the frames between which it has to." },
      of.TouchDownSpread...);
    visit(OptionField{ "Glide",
                       { 0, 1 },
                       "",
                       "1: bodies glide and sweep from side to side; 0: they sink straight "
                       "down. Needs Shapes." },
          of.Glide...);
    visit(FlagField("Inertia",
                    "Bodies come after the air as g / SettlingSpeed has it, instead of at once."),
          of.Inertia...);
    visit(OptionField{ "Seed",
                       { -1, 2147483647 },
                       "",
                       "Seed of the forces that are drawn: another one is another air; -1 is the "
                       "scene's own." },
          of.Seed...);
  }

  template <class Visitor, class... Holder>
  static void VisitUse(Visitor&& visit, Holder&... of)
  {
    visit(OptionField{ "TimeLimit",
                       { 0, 1e+09 },
                       "s",
                       "Seconds after which the best motion so far is given; 0: no limit. With a "
                       "limit two runs may differ." },
          of.TimeLimit...);
    visit(FlagField("WarmStart",
                    "When only some objects, rows or tracks changed since the last run: the same "
                    "air, and only what changed drifts again."),
          of.WarmStart...);
    visit(TextField("CheckpointFile",
                    "A file that the state of a run is written to after each of its parts, whole "
                    "or not at all; empty: none. A run of the same inputs and properties that was "
                    "ended before its time goes on from it, to the same bits; a run that ends by "
                    "itself removes it."),
          of.CheckpointFile...);
    visit(TextField("StateFile",
                    "A file that a finished run is kept in, for later edits; empty: none."),
          of.StateFile...);
    visit(TextField("EditOf",
                    "The State File of a run of the same scene that differs in some objects' rows: "
                    "the same air, and only what changed drifts again; empty: none."),
          of.EditOf...);
  }

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    VisitAir(visit, of...);
    VisitUse(visit, of...);
  }
};

/// Where airs as they were drawn are kept by key for runs with other marks; empty: nowhere.
struct DrawnAirs
{
  /// The path of a file; empty where there is none of the key.
  std::function<std::string(std::uint64_t key)> Found;
  /// Has write(path) write it.
  std::function<void(std::uint64_t key, const std::function<Result(const std::string&)>& write)>
    Make;
};

/// Plans for objects with rows of theirs, around what is in the way: by object a place a frame, or
/// nothing where there is none.
using PlanAroundObstacles = std::function<std::vector<std::vector<Vec3>>(
  const std::vector<MotionObject>& objects, const std::vector<Constraint>& rows)>;

/// Its Vortices are the scene's own, which stir the air with the random ones.
struct AssimilationInput : MotionProblem
{
  std::vector<Shape> Shapes; // by ShapeId: what flies; empty: nothing glides
  RotationOptions Turning;   // its Seed is not read: it is the air's
  /// Those besides rank 0 are in Serve meanwhile (Base/SharedWork.h); null: rank 0 alone.
  Communicator* Ranks = nullptr;
  DrawnAirs Drawn = {};
  /// For who gets another mark, with an obstacle between; null: such keep those by the shortest
  /// legs.
  PlanAroundObstacles PlanAround = nullptr;
  int LoopRow = -1; // of a scene that loops, as it is flown: the Row of those that close it
};

/// What a round brought.
struct AssimilationRound
{
  std::string Stage; // "draw", "drift", "wind", "simulate"
  std::string Candidate;
  double Control = 0.0;       // rms of the residual control in flight [m/s]
  double MedianControl = 0.0; // of the objects' rms [m/s]
  double Flow = 0.0;          // rms of the air's velocity at the bodies in flight [m/s]
  double Wind = 0.0;          // rms of the wind correction at the bodies [m/s]
  double Seconds = 0.0;       // since the run began

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Stage...);
    visit(of.Candidate...);
    visit(of.Control...);
    visit(of.MedianControl...);
    visit(of.Flow...);
    visit(of.Wind...);
    visit(of.Seconds...);
  }
};

/// An air of all frames on one lattice.
struct SampledAir
{
  HalfSeries Velocity; // m/s
  HalfSeries Wind;     // m/s^2, the wind correction's force in it; may be empty
};

struct AssimilationOutput
{
  std::vector<Track> Tracks;               // AirVelocities among them
  std::vector<std::vector<Vec3>> Controls; // by track and frame [m/s]
  /// By track and frame: 1 where the step from it is flown by the air and the slip alone.
  std::vector<std::vector<unsigned char>> Free;
  /// By track: how long a body with inertia takes to come after the air [s]; else none.
  std::vector<double> ResponseTimes;
  std::shared_ptr<const SampledAir> Air = std::make_shared<SampledAir>();
  std::vector<Vortex> Vortices;        // all that stir the air
  std::vector<Constraint> Constraints; // with TouchDown and LiftOff
  std::vector<ReportRow> Report;
  std::vector<AssimilationRound> Rounds;
  std::vector<std::string> Warnings;
};

/// Whether bodies go where their poses take them.
inline bool GlidesIn(const AssimilationInput& input, const AssimilationOptions& options)
{
  return options.Glide > 0.0 && !options.Inertia && !input.Shapes.empty();
}

/// Of the forces that are drawn.
std::uint64_t SeedOfAir(const AssimilationInput& input, const AssimilationOptions& options);
/// Of the wind correction's splines [m].
double WindSpacingIn(const Box& volume, const AssimilationOptions& options);
/// Points of the lattice of the air, whose corners are the volume's.
std::array<int, 3> AirLatticeDimensions(const Box& volume, const AssimilationOptions& options);

/// solids: the obstacles as SmokeSolver::SetSolids wants them on the simulation's grid of the given
/// options; may be empty.
using SolidsOn = std::function<SolidsAtFrame(const SmokeOptions& smoke)>;

struct AssimilationState; // Air/Run/AssimilationState.h

/// Errors: tracks that are empty, not finite or of different lengths, fewer than 8 frames, rows or
/// tracks without object. The same bits on any number of threads. memory, where there is one, is
/// what the last run left and is left anew: see WarmStart.
Result AssimilateAir(const AssimilationInput& input, const AssimilationOptions& options,
                     const SolidsOn& solids, const ParallelFor& parallel, Monitor& monitor,
                     AssimilationOutput& output, AssimilationState* memory = nullptr);

} // namespace waft
