// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Run/BodyDrift.h"

#include "Air/Drift/DriftContacts.h"
#include "Air/Drift/FreeLanding.h"
#include "Air/Drift/ResidualControl.h"
#include "Base/FractionDone.h"

#include <algorithm>
#include <atomic>
#include <utility>

namespace waft
{
namespace
{

constexpr int LandingIterations = 24; // of a path that is good but for its end
constexpr double SoughtAgain = 0.2;   // control over the flow, of what is lost where it is
constexpr int ContactPasses = 8;
// Of the sharpest bend of a path, what giving way may make of it: a body between others would
// rather jump out from between them than come a centimetre too near.
constexpr double SharpestGivingWay = 1.5;

double SharpestBend(const std::vector<Vec3>& path)
{
  double sharpest = 0.0;
  for (std::size_t f = 1; f + 1 < path.size(); ++f)
  {
    sharpest = std::max(sharpest, (path[f - 1] - 2.0 * path[f] + path[f + 1]).norm());
  }
  return sharpest;
}

// Gives each body what is too near to it; who has such neighbours.
std::vector<char> FindNeighbours(const AirContext& run, AirBodies& bodies)
{
  std::vector<std::vector<DriftNeighbour>> contacts =
    FindContacts(bodies.Problems, bodies.Paths, run.Input.Scene.Time.FramesPerSecond, run.Parallel);
  std::vector<char> touches;
  for (std::size_t o = 0; o < bodies.Size(); ++o)
  {
    touches.push_back(contacts[o].empty() ? 0 : 1);
    bodies.Problems[o].SetNeighbours(std::move(contacts[o]));
  }
  return touches;
}

// False: stopped, and some have not drifted.
bool DriftSome(const AirContext& run, const HalfSeries& series, int iterations,
               const DriftWeights& weights, const std::vector<char>& which, AirBodies& bodies,
               Monitor& monitor)
{
  PartMonitor part(monitor, 0.0, 1.0);
  std::atomic<std::size_t> done{ 0 };
  const AirSampler air(series);
  run.Parallel(bodies.Size(),
               [&](std::size_t begin, std::size_t end)
               {
                 for (std::size_t o = begin; o < end; ++o)
                 {
                   if (!part.Tick(FractionDone(done++, bodies.Size()), ""))
                   {
                     return;
                   }
                   if (which[o] && !bodies.IsKept(o))
                   {
                     SolveDrift(bodies.Problems[o].In(air), air, weights, iterations,
                                bodies.Paths[o]);
                   }
                 }
               });
  run.Publish(bodies);
  return part.Tick(1.0, "");
}

} // namespace

bool SeekPaths(const AirContext& run, const HalfSeries& series, const std::vector<char>& which,
               AirBodies& bodies, PartMonitor& monitor)
{
  std::atomic<std::size_t> done{ 0 };
  const AirSampler air(series);
  run.Parallel(bodies.Size(),
               [&](std::size_t begin, std::size_t end)
               {
                 for (std::size_t o = begin; o < end; ++o)
                 {
                   const double fraction = FractionDone(done++, bodies.Size());
                   if (!monitor.Tick(fraction, ""))
                   {
                     return;
                   }
                   if (which[o] && !bodies.IsKept(o))
                   {
                     SeekPath(run.Search, air, bodies.Problems[o], bodies.Paths[o], monitor);
                   }
                 }
               });
  run.Publish(bodies);
  return monitor.Tick(1.0, "");
}

bool SeekAgain(const AirContext& run, const HalfSeries& series, AirBodies& bodies,
               PartMonitor& monitor)
{
  const AirSampler air(series);
  std::vector<ResidualControl> residuals;
  ResidualControl all;
  for (std::size_t o = 0; o < bodies.Size(); ++o)
  {
    residuals.push_back(ResidualControlOf(bodies.Problems[o], air, bodies.Paths[o]));
    all.Flow += residuals.back().Flow;
    all.Steps += residuals.back().Steps;
  }
  std::vector<char> which;
  for (const ResidualControl& residual : residuals)
  {
    which.push_back(residual.Rms(residual.Control) > SoughtAgain * all.Rms(all.Flow) ? 1 : 0);
  }
  return SeekPaths(run, series, which, bodies, monitor);
}

bool DriftOn(const AirContext& run, const HalfSeries& air, int iterations, AirBodies& bodies,
             Monitor& monitor)
{
  (void)FindNeighbours(run, bodies);
  return DriftSome(run, air, iterations, run.Search.Weights, std::vector<char>(bodies.Size(), 1),
                   bodies, monitor);
}

void LandFreeBodies(const AirContext& run, const HalfSeries& series, AirBodies& bodies)
{
  const AirSampler air(series);
  const int frames = static_cast<int>(bodies.Paths.front().size());
  run.Parallel(bodies.Size(),
               [&](std::size_t begin, std::size_t end)
               {
                 for (std::size_t o = begin; o < end; ++o)
                 {
                   BodyProblem& body = bodies.Problems[o];
                   const int first = body.FreeFrom();
                   const FreeLanding landing =
                     bodies.IsKept(o) || first >= frames
                       ? FreeLanding()
                       : FindFreeLanding(run.Around, body.Object(), air, bodies.Paths[o], first);
                   if (landing.Frame >= 0)
                   {
                     body.LandFreely(landing.Frame, landing.Place);
                     SolveDrift(body.In(air), air, run.Search.Weights, LandingIterations,
                                bodies.Paths[o]);
                   }
                 }
               });
}

void KeepApart(const AirContext& run, const HalfSeries& air, AirBodies& bodies)
{
  PartMonitor monitor(run.Caller, 1.0, 1.0, "Keeping the objects apart");
  DriftWeights weights = run.Search.Weights;
  std::vector<double> allowed;
  for (const std::vector<Vec3>& path : bodies.Paths)
  {
    allowed.push_back(SharpestGivingWay * SharpestBend(path));
  }
  for (int pass = 0; pass < ContactPasses; ++pass)
  {
    const std::vector<char> touches = FindNeighbours(run, bodies);
    if (std::find(touches.begin(), touches.end(), 1) == touches.end())
    {
      return;
    }
    weights.Barrier *= 2.0;
    const std::vector<std::vector<Vec3>> before = bodies.Paths;
    if (!DriftSome(run, air, FurtherIterations, weights, touches, bodies, monitor))
    {
      bodies.Paths = before;
      return;
    }
    for (std::size_t o = 0; o < before.size(); ++o)
    {
      if (SharpestBend(bodies.Paths[o]) > allowed[o])
      {
        bodies.Paths[o] = before[o];
      }
    }
  }
}

std::vector<char> FinishPaths(const AirContext& run, const HalfSeries& series, AirBodies& bodies)
{
  const AirSampler air(series);
  std::vector<char> clear(bodies.Size(), 1);
  run.Parallel(bodies.Size(),
               [&](std::size_t begin, std::size_t end)
               {
                 for (std::size_t o = begin; o < end; ++o)
                 {
                   // What an edit left alone is exact already.
                   const bool isClear =
                     bodies.IsKept(o) ||
                     FinishPath(run.Search.Weights, air, bodies.Problems[o], bodies.Paths[o]);
                   clear[o] = isClear ? 1 : 0;
                 }
               });
  return clear;
}

} // namespace waft
