// SPDX-License-Identifier: BSD-3-Clause
// The drawn air, and the same with the force of the common wind.
#include "Air/AssimilationRun.h"

#include "Air/AirSymmetry.h"
#include "Base/Random.h"
#include "Grid/SmokeEnsemble.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

constexpr int TrialIterations = 20; // of a candidate
constexpr std::size_t TrialObjects = 48;
constexpr double SteeringRate = 6.0; // 1/s
constexpr int Draws = 7;
constexpr int CoarseVoxels = 16;
constexpr double DrawsEnd = 0.03;
constexpr std::uint64_t AirStream = 0x616972; // of random numbers, apart from all others of a seed

// Sum of squared velocities; above 0.
double EnergyOf(const FieldSeries& air)
{
  double sum = 1e-30;
  for (const auto& field : air.Values)
  {
    for (const std::array<float, 3>& v : field)
    {
      sum += Vec3(v[0], v[1], v[2]).squaredNorm();
    }
  }
  return sum;
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

Result AssimilationRun::ForcesOf(std::uint64_t seed, SmokeForces& forces) const
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
  forces.Vortices.insert(forces.Vortices.end(), this->Input.Vortices.begin(),
                         this->Input.Vortices.end());
  forces.Wind = this->Input.Wind;
  return Result::Ok();
}

Result AssimilationRun::DrawForces()
{
  AirScene coarse = this->Scene;
  coarse.Solids = {};
  coarse.LatticeDimensions.fill(CoarseVoxels);
  for (int& voxels : coarse.Smoke.Resolution)
  {
    voxels = std::max(4, voxels * CoarseVoxels / this->Options.Resolution);
  }
  Random random(this->Input.Scene.Seed, AirStream);
  std::vector<std::uint32_t> seeds;
  std::vector<double> open, closed;
  for (int k = 0; k < Draws; ++k)
  {
    seeds.push_back(random.Bits());
    WAFT_RETURN_IF_FAILED(this->ForcesOf(seeds.back(), coarse.Forces));
    for (const BoundaryKind boundary : { BoundaryKind::Open, BoundaryKind::Closed })
    {
      coarse.Smoke.Boundary.fill(boundary);
      PartMonitor monitor(this->Caller, DrawsEnd * k / Draws, DrawsEnd * (k + 1) / Draws,
                          "Drawing the forces of the air");
      FieldSeries air, none;
      const Result simulated = SimulateAir(coarse, {}, this->Parallel, monitor, air, none);
      if (!simulated || simulated.IsStopped())
      {
        return simulated;
      }
      (boundary == BoundaryKind::Open ? open : closed).push_back(EnergyOf(air));
    }
  }
  std::vector<double> sorted = open;
  std::sort(sorted.begin(), sorted.end());
  const double wanted = std::log(sorted[Draws / 2]);
  int best = 0;
  for (int k = 1; k < Draws; ++k)
  {
    const auto at = static_cast<std::size_t>(k);
    const bool isNearer = std::abs(std::log(closed[at]) - wanted) <
                          std::abs(std::log(closed[static_cast<std::size_t>(best)]) - wanted);
    best = isNearer ? k : best;
  }
  return this->ForcesOf(seeds[static_cast<std::size_t>(best)], this->Scene.Forces);
}

Result AssimilationRun::Draw()
{
  const Result drawn = this->DrawForces();
  if (!drawn || drawn.IsStopped())
  {
    return drawn;
  }
  FieldSeries none;
  PartMonitor monitor(this->Caller, DrawsEnd, DrawEnd, "Drawing the air");
  const Result simulated = SimulateAir(this->Scene, {}, this->Parallel, monitor, this->Air, none);
  if (!simulated || simulated.IsStopped())
  {
    return simulated;
  }
  const FieldSeries first = this->Air;
  double least = 1e300;
  AirSymmetry best;
  int tried = 0;
  for (const AirSymmetry& symmetry : AirSymmetries(this->Input.Scene.Bounds))
  {
    if (tried++ >= this->Options.Candidates || (tried > 1 && !this->IsSymmetric()))
    {
      break;
    }
    this->Air = Image(symmetry, first);
    const double control = this->TrialControl();
    AssimilationRound row;
    row.Stage = "draw";
    row.Candidate = symmetry.Text();
    row.Control = control;
    row.Seconds = this->Seconds();
    this->Output.Rounds.push_back(row);
    if (control < least)
    {
      least = control;
      best = symmetry;
    }
  }
  this->Air = Image(best, first);
  this->Scene.Forces = Image(best, this->Input.Scene.Bounds, this->Scene.Forces);
  this->Candidate = best.Text();
  return Result::Ok();
}

double AssimilationRun::TrialControl() const
{
  const AirSampler air(this->Air);
  const std::size_t stride = (this->Drifters.size() + TrialObjects - 1) / TrialObjects;
  const std::size_t count = (this->Drifters.size() + stride - 1) / stride;
  std::vector<double> squares(count, 0.0);
  this->Parallel(count,
                 [&](std::size_t begin, std::size_t end)
                 {
                   for (std::size_t k = begin; k < end; ++k)
                   {
                     const Drifter& drifter = this->Drifters[k * stride];
                     const DriftProblem problem = drifter.Problem();
                     std::vector<Vec3> path = drifter.Starts(air, 0).back();
                     const DriftOutcome outcome =
                       SolveDrift(problem, air, this->Weights(), TrialIterations, path);
                     squares[k] = outcome.Control * outcome.Control;
                   }
                 });
  double sum = 0.0;
  for (const double square : squares)
  {
    sum += square;
  }
  return std::sqrt(sum / static_cast<double>(count));
}

Result AssimilationRun::SimulateAgain(const FieldSeries& plain, int round)
{
  FieldSeries feed = MaterialDerivative(this->Air, this->Parallel);
  {
    const FieldSeries own = MaterialDerivative(plain, this->Parallel);
    for (std::size_t f = 0; f < feed.Values.size(); ++f)
    {
      for (std::size_t i = 0; i < feed.Values[f].size(); ++i)
      {
        for (std::size_t c = 0; c < 3; ++c)
        {
          feed.Values[f][i][c] -= own.Values[f][i][c];
          feed.Values[f][i][c] +=
            this->Output.Wind.IsEmpty() ? 0.0f : this->Output.Wind.Values[f][i][c];
        }
      }
    }
  }
  AirSteering steering;
  steering.Target = &this->Air;
  steering.Feed = &feed;
  steering.Rate = SteeringRate;
  FieldSeries air, steered;
  const double part = (1.0 - DriftEnd) / this->Options.Rounds;
  PartMonitor monitor(this->Caller, DriftEnd + round * part, DriftEnd + (round + 1) * part,
                      "Simulating the air with the common wind, round " +
                        std::to_string(round + 1) + " of at most " +
                        std::to_string(this->Options.Rounds));
  const Result simulated =
    SimulateAir(this->Scene, steering, this->Parallel, monitor, air, steered);
  if (!simulated || simulated.IsStopped())
  {
    return simulated;
  }
  this->Air = std::move(air);
  this->Output.Wind = std::move(steered);
  this->DriftOn(DriftIterations);
  this->Note("simulate " + std::to_string(round + 1), nullptr);
  return Result::Ok();
}

} // namespace waft
