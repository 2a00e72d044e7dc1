// SPDX-License-Identifier: BSD-3-Clause
// The drawn air, and the same with the force of the common wind.
#include "Air/Run/AssimilationRun.h"

#include "Air/Field/AirStatistics.h"
#include "Air/Field/AirSymmetry.h"
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

constexpr int TrialIterations = 12; // of a candidate
constexpr std::size_t TrialObjects = 48;
constexpr std::size_t FewestForStatistics = 12; // bodies
constexpr double PathStructureCost = 2.0;
constexpr double PathStrengthCost = 0.2;
constexpr double Tiny = 1e-12;       // [m^2/s^2]
constexpr double SteeringRate = 6.0; // 1/s
constexpr int ClosedDraws = 8;
constexpr int OpenDraws = 5; // the airs as which the drawn one ought to be
constexpr int CoarseVoxels = 16;
constexpr double DrawsEnd = 0.03;
constexpr double TrialsEnd = 0.06;
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
void FitDraw(const AirStatistics& wanted, AssimilationRun::ForceDraw& draw)
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

// Of a variance that is not as it is wanted; 0 where either is not known.
double StrengthCost(double found, double wanted)
{
  const double misfit = found > 0.0 && wanted > 0.0 ? std::log(found / wanted) : 0.0;
  return PathStrengthCost * misfit * misfit;
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

} // namespace

void AssimilationRun::SetUpScene()
{
  AirScene& scene = this->Scene;
  SmokeOptions& smoke = scene.Smoke;
  smoke.Bounds = this->Input.Scene.Bounds;
  smoke.FramesPerSecond = this->Input.Scene.Time.FramesPerSecond;
  smoke.Boundary.fill(BoundaryKind::Closed);
  smoke.BuoyancyTemperature = 0.0;
  smoke.AirDensity = this->Input.Scene.AirDensity;
  const Vec3 size = smoke.Bounds.Size();
  const double voxel = size.maxCoeff() / this->Options.Resolution;
  for (int c = 0; c < 3; ++c)
  {
    const auto axis = static_cast<std::size_t>(c);
    smoke.Resolution[axis] = std::max(4, static_cast<int>(std::lround(size[c] / voxel)));
  }
  scene.LatticeDimensions = AirLatticeDimensions(smoke.Bounds, this->Options);
  scene.Time = this->Input.Scene.Time;
  if (this->Solids && this->HasSolidsInside())
  {
    scene.Solids = this->Solids(smoke);
    scene.SolidsMove = this->Obstacles.HasMoving();
  }
}

bool AssimilationRun::HasSolidsInside() const
{
  const Box& volume = this->Input.Scene.Bounds;
  const double touching = 1e-6 * volume.Width();
  for (const ObstacleMesh& obstacle : this->Input.Obstacles)
  {
    Box box{ Vec3::Constant(1e300), Vec3::Constant(-1e300) };
    for (const Vec3& vertex : obstacle.Mesh.Points)
    {
      box.Min = box.Min.cwiseMin(vertex);
      box.Max = box.Max.cwiseMax(vertex);
    }
    const bool apart = ((box.Max - volume.Min).array() <= touching).any() ||
                       ((volume.Max - box.Min).array() <= touching).any();
    if (!apart || obstacle.IsMoving())
    {
      return true;
    }
  }
  return false;
}

bool AssimilationRun::IsSymmetric() const
{
  return !this->Scene.Solids && this->Input.Wind.IsEmpty() && this->Input.Vortices.empty();
}

Result AssimilationRun::ForcesOf(std::uint64_t seed, double scale, SmokeForces& forces) const
{
  EnsembleOptions options;
  options.Seed = seed;
  options.Bounds = this->Input.Scene.Bounds;
  options.NumberOfFrames = this->Input.Scene.Time.NumberOfFrames;
  options.FramesPerSecond = this->Input.Scene.Time.FramesPerSecond;
  options.WarmUpSeconds = this->Scene.Smoke.WarmUpSeconds;
  options.NumberOfObstacles = 0;
  options.NumberOfEmitters = 0;
  Ensemble ensemble;
  WAFT_RETURN_IF_FAILED(MakeEnsemble(options, ensemble));
  forces = ensemble.Forces;
  int id = 0; // after the scene's own
  for (const Vortex& vortex : this->Input.Vortices)
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
  forces.Vortices.insert(forces.Vortices.end(), this->Input.Vortices.begin(),
                         this->Input.Vortices.end());
  forces.Wind = this->Input.Wind;
  return Result::Ok();
}

double AssimilationRun::TypicalSettlingSpeed() const
{
  std::vector<double> speeds;
  for (const Drifter& drifter : this->Drifters)
  {
    speeds.push_back(drifter.Object().SettlingSpeed);
  }
  const auto middle = speeds.begin() + static_cast<std::ptrdiff_t>(speeds.size() / 2);
  std::nth_element(speeds.begin(), middle, speeds.end());
  return *middle;
}

AirScene AssimilationRun::CoarseScene() const
{
  AirScene coarse = this->Scene;
  coarse.LatticeDimensions.fill(CoarseVoxels);
  for (int& voxels : coarse.Smoke.Resolution)
  {
    voxels = std::max(4, voxels * CoarseVoxels / this->Options.Resolution);
  }
  if (this->Scene.Solids)
  {
    coarse.Solids = this->Solids(coarse.Smoke);
  }
  return coarse;
}

Result AssimilationRun::SimulateSideBySide(std::size_t count, double begin, double end,
                                           const std::function<AirScene(std::size_t)>& sceneOf,
                                           const std::function<void(std::size_t, HalfSeries&)>& use)
{
  PartMonitor monitor(this->Caller, begin, end, "Drawing the forces of the air");
  std::vector<Result> results(count, Result::Ok());
  std::atomic<std::size_t> done{ 0 };
  this->Parallel(count,
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

Result AssimilationRun::DrawForces(std::vector<ForceDraw>& draws)
{
  const AirScene coarse = this->CoarseScene();
  Random random(SeedOfAir(this->Input, this->Options), AirStream);
  draws.resize(ClosedDraws);
  for (ForceDraw& draw : draws)
  {
    draw.Seed = random.Bits();
    WAFT_RETURN_IF_FAILED(this->ForcesOf(draw.Seed, 1.0, draw.Forces));
  }
  const double rate = this->Input.Scene.Time.FramesPerSecond;
  const double speed = this->TypicalSettlingSpeed();
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
      DriftStatistics(air, rate, speed, SerialFor());
  };
  const Result simulated =
    this->SimulateSideBySide(ClosedDraws + OpenDraws, 0.0, DrawsEnd, sceneOf, use);
  if (!simulated || simulated.IsStopped())
  {
    return simulated;
  }
  this->Wanted = MeanOf(open);
  this->Wanted.VelocityVariance *= VelocityGain;
  this->Wanted.AccelerationVariance *= AccelerationGain;
  this->Wanted.OwnVelocityVariance *= VelocityGain;
  this->Wanted.OwnAccelerationVariance *= AccelerationGain;
  for (ForceDraw& draw : draws)
  {
    FitDraw(this->Wanted, draw);
    WAFT_RETURN_IF_FAILED(this->ForcesOf(draw.Seed, draw.Scale, draw.Forces));
  }
  std::stable_sort(draws.begin(), draws.end(),
                   [](const ForceDraw& a, const ForceDraw& b) { return a.Misfit < b.Misfit; });
  return Result::Ok();
}

Result AssimilationRun::Draw()
{
  std::vector<ForceDraw> draws;
  Result result = this->DrawForces(draws);
  if (!result || result.IsStopped())
  {
    return result;
  }
  std::vector<AirSymmetry> symmetries = AirSymmetries(this->Input.Scene.Bounds);
  symmetries.resize(this->IsSymmetric() ? symmetries.size() : 1);
  const auto candidates = static_cast<std::size_t>(this->Options.Candidates);
  draws.resize(std::min(draws.size(), (candidates + symmetries.size() - 1) / symmetries.size()));
  const AirScene coarse = this->CoarseScene();
  std::vector<HalfSeries> airs(draws.size());
  result = this->SimulateSideBySide(
    draws.size(), DrawsEnd, TrialsEnd,
    [&](std::size_t k)
    {
      AirScene scene = coarse;
      scene.Forces = draws[k].Forces;
      return scene;
    },
    [&](std::size_t k, HalfSeries& air) { airs[k] = std::move(air); });
  if (!result || result.IsStopped())
  {
    return result;
  }
  double least = 1e300;
  std::size_t draw = 0;
  AirSymmetry best;
  for (std::size_t k = 0; k < candidates && k < draws.size() * symmetries.size(); ++k)
  {
    const AirSymmetry& symmetry = symmetries[k % symmetries.size()];
    const std::size_t from = k / symmetries.size();
    AssimilationRound row;
    row.Stage = "draw";
    row.Candidate = "air " + std::to_string(from + 1) + ", " + symmetry.Text();
    const double judged = this->Try(Image(symmetry, airs[from]), row);
    row.Seconds = this->Seconds();
    this->Output.Rounds.push_back(row);
    if (judged < least)
    {
      least = judged;
      draw = from;
      best = symmetry;
      this->Candidate = row.Candidate;
    }
  }
  this->Scene.Forces = Image(best, this->Input.Scene.Bounds, draws[draw].Forces);
  PartMonitor monitor(this->Caller, TrialsEnd, DrawEnd, "Drawing the air");
  const Result simulated =
    SimulateAir(this->Scene, nullptr, this->Parallel, monitor, this->Drawn.Velocity, &this->Begun);
  return simulated;
}

double AssimilationRun::Try(const HalfSeries& series, AssimilationRound& row) const
{
  const AirSampler air(series);
  const std::size_t stride = (this->Drifters.size() + TrialObjects - 1) / TrialObjects;
  const std::size_t count = (this->Drifters.size() + stride - 1) / stride;
  std::vector<double> squares(count, 0.0);
  FreeFlights flights;
  flights.Paths.resize(count);
  flights.IsFree.resize(count);
  const auto unfree = static_cast<std::size_t>(0.5 * this->Input.Scene.Time.FramesPerSecond);
  this->Parallel(count,
                 [&](std::size_t begin, std::size_t end)
                 {
                   for (std::size_t k = begin; k < end; ++k)
                   {
                     const Drifter& drifter = this->Drifters[k * stride];
                     const DriftProblem problem = drifter.Problem(air);
                     std::vector<Vec3>& path = flights.Paths[k];
                     path = drifter.Starts(air, 0).back();
                     const DriftOutcome outcome =
                       SolveDrift(problem, air, this->Weights(), TrialIterations, path);
                     squares[k] = outcome.Control * outcome.Control;
                     flights.IsFree[k].assign(path.size(), 0);
                     for (std::size_t f = unfree; f + unfree < path.size(); ++f)
                     {
                       flights.IsFree[k][f] =
                         IsFreeStep(problem, path, static_cast<int>(f)) ? 1 : 0;
                     }
                   }
                 });
  double sum = 0.0;
  for (const double square : squares)
  {
    sum += square / static_cast<double>(count);
  }
  const AirStatistics found =
    StatisticsOf(flights, this->Input.Scene.Time.FramesPerSecond, this->Input.Scene.Bounds.Width());
  row.Control = std::sqrt(sum);

  const double cost = sum / std::max(this->Wanted.VelocityVariance, Tiny);
  if (count < FewestForStatistics)
  {
    return cost + StrengthCost(found.OwnVelocityVariance, this->Wanted.OwnVelocityVariance) +
           StrengthCost(found.OwnAccelerationVariance, this->Wanted.OwnAccelerationVariance);
  }
  const double structure = StructureDistance(found, this->Wanted);
  return cost + PathStructureCost * structure * structure +
         StrengthCost(found.VelocityVariance, this->Wanted.VelocityVariance) +
         StrengthCost(found.AccelerationVariance, this->Wanted.AccelerationVariance);
}

Result AssimilationRun::SimulateAgain(HalfSeries plain, int round)
{
  AirSteering steering(this->Drawn.Velocity, std::move(plain), std::move(this->Drawn.Wind),
                       SteeringRate);
  this->Drawn.Wind = HalfSeries();
  HalfSeries air;
  PartMonitor monitor(
    this->Caller, this->ProgressOf(round, WindEnd), this->ProgressOf(round, SimulationEnd),
    "Simulating the air with the common wind, round " + std::to_string(round + 1) + " of at most " +
      std::to_string(this->Options.Rounds));
  const Result simulated =
    SimulateAir(this->Scene, &steering, this->Parallel, monitor, air, &this->Begun);
  if (!simulated || simulated.IsStopped())
  {
    return simulated;
  }
  this->Drawn.Velocity = std::move(air);
  this->Drawn.Wind = steering.TakePushes();
  PartMonitor drifting(this->Caller, this->ProgressOf(round, SimulationEnd),
                       this->ProgressOf(round, DriftingEnd),
                       "Letting the objects drift to their marks");
  if (!this->DriftOn(DriftIterations, drifting))
  {
    return Result::Stopped();
  }
  PartMonitor seeking(this->Caller, this->ProgressOf(round, DriftingEnd),
                      this->ProgressOf(round, 1.0), "Seeking anew what the air has lost");
  if (!this->SeekAgain(seeking))
  {
    return Result::Stopped();
  }
  this->Note("simulate " + std::to_string(round + 1), nullptr);
  return Result::Ok();
}

} // namespace waft
