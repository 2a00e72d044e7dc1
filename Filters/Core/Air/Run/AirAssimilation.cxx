// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Run/AirAssimilation.h"

#include "Air/Run/AirCorrection.h"
#include "Air/Run/AirDraw.h"
#include "Air/Run/AirLoop.h"
#include "Air/Run/AirResult.h"
#include "Air/Run/AirRounds.h"
#include "Air/Run/AirSetup.h"
#include "Air/Run/AirWhen.h"
#include "Air/Run/AirWho.h"
#include "Air/Run/AssimilationResume.h"
#include "Air/Run/BodyDrift.h"
#include "Air/Run/BodyTurning.h"
#include "Air/Run/RunProgress.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace waft
{
namespace
{

constexpr int LeastFrames = 2;
constexpr int LeastDrawn = 32;  // voxels along the longest side, of an air as drawn
constexpr int LongestSide = 32; // of the volume, over the shortest: of less no coarse grid is made
constexpr double WindSpacingOverSide = 0.1; // the longest of the volume
constexpr double LeastWindSpacing = 1.0 / 256.0;

void ShowPaths(const AirContext& run, const AirBodies& bodies, std::vector<Track>& tracks)
{
  tracks.resize(bodies.Size());
  for (std::size_t o = 0; o < bodies.Size(); ++o)
  {
    tracks[o].ObjectId = bodies.Problems[o].Object().ObjectId;
    tracks[o].Positions = bodies.Paths[o];
    tracks[o].Positions.resize(bodies.Paths[o].size() - (run.Input.Scene.Loops != 0 ? 1 : 0));
  }
}

// An air that is simulated again is drawn on a grid of half the resolution, as a preview's.
AssimilationOptions Drawn(AssimilationOptions options)
{
  if (options.Rounds > 0)
  {
    options.Resolution = std::max(std::min(options.Resolution, LeastDrawn), options.Resolution / 2);
    options.LatticeResolution = std::min(options.LatticeResolution, options.Resolution);
  }
  return options;
}

// From the plan to the marks in the air as it was drawn.
Result FirstDrift(const AirContext& run, AirState& state, AssimilationOutput& output)
{
  PartMonitor monitor(run.Caller, DrawEnd, DriftEnd, "Letting the objects drift to their marks");
  const Result sought = SeekPaths(run, state.Sampled.Velocity,
                                  std::vector<char>(state.Bodies.Size(), 1), state.Bodies, monitor);
  WAFT_RETURN_IF_FAILED(sought);
  output.Rounds.push_back(RoundOf(run, state, "drift"));
  return monitor.Tick(1.0, "") ? Result::Ok() : Result::Stopped();
}

// What an edit changed, in the air that it leaves. Stopped it has what there is by then.
Result DriftEdited(const AirContext& run, AirState& state, AssimilationOutput& output)
{
  WAFT_RETURN_IF_FAILED(FirstDrift(run, state, output));
  WAFT_RETURN_IF_FAILED(TurnAndDrift(run, state.Sampled.Velocity, FurtherIterations,
                                     Everybody(state.Bodies), state.Bodies));
  if (!state.Bodies.Poses.empty()) // where their poses take them is another way
  {
    PartMonitor seeking(run.Caller, DriftEnd, DriftEnd, "Seeking anew by how the objects turn");
    WAFT_RETURN_IF_FAILED(
      SeekPaths(run, state.Sampled.Velocity, Everybody(state.Bodies), state.Bodies, seeking));
  }
  PartMonitor drifting(run.Caller, DriftEnd, 1.0, "Letting the objects drift to their marks");
  WAFT_RETURN_IF_FAILED(
    DriftOn(run, state.Sampled.Velocity, DriftIterations, state.Bodies, drifting));
  output.Rounds.push_back(RoundOf(run, state, "edit"));
  return Result::Ok();
}

bool IsLate(const AirContext& run)
{
  return run.Options.TimeLimit > 0.0 && run.Seconds() > run.Options.TimeLimit;
}

// Where the time is up in between, the correction is what the air has.
Result CorrectAndSimulate(const AirContext& run, CheckpointFile& checkpoint, AirState& state,
                          AssimilationOutput& output)
{
  if (state.Plain.IsEmpty())
  {
    HalfSeries plain = state.Sampled.Velocity;
    const Result corrected = AddWind(run, state, output);
    if (!corrected || corrected.IsStopped())
    {
      return corrected;
    }
    state.Plain = std::move(plain);
    KeepCheckpoint(run, state, output, checkpoint);
  }
  if (IsLate(run))
  {
    return Result::Ok();
  }
  const HalfSeries plain = std::exchange(state.Plain, HalfSeries());
  const Result simulated = SimulateAgain(run, plain, state, output);
  if (simulated && !simulated.IsStopped())
  {
    state.IsSimulated = true;
    KeepCheckpoint(run, state, output, checkpoint);
  }
  return simulated;
}

// An air is drawn, the objects drift in it; then it is simulated with the force of the wind that
// makes their controls needless, and what it lacks then is added to it as it is.
Result Assimilate(AirContext& run, CheckpointFile& checkpoint, AirState& state,
                  AssimilationOutput& output)
{
  Result result = Result::Ok();
  if (!Resume(run, checkpoint, state, output))
  {
    result = DrawAir(run, state, output);
    if (!result || result.IsStopped())
    {
      state.Sampled.Velocity = HalfSeries();
      return result;
    }
    result = ChooseWho(run, state, output);
    WAFT_RETURN_IF_FAILED(result);
    if (!result.IsStopped())
    {
      int chosen = 0;
      result = ChooseWhen(run, state.Sampled.Velocity, state.Bodies, output, chosen);
      WAFT_RETURN_IF_FAILED(result);
      if (chosen > 0)
      {
        output.Rounds.push_back(RoundOf(run, state, "when"));
        output.Rounds.back().Candidate =
          std::to_string(chosen) + " objects come at frames of their own in their windows";
      }
    }
    if (!result.IsStopped())
    {
      WAFT_RETURN_IF_FAILED(MoveFormations(run, state.Sampled.Velocity, state.Bodies, output));
      result = FirstDrift(run, state, output);
    }
    WAFT_RETURN_IF_FAILED(result);
    if (!result.IsStopped())
    {
      KeepCheckpoint(run, state, output, checkpoint);
    }
  }
  if (!result.IsStopped() && run.Options.Rounds > 0 && !state.IsSimulated && !IsLate(run))
  {
    result = CorrectAndSimulate(run, checkpoint, state, output);
    WAFT_RETURN_IF_FAILED(result);
  }
  if (!result.IsStopped() && (state.IsSimulated || run.Options.Rounds == 0))
  {
    result = AddWind(run, state, output);
    WAFT_RETURN_IF_FAILED(result);
  }
  if (!result.IsStopped() && state.Bodies.Poses.empty()) // there was no time for a correction
  {
    result = TurnAndDrift(run, state.Sampled.Velocity, DriftIterations, Everybody(state.Bodies),
                          state.Bodies);
  }
  return result;
}

} // namespace

std::uint64_t SeedOfAir(const AssimilationInput& input, const AssimilationOptions& options)
{
  return options.Seed < 0 ? input.Scene.Seed : static_cast<std::uint64_t>(options.Seed);
}

double WindSpacingIn(const Box& volume, const AssimilationOptions& options)
{
  return options.WindSpacing > 0.0 ? options.WindSpacing
                                   : WindSpacingOverSide * volume.Size().maxCoeff();
}

std::array<int, 3> AirLatticeDimensions(const Box& volume, const AssimilationOptions& options)
{
  const Vec3 size = volume.Size();
  const double cell = size.maxCoeff() / (options.LatticeResolution - 1);
  std::array<int, 3> points{};
  for (int c = 0; c < 3; ++c)
  {
    points[static_cast<std::size_t>(c)] =
      std::max(3, static_cast<int>(std::lround(size[c] / cell)) + 1);
  }
  return points;
}

namespace
{

Result CheckInput(const AssimilationInput& input, const AssimilationOptions& options)
{
  WAFT_RETURN_IF_FAILED(options.Validate());
  WAFT_RETURN_IF_FAILED(CheckTracks(input, LeastFrames));
  const Vec3 size = input.Scene.Bounds.Size();
  if (size.minCoeff() * LongestSide < size.maxCoeff())
  {
    return Result::Error("the volume: expected a shortest side of at least " +
                         NumberText(size.maxCoeff() / LongestSide) +
                         " m beside its longest, room for an eddy, found " +
                         NumberText(size.minCoeff()) + " m");
  }
  const double least = LeastWindSpacing * size.maxCoeff();
  if (WindSpacingIn(input.Scene.Bounds, options) < least)
  {
    return Result::Error("WindSpacing: expected 0 or a number from " + NumberText(least) +
                         " m in this volume, found " + NumberText(options.WindSpacing));
  }
  return Result::Ok();
}

// Of a scene that does not loop, or is unrolled.
Result AssimilateShot(const AssimilationInput& input, const AssimilationOptions& options,
                      const SolidsOn& solids, const ParallelFor& parallel, Monitor& monitor,
                      AssimilationOutput& output, AssimilationState* memory)
{
  AirContext setUp(input, options, solids, parallel, monitor);
  AirState state;
  WAFT_RETURN_IF_FAILED(SetUpObstacles(setUp));
  WAFT_RETURN_IF_FAILED(SetUpBodies(setUp, state.Bodies, output));
  state.Scene = SetUpScene(setUp, Drawn(options));
  setUp.Search.HasSolids = static_cast<bool>(state.Scene.Solids);
  setUp.Key = KeyOf(input, options);
  setUp.Publish = [&](const AirBodies& bodies)
  {
    if (monitor.Publishes())
    {
      ShowPaths(setUp, bodies, output.Tracks);
    }
  };
  AirContext& run = setUp;
  run.Publish(state.Bodies);
  const bool isEdit = TakeEdit(run, memory, state, output);
  const Result edited =
    isEdit && !state.Bodies.AreAllKept() ? DriftEdited(run, state, output) : Result::Ok();
  if (memory != nullptr)
  {
    *memory = AssimilationState();
  }
  WAFT_RETURN_IF_FAILED(edited);
  CheckpointFile checkpoint = CheckpointOf(run, output);
  const Result result = isEdit ? Result::Ok() : Assimilate(run, checkpoint, state, output);
  if (!result)
  {
    return result;
  }
  if (!state.Sampled.Velocity.IsEmpty())
  {
    WAFT_RETURN_IF_FAILED(FinishRun(run, result.IsStopped(), state, output));
  }
  else
  {
    KeepPlan(run, output);
  }
  if (!result.IsStopped())
  {
    checkpoint.Remove();
    Leave(run, state, output, memory);
  }
  return result;
}

} // namespace

Result AssimilateAir(const AssimilationInput& input, const AssimilationOptions& options,
                     const SolidsOn& solids, const ParallelFor& parallel, Monitor& monitor,
                     AssimilationOutput& output, AssimilationState* memory)
{
  WAFT_RETURN_IF_FAILED(CheckInput(input, options));
  if (input.Scene.Loops == 0)
  {
    return AssimilateShot(input, options, solids, parallel, monitor, output, memory);
  }
  AssimilationInput unrolled;
  WAFT_RETURN_IF_FAILED(Unroll(input, unrolled));
  const Result result =
    AssimilateShot(unrolled, options, Unrolled(solids, input.Scene.Time.NumberOfFrames), parallel,
                   monitor, output, memory);
  RollUp(unrolled, output);
  return result;
}

} // namespace waft
