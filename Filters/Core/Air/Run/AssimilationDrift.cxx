// SPDX-License-Identifier: BSD-3-Clause
// The objects in the air as it is, and the wind that they need in common.
#include "Air/Run/AssimilationRun.h"

#include "Air/Drift/DriftContacts.h"
#include "Air/Drift/FreeLanding.h"
#include "Base/FractionDone.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>

namespace waft
{
namespace
{

constexpr int FurtherIterations = 12;     // where the air has changed little, and of every start
constexpr std::size_t FollowedStarts = 3; // the cheapest by then
constexpr double SoughtAgain = 0.2;       // control over the flow, of what is lost where it is
constexpr int FollowedIterations = 24;    // the air changes anyhow before the last drift
constexpr int HarderPushes = 3;
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

} // namespace

DriftWeights AssimilationRun::Weights() const
{
  DriftWeights weights;
  weights.Smoothness = this->Options.Smoothness;
  return weights;
}

Result AssimilationRun::FirstDrift()
{
  PartMonitor monitor(this->Caller, DrawEnd, DriftEnd, "Letting the objects drift to their marks");
  (void)this->Seek(std::vector<char>(this->Drifters.size(), 1), monitor);
  this->Note("drift", nullptr);
  return monitor.Tick(1.0, "") ? Result::Ok() : Result::Stopped();
}

bool AssimilationRun::SeekAgain(Monitor& monitor)
{
  const AirSampler air(this->Drawn.Velocity);
  std::vector<HandOf> hands;
  HandOf all;
  for (std::size_t o = 0; o < this->Drifters.size(); ++o)
  {
    hands.push_back(this->Hand(o, air));
    all.Flow += hands.back().Flow;
    all.Steps += hands.back().Steps;
  }
  std::vector<char> which;
  for (const HandOf& hand : hands)
  {
    which.push_back(hand.Rms(hand.Control) > SoughtAgain * all.Rms(all.Flow) ? 1 : 0);
  }
  return this->Seek(which, monitor);
}

bool AssimilationRun::Seek(const std::vector<char>& which, Monitor& monitor)
{
  std::atomic<std::size_t> done{ 0 };
  const AirSampler air(this->Drawn.Velocity);
  this->Parallel(this->Drifters.size(),
                 [&](std::size_t begin, std::size_t end)
                 {
                   for (std::size_t o = begin; o < end; ++o)
                   {
                     const double fraction = FractionDone(done++, this->Drifters.size());
                     if (!monitor.Tick(fraction, ""))
                     {
                       return;
                     }
                     if (which[o] && !this->IsKept(o))
                     {
                       this->SeekPath(o, air, monitor);
                     }
                   }
                 });
  this->ShowPaths();
  return monitor.Tick(1.0, "");
}

void AssimilationRun::SeekPath(std::size_t o, const AirSampler& air, Monitor& monitor)
{
  const double rate = this->Input.Scene.Time.FramesPerSecond;
  const int spread = static_cast<int>(std::lround(this->Options.TouchDownSpread * rate));
  const int step = std::max(1, static_cast<int>(std::lround(rate / 2.0)));
  Drifter& drifter = this->Drifters[o];
  const auto judged = [&](const std::vector<Vec3>& path)
  { return this->JudgementOf(drifter, this->CostOf(drifter, air, path), path); };
  const Judgement before = judged(this->Paths[o]);
  const std::vector<Vec3> pathBefore = this->Paths[o];
  std::vector<std::pair<int, int>> timesBefore;
  for (std::size_t l = 0; l < drifter.NumberOfLandings(); ++l)
  {
    timesBefore.emplace_back(drifter.TouchDown(l), drifter.LiftOff(l));
    drifter.SetTouchDown(l, drifter.LandingFrame(l));
    drifter.SetLiftOff(l, drifter.LeavingFrame(l));
  }
  this->Paths[o] = this->BestDrift(drifter, air, drifter.Starts(air, this->Options.Starts));
  for (std::size_t l = 0; l < drifter.NumberOfLandings(); ++l)
  {
    const int landing = drifter.LandingFrame(l);
    this->SeekTime(
      o, air, { landing, landing > 0 ? drifter.EarliestTouchDown(l, spread) : landing, -step },
      [&](int frame) { drifter.SetTouchDown(l, frame); },
      [&](const std::vector<Vec3>& path, int last) { return drifter.Retimed(path, l, last); },
      monitor);
    this->SeekTime(
      o, air, { drifter.LeavingFrame(l), drifter.LatestLiftOff(l, spread), step },
      [&](int frame) { drifter.SetLiftOff(l, frame); },
      [&](const std::vector<Vec3>& path, int last) { return drifter.Delayed(path, l, last); },
      monitor);
  }
  if (!(judged(this->Paths[o]) < before))
  {
    this->Paths[o] = pathBefore;
    for (std::size_t l = 0; l < timesBefore.size(); ++l)
    {
      drifter.SetTouchDown(l, timesBefore[l].first);
      drifter.SetLiftOff(l, timesBefore[l].second);
    }
  }
}

void AssimilationRun::SeekTime(std::size_t o, const AirSampler& air, const FramesToTry& frames,
                               const std::function<void(int)>& set, const Retiming& retimed,
                               Monitor& monitor)
{
  const Drifter& drifter = this->Drifters[o];
  const auto judged = [&](const std::vector<Vec3>& path)
  { return this->JudgementOf(drifter, this->CostOf(drifter, air, path), path); };
  Judgement least = judged(this->Paths[o]);
  int best = frames.First;
  int last = frames.First;
  std::vector<Vec3> path = this->Paths[o];
  for (int frame = frames.First + frames.Step;
       (frame - frames.Last) * frames.Step <= 0 && monitor.Tick(-1.0, ""); frame += frames.Step)
  {
    set(frame);
    path = this->BestDrift(drifter, air, { retimed(path, last), drifter.Starts(air, 0).back() });
    last = frame;
    const Judgement now = judged(path);
    if (now < least)
    {
      least = now;
      best = frame;
      this->Paths[o] = path;
    }
  }
  set(best);
}

double AssimilationRun::CostOf(const Drifter& drifter, const AirSampler& air,
                               std::vector<Vec3> path) const
{
  return SolveDrift(drifter.Problem(air), air, this->Weights(), 1, path).Cost;
}

std::vector<Vec3> AssimilationRun::BestDrift(const Drifter& drifter, const AirSampler& air,
                                             std::vector<std::vector<Vec3>> paths) const
{
  const DriftProblem problem = drifter.Problem(air);
  std::vector<std::pair<Judgement, std::size_t>> order;
  const auto follow = [&](std::size_t k, int iterations)
  {
    const double cost = SolveDrift(problem, air, this->Weights(), iterations, paths[k]).Cost;
    return this->JudgementOf(drifter, cost, paths[k]);
  };
  for (std::size_t k = 0; k < paths.size(); ++k)
  {
    order.emplace_back(follow(k, FurtherIterations), k);
  }
  std::sort(order.begin(), order.end());
  order.resize(std::min((order.size() + 2) / 3, FollowedStarts));
  for (auto& [judgement, k] : order)
  {
    judgement = follow(k, FollowedIterations);
  }
  return paths[std::min_element(order.begin(), order.end())->second];
}

AssimilationRun::Judgement AssimilationRun::JudgementOf(const Drifter& drifter, double cost,
                                                        const std::vector<Vec3>& path) const
{
  return { static_cast<bool>(this->Scene.Solids) && drifter.PassesThrough(path),
           cost / drifter.NumberOfFlownSteps() };
}

std::vector<char> AssimilationRun::FindNeighbours()
{
  std::vector<std::vector<DriftNeighbour>> contacts = FindContacts(
    this->Drifters, this->Paths, this->Input.Scene.Time.FramesPerSecond, this->Parallel);
  std::vector<char> touches;
  for (std::size_t o = 0; o < this->Drifters.size(); ++o)
  {
    touches.push_back(contacts[o].empty() ? 0 : 1);
    this->Drifters[o].SetNeighbours(std::move(contacts[o]));
  }
  return touches;
}

bool AssimilationRun::DriftOn(int iterations, Monitor& monitor)
{
  (void)this->FindNeighbours();
  return this->Drift(iterations, this->Weights(), std::vector<char>(this->Drifters.size(), 1),
                     monitor);
}

void AssimilationRun::KeepApart()
{
  PartMonitor monitor(this->Caller, 1.0, 1.0, "Keeping the objects apart");
  DriftWeights weights = this->Weights();
  std::vector<double> allowed;
  for (const std::vector<Vec3>& path : this->Paths)
  {
    allowed.push_back(SharpestGivingWay * SharpestBend(path));
  }
  for (int pass = 0; pass < ContactPasses; ++pass)
  {
    const std::vector<char> touches = this->FindNeighbours();
    if (std::find(touches.begin(), touches.end(), 1) == touches.end())
    {
      return;
    }
    weights.Barrier *= 2.0;
    const std::vector<std::vector<Vec3>> before = this->Paths;
    if (!this->Drift(FurtherIterations, weights, touches, monitor))
    {
      this->Paths = before;
      return;
    }
    for (std::size_t o = 0; o < before.size(); ++o)
    {
      if (SharpestBend(this->Paths[o]) > allowed[o])
      {
        this->Paths[o] = before[o];
      }
    }
  }
}

bool AssimilationRun::Drift(int iterations, const DriftWeights& weights,
                            const std::vector<char>& which, Monitor& monitor)
{
  PartMonitor part(monitor, 0.0, 1.0);
  std::atomic<std::size_t> done{ 0 };
  const AirSampler air(this->Drawn.Velocity);
  this->Parallel(this->Drifters.size(),
                 [&](std::size_t begin, std::size_t end)
                 {
                   for (std::size_t o = begin; o < end; ++o)
                   {
                     if (!part.Tick(FractionDone(done++, this->Drifters.size()), ""))
                     {
                       return;
                     }
                     if (which[o] && !this->IsKept(o))
                     {
                       SolveDrift(this->Drifters[o].Problem(air), air, weights, iterations,
                                  this->Paths[o]);
                     }
                   }
                 });
  this->ShowPaths();
  return part.Tick(1.0, "");
}

Result AssimilationRun::FindWind(const HalfSeries& plain, int round)
{
  CommonWindOptions options;
  options.Spacing = this->Options.WindSpacing;
  options.TimeSpacing = this->Options.WindTimeSpacing;
  options.Ridge *= this->Options.WindStiffness;
  options.Bending *= this->Options.WindStiffness;
  options.Changing *= this->Options.WindStiffness;
  CommonWind common(this->Input.Scene.Bounds, this->Input.Scene.Time, options);
  const double begin = this->ProgressOf(round, 0.0);
  const double step = (this->ProgressOf(round, WindEnd) - begin) / this->Options.WindRounds;
  for (int k = 0; k < this->Options.WindRounds; ++k)
  {
    PartMonitor fitting(this->Caller, begin + k * step, begin + (k + 0.5) * step,
                        "Fitting the common wind");
    const bool isFitted = this->FitWind(common, fitting);
    if (!isFitted || !this->AddWind(plain, common, fitting))
    {
      this->Drawn.Velocity = plain;
      return Result::Stopped();
    }
    PartMonitor drifting(this->Caller, begin + (k + 0.5) * step, begin + (k + 1) * step,
                         "Letting the objects drift in the common wind");
    if (!this->DriftOn(FurtherIterations, drifting))
    {
      return Result::Stopped();
    }
    this->Note("wind " + std::to_string(k + 1), &common);
  }
  return Result::Ok();
}

bool AssimilationRun::AddWind(const HalfSeries& plain, const CommonWind& common, Monitor& monitor)
{
  HalfSeries& air = this->Drawn.Velocity;
  if (!common.AddTo(plain, air, this->Parallel, monitor))
  {
    return false;
  }
  for (std::vector<Half3>& field : air.Values)
  {
    StopAtFloor(air, field);
  }
  return true;
}

bool AssimilationRun::FitWind(CommonWind& common, Monitor& monitor) const
{
  const AirSampler air(this->Drawn.Velocity);
  std::map<int, WindSamples> byFrame;
  for (std::size_t o = 0; o < this->Drifters.size(); ++o)
  {
    const DriftProblem problem = this->Drifters[o].Problem(air);
    const std::vector<Vec3> controls = DriftControls(problem, air, this->Paths[o]);
    for (int k = 1; k < static_cast<int>(controls.size()); k += WindStride)
    {
      const auto at = static_cast<std::size_t>(k);
      if (!IsFreeStep(problem, this->Paths[o], k))
      {
        continue;
      }
      const Vec3 middle = 0.5 * (this->Paths[o][at] + this->Paths[o][at + 1]);
      WindSamples& samples = byFrame[k];
      samples.Frame = k + 0.5;
      samples.Positions.push_back(middle);
      samples.Values.push_back(controls[at] + common.At(middle, k + 0.5));
    }
  }
  std::vector<WindSamples> samples;
  for (auto& [frame, at] : byFrame)
  {
    samples.push_back(std::move(at));
  }
  return common.Fit(samples, this->Parallel, monitor);
}

bool AssimilationRun::FinishPath(std::size_t o, const AirSampler& air)
{
  const Drifter& drifter = this->Drifters[o];
  DriftWeights weights = this->Weights();
  for (int k = 0; k < HarderPushes && !drifter.IsClear(this->Paths[o]); ++k)
  {
    weights.Barrier *= 10.0;
    SolveDrift(drifter.Problem(air), air, weights, DriftIterations, this->Paths[o]);
  }
  return drifter.MakeExact(this->Paths[o]);
}

void AssimilationRun::LandFreeBodies()
{
  const AirSampler air(this->Drawn.Velocity);
  const int frames = static_cast<int>(this->Paths.front().size());
  this->Parallel(
    this->Drifters.size(),
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t o = begin; o < end; ++o)
      {
        Drifter& drifter = this->Drifters[o];
        const int first = drifter.FreeFrom();
        const FreeLanding landing =
          this->IsKept(o) || first >= frames
            ? FreeLanding()
            : FindFreeLanding(this->Around, drifter.Object(), air, this->Paths[o], first);
        if (landing.Frame >= 0)
        {
          drifter.LandFreely(landing.Frame, landing.Place);
          SolveDrift(drifter.Problem(air), air, this->Weights(), LandingIterations, this->Paths[o]);
        }
      }
    });
}

} // namespace waft
