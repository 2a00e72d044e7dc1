// SPDX-License-Identifier: BSD-3-Clause
#include "Air/AirAssimilation.h"

#include "Air/AirSimulation.h"
#include "Air/AirSymmetry.h"
#include "Air/DriftContacts.h"
#include "Air/Drifter.h"
#include "Base/Random.h"
#include "Constraints/ConstraintCheck.h"
#include "Grid/SmokeEnsemble.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <map>

namespace waft
{
namespace
{

constexpr int LeastFrames = 8;
constexpr int DriftIterations = 60;
constexpr int FurtherIterations = 12; // where the air has changed little
constexpr int TrialIterations = 20;   // of a candidate
constexpr std::size_t TrialObjects = 48;
constexpr double SteeringRate = 6.0;   // 1/s
constexpr double EnoughControl = 0.05; // of the bodies' motion
constexpr int HarderPushes = 3;
constexpr int Draws = 7;
constexpr int CoarseVoxels = 16;
constexpr double DrawsEnd = 0.03;
constexpr double DrawEnd = 0.25; // of a run, about
constexpr double DriftEnd = 0.4;
constexpr int WindStride = 3;                 // frames between samples of the common wind
constexpr std::uint64_t AirStream = 0x616972; // of random numbers, apart from all others of a seed

Result CheckInput(const AssimilationInput& input)
{
  const int frames = input.Scene.Time.NumberOfFrames;
  if (input.Tracks.empty())
  {
    return Result::Error("Tracks: no track, at least one expected");
  }
  if (frames < LeastFrames)
  {
    return Result::Error("NumberOfFrames: at least " + std::to_string(LeastFrames) +
                         " expected, found " + std::to_string(frames));
  }
  for (const Track& track : input.Tracks)
  {
    const std::string name = "Tracks, object " + std::to_string(track.ObjectId);
    if (track.Positions.size() != static_cast<std::size_t>(frames))
    {
      return Result::Error(name + ": " + std::to_string(track.Positions.size()) +
                           " points, one a frame (" + std::to_string(frames) + ") expected");
    }
    for (std::size_t k = 0; k < track.Positions.size(); ++k)
    {
      if (!track.Positions[k].allFinite())
      {
        return Result::Error(name + ": not a finite position at frame " + std::to_string(k));
      }
    }
  }
  return Result::Ok();
}

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

class Assimilation
{
public:
  Assimilation(const AssimilationInput& input, const AssimilationOptions& options,
               const SolidsOn& solids, const ParallelFor& parallel, Monitor& monitor,
               AssimilationOutput& output) :
    Input(input),
    Options(options), Solids(solids), Parallel(parallel), Caller(monitor),
    Output(output), Around{ input.Scene, this->Obstacles, options.Inertia }
  {
  }

  Result Run()
  {
    WAFT_RETURN_IF_FAILED(CheckInput(this->Input));
    WAFT_RETURN_IF_FAILED(this->Obstacles.Build(this->Input.Obstacles));
    WAFT_RETURN_IF_FAILED(this->SetUpDrifters());
    this->SetUpScene();
    Result result = this->Draw();
    if (!result || result.IsStopped())
    {
      return result;
    }
    result = this->FirstDrift();
    if (this->Options.Rounds == 0 && !result.IsStopped())
    {
      this->FindWind();
    }
    for (int round = 0; round < this->Options.Rounds && !result.IsStopped() && this->GoesOn();
         ++round)
    {
      const FieldSeries plain = this->Air;
      this->FindWind();
      result = this->SimulateAgain(plain, round);
      WAFT_RETURN_IF_FAILED(result);
    }
    this->Finish();
    return result;
  }

private:
  // The air with the wind that the controls have in common.
  void FindWind()
  {
    CommonWindOptions options;
    options.Spacing = this->Options.WindSpacing;
    options.TimeSpacing = this->Options.WindTimeSpacing;
    options.Ridge *= this->Options.WindStiffness;
    options.Bending *= this->Options.WindStiffness;
    options.Changing *= this->Options.WindStiffness;
    CommonWind common(this->Input.Scene.Bounds, this->Input.Scene.Time, options);
    const FieldSeries plain = this->Air;
    for (int k = 0; k < this->Options.WindRounds; ++k)
    {
      this->FitWind(common);
      this->Air = plain;
      common.AddTo(this->Air, this->Parallel);
      this->DriftOn(FurtherIterations);
      this->Note("wind " + std::to_string(k + 1), &common);
    }
  }

  bool GoesOn() const
  {
    const AssimilationRound& last = this->Output.Rounds.back();
    const bool isLate = this->Options.TimeLimit > 0.0 && this->Seconds() > this->Options.TimeLimit;
    return last.Control > EnoughControl * last.Motion && !isLate;
  }

  Result SetUpDrifters()
  {
    this->Output.Constraints = this->Input.Constraints;
    this->Output.Report = JudgeConstraints(this->Input.Constraints, this->Input.Objects,
                                           this->Obstacles, this->Input.Scene);
    std::map<int, const MotionObject*> objects;
    for (const MotionObject& object : this->Input.Objects)
    {
      objects[object.ObjectId] = &object;
    }
    for (const Track& track : this->Input.Tracks)
    {
      const auto object = objects.find(track.ObjectId);
      if (object == objects.end())
      {
        return Result::Error("Objects: no object " + std::to_string(track.ObjectId) +
                             ", which Tracks has");
      }
      std::vector<Constraint> rows;
      for (const Constraint& row : this->Input.Constraints)
      {
        if (row.ObjectId == track.ObjectId && IsBinding(row, this->Output.Report))
        {
          rows.push_back(row);
        }
      }
      this->Drifters.emplace_back(this->Around, *object->second, track.Positions, rows);
      this->Paths.push_back(track.Positions);
    }
    return Result::Ok();
  }

  void SetUpScene()
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

  // The ground is mostly a slab below the volume, which the air does not meet.
  bool HasSolidsInside() const
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

  Result ForcesOf(std::uint64_t seed, SmokeForces& forces) const
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

  // Of several draws the one whose air in the closed box is as strong as such airs are in the open
  // one of the databases, by coarse simulations.
  Result DrawForces()
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

  Result Draw()
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

  bool IsSymmetric() const
  {
    return !this->Scene.Solids && this->Input.Wind.IsEmpty() && this->Input.Vortices.empty();
  }

  DriftWeights Weights() const
  {
    DriftWeights weights;
    weights.Smoothness = this->Options.Smoothness;
    return weights;
  }

  double TrialControl() const
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

  // From several starts and to several touch-downs; the least control is kept.
  Result FirstDrift()
  {
    PartMonitor monitor(this->Caller, DrawEnd, DriftEnd,
                        "Letting the objects drift to their marks");
    std::atomic<std::size_t> done{ 0 };
    const AirSampler air(this->Air);
    const double rate = this->Input.Scene.Time.FramesPerSecond;
    const int spread = static_cast<int>(std::lround(this->Options.TouchDownSpread * rate));
    this->Parallel(this->Drifters.size(),
                   [&](std::size_t begin, std::size_t end)
                   {
                     for (std::size_t o = begin; o < end; ++o)
                     {
                       Drifter& drifter = this->Drifters[o];
                       if (!monitor.Tick(static_cast<double>(done++) / this->Drifters.size(), ""))
                       {
                         return;
                       }
                       this->Paths[o] = this->BestDrift(drifter, air);
                       for (std::size_t l = 0; l < drifter.NumberOfLandings(); ++l)
                       {
                         const int latest = drifter.LandingFrame(l);
                         const int earliest = drifter.EarliestTouchDown(l, spread);
                         const int step = std::max(1, static_cast<int>(std::lround(rate / 2.0)));
                         double least = this->CostOf(drifter, air, this->Paths[o]);
                         int best = latest;
                         for (int frame = latest - step;
                              frame >= earliest && latest > 0 && monitor.Tick(-1.0, "");
                              frame -= step)
                         {
                           drifter.SetTouchDown(l, frame);
                           std::vector<Vec3> path = this->BestDrift(drifter, air);
                           const double cost = this->CostOf(drifter, air, path);
                           if (cost < least)
                           {
                             least = cost;
                             best = frame;
                             this->Paths[o] = path;
                           }
                         }
                         drifter.SetTouchDown(l, best);
                       }
                     }
                   });
    this->Note("drift", nullptr);
    return monitor.Tick(1.0, "") ? Result::Ok() : Result::Stopped();
  }

  double CostOf(const Drifter& drifter, const AirSampler& air, std::vector<Vec3> path) const
  {
    return SolveDrift(drifter.Problem(), air, this->Weights(), 1, path).Cost;
  }

  std::vector<Vec3> BestDrift(const Drifter& drifter, const AirSampler& air) const
  {
    const DriftProblem problem = drifter.Problem();
    std::vector<Vec3> best;
    double least = 1e300;
    for (std::vector<Vec3>& path : drifter.Starts(air, this->Options.Starts))
    {
      const DriftOutcome outcome = SolveDrift(problem, air, this->Weights(), DriftIterations, path);
      if (outcome.Cost < least)
      {
        least = outcome.Cost;
        best = path;
      }
    }
    return best;
  }

  void DriftOn(int iterations)
  {
    std::vector<std::vector<DriftNeighbour>> contacts = FindContacts(
      this->Drifters, this->Paths, this->Input.Scene.Time.FramesPerSecond, this->Parallel);
    for (std::size_t o = 0; o < this->Drifters.size(); ++o)
    {
      this->Drifters[o].SetNeighbours(std::move(contacts[o]));
    }
    const AirSampler air(this->Air);
    this->Parallel(this->Drifters.size(),
                   [&](std::size_t begin, std::size_t end)
                   {
                     for (std::size_t o = begin; o < end; ++o)
                     {
                       SolveDrift(this->Drifters[o].Problem(), air, this->Weights(), iterations,
                                  this->Paths[o]);
                     }
                   });
  }

  // The wind that would have made the controls needless: what it is at the bodies, and they.
  void FitWind(CommonWind& common) const
  {
    const AirSampler air(this->Air);
    std::map<int, WindSamples> byFrame;
    for (std::size_t o = 0; o < this->Drifters.size(); ++o)
    {
      const DriftProblem problem = this->Drifters[o].Problem();
      const std::vector<Vec3> controls = DriftControls(problem, air, this->Paths[o]);
      for (int k = 1; k < static_cast<int>(controls.size()); k += WindStride)
      {
        const auto at = static_cast<std::size_t>(k);
        if (problem.Flight[at] < 1.0)
        {
          continue;
        }
        const Vec3 place = 0.5 * (this->Paths[o][at] + this->Paths[o][at + 1]);
        WindSamples& samples = byFrame[k];
        samples.Frame = k + 0.5;
        samples.Places.push_back(place);
        samples.Values.push_back(controls[at] + common.At(place, k + 0.5));
      }
    }
    std::vector<WindSamples> samples;
    for (auto& [frame, at] : byFrame)
    {
      samples.push_back(std::move(at));
    }
    common.Fit(samples, this->Parallel);
  }

  // Towards the air with the common wind, by what its motion asks for beside what drives it now.
  Result SimulateAgain(const FieldSeries& plain, int round)
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

  // What keeps too near to something is pushed harder first; only what that does not help is moved
  // out of the way without a look at the air.
  bool FinishPath(std::size_t o, const AirSampler& air)
  {
    const Drifter& drifter = this->Drifters[o];
    DriftWeights weights = this->Weights();
    for (int k = 0; k < HarderPushes && !drifter.IsClear(this->Paths[o]); ++k)
    {
      weights.Barrier *= 10.0;
      SolveDrift(drifter.Problem(), air, weights, DriftIterations, this->Paths[o]);
    }
    return drifter.MakeExact(this->Paths[o]);
  }

  void Finish()
  {
    const AirSampler air(this->Air);
    const std::size_t count = this->Drifters.size();
    std::vector<char> clear(count, 1);
    this->Parallel(count,
                   [&](std::size_t begin, std::size_t end)
                   {
                     for (std::size_t o = begin; o < end; ++o)
                     {
                       clear[o] = this->FinishPath(o, air) ? 1 : 0;
                     }
                   });
    this->Note("finish", nullptr);
    for (std::size_t o = 0; o < count; ++o)
    {
      if (!clear[o])
      {
        this->Output.Warnings.push_back("object " +
                                        std::to_string(this->Drifters[o].Object().ObjectId) +
                                        ": the path leaves less than the clearance asked for");
      }
      Track track;
      track.ObjectId = this->Drifters[o].Object().ObjectId;
      track.Positions = this->Paths[o];
      const DriftProblem problem = this->Drifters[o].Problem();
      const std::vector<Vec3> between = DriftControls(problem, air, track.Positions);
      std::vector<Vec3> controls(track.Positions.size(), Vec3::Zero());
      for (std::size_t f = 0; f < track.Positions.size(); ++f)
      {
        track.AirVelocities.push_back(air.At(static_cast<int>(f), track.Positions[f]));
        const std::size_t before = f > 0 ? f - 1 : 0;
        const std::size_t after = std::min(f, between.size() - 1);
        controls[f] = 0.5 * (between[before] + between[after]);
      }
      this->Output.Tracks.push_back(std::move(track));
      this->Output.Controls.push_back(std::move(controls));
      for (Constraint& row : this->Output.Constraints)
      {
        for (const Constraint& own : this->Drifters[o].Rows())
        {
          if (own.Row == row.Row && own.Target == row.Target && own.ObjectId == row.ObjectId)
          {
            row.TouchDown = own.TouchDown;
          }
        }
      }
    }
    MeasureResiduals(this->Output.Constraints, this->Output.Tracks, this->Input.Objects,
                     this->Obstacles, this->Input.Scene, this->Output.Report);
    this->Output.Air = std::move(this->Air);
    this->Output.Vortices = this->Scene.Forces.Vortices;
  }

  void Note(const std::string& stage, const CommonWind* common)
  {
    const AirSampler air(this->Air);
    AssimilationRound row;
    row.Stage = stage;
    row.Candidate = this->Candidate;
    std::vector<double> byObject;
    double sum = 0.0, motion = 0.0, wind = 0.0;
    std::size_t count = 0;
    const double step = this->Input.Scene.Time.Step();
    std::vector<std::vector<Vec3>> velocities(this->Input.Tracks.front().Positions.size() - 1);
    for (std::size_t o = 0; o < this->Drifters.size(); ++o)
    {
      const DriftProblem problem = this->Drifters[o].Problem();
      const std::vector<Vec3> controls = DriftControls(problem, air, this->Paths[o]);
      double own = 0.0;
      std::size_t steps = 0;
      for (std::size_t k = 0; k < controls.size(); ++k)
      {
        if (problem.Flight[k] >= 1.0)
        {
          own += controls[k].squaredNorm();
          ++steps;
          velocities[k].push_back((this->Paths[o][k + 1] - this->Paths[o][k]) / step);
          if (common && k % WindStride == 0)
          {
            wind +=
              WindStride *
              common->At(0.5 * (this->Paths[o][k] + this->Paths[o][k + 1]), k + 0.5).squaredNorm();
          }
        }
      }
      sum += own;
      count += steps;
      byObject.push_back(steps > 0 ? std::sqrt(own / static_cast<double>(steps)) : 0.0);
    }
    for (const std::vector<Vec3>& at : velocities)
    {
      Vec3 mean = Vec3::Zero();
      for (const Vec3& v : at)
      {
        mean += v / static_cast<double>(at.size());
      }
      for (const Vec3& v : at)
      {
        motion += (v - mean).squaredNorm();
      }
    }
    std::sort(byObject.begin(), byObject.end());
    const double all = std::max<double>(1.0, static_cast<double>(count));
    row.Control = std::sqrt(sum / all);
    row.MedianControl = byObject[byObject.size() / 2];
    row.Motion = std::sqrt(motion / all);
    row.Wind = std::sqrt(wind / all);
    row.Seconds = this->Seconds();
    this->Output.Rounds.push_back(row);
  }

  double Seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - this->Begun).count();
  }

  const AssimilationInput& Input;
  const AssimilationOptions& Options;
  const SolidsOn& Solids;
  const ParallelFor& Parallel;
  Monitor& Caller;
  AssimilationOutput& Output;
  ObstacleSet Obstacles;
  DriftScene Around;
  std::vector<Drifter> Drifters;
  std::vector<std::vector<Vec3>> Paths;
  AirScene Scene;
  FieldSeries Air;
  std::string Candidate;
  std::chrono::steady_clock::time_point Begun = std::chrono::steady_clock::now();
};

} // namespace

std::array<int, 3> AirLatticeDimensions(const Box& volume, const AssimilationOptions& options)
{
  const Vec3 size = volume.Size();
  const double cell = size.maxCoeff() / (options.LatticeResolution - 1);
  std::array<int, 3> points{};
  for (int c = 0; c < 3; ++c)
  {
    points[static_cast<std::size_t>(c)] =
      std::max(3, static_cast<int>(std::lround(size[c] / cell)) + 1);
  }
  return points;
}

Result AssimilateAir(const AssimilationInput& input, const AssimilationOptions& options,
                     const SolidsOn& solids, const ParallelFor& parallel, Monitor& monitor,
                     AssimilationOutput& output)
{
  WAFT_RETURN_IF_FAILED(options.Validate());
  return Assimilation(input, options, solids, parallel, monitor, output).Run();
}

} // namespace waft
