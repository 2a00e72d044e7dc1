// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Field/WarmUp.h"

#include "Air/Field/AirSampler.h"
#include "Base/NumberText.h"
#include "Grid/SmokeEnsemble.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>

namespace waft
{
namespace
{

constexpr double Steady = 0.1;          // by which means may differ
constexpr int MostTurnovers = 4;        // before it is given up
constexpr double LongestTurnover = 6.0; // s, of a volume of 4 m
constexpr double StepSeconds = 0.133;   // likewise: half a voxel of the coarse grid

// Mean of the last `count` values but for `skipped`.
double MeanBefore(const std::vector<double>& values, int count, int skipped)
{
  const auto end = values.end() - skipped;
  return std::accumulate(end - count, end, 0.0) / count;
}

bool IsAlike(const std::vector<double>& values, int turnover)
{
  const double now = MeanBefore(values, turnover, 0);
  const double before = MeanBefore(values, turnover, turnover);
  return std::abs(now - before) <= Steady * std::max(now, before);
}

} // namespace

std::string WarmUp::Text(double framesPerSecond) const
{
  const std::string turnovers = NumberText(static_cast<double>(this->Frames) / this->Turnover, 2);
  return NumberText(this->Frames / framesPerSecond, 3) + " s, " + turnovers + " turnovers" +
         (this->IsSteady ? "" : ", not steady yet");
}

Result FindWarmUp(AirScene scene, const std::function<SmokeForces(double until)>& forces,
                  const ParallelFor& parallel, Monitor& monitor, WarmUp& found)
{
  const Box& volume = scene.Smoke.Bounds;
  found = WarmUp();
  found.Stride =
    std::max(1, static_cast<int>(std::lround(StepSeconds * TimeScaleOf(volume.Width()) *
                                             scene.Time.FramesPerSecond)));
  const double rate = scene.Time.FramesPerSecond / found.Stride; // of steps
  scene.Smoke.FramesPerSecond = rate;
  const auto longest = static_cast<int>(
    std::max(2.0, std::ceil(LongestTurnover * TimeScaleOf(volume.Width()) * rate)));
  scene.Smoke.WarmUpSeconds = 0.0;
  SmokeForces felt = forces(MostTurnovers * longest / rate);
  felt.Wind = std::move(scene.Forces.Wind);
  SmokeSolver solver;
  WAFT_RETURN_IF_FAILED(solver.Begin(scene.Smoke, std::move(felt)));
  WAFT_RETURN_IF_FAILED(PlaceSolids(scene, 0, solver));
  const double extent = volume.Size().prod();
  std::vector<double> speeds, vorticities; // rms, by frame
  std::deque<std::vector<Half3>> airs;     // the last ones
  SmokeFrame cells;
  int turnover = 0; // steps
  while (found.Turnover == 0)
  {
    const double begun = static_cast<double>(speeds.size()) / (MostTurnovers * longest);
    PartMonitor step(monitor, begun, begun);
    const Result stepped = solver.Step(parallel, step);
    if (!stepped || stepped.IsStopped())
    {
      return stepped;
    }
    speeds.push_back(std::sqrt(2.0 * solver.KineticEnergy() / extent));
    vorticities.push_back(std::sqrt(2.0 * solver.Enstrophy() / extent));
    HalfSeries air = AirLattice(scene, FieldMeaning::Velocity);
    solver.ReadVelocity(cells);
    AppendAir(scene, cells, solver.Time(), parallel, air);
    airs.push_back(std::move(air.Values.front()));
    if (airs.size() > 2 * static_cast<std::size_t>(longest))
    {
      airs.pop_front();
    }
    const auto steps = static_cast<int>(speeds.size());
    const double speed = MeanBefore(speeds, std::min(steps, longest), 0);
    turnover =
      speed > 0.0
        ? std::clamp(static_cast<int>(std::lround(volume.Width() / speed * rate)), 1, longest)
        : longest;
    if (steps < 2 * turnover)
    {
      continue;
    }
    found.IsSteady = IsAlike(speeds, turnover) && IsAlike(vorticities, turnover);
    if (found.IsSteady || steps >= MostTurnovers * turnover)
    {
      found.Frames = (steps - 1) * found.Stride; // the first is that of rest
      found.Turnover = turnover * found.Stride;
    }
  }
  const auto kept = std::min<std::size_t>(airs.size(), 2 * static_cast<std::size_t>(turnover));
  found.Recent = AirLattice(scene, FieldMeaning::Velocity);
  for (std::size_t k = 0; k < kept; ++k)
  {
    found.Recent.Times.push_back(static_cast<double>(k) / rate);
    found.Recent.Values.push_back(std::move(airs[airs.size() - kept + k]));
  }
  return Result::Ok();
}

Result BeginWarmUp(const WarmUp& warmUp, AirScene& scene, SmokeState& begun)
{
  scene.Smoke.WarmUpSeconds = warmUp.Turnover / scene.Time.FramesPerSecond;
  SmokeSolver solver;
  WAFT_RETURN_IF_FAILED(solver.Begin(scene.Smoke, {}));
  WAFT_RETURN_IF_FAILED(PlaceSolids(scene, 0, solver));
  const AirSampler air(warmUp.Recent);
  const int first = std::max(0, static_cast<int>(warmUp.Recent.Values.size()) - 1 -
                                  warmUp.Turnover / warmUp.Stride);
  WAFT_RETURN_IF_FAILED(
    solver.SetVelocity([&](const Vec3& x) { return air.At(first, x); }, /*project=*/true));
  begun = solver.Save();
  begun.Frame = -1;
  return Result::Ok();
}

} // namespace waft
