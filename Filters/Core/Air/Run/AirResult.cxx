// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Run/AirResult.h"

#include "Air/Run/AirCorrection.h"
#include "Air/Run/AirRounds.h"
#include "Air/Run/AirSetup.h"
#include "Air/Run/BodyDrift.h"
#include "Air/Run/BodyTurning.h"
#include "Base/NumberText.h"
#include "Constraints/ConstraintCheck.h"
#include "Constraints/RowsOfObjects.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace waft
{
namespace
{

constexpr const char* Finished = "finish";

// A body's way as it is now, its control at each frame, and which steps are free.
void Describe(const BodyProblem& body, const AirSampler& air, Track& track,
              std::vector<Vec3>& controls, std::vector<unsigned char>& isFree)
{
  const DriftProblem problem = body.In(air);
  const std::vector<Vec3> between = DriftControls(problem, air, track.Positions);
  controls.assign(track.Positions.size(), Vec3::Zero());
  isFree.assign(track.Positions.size(), 0);
  for (std::size_t f = 0; f < track.Positions.size(); ++f)
  {
    track.AirVelocities.push_back(air.At(static_cast<int>(f), track.Positions[f]));
    const std::size_t before = f > 0 ? f - 1 : 0;
    const std::size_t after = std::min(f, between.size() - 1);
    controls[f] = 0.5 * (between[before] + between[after]);
    isFree[f] =
      f < between.size() && IsFreeOfGround(problem, track.Positions, static_cast<int>(f)) ? 1 : 0;
  }
}

/// From the frame from which it is gone on it stays where it was seen last.
void EndWhereGone(int leave, Track& track, std::vector<Vec3>& controls,
                  std::vector<unsigned char>& isFree)
{
  track.Leave = leave;
  if (leave < 0)
  {
    return;
  }
  const auto end = static_cast<std::size_t>(std::max(leave, 1));
  const auto keep = [end](auto& values)
  {
    for (std::size_t f = end; f < values.size(); ++f)
    {
      values[f] = values[end - 1];
    }
  };
  keep(track.Positions);
  keep(track.AirVelocities);
  keep(track.Slips);
  keep(track.Orientations);
  std::fill(track.AngularVelocities.begin() + (track.AngularVelocities.empty() ? 0 : end),
            track.AngularVelocities.end(), Vec3::Zero());
  std::fill(controls.begin() + end - 1, controls.end(), Vec3::Zero());
  std::fill(isFree.begin() + end - 1, isFree.end(), 0);
}

void WarnOfWhoStays(const AirBodies& bodies, AssimilationOutput& output)
{
  constexpr std::size_t most = 10;
  std::string names;
  std::size_t count = 0;
  for (std::size_t o = 0; o < bodies.Size(); ++o)
  {
    if (bodies.Problems[o].LeavingRow() != nullptr && output.Tracks[o].Leave < 0)
    {
      const std::string id = std::to_string(output.Tracks[o].ObjectId);
      names += count < most ? (count > 0 ? ", " : "") + id : "";
      ++count;
    }
  }
  if (count > 0)
  {
    output.Warnings.push_back((count > 1 ? "objects " : "object ") + names +
                              (count > most ? " and more" : "") +
                              ": still in the volume at the last frame, though to leave: give "
                              "them more time, or a wind that carries them out");
  }
}

} // namespace

void KeepPlan(const AirContext& run, AssimilationOutput& output)
{
  output.Warnings.push_back("stopped before there was an air: the paths are the plan's");
  output.Tracks = run.Input.Tracks;
  for (const Track& track : output.Tracks)
  {
    output.Controls.emplace_back(track.Positions.size(), Vec3::Zero());
    output.Free.emplace_back(track.Positions.size(), 0);
  }
  MeasureResiduals(output.Constraints, output.Tracks, run.Input.Objects, run.Obstacles,
                   run.Input.Scene, output.Report);
}

Result FinishRun(const AirContext& run, bool isStopped, AirState& state, AssimilationOutput& output)
{
  AirBodies& bodies = state.Bodies;
  HalfSeries& series = state.Sampled.Velocity;
  series = OnLattice(std::move(series), AirLattice(SetUpScene(run, run.Options), series.Meaning),
                     run.Parallel); // a stop may have come before it was simulated
  if (isStopped)
  {
    output.Warnings.push_back("stopped: objects may come too near to each other");
  }
  else
  {
    WAFT_RETURN_IF_FAILED(LandFreeBodies(run, series, bodies));
    KeepApart(run, series, bodies);
  }
  const std::vector<char> clear = FinishPaths(run, series, bodies);
  if (!isStopped && bodies.IsOld.empty() && run.Options.WindRounds > 0) // an edit keeps the air
  {
    AddRest(run, state, output);
  }
  if (!output.Rounds.empty() && output.Rounds.back().Stage == Finished)
  {
    output.Rounds.pop_back(); // of the run that this one goes on from
  }
  output.Rounds.push_back(RoundOf(run, state, Finished));
  WarnOfLargeControls(run, bodies, series, output.Rounds.back().Flow, output.Warnings);
  output.Tracks.assign(bodies.Size(), Track()); // in place of what was published
  output.Controls.assign(bodies.Size(), {});
  output.Free.assign(bodies.Size(), {});
  const AirSampler air(series);
  run.Parallel(bodies.Size(),
               [&](std::size_t begin, std::size_t end)
               {
                 for (std::size_t o = begin; o < end; ++o)
                 {
                   output.Tracks[o] = FlownTrack(bodies, o);
                   Describe(bodies.Problems[o], air, output.Tracks[o], output.Controls[o],
                            output.Free[o]);
                   const Constraint* leaving = bodies.Problems[o].LeavingRow();
                   output.Tracks[o].Fade = leaving != nullptr ? leaving->Goes.Fade : 0;
                   EndWhereGone(bodies.Problems[o].GoneFrom(bodies.Paths[o]), output.Tracks[o],
                                output.Controls[o], output.Free[o]);
                 }
               });
  WarnOfWhoStays(bodies, output);
  output.ResponseTimes.clear();
  for (std::size_t o = 0; run.Options.Inertia && o < bodies.Size(); ++o)
  {
    output.ResponseTimes.push_back(bodies.Problems[o].In(air).ResponseTime);
  }
  const RowsOfObjects places(output.Constraints);
  for (std::size_t o = 0; o < bodies.Size(); ++o)
  {
    if (!clear[o])
    {
      output.Warnings.push_back("object " + std::to_string(bodies.Problems[o].Object().ObjectId) +
                                ": the path leaves less than the clearance asked for, " +
                                NumberText(bodies.Problems[o].Object().ClearanceRadius) +
                                " m: give its marks more room beside what is in the way");
    }
    for (const std::size_t place : places.Of(bodies.Problems[o].Object().ObjectId))
    {
      Constraint& row = output.Constraints[place];
      for (const Constraint& own : bodies.Problems[o].Rows())
      {
        if (own.Row == row.Row && own.Target == row.Target)
        {
          row.TouchDown = own.TouchDown;
          row.LiftOff = own.LiftOff;
        }
      }
      row.Leave = output.Tracks[o].Leave;
    }
    const Constraint* landing = bodies.Problems[o].FreeLanding();
    const int leave = output.Tracks[o].Leave;
    if (landing != nullptr && (leave < 0 || landing->TouchDown < leave))
    {
      output.Constraints.push_back(*landing);
    }
  }
  MeasureResiduals(output.Constraints, output.Tracks, run.Input.Objects, run.Obstacles,
                   run.Input.Scene, output.Report);
  output.Air = std::make_shared<SampledAir>(std::move(state.Sampled));
  output.Vortices = state.Scene.Forces.Vortices;
  return Result::Ok();
}

} // namespace waft
