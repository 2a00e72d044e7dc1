// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Run/BodyDrift.h"

#include "Air/Drift/DriftTogether.h"
#include "Air/Run/AirRounds.h"
#include "Air/Run/EachBody.h"
#include "Base/ShapeMeasures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

namespace waft
{
namespace
{

constexpr double SoughtAgain = 0.2; // control over the flow, of what is lost where it is
constexpr int ContactPasses = 3;
constexpr double FirmContact = 4.0; // over the usual weight, of the last pass and after it
// Over the usual weight in the end, of changes of the control: what contact and a mark ask for at
// once is spread over more frames.
constexpr double EvenControl = 2.0;
constexpr int ContactIterations = 24;
constexpr double ContactMargin = 0.5; // of what two need, to which their contacts are looked for
constexpr double Touching = 1e-3;     // m, by which a pair may be too near
constexpr int HarderPushes = 3;

double RateOf(const AirContext& run)
{
  return run.Input.Scene.Time.FramesPerSecond;
}

// Adds who is nearer to another than they keep.
void AddTouching(const std::vector<DriftContact>& contacts,
                 const std::vector<std::vector<Vec3>>& paths, std::vector<char>& which)
{
  const std::vector<std::vector<double>> residue = ContactResidue(contacts, paths);
  for (std::size_t o = 0; o < residue.size(); ++o)
  {
    const double most = *std::max_element(residue[o].begin(), residue[o].end());
    which[o] = most > Touching ? 1 : which[o];
  }
}

/// Of bodies that have turned.
PosedExtents ExtentsOf(const AirContext& run, const AirBodies& bodies)
{
  PosedExtents extents;
  if (bodies.Poses.size() != bodies.Size())
  {
    return extents;
  }
  std::vector<Vec3> ofShapes;
  for (const Shape& shape : run.Input.Shapes)
  {
    ofShapes.push_back(EllipsoidAbout(shape.Mesh));
  }
  for (const BodyProblem& body : bodies.Problems)
  {
    extents.HalfAxes.push_back(ofShapes[static_cast<std::size_t>(body.Object().ShapeId)]);
  }
  extents.Poses = &bodies.Poses;
  return extents;
}

// Those that may move, among the others.
std::vector<TogetherBody> Together(const AirSampler& air, const DriftWeights& weights,
                                   const std::vector<char>& which, const AirBodies& bodies)
{
  std::vector<TogetherBody> together(bodies.Size());
  for (std::size_t o = 0; o < bodies.Size(); ++o)
  {
    together[o].Weights = weights;
    if (which[o] && !bodies.IsKept(o))
    {
      together[o].Problem = std::make_unique<DriftProblem>(bodies.Problems[o].In(air));
    }
  }
  return together;
}

} // namespace

Result SeekPaths(const AirContext& run, const HalfSeries& series, const std::vector<char>& which,
                 AirBodies& bodies, PartMonitor& monitor)
{
  const Result sought = EachBody(run, series, BodyTask::Seek, 0, which, bodies, monitor);
  run.Publish(bodies);
  return !sought || monitor.Tick(1.0, "") ? sought : Result::Stopped();
}

Result SeekAgain(const AirContext& run, const HalfSeries& series, AirBodies& bodies,
                 PartMonitor& monitor)
{
  const std::vector<ResidualControl> residuals = ResidualControlsOf(run, bodies, series);
  ResidualControl all;
  for (const ResidualControl& residual : residuals)
  {
    all.Flow += residual.Flow;
    all.Steps += residual.Steps;
  }
  std::vector<char> which;
  for (const ResidualControl& residual : residuals)
  {
    which.push_back(residual.Rms(residual.Control) > SoughtAgain * all.Rms(all.Flow) ? 1 : 0);
  }
  return SeekPaths(run, series, which, bodies, monitor);
}

Result DriftOn(const AirContext& run, const HalfSeries& series, int iterations, AirBodies& bodies,
               Monitor& monitor)
{
  PartMonitor part(monitor, 0.0, 1.0);
  const AirSampler air(series);
  const KeptDistances kept = KeptBy(bodies.Problems, RateOf(run));
  const PosedExtents extents = ExtentsOf(run, bodies);
  const auto contacts = [&]
  { return FindContacts(kept, bodies.Paths, ContactMargin, run.Parallel, extents); };
  std::vector<char> touches(bodies.Size(), 0);
  AddTouching(contacts(), bodies.Paths, touches);
  std::vector<char> alone(bodies.Size());
  std::transform(touches.begin(), touches.end(), alone.begin(), std::logical_not<char>());
  const Result result = EachBody(run, series, BodyTask::Drift, iterations, alone, bodies, part);
  bool goesOn = part.Tick(1.0, "") && !result.IsStopped();
  if (result && goesOn)
  {
    const std::vector<DriftContact> near = contacts();
    AddTouching(near, bodies.Paths, touches);
    const DriftWeights& weights = run.Search.Weights;
    goesOn = SolveTogether(Together(air, weights, touches, bodies), near, air, weights.Contact,
                           iterations, run.Parallel, part, bodies.Paths);
  }
  run.Publish(bodies);
  return !result || goesOn ? result : Result::Stopped();
}

Result LandFreeBodies(const AirContext& run, const HalfSeries& series, AirBodies& bodies)
{
  const int frames = static_cast<int>(bodies.Paths.front().size());
  std::vector<char> which;
  for (const BodyProblem& body : bodies.Problems)
  {
    which.push_back(body.FreeFrom() < frames ? 1 : 0);
  }
  SilentMonitor silent; // it is short, and a motion without it would not be whole
  PartMonitor part(silent, 0.0, 1.0);
  return EachBody(run, series, BodyTask::Land, 0, which, bodies, part);
}

void KeepApart(const AirContext& run, const HalfSeries& series, AirBodies& bodies)
{
  PartMonitor monitor(run.Caller, 1.0, 1.0, "Keeping the objects apart");
  const AirSampler air(series);
  const KeptDistances kept = KeptBy(bodies.Problems, RateOf(run));
  const PosedExtents extents = ExtentsOf(run, bodies);
  DriftWeights weights = run.Search.Weights;
  weights.Smoothness *= EvenControl;
  std::vector<char> touches(bodies.Size(), 0);
  for (int pass = 0; pass < ContactPasses; ++pass)
  {
    const std::vector<DriftContact> contacts =
      FindContacts(kept, bodies.Paths, ContactMargin, run.Parallel, extents);
    std::vector<char> now(bodies.Size(), 0);
    AddTouching(contacts, bodies.Paths, now);
    if (std::find(now.begin(), now.end(), 1) == now.end())
    {
      return;
    }
    std::transform(now.begin(), now.end(), touches.begin(), touches.begin(),
                   std::logical_or<char>());
    if (!SolveTogether(Together(air, weights, touches, bodies), contacts, air, weights.Contact,
                       ContactIterations, run.Parallel, monitor, bodies.Paths))
    {
      return;
    }
    run.Publish(bodies);
    weights.Contact *= std::pow(FirmContact, 1.0 / (ContactPasses - 1));
  }
}

std::vector<char> FinishPaths(const AirContext& run, const HalfSeries& series, AirBodies& bodies)
{
  const AirSampler air(series);
  const KeptDistances kept = KeptBy(bodies.Problems, RateOf(run));
  const PosedExtents extents = ExtentsOf(run, bodies);
  PartMonitor monitor(run.Caller, 1.0, 1.0, "Bringing the objects to their marks exactly");
  DriftWeights weights = run.Search.Weights;
  weights.Contact *= FirmContact;
  weights.Smoothness *= EvenControl;
  std::vector<double> barriers(bodies.Size(), weights.Barrier);
  const auto drift = [&](const std::vector<TogetherBody>& together)
  {
    (void)SolveTogether(together,
                        FindContacts(kept, bodies.Paths, ContactMargin, run.Parallel, extents), air,
                        weights.Contact, DriftIterations, run.Parallel, monitor, bodies.Paths);
  };
  // What keeps too near to something is pushed harder first; only what that does not help is moved
  // out of the way without a look at the air.
  std::vector<char> clear(bodies.Size(), 1);
  for (int k = 0; k < HarderPushes; ++k)
  {
    std::vector<char> blocked(bodies.Size(), 0);
    run.Parallel(bodies.Size(),
                 [&](std::size_t begin, std::size_t end)
                 {
                   for (std::size_t o = begin; o < end; ++o)
                   {
                     blocked[o] =
                       !bodies.IsKept(o) && !bodies.Problems[o].IsClear(bodies.Paths[o]) ? 1 : 0;
                   }
                 });
    if (std::find(blocked.begin(), blocked.end(), 1) == blocked.end())
    {
      break;
    }
    std::vector<TogetherBody> together = Together(air, weights, blocked, bodies);
    for (std::size_t o = 0; o < bodies.Size(); ++o)
    {
      barriers[o] *= blocked[o] ? 10.0 : 1.0;
      together[o].Weights.Barrier = barriers[o];
    }
    drift(together);
  }
  std::vector<TogetherBody> held = Together(air, weights, clear, bodies);
  for (std::size_t o = 0; o < bodies.Size(); ++o)
  {
    held[o].Weights.Barrier = barriers[o];
    if (held[o].Problem && !bodies.Problems[o].HoldToBalls(bodies.Paths[o], *held[o].Problem))
    {
      held[o].Problem.reset();
    }
  }
  drift(held);
  run.Parallel(bodies.Size(),
               [&](std::size_t begin, std::size_t end)
               {
                 for (std::size_t o = begin; o < end; ++o)
                 {
                   // What an edit left alone is exact already.
                   const bool isClear =
                     bodies.IsKept(o) || bodies.Problems[o].MakeExact(bodies.Paths[o]);
                   clear[o] = isClear ? 1 : 0;
                 }
               });
  return clear;
}

} // namespace waft
