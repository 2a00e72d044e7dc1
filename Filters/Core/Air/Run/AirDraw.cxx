// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Run/AirDraw.h"

#include "Air/Field/AirSymmetry.h"
#include "Air/Field/ForceDraws.h"
#include "Air/Run/AirLoop.h"
#include "Air/Run/DrawnAir.h"
#include "Air/Run/RunProgress.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace waft
{
namespace
{

constexpr int TrialIterations = 12; // of a candidate
constexpr std::size_t TrialObjects = 16;
constexpr std::size_t FewestForStatistics = 8; // bodies
constexpr double PathStructureCost = 2.0;
constexpr double PathStrengthCost = 0.2;
constexpr double Tiny = 1e-12; // [m^2/s^2]
constexpr int CoarseVoxels = 16;
constexpr double DrawsEnd = 0.03;
constexpr const char* Drawing = "Drawing the forces of the air";

// Of a variance that is not as it is wanted; 0 where either is not known.
double StrengthCost(double found, double wanted)
{
  const double misfit = found > 0.0 && wanted > 0.0 ? std::log(found / wanted) : 0.0;
  return PathStrengthCost * misfit * misfit;
}

// That of the middle settling speed.
BodyLaw TypicalLaw(const AirBodies& bodies)
{
  std::vector<BodyLaw> laws;
  for (const BodyProblem& body : bodies.Problems)
  {
    laws.push_back(LawOf(body.Object()));
  }
  const auto middle = laws.begin() + static_cast<std::ptrdiff_t>(laws.size() / 2);
  std::nth_element(laws.begin(), middle, laws.end(),
                   [](const BodyLaw& a, const BodyLaw& b)
                   { return a.SettlingSpeed() < b.SettlingSpeed(); });
  return *middle;
}

AirScene CoarseSceneOf(const AirContext& run, const AirScene& scene)
{
  AirScene coarse = scene;
  const int most = *std::max_element(scene.Smoke.Resolution.begin(), scene.Smoke.Resolution.end());
  coarse.LatticeDimensions.fill(CoarseVoxels);
  for (int& voxels : coarse.Smoke.Resolution)
  {
    voxels = std::max(4, voxels * CoarseVoxels / most);
  }
  if (scene.Solids)
  {
    coarse.Solids = run.Solids(coarse.Smoke);
  }
  return coarse;
}

// Whether nothing forbids quarter turns and mirror images.
bool IsSymmetric(const AirContext& run, const AirScene& scene)
{
  return !scene.Solids && run.Input.Wind.IsEmpty() && run.Input.Vortices.empty();
}

// What the objects' flight in an air costs; the row gets their control.
double Try(const AirContext& run, const AirBodies& bodies, const AirStatistics& wanted,
           const HalfSeries& series, AssimilationRound& row)
{
  const AirSampler air(series);
  const std::size_t stride = (bodies.Problems.size() + TrialObjects - 1) / TrialObjects;
  const std::size_t count = (bodies.Problems.size() + stride - 1) / stride;
  std::vector<double> squares(count, 0.0);
  FreeFlights flights;
  flights.Paths.resize(count);
  flights.IsFree.resize(count);
  const auto unfree = static_cast<std::size_t>(0.5 * run.Input.Scene.Time.FramesPerSecond);
  run.Parallel(count,
               [&](std::size_t begin, std::size_t end)
               {
                 for (std::size_t k = begin; k < end; ++k)
                 {
                   const BodyProblem& body = bodies.Problems[k * stride];
                   const DriftProblem problem = body.In(air);
                   std::vector<Vec3>& path = flights.Paths[k];
                   path = body.Starts(air, 0).back();
                   (void)SolveDrift(problem, air, run.Search.Weights, TrialIterations, path);
                   const double control = ControlInFlight(problem, air, path);
                   squares[k] = control * control;
                   flights.IsFree[k].assign(path.size(), 0);
                   for (std::size_t f = unfree; f + unfree < path.size(); ++f)
                   {
                     flights.IsFree[k][f] = IsFreeStep(problem, path, static_cast<int>(f)) ? 1 : 0;
                   }
                 }
               });
  double sum = 0.0;
  for (const double square : squares)
  {
    sum += square / static_cast<double>(count);
  }
  const AirStatistics found =
    StatisticsOf(flights, run.Input.Scene.Time.FramesPerSecond, run.Input.Scene.Bounds.Width());
  row.Control = std::sqrt(sum);

  const double cost = sum / std::max(wanted.VelocityVariance, Tiny);
  if (count < FewestForStatistics)
  {
    return cost + StrengthCost(found.OwnVelocityVariance, wanted.OwnVelocityVariance) +
           StrengthCost(found.OwnAccelerationVariance, wanted.OwnAccelerationVariance);
  }
  const double structure = StructureDistance(found, wanted);
  return cost + PathStructureCost * structure * structure +
         StrengthCost(found.VelocityVariance, wanted.VelocityVariance) +
         StrengthCost(found.AccelerationVariance, wanted.AccelerationVariance);
}

// What does not hang on the marks.
Result Draw(const AirContext& run, const AirScene& scene, const BodyLaw& law, DrawnAir& drawn)
{
  const int period = scene.Time.NumberOfFrames - 1;
  AirScene stirred = scene;
  stirred.Time.NumberOfFrames += FramesBeyond(run.Input.Scene, period);
  ForceDraw draw;
  PartMonitor drawing(run.Caller, 0.0, DrawsEnd, Drawing);
  Result result =
    DrawForces(run.Input, SeedOfAir(run.Input, run.Options), CoarseSceneOf(run, stirred), law,
               run.Parallel, drawing, draw, drawn.Wanted);
  if (!result || result.IsStopped())
  {
    return result;
  }
  stirred.Forces = draw.Forces;
  stirred.Forces.Wind = run.Input.Wind;
  SmokeState begun;
  WAFT_RETURN_IF_FAILED(BeginWarmUp(draw.Begin, stirred, begun));
  PartMonitor monitor(run.Caller, DrawsEnd, DrawEnd, Drawing);
  result = SimulateAir(stirred, nullptr, run.Parallel, monitor, drawn.Air, &begun);
  if (run.Input.Scene.Loops != 0 && result && !result.IsStopped())
  {
    JoinEnds(period, run.Parallel, drawn.Air);
  }
  drawn.Forces = std::move(draw.Forces);
  drawn.WarmUp = draw.Begin.Text(run.Input.Scene.Time.FramesPerSecond);
  return result;
}

} // namespace

Result DrawAir(const AirContext& run, AirState& state, AssimilationOutput& output)
{
  const BodyLaw law = TypicalLaw(state.Bodies);
  const std::uint64_t key = KeyOfDrawnAir(run, state.Scene, law);
  DrawnAir drawn;
  if (!FindDrawnAir(run, key, drawn))
  {
    const Result result = Draw(run, state.Scene, law, drawn);
    if (!result || result.IsStopped())
    {
      return result;
    }
    KeepDrawnAir(run, key, drawn);
  }
  HalfSeries& air = state.Sampled.Velocity;
  air = std::move(drawn.Air);
  std::vector<AirSymmetry> symmetries = AirSymmetries(run.Input.Scene.Bounds);
  const auto candidates = static_cast<std::size_t>(run.Options.Candidates);
  symmetries.resize(IsSymmetric(run, state.Scene) ? std::min(symmetries.size(), candidates) : 1);
  double least = 1e300;
  AirSymmetry best;
  HalfSeries image, bestImage;
  for (const AirSymmetry& symmetry : symmetries)
  {
    AssimilationRound row;
    row.Stage = "draw";
    row.Candidate = symmetry.Text();
    const bool isItself = &symmetry == symmetries.data();
    if (!isItself)
    {
      SetImage(symmetry, air, image);
    }
    const double judged = Try(run, state.Bodies, drawn.Wanted, isItself ? air : image, row);
    row.Seconds = run.Seconds();
    output.Rounds.push_back(row);
    if (judged < least)
    {
      least = judged;
      best = symmetry;
      std::swap(image, bestImage);
    }
  }
  state.Candidate = best.Text() + "; warmed up for " + drawn.WarmUp;
  state.Scene.Forces = Image(best, run.Input.Scene.Bounds, drawn.Forces);
  state.Scene.Forces.Wind = run.Input.Wind;
  if (best.Text() != AirSymmetry().Text())
  {
    air = std::move(bestImage);
  }
  return Result::Ok();
}

} // namespace waft
