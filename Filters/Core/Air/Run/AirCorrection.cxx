// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Run/AirCorrection.h"

#include "Air/Field/AirSteering.h"
#include "Air/Field/WindCorrection.h"
#include "Air/Run/AirLoop.h"
#include "Air/Run/AirRounds.h"
#include "Air/Run/AirSetup.h"
#include "Air/Run/BodyDrift.h"
#include "Air/Run/BodyTurning.h"
#include "Air/Run/RunProgress.h"
#include "Base/NumberText.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace waft
{
namespace
{

constexpr double SteeringShare = 0.8; // of what the air lacks, in a frame
// What a wind may be off at the bodies, over the flow there: of the first fit to an air as drawn,
// of the first to one that has been simulated again, and of the last.
constexpr double FirstError = 1.0;
constexpr double FurtherError = 0.05;
constexpr double LastError = 0.01;
// Chi2 of a wind that such an air may well have, whose force it is simulated with, of one beside
// that, and of one that is all that is added to an air: what asks for more stays control.
constexpr double Likely = 0.25;
constexpr double LikelyInTheEnd = 0.8;
constexpr double LikelyAlone = 0.19;
constexpr int FurtherRounds = 5;   // of fits to an air that has been simulated again, at most
constexpr double Enough = 0.02;    // of the flow, that is left as control: then no further ones
constexpr double Slow = 0.95;      // of the control before, that is left: likewise
constexpr int MostIterations = 60; // of conjugate gradients
constexpr double LeftBeforeNext = 3e-2; // of the gradient, by a fit that another one follows
constexpr double LeftInTheEnd = 3e-3;   // and by the last of several, and the rest
constexpr double LargeGradient = 0.5;   // that they leave, of which is warned
constexpr int WindStride =
  3; // frames between samples of a wind, but for the rest of a simulated air

// The air as it was without, with the wind correction. False: stopped, at some frames.
bool AddTo(const AirContext& run, const HalfSeries& plain, const WindCorrection& correction,
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
                          const AirSampler& air, const WindCorrection& correction, int stride)
{
  const DriftProblem problem = body.In(air);
  const std::vector<Vec3> controls = DriftControls(problem, air, path);
  std::vector<Lack> lacks;
  for (int k = stride / 2; k < static_cast<int>(controls.size()); k += stride)
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
bool Fit(const AirContext& run, const AirState& state, double error, double left, int stride,
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
                   lacks[o] = LacksOf(bodies.Problems[o], bodies.Paths[o], air, correction, stride);
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
  return correction.Fit(samples, error, left, MostIterations, run.Parallel, monitor);
}

WindCorrection CorrectionOf(const AirContext& run, const HalfSeries& plain)
{
  const Box& volume = run.Input.Scene.Bounds;
  std::vector<WindScale> scales =
    ScalesOf(plain, WindSpacingIn(volume, run.Options),
             run.Options.WindTimeSpacing * TimeScaleOf(volume.Width()));
  return WindCorrection(volume, run.Input.Scene.Time, scales, run.FromSolids,
                        run.FromSolids && run.Inside.HasMoving(), run.Input.Scene.Loops != 0);
}

double FlowAt(const AirContext& run, const AirState& state)
{
  ResidualControl all;
  for (const ResidualControl& own : ResidualControlsOf(run, state.Bodies, state.Sampled.Velocity))
  {
    all.Flow += own.Flow;
    all.Steps += own.Steps;
  }
  return std::max(all.Rms(all.Flow), 1e-3);
}

// Its figures.
std::string FitText(const WindFit& fit)
{
  return "chi2 " + NumberText(fit.ChiSquared, 2) + "; " + std::to_string(fit.Unknowns) +
         " unknowns, " + std::to_string(fit.Iterations) + " iterations to " +
         NumberText(fit.Gradient, 2) + " of the gradient without";
}

void WarnOfFit(const WindFit& fit, AssimilationOutput& output)
{
  if (fit.Gradient > LargeGradient)
  {
    output.Warnings.push_back(
      "the wind correction was not found to its end: " + std::to_string(fit.Iterations) +
      " iterations leave " + NumberText(100.0 * fit.Gradient, 2) +
      " % of the gradient; what it lacks moves the objects as their own control");
  }
}

// The acceleration that a wind adds to an air at the bodies, over the air's own: what no force that
// is declared brings about.
double MomentumResidual(const AirContext& run, const AirState& state, const HalfSeries& plain)
{
  const AirSampler before(plain), after(state.Sampled.Velocity);
  const double rate = run.Input.Scene.Time.FramesPerSecond;
  const auto accelerationOf = [rate](const AirSampler& air, int frame, const Vec3& x)
  {
    Mat3 gradient;
    const Vec3 u = air.At(frame, x, &gradient);
    return Vec3(0.5 * rate * (air.At(frame + 1, x) - air.At(frame - 1, x)) + gradient * u);
  };
  const std::size_t count = state.Bodies.Size();
  std::vector<double> added(count, 0.0), own(count, 0.0);
  run.Parallel(count,
               [&](std::size_t begin, std::size_t end)
               {
                 for (std::size_t o = begin; o < end; ++o)
                 {
                   const DriftProblem problem = state.Bodies.Problems[o].In(after);
                   const std::vector<Vec3>& path = state.Bodies.Paths[o];
                   for (int f = 1; f + 1 < static_cast<int>(path.size()); ++f)
                   {
                     if (IsFreeStep(problem, path, f))
                     {
                       const Vec3& x = path[static_cast<std::size_t>(f)];
                       const Vec3 was = accelerationOf(before, f, x);
                       added[o] += (accelerationOf(after, f, x) - was).squaredNorm();
                       own[o] += was.squaredNorm();
                     }
                   }
                 }
               });
  const double all = std::accumulate(own.begin(), own.end(), 0.0);
  return all > 0.0 ? std::sqrt(std::accumulate(added.begin(), added.end(), 0.0) / all) : 0.0;
}

// The last fit of some left little, or hardly less than the one before.
bool IsEnough(const std::vector<AssimilationRound>& rounds)
{
  const AssimilationRound& last = rounds.back();
  return last.Control <= Enough * last.Flow ||
         last.Control > Slow * rounds[rounds.size() - 2].Control;
}

} // namespace

Result AddWind(const AirContext& run, AirState& state, AssimilationOutput& output)
{
  const HalfSeries plain = state.Sampled.Velocity;
  WindCorrection correction = CorrectionOf(run, plain);
  const double flow = FlowAt(run, state) * std::sqrt(run.Options.WindStiffness);
  const bool isDrawn = !state.IsSimulated;
  const bool isLast = !isDrawn || run.Options.Rounds == 0;
  const int rounds =
    isDrawn ? run.Options.WindRounds : std::min(FurtherRounds, run.Options.WindRounds);
  const int turning = isDrawn ? std::max(1, rounds - 2) : 0; // those that disagree
  const int slipping = isDrawn ? rounds - 1 : std::min(2, rounds - 1);
  const double firstError = isDrawn ? FirstError : FurtherError;
  const double begin = isDrawn ? DriftEnd : SeekingEnd;
  const double step = ((isLast ? 1.0 : WindEnd) - begin) / std::max(1, rounds);
  const double likely = !isLast ? Likely : isDrawn ? LikelyAlone : LikelyInTheEnd;
  double leastError = 0.0;
  for (int k = 0; k < rounds; ++k)
  {
    const bool turns = (isDrawn && k == 0) || k == turning;
    if (turns)
    {
      const Result turned = isDrawn && k == 0
                              ? TurnAndDrift(run, state.Sampled.Velocity, FurtherIterations,
                                             Everybody(state.Bodies), state.Bodies)
                              : TurnDisagreeing(run, state.Sampled.Velocity, state.Bodies);
      if (!turned || turned.IsStopped())
      {
        return turned;
      }
    }
    if (isLast && k == slipping) // the poses stay from here on
    {
      const Result slipped = SlipAnew(run, state.Sampled.Velocity, state.Bodies);
      if (!slipped || slipped.IsStopped())
      {
        return slipped;
      }
    }
    const double done = static_cast<double>(k) / std::max(1, rounds - 1);
    const double error =
      std::max(flow * firstError * std::pow(LastError / firstError, done), leastError);
    PartMonitor fitting(run.Caller, begin + k * step, begin + (k + 0.5) * step,
                        "Fitting the wind correction");
    const double left = k + 1 < rounds ? LeftBeforeNext : LeftInTheEnd;
    const bool isFitted = Fit(run, state, error, left, WindStride, correction, fitting);
    if (!isFitted || !AddTo(run, plain, correction, state.Sampled.Velocity, fitting))
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
    output.Rounds.back().Candidate = FitText(correction.Fitted());
    if (correction.Fitted().ChiSquared > likely)
    {
      leastError = error * correction.Fitted().ChiSquared / likely;
    }
    if (!isDrawn && k >= slipping && IsEnough(output.Rounds))
    {
      break;
    }
  }
  return Result::Ok();
}

void AddRest(const AirContext& run, AirState& state, AssimilationOutput& output)
{
  const HalfSeries plain = state.Sampled.Velocity;
  WindCorrection correction = CorrectionOf(run, plain);
  const double error = LastError * FlowAt(run, state) * std::sqrt(run.Options.WindStiffness);
  PartMonitor fitting(run.Caller, 1.0, 1.0, "Fitting what the air lacks still");
  SilentMonitor silent; // what is found by a stop is added to all frames
  (void)Fit(run, state, error, LeftInTheEnd, state.IsSimulated ? 1 : WindStride, correction,
            fitting);
  (void)AddTo(run, plain, correction, state.Sampled.Velocity, silent);
  output.Rounds.push_back(RoundOf(run, state, "rest", &correction));
  output.Rounds.back().Candidate = FitText(correction.Fitted()) + "; momentum residual " +
                                   NumberText(MomentumResidual(run, state, plain), 2) +
                                   " of the acceleration";
  WarnOfFit(correction.Fitted(), output);
}

Result SimulateAgain(const AirContext& run, const HalfSeries& plain, AirState& state,
                     AssimilationOutput& output)
{
  AirScene scene = SetUpScene(run, run.Options);
  scene.Forces = state.Scene.Forces;
  AirSteering steering(state.Sampled.Velocity, plain,
                       SteeringShare * run.Input.Scene.Time.FramesPerSecond);
  HalfSeries air;
  PartMonitor monitor(run.Caller, WindEnd, SimulationEnd,
                      "Simulating the air with the wind correction");
  const Result simulated = SimulateAir(scene, &steering, run.Parallel, monitor, air);
  if (!simulated || simulated.IsStopped())
  {
    return simulated; // the objects drift in the air that was wanted
  }
  if (run.Input.Scene.Loops != 0)
  {
    BendEnds(run.Input.Scene.Time.FramesPerSecond, run.Parallel, air);
  }
  state.Sampled.Wind = OnLattice(steering.TakePushes(), air, run.Parallel);
  state.Sampled.Velocity = std::move(air);
  PartMonitor drifting(run.Caller, SimulationEnd, SeekingEnd,
                       "Letting the objects drift to their marks");
  const Result drifted =
    DriftOn(run, state.Sampled.Velocity, DriftIterations, state.Bodies, drifting);
  if (!drifted || drifted.IsStopped())
  {
    return drifted;
  }
  PartMonitor seeking(run.Caller, SeekingEnd, SeekingEnd, "Seeking anew what the air has lost");
  const Result sought = SeekAgain(run, state.Sampled.Velocity, state.Bodies, seeking);
  if (!sought || sought.IsStopped())
  {
    return sought;
  }
  output.Rounds.push_back(RoundOf(run, state, "simulate"));
  return Result::Ok();
}

} // namespace waft
