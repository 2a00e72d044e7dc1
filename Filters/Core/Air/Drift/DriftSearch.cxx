// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Drift/DriftSearch.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace waft
{
namespace
{

constexpr std::size_t FollowedStarts = 3; // the cheapest by then
constexpr int FollowedIterations = 24;    // the air changes anyhow before the last drift
constexpr int HarderPushes = 3;

// Of two paths the one that judges less goes on.
struct Judgement
{
  bool PassesThrough = false; // an obstacle: barriers ask at frames alone, a wall may be thinner
  double Cost = 0.0;          // a step flown: lying costs nothing, and would end each flight early
  bool operator<(const Judgement& other) const
  {
    return this->PassesThrough != other.PassesThrough ? other.PassesThrough
                                                      : this->Cost < other.Cost;
  }
};

Judgement JudgementOf(const DriftSearch& search, const Drifter& drifter, double cost,
                      const std::vector<Vec3>& path)
{
  return { search.HasSolids && drifter.PassesThrough(path), cost / drifter.NumberOfFlownSteps() };
}

// Of a path as it is.
Judgement JudgementOf(const DriftSearch& search, const AirSampler& air, const Drifter& drifter,
                      const std::vector<Vec3>& path)
{
  std::vector<Vec3> moved = path;
  const double cost = SolveDrift(drifter.Problem(air), air, search.Weights, 1, moved).Cost;
  return JudgementOf(search, drifter, cost, path);
}

// The best path that a search from one of `paths` comes to.
std::vector<Vec3> BestDrift(const DriftSearch& search, const AirSampler& air,
                            const Drifter& drifter, std::vector<std::vector<Vec3>> paths)
{
  const DriftProblem problem = drifter.Problem(air);
  std::vector<std::pair<Judgement, std::size_t>> order;
  const auto follow = [&](std::size_t k, int iterations)
  {
    const double cost = SolveDrift(problem, air, search.Weights, iterations, paths[k]).Cost;
    return JudgementOf(search, drifter, cost, paths[k]);
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

// Another frame for the end or the beginning of a flight.
struct FramesToTry
{
  int First = 0, Last = 0, Step = 1; // First: as it is
  std::function<void(int)> Set;      // gives one to the drifter
  /// Brings a path from the frame that it has to the one that is set.
  std::function<std::vector<Vec3>(const std::vector<Vec3>& path, int frame)> Retimed;
};

void SeekTime(const DriftSearch& search, const AirSampler& air, const Drifter& drifter,
              const FramesToTry& frames, std::vector<Vec3>& path, Monitor& monitor)
{
  Judgement least = JudgementOf(search, air, drifter, path);
  int best = frames.First;
  int last = frames.First;
  std::vector<Vec3> tried = path;
  for (int frame = frames.First + frames.Step;
       (frame - frames.Last) * frames.Step <= 0 && monitor.Tick(-1.0, ""); frame += frames.Step)
  {
    frames.Set(frame);
    tried = BestDrift(search, air, drifter,
                      { frames.Retimed(tried, last), drifter.Starts(air, 0).back() });
    last = frame;
    const Judgement now = JudgementOf(search, air, drifter, tried);
    if (now < least)
    {
      least = now;
      best = frame;
      path = tried;
    }
  }
  frames.Set(best);
}

} // namespace

void SeekPath(const DriftSearch& search, const AirSampler& air, Drifter& drifter,
              std::vector<Vec3>& path, Monitor& monitor)
{
  const Judgement before = JudgementOf(search, air, drifter, path);
  const std::vector<Vec3> pathBefore = path;
  std::vector<std::pair<int, int>> timesBefore;
  for (std::size_t l = 0; l < drifter.NumberOfLandings(); ++l)
  {
    timesBefore.emplace_back(drifter.TouchDown(l), drifter.LiftOff(l));
    drifter.SetTouchDown(l, drifter.LandingFrame(l));
    drifter.SetLiftOff(l, drifter.LeavingFrame(l));
  }
  path = BestDrift(search, air, drifter, drifter.Starts(air, search.Starts));
  for (std::size_t l = 0; l < drifter.NumberOfLandings(); ++l)
  {
    const int landing = drifter.LandingFrame(l);
    const FramesToTry touchDowns{
      landing, landing > 0 ? drifter.EarliestTouchDown(l, search.Spread) : landing, -search.Step,
      [&](int frame) { drifter.SetTouchDown(l, frame); },
      [&](const std::vector<Vec3>& from, int last) { return drifter.Retimed(from, l, last); }
    };
    SeekTime(search, air, drifter, touchDowns, path, monitor);
    const FramesToTry liftOffs{ drifter.LeavingFrame(l), drifter.LatestLiftOff(l, search.Spread),
                                search.Step, [&](int frame) { drifter.SetLiftOff(l, frame); },
                                [&](const std::vector<Vec3>& from, int last)
                                { return drifter.Delayed(from, l, last); } };
    SeekTime(search, air, drifter, liftOffs, path, monitor);
  }
  if (!(JudgementOf(search, air, drifter, path) < before))
  {
    path = pathBefore;
    for (std::size_t l = 0; l < timesBefore.size(); ++l)
    {
      drifter.SetTouchDown(l, timesBefore[l].first);
      drifter.SetLiftOff(l, timesBefore[l].second);
    }
  }
}

bool FinishPath(DriftWeights weights, const AirSampler& air, const Drifter& drifter,
                std::vector<Vec3>& path)
{
  for (int k = 0; k < HarderPushes && !drifter.IsClear(path); ++k)
  {
    weights.Barrier *= 10.0;
    SolveDrift(drifter.Problem(air), air, weights, DriftIterations, path);
  }
  return drifter.MakeExact(path);
}

} // namespace waft
