// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Field/ForceDraws.h"

#include "Base/FractionDone.h"
#include "Base/Random.h"
#include "Grid/SmokeEnsemble.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace waft
{
namespace
{

constexpr int ClosedDraws = 8;
constexpr int OpenDraws = 5;                  // the airs as which the drawn one ought to be
constexpr std::uint64_t AirStream = 0x616972; // of random numbers, apart from all others of a seed

// What drifters of the full grid show in the databases' open boxes over what coarse open boxes
// show, and what a closed box gains from the coarse grid to the full one (12 seeds in 4 m, 16^3
// against 64^3: 1.24 and 1.03, 1.77 and 1.25).
constexpr double VelocityGain = 1.24 / 1.03;
constexpr double AccelerationGain = 1.77 / 1.25;
constexpr double MostScaling = 2.0; // of the forces, up and down
constexpr double ScalingCost = 0.25;
constexpr double StructureCost = 4.0;

// How far a closed draw is from what is wanted when its forces are scaled as suits it best:
// variances of velocity go as the scale, those of acceleration as its square.
void FitDraw(const AirStatistics& wanted, ForceDraw& draw)
{
  if (!(draw.Found.AccelerationVariance > 0.0 && wanted.AccelerationVariance > 0.0))
  {
    return; // nothing flew long enough to tell
  }
  const double v = std::log(draw.Found.VelocityVariance / wanted.VelocityVariance);
  const double a = std::log(draw.Found.AccelerationVariance / wanted.AccelerationVariance);
  const double most = std::log(MostScaling);
  const double scale = std::clamp(-(v + 2.0 * a) / 5.0, -most, most);
  const double structure = StructureDistance(draw.Found, wanted);
  const double misfit = std::pow(v + scale, 2) + std::pow(a + 2.0 * scale, 2) +
                        ScalingCost * scale * scale + StructureCost * structure * structure;
  draw.Scale = std::exp(scale);
  draw.Misfit = std::isfinite(misfit) ? misfit : 1e300;
}

AirStatistics MeanOf(const std::vector<AirStatistics>& airs)
{
  AirStatistics mean;
  const auto count = static_cast<double>(airs.size());
  for (const AirStatistics& air : airs)
  {
    mean.VelocityVariance += air.VelocityVariance / count;
    mean.AccelerationVariance += air.AccelerationVariance / count;
    mean.OwnVelocityVariance += air.OwnVelocityVariance / count;
    mean.OwnAccelerationVariance += air.OwnAccelerationVariance / count;
    for (std::size_t bin = 0; bin < mean.Structure.size(); ++bin)
    {
      mean.Structure[bin] += air.Structure[bin] / count;
    }
  }
  return mean;
}

// scale: of the random forces, not of the problem's own.
Result ForcesOf(const MotionProblem& problem, double warmUpSeconds, std::uint64_t seed,
                double scale, SmokeForces& forces)
{
  EnsembleOptions options;
  options.Seed = seed;
  options.Bounds = problem.Scene.Bounds;
  options.NumberOfFrames = problem.Scene.Time.NumberOfFrames;
  options.FramesPerSecond = problem.Scene.Time.FramesPerSecond;
  options.WarmUpSeconds = warmUpSeconds;
  options.NumberOfObstacles = 0;
  options.NumberOfEmitters = 0;
  Ensemble ensemble;
  WAFT_RETURN_IF_FAILED(MakeEnsemble(options, ensemble));
  forces = ensemble.Forces;
  int id = 0; // after the problem's own
  for (const Vortex& vortex : problem.Vortices)
  {
    id = std::max(id, vortex.VortexId + 1);
  }
  for (Vortex& vortex : forces.Vortices)
  {
    vortex.Strength *= scale;
    vortex.VortexId = id++;
  }
  for (AnalyticWind& wind : forces.Winds)
  {
    wind.Strength *= scale;
  }
  forces.Vortices.insert(forces.Vortices.end(), problem.Vortices.begin(), problem.Vortices.end());
  forces.Wind = problem.Wind;
  return Result::Ok();
}

} // namespace

Result SimulateSideBySide(std::size_t count, const std::function<AirScene(std::size_t)>& sceneOf,
                          const std::function<void(std::size_t, HalfSeries&)>& use,
                          const ParallelFor& parallel, PartMonitor& monitor)
{
  std::vector<Result> results(count, Result::Ok());
  std::atomic<std::size_t> done{ 0 };
  parallel(count,
           [&](std::size_t first, std::size_t last)
           {
             for (std::size_t k = first; k < last; ++k)
             {
               const std::size_t before = done;
               PartMonitor step(monitor, FractionDone(before, count),
                                FractionDone(before + 1, count));
               HalfSeries air;
               results[k] = SimulateAir(sceneOf(k), nullptr, SerialFor(), step, air);
               if (results[k] && !results[k].IsStopped())
               {
                 use(k, air);
               }
               ++done;
             }
           });
  for (const Result& result : results)
  {
    if (!result || result.IsStopped())
    {
      return result;
    }
  }
  return Result::Ok();
}

Result DrawForces(const MotionProblem& problem, std::uint64_t seed, const AirScene& coarse,
                  const BodyLaw& law, const ParallelFor& parallel, PartMonitor& monitor,
                  std::vector<ForceDraw>& draws, AirStatistics& wanted)
{
  Random random(seed, AirStream);
  const double warmUp = coarse.Smoke.WarmUpSeconds;
  draws.resize(ClosedDraws);
  for (ForceDraw& draw : draws)
  {
    draw.Seed = random.Bits();
    WAFT_RETURN_IF_FAILED(ForcesOf(problem, warmUp, draw.Seed, 1.0, draw.Forces));
  }
  const double rate = problem.Scene.Time.FramesPerSecond;
  std::vector<AirStatistics> open(OpenDraws);
  const auto sceneOf = [&](std::size_t k)
  {
    AirScene scene = coarse;
    scene.Forces = draws[k % ClosedDraws].Forces;
    if (k >= ClosedDraws)
    {
      scene.Solids = {};
      scene.Smoke.Boundary.fill(BoundaryKind::Open);
    }
    return scene;
  };
  const auto use = [&](std::size_t k, const HalfSeries& air)
  {
    (k < ClosedDraws ? draws[k].Found : open[k - ClosedDraws]) =
      DriftStatistics(air, rate, law, SerialFor());
  };
  const Result simulated =
    SimulateSideBySide(ClosedDraws + OpenDraws, sceneOf, use, parallel, monitor);
  if (!simulated || simulated.IsStopped())
  {
    return simulated;
  }
  wanted = MeanOf(open);
  wanted.VelocityVariance *= VelocityGain;
  wanted.AccelerationVariance *= AccelerationGain;
  wanted.OwnVelocityVariance *= VelocityGain;
  wanted.OwnAccelerationVariance *= AccelerationGain;
  for (ForceDraw& draw : draws)
  {
    FitDraw(wanted, draw);
    WAFT_RETURN_IF_FAILED(ForcesOf(problem, warmUp, draw.Seed, draw.Scale, draw.Forces));
  }
  std::stable_sort(draws.begin(), draws.end(),
                   [](const ForceDraw& a, const ForceDraw& b) { return a.Misfit < b.Misfit; });
  return Result::Ok();
}

} // namespace waft
