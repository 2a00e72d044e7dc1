// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Run/BodyDrift.h"

#include "Air/Drift/DriftTogether.h"
#include "Air/Run/AirRounds.h"
#include "Air/Run/EachBody.h"
#include "Air/Run/TouchingBodies.h"
#include "Base/ShapeMeasures.h"

#include <algorithm>
#include <cmath>
#include <functional>

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
  const KeptDistances kept = KeptBy(bodies.Problems, RateOf(run));
  const PosedExtents extents = ExtentsOf(run, bodies);
  const auto contacts = [&](double margin)
  { return FindContacts(kept, bodies.Paths, margin, run.Parallel, extents); };
  std::vector<char> touches(bodies.Size(), 0);
  AddTouching(contacts(0.0), bodies.Paths, touches);
  std::vector<char> alone(bodies.Size());
  std::transform(touches.begin(), touches.end(), alone.begin(), std::logical_not<char>());
  const Result result = EachBody(run, series, BodyTask::Drift, iterations, alone, bodies, part);
  bool goesOn = part.Tick(1.0, "") && !result.IsStopped();
  if (result && goesOn)
  {
    const std::vector<DriftContact> near = contacts(ContactMargin);
    AddTouching(near, bodies.Paths, touches);
    TouchingTask task;
    task.Which = touches;
    task.Weights = run.Search.Weights;
    task.Iterations = iterations;
    goesOn = SolveTouching(run, series, task, near, bodies, part);
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
    const Constraint* leaving = body.LeavingRow();
    const bool goesOut = leaving != nullptr && leaving->Goes.IsUnderway();
    which.push_back(body.FreeFrom() < frames && !goesOut ? 1 : 0);
  }
  SilentMonitor silent; // it is short, and a motion without it would not be whole
  PartMonitor part(silent, 0.0, 1.0);
  return EachBody(run, series, BodyTask::Land, 0, which, bodies, part);
}

void KeepApart(const AirContext& run, const HalfSeries& series, AirBodies& bodies)
{
  PartMonitor monitor(run.Caller, 1.0, 1.0, "Keeping the objects apart");
  const KeptDistances kept = KeptBy(bodies.Problems, RateOf(run));
  const PosedExtents extents = ExtentsOf(run, bodies);
  TouchingTask task;
  task.Weights = run.Search.Weights;
  task.Weights.Smoothness *= EvenControl;
  task.Iterations = ContactIterations;
  task.Which.assign(bodies.Size(), 0);
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
    std::transform(now.begin(), now.end(), task.Which.begin(), task.Which.begin(),
                   std::logical_or<char>());
    if (!SolveTouching(run, series, task, contacts, bodies, monitor))
    {
      return;
    }
    run.Publish(bodies);
    task.Weights.Contact *= std::pow(FirmContact, 1.0 / (ContactPasses - 1));
  }
}

std::vector<char> FinishPaths(const AirContext& run, const HalfSeries& series, AirBodies& bodies)
{
  const KeptDistances kept = KeptBy(bodies.Problems, RateOf(run));
  const PosedExtents extents = ExtentsOf(run, bodies);
  PartMonitor monitor(run.Caller, 1.0, 1.0, "Bringing the objects to their marks exactly");
  TouchingTask task;
  task.Weights = run.Search.Weights;
  task.Weights.Contact *= FirmContact;
  task.Weights.Smoothness *= EvenControl;
  task.Barriers.assign(bodies.Size(), task.Weights.Barrier);
  task.Iterations = DriftIterations;
  const auto drift = [&]
  {
    (void)SolveTouching(run, series, task,
                        FindContacts(kept, bodies.Paths, ContactMargin, run.Parallel, extents),
                        bodies, monitor);
  };
  // What keeps too near to something is pushed harder first; only what that does not help is moved
  // out of the way without a look at the air.
  for (int k = 0; k < HarderPushes; ++k)
  {
    task.Which.assign(bodies.Size(), 0);
    run.Parallel(bodies.Size(),
                 [&](std::size_t begin, std::size_t end)
                 {
                   for (std::size_t o = begin; o < end; ++o)
                   {
                     task.Which[o] =
                       !bodies.IsKept(o) && !bodies.Problems[o].IsClear(bodies.Paths[o]) ? 1 : 0;
                   }
                 });
    if (std::find(task.Which.begin(), task.Which.end(), 1) == task.Which.end())
    {
      break;
    }
    for (std::size_t o = 0; o < bodies.Size(); ++o)
    {
      task.Barriers[o] *= task.Which[o] ? 10.0 : 1.0;
    }
    drift();
  }
  std::vector<char> clear(bodies.Size(), 1);
  task.Which = clear;
  task.HoldsToBalls = true;
  drift();
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
