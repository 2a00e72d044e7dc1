// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Run/AirCorrection.h"

#include "Air/Field/WindCorrection.h"
#include "Air/Run/AirRounds.h"
#include "Air/Run/BodyDrift.h"
#include "Air/Run/BodyTurning.h"
#include "Air/Run/RunProgress.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace waft
{
namespace
{

constexpr std::size_t FewestToFitTogether = 128;      // bodies
constexpr double SteeringRate = 6.0;                  // 1/s, in a volume of 4 m
constexpr std::size_t LongAir = std::size_t(1) << 27; // points of all frames, 0.8 GB

// The air as it was without, with the wind correction. False: stopped, at some frames.
bool AddWind(const AirContext& run, const HalfSeries& plain, const WindCorrection& correction,
             HalfSeries& air, Monitor& monitor)
{
  if (!correction.AddTo(plain, air, run.Parallel, monitor))
  {
    return false;
  }
  for (std::vector<Half3>& field : air.Values)
  {
    StopAtFloor(air, field);
  }
  return true;
}

// What a wind would have to be at a body in the middle of a step, so that it needs no control.
struct Lack
{
  int Step;
  Vec3 Place, Wind;
};

std::vector<Lack> LacksOf(const BodyProblem& body, const std::vector<Vec3>& path,
                          const AirSampler& air, const WindCorrection& correction)
{
  const DriftProblem problem = body.In(air);
  const std::vector<Vec3> controls = DriftControls(problem, air, path);
  std::vector<Lack> lacks;
  for (int k = 1; k < static_cast<int>(controls.size()); k += WindStride)
  {
    const auto at = static_cast<std::size_t>(k);
    if (IsFreeStep(problem, path, k))
    {
      const Vec3 middle = 0.5 * (path[at] + path[at + 1]);
      lacks.push_back({ k, middle, controls[at] + correction.At(middle, k + 0.5) });
    }
  }
  return lacks;
}

// The wind that would have made the controls needless: what it is at the bodies, and they.
bool FitWind(const AirContext& run, const AirState& state, const WindCorrectionOptions& options,
             WindCorrection& correction, Monitor& monitor)
{
  const AirBodies& bodies = state.Bodies;
  const AirSampler air(state.Sampled.Velocity);
  std::vector<std::vector<Lack>> lacks(bodies.Size());
  run.Parallel(bodies.Size(),
               [&](std::size_t begin, std::size_t end)
               {
                 for (std::size_t o = begin; o < end; ++o)
                 {
                   lacks[o] = LacksOf(bodies.Problems[o], bodies.Paths[o], air, correction);
                 }
               });
  std::map<int, WindSamples> byFrame;
  for (const std::vector<Lack>& own : lacks)
  {
    for (const Lack& lack : own)
    {
      WindSamples& samples = byFrame[lack.Step];
      samples.Frame = lack.Step + 0.5;
      samples.Positions.push_back(lack.Place);
      samples.Values.push_back(lack.Wind);
    }
  }
  std::vector<WindSamples> samples;
  for (auto& [frame, at] : byFrame)
  {
    samples.push_back(std::move(at));
  }
  SingleRank alone;
  Communicator* ranks = run.Input.Ranks;
  if (ranks == nullptr || ranks->Size() == 1 || bodies.Size() < FewestToFitTogether)
  {
    return correction.Fit(samples, run.Parallel, alone, monitor);
  }
  MemoryStream job;
  job.Values(run.Input.Scene, options, correction.Values(), samples);
  const WorkSharing others(*ranks, WindKind, job);
  return correction.Fit(samples, run.Parallel, *ranks, monitor);
}

} // namespace

Result ServeWind(ReadingStream& inputs, Communicator& ranks, const ParallelFor& parallel)
{
  SceneInfo scene;
  WindCorrectionOptions options;
  std::vector<double> values;
  std::vector<WindSamples> samples;
  inputs.Values(scene, options, values, samples);
  WindCorrection correction(scene.Bounds, scene.Time, options);
  correction.Values() = values;
  SilentMonitor silent; // the first rank's is asked
  (void)correction.Fit(samples, parallel, ranks, silent);
  return Result::Ok();
}

Result FindWind(const AirContext& run, const HalfSeries& plain, AirState& state,
                AssimilationOutput& output)
{
  WindCorrectionOptions options;
  options.Spacing = WindSpacingIn(run.Input.Scene.Bounds, run.Options);
  options.TimeSpacing = run.Options.WindTimeSpacing * TimeScaleOf(run.Input.Scene.Bounds.Width());
  options.Ridge *= run.Options.WindStiffness;
  options.Bending *= run.Options.WindStiffness;
  options.Changing *= run.Options.WindStiffness;
  WindCorrection correction(run.Input.Scene.Bounds, run.Input.Scene.Time, options);
  const double begin = ProgressOf(run.Options.Rounds, state.Rounds, 0.0);
  const double step =
    (ProgressOf(run.Options.Rounds, state.Rounds, WindEnd) - begin) / run.Options.WindRounds;
  const int again = run.Options.WindRounds / 2;
  for (int k = 0; k < run.Options.WindRounds; ++k)
  {
    const bool isFirst = k == 0 && state.Bodies.Poses.empty();
    if (isFirst || (k == again && run.Options.Rounds > 0))
    {
      const Result turned = isFirst ? TurnAndDrift(run, state.Sampled.Velocity, FurtherIterations,
                                                   Everybody(state.Bodies), state.Bodies)
                                    : TurnDisagreeing(run, state.Sampled.Velocity, state.Bodies);
      if (!turned || turned.IsStopped())
      {
        state.Sampled.Velocity = plain;
        return turned;
      }
    }
    PartMonitor fitting(run.Caller, begin + k * step, begin + (k + 0.5) * step,
                        "Fitting the wind correction");
    const bool isFitted = FitWind(run, state, options, correction, fitting);
    if (!isFitted || !AddWind(run, plain, correction, state.Sampled.Velocity, fitting))
    {
      state.Sampled.Velocity = plain;
      return Result::Stopped();
    }
    PartMonitor drifting(run.Caller, begin + (k + 0.5) * step, begin + (k + 1) * step,
                         "Letting the objects drift in the wind correction");
    const Result drifted =
      DriftOn(run, state.Sampled.Velocity, FurtherIterations, state.Bodies, drifting);
    if (!drifted || drifted.IsStopped())
    {
      return drifted;
    }
    output.Rounds.push_back(RoundOf(run, state, "wind " + std::to_string(k + 1), &correction));
  }
  return Result::Ok();
}

Result SimulateAgain(const AirContext& run, HalfSeries plain, AirState& state,
                     AssimilationOutput& output)
{
  const int rounds = run.Options.Rounds;
  const std::string number = std::to_string(state.Rounds + 1);
  const bool isLong = plain.Values.size() * plain.NumberOfPoints() > LongAir;
  AirSteering steering(std::move(state.Sampled.Velocity), std::move(plain),
                       std::move(state.Sampled.Wind),
                       SteeringRate / TimeScaleOf(run.Input.Scene.Bounds.Width()), isLong);
  state.Sampled = SampledAir();
  HalfSeries air;
  PartMonitor monitor(run.Caller, ProgressOf(rounds, state.Rounds, WindEnd),
                      ProgressOf(rounds, state.Rounds, SimulationEnd),
                      "Simulating the air with the wind correction, round " + number +
                        " of at most " + std::to_string(rounds));
  const Result simulated =
    SimulateAir(state.Scene, &steering, run.Parallel, monitor, air, &state.Begun);
  if (!simulated || simulated.IsStopped())
  {
    state.Sampled.Velocity = steering.TakeWanted(); // in which the objects drift
    return simulated;
  }
  state.Sampled.Velocity = std::move(air);
  state.Sampled.Wind = steering.TakePushes();
  PartMonitor drifting(run.Caller, ProgressOf(rounds, state.Rounds, SimulationEnd),
                       ProgressOf(rounds, state.Rounds, DriftingEnd),
                       "Letting the objects drift to their marks");
  const Result drifted =
    DriftOn(run, state.Sampled.Velocity, DriftIterations, state.Bodies, drifting);
  if (!drifted || drifted.IsStopped())
  {
    return drifted;
  }
  PartMonitor seeking(run.Caller, ProgressOf(rounds, state.Rounds, DriftingEnd),
                      ProgressOf(rounds, state.Rounds, 1.0), "Seeking anew what the air has lost");
  const Result sought = SeekAgain(run, state.Sampled.Velocity, state.Bodies, seeking);
  if (!sought || sought.IsStopped())
  {
    return sought;
  }
  output.Rounds.push_back(RoundOf(run, state, "simulate " + number));
  return Result::Ok();
}

} // namespace waft
