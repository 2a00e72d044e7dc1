// SPDX-License-Identifier: BSD-3-Clause
#include "Chain/RunChain.h"

#include "Air/Run/BodyTurning.h"
#include "Base/StateArchive.h"
#include "Constraints/MotionProblem.h"
#include "Grid/NodeSolids.h"
#include "Planning/InputCheck.h"
#include "Spacetime/Run/Spacetime.h"
#include "Spacetime/Run/SpacetimeBudget.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <utility>

namespace waft
{
namespace
{

using Clock = std::chrono::steady_clock;

constexpr double HurriedInterval = 0.1; // s

/// Fields of the air's velocity at all frames, one after another.
FieldSeries AirOfFrames(const SampledAir& air, const Timeline& line)
{
  FieldSeries all{ static_cast<const SeriesLattice&>(air.Velocity) };
  all.Times.clear();
  for (int frame = 0; frame < line.NumberOfFrames; ++frame)
  {
    const double time = line.Time(frame);
    all.Times.push_back(time);
    all.Values.push_back(air.Velocity.Around(time).At(time));
  }
  return all;
}

/// Without an air to choose by, objects come at the ends of their windows.
void ArriveAsPlanned(int lastFrame, PlanOutput& plan)
{
  for (Constraint& row : plan.Constraints)
  {
    SetArrival(row.Frame, row.Value, row);
  }
  SetHolds(lastFrame, plan.Constraints);
  for (ReportRow& line : plan.Report)
  {
    line.Arrival = line.Frame;
  }
}

/// One run.
class Chain
{
public:
  Chain(const ChainInputs& inputs, const ChainOptions& options, const ParallelFor& parallel,
        Monitor& monitor, Motion& motion, ChainMemory& memory) :
    Inputs(inputs),
    Options(options), Parallel(parallel), Whole(monitor), Made(motion), Memory(memory)
  {
  }
  Result Run();

private:
  /// What a stage of the table is here.
  struct StageWork
  {
    Result (Chain::*Run)(Monitor& monitor); // null: it was run before
    void (*Clear)(Motion& motion);          // what it gives
  };
  static const StageWork& WorkOf(ChainStage stage);

  bool Wants(ChainStage stage) const
  {
    return stage <= this->Options.StopAfter && RunsAt(stage, this->Options.Detail);
  }
  Result CheckRoomAhead() const;
  void SetUp();
  /// Runs a stage when it is wanted, else clears what an earlier run left of it.
  Result Do(ChainStage stage);
  /// Whether the output is there of just this problem and these options; else it is cleared, with
  /// those of the stages after it.
  template <class... Own>
  bool IsKept(ChainStage stage, const MotionProblem& problem, const Own&... options);
  void Clear(ChainStage stage);
  double SecondsLeft() const;
  void LimitTime(double& limit) const;
  /// What the scene says, with the paths and rows that a stage begins with.
  MotionProblem ProblemOf(ChainStage stage) const;

  Result Plan(Monitor& monitor);
  Result Assimilate(Monitor& monitor);
  Result Optimise(Monitor& monitor);
  Result Turn(Monitor& monitor);
  Result Fit(Monitor& monitor);
  PlanAroundObstacles Around();
  bool HasAir() const { return !this->Made.Air.Air->Velocity.IsEmpty(); }

  const ChainInputs& Inputs;
  ChainOptions Options;
  const ParallelFor& Parallel;
  Monitor& Whole;
  Motion& Made;
  ChainMemory& Memory;
  Clock::time_point Start = Clock::now();
  std::vector<ObstacleMesh> Obstacles;
  FieldSeries Wind;
  std::uint64_t Key = 0;        // of the stage that works
  bool Hurries = false;         // somebody stopped it, and waits
  double Done = 0.0, All = 0.0; // shares of the time
};

Result Chain::CheckRoomAhead() const
{
  const Scene& scene = this->Inputs.TheScene;
  return this->Wants(ChainStage::Spacetime)
           ? CheckRoom(VolumeAboveGround(scene), scene.Info.Time.NumberOfFrames,
                       scene.Objects.size(), this->Options.Optimiser)
           : Result::Ok();
}

void Chain::SetUp()
{
  const Scene& scene = this->Inputs.TheScene;
  const std::int64_t seed =
    this->Options.Seed >= 0 ? this->Options.Seed : static_cast<std::int64_t>(scene.Info.Seed);
  this->Options.Plan.Seed = static_cast<std::uint64_t>(seed);
  this->Options.Air.Seed = static_cast<int>(seed);
  this->Options.Rotation.Seed = static_cast<std::uint64_t>(seed);
  if (this->Options.Turning)
  {
    this->Options.Turning->Seed = this->Options.Rotation.Seed;
  }
  this->Options.Fit.Seed = static_cast<std::uint64_t>(seed);
  this->Obstacles = ObstaclesOfFrames(scene.Obstacles, scene.Info.Time);
  this->Wind = this->Inputs.Wind.OfFrames(scene.Info.Time);
  for (const ChainStageTraits& stage : ChainStages())
  {
    this->All += this->Wants(stage.Stage) ? stage.Share : 0.0;
  }
  this->Made.IsStopped = false;
  this->Made.Efforts.clear();
  this->Made.Report.clear();
}

double Chain::SecondsLeft() const
{
  const std::chrono::duration<double> passed = Clock::now() - this->Start;
  return this->Options.TimeLimit - passed.count();
}

// What is left of the run's time, where that is less than a stage's own.
void Chain::LimitTime(double& limit) const
{
  constexpr double least = 0.001; // 0 is none
  if (this->Options.TimeLimit > 0.0)
  {
    const double left = std::max(this->SecondsLeft(), least);
    limit = limit > 0.0 ? std::min(limit, left) : left;
  }
}

MotionProblem Chain::ProblemOf(ChainStage stage) const
{
  const Scene& scene = this->Inputs.TheScene;
  return { scene.Info,      this->Made.PathsBefore(stage),
           scene.Objects,   this->Made.RowsBefore(stage),
           this->Obstacles, scene.Vortices,
           this->Wind };
}

template <class... Own>
bool Chain::IsKept(ChainStage stage, const MotionProblem& problem, const Own&... options)
{
  DigestStream stream;
  stream.Values(problem);
  for (const auto& [before, key] : this->Memory.Keys)
  {
    if (before < stage)
    {
      stream.Values(key);
    }
  }
  stream.Values(options...);
  this->Key = stream.Sum();
  const auto kept = this->Memory.Keys.find(stage);
  if (kept != this->Memory.Keys.end() && kept->second == this->Key)
  {
    return true;
  }
  for (const ChainStageTraits& later : ChainStages())
  {
    if (later.Stage >= stage)
    {
      this->Clear(later.Stage);
    }
  }
  return false;
}

const Chain::StageWork& Chain::WorkOf(ChainStage stage)
{
  static const std::map<ChainStage, StageWork> works = {
    { ChainStage::Scene, { nullptr, [](Motion&) {} } },
    { ChainStage::Planner,
      { &Chain::Plan,
        [](Motion& motion)
        {
          motion.Plan = PlanOutput();
          motion.Takes.clear();
        } } },
    { ChainStage::Assimilation,
      { &Chain::Assimilate, [](Motion& motion) { motion.Air = AssimilationOutput(); } } },
    { ChainStage::Spacetime,
      { &Chain::Optimise, [](Motion& motion) { motion.Optimised = SpacetimeOutput(); } } },
    { ChainStage::Rotation,
      { &Chain::Turn,
        [](Motion& motion)
        {
          motion.Turned = RotationOutput();
          motion.Tracks.clear();
          motion.Laid.clear();
        } } },
    { ChainStage::VortexFit, { &Chain::Fit, [](Motion& motion) { motion.Fit = AirVortexFit(); } } },
  };
  return works.at(stage);
}

void Chain::Clear(ChainStage stage)
{
  this->Memory.Keys.erase(stage);
  this->Made.Warnings.erase(stage);
  WorkOf(stage).Clear(this->Made);
}

Result Chain::Do(ChainStage stage)
{
  const bool isLast = stage == ChainStage::Rotation; // that bodies take; quick, of the best so far
  if (!this->Wants(stage) || (this->Made.IsStopped && !isLast))
  {
    this->Clear(stage);
    return Result::Ok();
  }
  const Effort start = Effort::Now();
  const double begin = this->Done;
  this->Done += TraitsOf(stage).Share / this->All;
  PartMonitor part(this->Whole, begin, this->Done);
  SilentMonitor silent;
  Monitor& monitor = this->Made.IsStopped ? static_cast<Monitor&>(silent) : part;
  this->Key = 0;
  const auto before = this->Memory.Keys.count(stage) > 0 ? this->Memory.Keys[stage] : 0;
  if (this->Inputs.Begins)
  {
    this->Inputs.Begins(stage);
  }
  const Result result = (this->*WorkOf(stage).Run)(monitor);
  if (!result)
  {
    this->Clear(stage);
    return result;
  }
  const bool isOver = this->Options.TimeLimit > 0.0 && this->SecondsLeft() <= 0.0;
  if (!this->Made.IsStopped && (result.IsStopped() || isOver))
  {
    this->Made.IsStopped = true;
    this->Made.StoppedIn = stage;
    this->Hurries = !isOver;
  }
  const bool isGiven = stage == ChainStage::Planner && this->Options.HasPlan;
  if (!isGiven && (this->Memory.Keys.count(stage) == 0 || before != this->Key))
  {
    this->Made.Efforts[stage] = Effort::Now().Since(start);
  }
  if (!this->Made.IsStopped)
  {
    this->Memory.Keys[stage] = this->Key;
  }
  const bool isHalfPlanned = stage == ChainStage::Planner && result.IsStopped();
  return this->Inputs.Ended && !isHalfPlanned ? this->Inputs.Ended(stage) : Result::Ok();
}

Result Chain::Plan(Monitor& monitor)
{
  if (this->Options.HasPlan)
  {
    this->Key = DigestOf(this->Made.Plan.Tracks);
    return Result::Ok();
  }
  const Scene& scene = this->Inputs.TheScene;
  MotionProblem problem{ scene.Info,     {}, scene.Objects, scene.Constraints, this->Obstacles,
                         scene.Vortices, {} };
  if (this->IsKept(ChainStage::Planner, problem, this->Options.Plan, this->Options.Takes))
  {
    return Result::Ok();
  }
  ObstacleSet obstacles;
  WAFT_RETURN_IF_FAILED(BuildPlanObstacles(this->Obstacles, obstacles));
  const PlanInput input{
    this->Inputs.Database, scene.Objects, scene.Constraints, obstacles, scene.Info, {},
    this->Inputs.Ranks
  };
  const Result result = PlanTakes(input, this->Options.Plan, this->Options.Takes, this->Parallel,
                                  monitor, this->Made.Plan, this->Made.Takes, &this->Memory.Plans);
  if (!RunsAt(ChainStage::Assimilation, this->Options.Detail))
  {
    ArriveAsPlanned(this->Inputs.TheScene.Info.Time.NumberOfFrames - 1, this->Made.Plan);
  }
  this->Made.Warnings[ChainStage::Planner] =
    PlanRemarks(this->Inputs.Database, scene.Info, this->Made.Plan);
  return result;
}

// Who gets another mark with an obstacle between is planned as all were.
PlanAroundObstacles Chain::Around()
{
  if (this->Inputs.Database.Segments.empty()) // the plan was given
  {
    return nullptr;
  }
  const auto memory = std::make_shared<PlanCache>();
  return [this, memory](const std::vector<MotionObject>& objects, std::vector<Constraint> rows)
  {
    for (Constraint& row : rows)
    {
      row.Choice = ObjectChoice::Given;
    }
    std::vector<std::vector<Vec3>> paths(objects.size());
    ObstacleSet obstacles;
    PlanOutput plan;
    SilentMonitor silent;
    if (!BuildPlanObstacles(this->Obstacles, obstacles) ||
        !PlanMotion({ this->Inputs.Database, objects, rows, obstacles, this->Inputs.TheScene.Info },
                    this->Options.Plan, this->Parallel, silent, plan, memory.get()))
    {
      return paths;
    }
    for (std::size_t o = 0; o < paths.size(); ++o)
    {
      if (plan.Objects[o].Status == ConstraintStatus::Met)
      {
        paths[o] = std::move(plan.Tracks[o].Positions);
      }
    }
    return paths;
  };
}

Result Chain::Assimilate(Monitor& monitor)
{
  AssimilationInput problem{ this->ProblemOf(ChainStage::Assimilation),
                             this->Inputs.TheScene.Shapes,
                             this->Options.Turning.value_or(this->Options.Rotation),
                             this->Inputs.Ranks,
                             this->Inputs.Drawn,
                             this->Around() };
  AssimilationOptions motion = this->Options.Air; // without what changes nothing of it
  motion.CheckpointFile = motion.StateFile = std::string();
  motion.TimeLimit = 0.0;
  if (this->IsKept(ChainStage::Assimilation, problem, problem.Shapes, motion, problem.Turning))
  {
    return Result::Ok();
  }
  WAFT_RETURN_IF_FAILED(problem.Wind.Validate("Wind"));
  AssimilationOptions options = this->Options.Air;
  this->LimitTime(options.TimeLimit);
  const SolidsOn solids = [this](const SmokeOptions& smoke)
  { return NodeSolids(this->Obstacles, smoke); };
  const Result result = AssimilateAir(problem, options, solids, this->Parallel, monitor,
                                      this->Made.Air, &this->Memory.Air);
  this->Made.Warnings[ChainStage::Assimilation] = this->Made.Air.Warnings;
  return result;
}

Result Chain::Optimise(Monitor& monitor)
{
  SpacetimeInput input{ this->ProblemOf(ChainStage::Spacetime), {} };
  if (this->HasAir())
  {
    input.Vortices = this->Made.Air.Vortices;
  }
  else
  {
    const std::vector<Vortex>& planned = this->Made.Plan.Vortices;
    input.Vortices.insert(input.Vortices.end(), planned.begin(), planned.end());
  }
  SpacetimeOptions motion = this->Options.Optimiser; // likewise
  motion.CheckpointFile.clear();
  motion.TimeLimit = 0.0;
  if (this->IsKept(ChainStage::Spacetime, input, motion))
  {
    return Result::Ok();
  }
  WAFT_RETURN_IF_FAILED(input.Wind.Validate("Wind"));
  if (this->HasAir())
  {
    input.Air = AirOfFrames(*this->Made.Air.Air, input.Scene.Time);
  }
  SpacetimeOptions options = this->Options.Optimiser;
  this->LimitTime(options.TimeLimit);
  const Result result = RunSpacetime(input, options, this->Parallel, monitor, this->Made.Optimised);
  this->Made.Warnings[ChainStage::Spacetime] = this->Made.Optimised.Warnings;
  return result;
}

Result Chain::Turn(Monitor& monitor)
{
  const Scene& scene = this->Inputs.TheScene;
  if (this->Made.Paths().size() < scene.Objects.size())
  {
    return Result::Stopped(); // while they were planned
  }
  MotionProblem problem = this->ProblemOf(ChainStage::Rotation);
  if (this->IsKept(ChainStage::Rotation, problem, this->Options.Rotation))
  {
    return Result::Ok();
  }
  RotationInput input;
  input.Scene = scene.Info;
  input.Objects = scene.Objects;
  input.Shapes = scene.Shapes;
  input.Tracks = std::move(problem.Tracks);
  input.Constraints = std::move(problem.Constraints);
  AirOnTracks air(input.Tracks, scene.Info.Time);
  // To somebody who waits a tenth of a second between two fields is good enough.
  const int step =
    this->Hurries
      ? std::max(1,
                 static_cast<int>(std::lround(HurriedInterval * scene.Info.Time.FramesPerSecond)))
      : 1;
  for (int frame = 0; this->HasAir() && frame < scene.Info.Time.NumberOfFrames; frame += step)
  {
    WAFT_RETURN_IF_FAILED(
      air.Add(FieldAt(this->Made.Air.Air->Velocity, scene.Info.Time.Time(frame))));
  }
  air.Finish();
  ObstacleSet obstacles;
  WAFT_RETURN_IF_FAILED(obstacles.Build(this->Obstacles));
  input.Air = &air;
  input.Obstacles = &obstacles;
  input.Wind = &this->Wind;
  input.Ranks = this->Inputs.Ranks;
  const Result result =
    RunRotationRefine(input, this->Options.Rotation, this->Parallel, monitor, this->Made.Turned);
  if (result && !result.IsStopped())
  {
    this->Made.Tracks = std::move(input.Tracks);
    this->Made.Laid = ApplyShifts(this->Made.Turned, this->Made.Tracks);
    this->Made.Warnings[ChainStage::Rotation] = this->Made.Turned.Warnings;
  }
  return result;
}

Result Chain::Fit(Monitor& monitor)
{
  const MotionProblem problem = this->ProblemOf(ChainStage::VortexFit);
  if (this->IsKept(ChainStage::VortexFit, problem, this->Options.Fit))
  {
    return Result::Ok();
  }
  VortexFitOptions options = this->Options.Fit;
  options.Bounds = problem.Scene.Bounds;
  return FitAirVortices(problem.Tracks, problem.Scene.Time, {}, options, monitor, this->Made.Fit);
}

Result Chain::Run()
{
  WAFT_RETURN_IF_FAILED(this->Options.Validate());
  WAFT_RETURN_IF_FAILED(this->CheckRoomAhead());
  this->SetUp();
  for (const ChainStageTraits& stage : ChainStages())
  {
    if (WorkOf(stage.Stage).Run != nullptr)
    {
      WAFT_RETURN_IF_FAILED(this->Do(stage.Stage));
    }
  }
  this->Made.Report = JoinReports(this->Made.ReportOf(this->Made.MovedBy()), this->Made.Plan.Report,
                                  this->Made.Turned.Report, this->Made.RowsAtLast());
  return this->Made.IsStopped ? Result::Stopped() : Result::Ok();
}

} // namespace

Result RunChain(const ChainInputs& inputs, const ChainOptions& options, const ParallelFor& parallel,
                Monitor& monitor, Motion& motion, ChainMemory* memory)
{
  ChainMemory none;
  return Chain(inputs, options, parallel, monitor, motion, memory != nullptr ? *memory : none)
    .Run();
}

std::string DigestOfRun(const Scene& scene, const SceneWind& wind, const ChainOptions& options)
{
  ChainOptions own = options;
  own.Air.CheckpointFile = own.Air.StateFile = own.Air.EditOf = std::string();
  own.Optimiser.CheckpointFile.clear();
  own.Optimiser.CheckpointInterval = 0.0;
  own.Air.TimeLimit = own.Optimiser.TimeLimit = own.Optimiser.MemoryLimit = 0.0;
  const MotionProblem problem{ scene.Info,
                               {},
                               scene.Objects,
                               scene.Constraints,
                               ObstaclesOfFrames(scene.Obstacles, scene.Info.Time),
                               scene.Vortices,
                               wind.OfFrames(scene.Info.Time) };
  DigestStream sum;
  const int detail = static_cast<int>(own.Detail);
  const RotationOptions turning = own.Turning.value_or(own.Rotation);
  sum.Values(problem, scene.Shapes, detail, own.Seed, own.Plan, own.Takes, own.Air, turning,
             own.Optimiser, own.Rotation, own.Fit);
  constexpr const char* digits = "0123456789abcdef";
  std::string text;
  for (const char byte : sum.Text())
  {
    text += digits[static_cast<unsigned char>(byte) >> 4u];
    text += digits[static_cast<unsigned char>(byte) & 15u];
  }
  return text;
}

} // namespace waft
