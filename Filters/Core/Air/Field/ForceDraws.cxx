// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Field/ForceDraws.h"

#include "Base/FractionDone.h"
#include "Base/Random.h"
#include "Grid/SmokeEnsemble.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

namespace waft
{
namespace
{

constexpr int ClosedDraws = 3;
constexpr int OpenDraws = 2;                  // the airs as which the drawn one ought to be
constexpr std::uint64_t AirStream = 0x616972; // of random numbers, apart from all others of a seed

// A closed box keeps what it is given: about as strong its forces make bodies move in it as the
// full ones make them move in an open box (64^3, 4 m, 8 seeds: with 0.66 the variances of velocity
// are 1.2 times and of acceleration 1.4 times an open box's).
constexpr double ClosedScale = 0.56;
// What bodies show in open boxes of the full grid over coarse ones, and what a closed box gains
// from the coarse grid to the full one (the same boxes; coarse ones by their steps).
constexpr double VelocityGain = 1.15 / 1.17;
constexpr double AccelerationGain = 2.44 / 3.30;
constexpr double MostScaling = 2.5; // of the forces, up and down
constexpr double ScalingCost = 0.25;
constexpr double StructureCost = 4.0;
constexpr double AccelerationWeight = 0.25; // beside that of velocity

// Of how a closed draw is to what is wanted.
struct Fitted
{
  double Misfit = 1e300;
  double Scale = 1.0; // of its forces, that suits it best
};

// Variances of velocity go as the forces, those of acceleration as their square.
Fitted Fit(const AirStatistics& found, const AirStatistics& wanted)
{
  Fitted fitted;
  if (!(found.AccelerationVariance > 0.0 && wanted.AccelerationVariance > 0.0))
  {
    return fitted; // nothing flew long enough to tell
  }
  const double v = std::log(found.VelocityVariance / wanted.VelocityVariance);
  const double a = std::log(found.AccelerationVariance / wanted.AccelerationVariance);
  const double most = std::log(MostScaling);
  const double scale =
    std::clamp(-(v + 2.0 * AccelerationWeight * a) / (1.0 + 4.0 * AccelerationWeight), -most, most);
  const double structure = StructureDistance(found, wanted);
  const double misfit = std::pow(v + scale, 2) + AccelerationWeight * std::pow(a + 2.0 * scale, 2) +
                        ScalingCost * scale * scale + StructureCost * structure * structure;
  fitted.Misfit = std::isfinite(misfit) ? misfit : 1e300;
  fitted.Scale = std::exp(scale);
  return fitted;
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

// In the time of a clock that begins with the air at rest.
SmokeForces RandomForces(const Box& volume, std::uint64_t seed, double scale, double from,
                         double to)
{
  SmokeForces forces = StirringForces(volume, seed, from, to);
  for (Vortex& vortex : forces.Vortices)
  {
    vortex.Strength *= scale;
  }
  for (AnalyticWind& wind : forces.Winds)
  {
    wind.Strength *= scale;
  }
  return forces;
}

// Those that are felt from the last turnover of the warm-up on, in the time of the frames.
SmokeForces ForcesOf(const MotionProblem& problem, const Timeline& time, std::uint64_t seed,
                     double scale, const WarmUp& warmUp)
{
  const double first = warmUp.Frames / time.FramesPerSecond;
  SmokeForces forces =
    RandomForces(problem.Scene.Bounds, seed, scale, first - warmUp.Turnover / time.FramesPerSecond,
                 first + time.Time(time.NumberOfFrames - 1));
  int id = 0; // after the problem's own
  for (const Vortex& vortex : problem.Vortices)
  {
    id = std::max(id, vortex.VortexId + 1);
  }
  for (Vortex& vortex : forces.Vortices)
  {
    vortex.CenterTime -= first;
    vortex.VortexId += id;
  }
  for (AnalyticWind& wind : forces.Winds)
  {
    wind.CenterTime -= first;
  }
  forces.Vortices.insert(forces.Vortices.end(), problem.Vortices.begin(), problem.Vortices.end());
  return forces;
}

} // namespace

Result DrawForces(const MotionProblem& problem, std::uint64_t seed, const AirScene& coarse,
                  const BodyLaw& law, const ParallelFor& parallel, PartMonitor& monitor,
                  ForceDraw& draw, AirStatistics& wanted)
{
  Random random(seed, AirStream);
  std::vector<std::uint64_t> seeds(ClosedDraws + OpenDraws);
  for (std::uint64_t& one : seeds)
  {
    one = random.Bits();
  }
  FieldSeries wind; // until the first frame as in it
  if (!problem.Wind.IsEmpty())
  {
    static_cast<SeriesLattice&>(wind) = problem.Wind;
    wind.Times.resize(1);
    wind.Values = { problem.Wind.Values.front() };
  }
  std::vector<WarmUp> warmUps(seeds.size());
  std::vector<AirStatistics> found(seeds.size());
  std::vector<Result> results(seeds.size(), Result::Ok());
  std::atomic<std::size_t> done{ 0 };
  const auto warmUp = [&](std::size_t k, double scale)
  {
    const std::size_t before = done;
    PartMonitor step(monitor, FractionDone(before, seeds.size() + 1),
                     FractionDone(before + 1, seeds.size() + 1));
    AirScene scene = coarse;
    scene.Forces.Wind = wind;
    if (k >= ClosedDraws)
    {
      scene.Solids = {};
      scene.Smoke.Boundary.fill(BoundaryKind::Open);
    }
    const auto forces = [&](double until)
    { return RandomForces(problem.Scene.Bounds, seeds[k], scale, 0.0, until); };
    results[k] = FindWarmUp(std::move(scene), forces, SerialFor(), step, warmUps[k]);
    if (results[k] && !results[k].IsStopped())
    {
      found[k] =
        DriftStatistics(warmUps[k].Recent, problem.Scene.Time.FramesPerSecond / warmUps[k].Stride,
                        law, SerialFor());
    }
    ++done;
  };
  parallel(seeds.size(),
           [&](std::size_t first, std::size_t last)
           {
             for (std::size_t k = first; k < last; ++k)
             {
               warmUp(k, k < ClosedDraws ? ClosedScale : 1.0);
             }
           });
  for (const Result& result : results)
  {
    if (!result || result.IsStopped())
    {
      return result;
    }
  }
  wanted = MeanOf({ found.begin() + ClosedDraws, found.end() });
  wanted.VelocityVariance *= VelocityGain;
  wanted.AccelerationVariance *= AccelerationGain;
  wanted.OwnVelocityVariance *= VelocityGain;
  wanted.OwnAccelerationVariance *= AccelerationGain;
  std::size_t best = 0;
  Fitted least;
  for (std::size_t k = 0; k < ClosedDraws; ++k)
  {
    const Fitted fitted = Fit(found[k], wanted);
    if (k == 0 || fitted.Misfit < least.Misfit)
    {
      least = fitted;
      best = k;
    }
  }
  const double scale = ClosedScale * least.Scale;
  warmUp(best, scale);
  draw.Forces = ForcesOf(problem, coarse.Time, seeds[best], scale, warmUps[best]);
  draw.Begin = std::move(warmUps[best]);
  return results[best];
}

} // namespace waft
