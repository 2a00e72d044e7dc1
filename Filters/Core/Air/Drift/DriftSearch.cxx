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
constexpr int TriedIterations = 6;        // of each
constexpr int FollowedIterations = 18;    // the air changes anyhow before the last drift

// Of two paths the one that judges less goes on.
struct Merit
{
  bool PassesThrough = false; // an obstacle: barriers ask at frames alone, a wall may be thinner
  double Cost = 0.0;          // a step flown: lying costs nothing, and would end each flight early
  bool operator<(const Merit& other) const
  {
    return this->PassesThrough != other.PassesThrough ? other.PassesThrough
                                                      : this->Cost < other.Cost;
  }
};

Merit MeritOf(const DriftSearch& search, const BodyProblem& body, double cost,
              const std::vector<Vec3>& path)
{
  return { search.HasSolids && body.PassesThrough(path), cost / body.NumberOfFlownSteps() };
}

// Of a path as it is.
Merit MeritOf(const DriftSearch& search, const AirSampler& air, const BodyProblem& body,
              const std::vector<Vec3>& path)
{
  std::vector<Vec3> same = path;
  const double cost = SolveDrift(body.In(air), air, search.Weights, 0, same).Cost;
  return MeritOf(search, body, cost, path);
}

// The best path that a search from one of `paths` comes to.
std::vector<Vec3> BestDrift(const DriftSearch& search, const AirSampler& air,
                            const BodyProblem& body, std::vector<std::vector<Vec3>> paths)
{
  const DriftProblem problem = body.In(air);
  std::vector<std::pair<Merit, std::size_t>> order;
  const auto follow = [&](std::size_t k, int iterations)
  {
    const double cost = SolveDrift(problem, air, search.Weights, iterations, paths[k]).Cost;
    return MeritOf(search, body, cost, paths[k]);
  };
  for (std::size_t k = 0; k < paths.size(); ++k)
  {
    order.emplace_back(follow(k, TriedIterations), k);
  }
  std::sort(order.begin(), order.end());
  order.resize(std::min((order.size() + 2) / 3, FollowedStarts));
  for (auto& [merit, k] : order)
  {
    merit = follow(k, FollowedIterations);
  }
  return paths[std::min_element(order.begin(), order.end())->second];
}

// Another frame for the end or the beginning of a flight.
struct FramesToTry
{
  int First = 0, Last = 0, Step = 1; // First: as it is
  std::function<void(int)> Set;      // gives one to the body
  /// Brings a path from the frame that it has to the one that is set.
  std::function<std::vector<Vec3>(const std::vector<Vec3>& path, int frame)> Retimed;
};

void SeekTime(const DriftSearch& search, const AirSampler& air, const BodyProblem& body,
              const FramesToTry& frames, std::vector<Vec3>& path, Monitor& monitor)
{
  Merit least = MeritOf(search, air, body, path);
  int best = frames.First;
  int last = frames.First;
  std::vector<Vec3> tried = path;
  for (int frame = frames.First + frames.Step;
       (frame - frames.Last) * frames.Step <= 0 && monitor.Tick(-1.0, ""); frame += frames.Step)
  {
    frames.Set(frame);
    tried =
      BestDrift(search, air, body, { frames.Retimed(tried, last), body.Starts(air, 0).back() });
    last = frame;
    const Merit now = MeritOf(search, air, body, tried);
    if (now < least)
    {
      least = now;
      best = frame;
      path = tried;
    }
  }
  frames.Set(best);
}

int EarliestTouchDown(const DriftSearch& search, const BodyProblem& body, std::size_t landing)
{
  const int frame = body.LandingFrame(landing);
  return frame > 0 ? body.EarliestTouchDown(landing, search.Spread) : frame;
}

/// What comes down tips over, rocks and lies still at the row's frame.
int LatestTouchDown(const DriftSearch& search, const BodyProblem& body, std::size_t landing)
{
  return std::max(body.LandingFrame(landing) - search.Settling,
                  EarliestTouchDown(search, body, landing));
}

} // namespace

void SetLatestTouchDowns(const DriftSearch& search, BodyProblem& body)
{
  for (std::size_t l = 0; l < body.NumberOfLandings(); ++l)
  {
    body.SetTouchDown(l, body.LandingFrame(l));
    body.SetLiftOff(l, body.LeavingFrame(l));
    body.SetTouchDown(l, LatestTouchDown(search, body, l));
  }
}

void SeekPath(const DriftSearch& search, const AirSampler& air, BodyProblem& body,
              std::vector<Vec3>& path, Monitor& monitor)
{
  const Merit before = MeritOf(search, air, body, path);
  const std::vector<Vec3> pathBefore = path;
  std::vector<std::pair<int, int>> timesBefore;
  for (std::size_t l = 0; l < body.NumberOfLandings(); ++l)
  {
    timesBefore.emplace_back(body.TouchDown(l), body.LiftOff(l));
  }
  SetLatestTouchDowns(search, body);
  path = BestDrift(search, air, body, body.Starts(air, search.Starts));
  for (std::size_t l = 0; l < body.NumberOfLandings(); ++l)
  {
    const FramesToTry touchDowns{ body.TouchDown(l), EarliestTouchDown(search, body, l),
                                  -search.Step, [&](int frame) { body.SetTouchDown(l, frame); },
                                  [&](const std::vector<Vec3>& from, int last)
                                  { return body.Retimed(from, l, last); } };
    SeekTime(search, air, body, touchDowns, path, monitor);
    const FramesToTry liftOffs{ body.LeavingFrame(l), body.LatestLiftOff(l, search.Spread),
                                search.Step, [&](int frame) { body.SetLiftOff(l, frame); },
                                [&](const std::vector<Vec3>& from, int last)
                                { return body.Delayed(from, l, last); } };
    SeekTime(search, air, body, liftOffs, path, monitor);
  }
  if (!(MeritOf(search, air, body, path) < before))
  {
    path = pathBefore;
    for (std::size_t l = 0; l < timesBefore.size(); ++l)
    {
      body.SetTouchDown(l, timesBefore[l].first);
      body.SetLiftOff(l, timesBefore[l].second);
    }
  }
}

} // namespace waft
