// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Run/SpacetimeRun.h"

#include "Spacetime/Paper/FieldPenalty.h"
#include "Spacetime/Run/InitialObjects.h"
#include "Spacetime/Run/Schedule.h"
#include "Spacetime/Run/SpacetimeBudget.h"
#include "Spacetime/Run/StageProgress.h"
#include "Spacetime/Scene/InitialGas.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace waft
{
namespace
{

constexpr double CoarseTimeFraction = 0.5; // of a time limit, for the coarse levels
constexpr double ForUpdates = 1.03;        // work with that for the fields, over that without

} // namespace

SpacetimeRun::SpacetimeRun(const SpacetimeInput& input, const SpacetimeOptions& options,
                           const SpacetimeSetup& problem, const ParallelFor& parallel,
                           Monitor& monitor, SpacetimeOutput& output) :
  Input(input),
  Options(options), Problem(problem), Parallel(parallel), Progress(monitor), Output(output),
  Clock(std::chrono::steady_clock::now())
{
}

Result SpacetimeRun::Run(StateVector start)
{
  this->Output.Spacing = this->Problem.Spacing;
  if (this->Progress.Publishes())
  {
    this->Output.Tracks = this->Input.Tracks;
  }
  WAFT_RETURN_IF_FAILED(this->Begin(std::move(start)));
  this->AllWork =
    std::max(1.0, ForUpdates * this->State.Plan.Work(0, this->Problem.Model.NumberOfFrames));
  while (!this->Stopped && !this->State.IsDone() && this->RunStage())
  {
  }
  this->LeaveLevel();
  return this->Export();
}

double SpacetimeRun::Elapsed() const
{
  const std::chrono::duration<double> d = std::chrono::steady_clock::now() - this->Clock;
  return d.count();
}

bool SpacetimeRun::TimeIsUp() const
{
  const double fraction = this->State.Coarseness > 0 ? CoarseTimeFraction : 1.0;
  const double limit = this->Options.TimeLimit * fraction;
  return limit > 0.0 && this->Elapsed() > limit;
}

double SpacetimeRun::FractionAt(std::size_t stage) const
{
  return 1.0 - this->State.Plan.Work(stage, this->Problem.Model.NumberOfFrames) / this->AllWork;
}

void SpacetimeRun::Record(int pass, const std::string& stage, int iteration,
                          const SpacetimeTerms& terms, double violation, double leash)
{
  ConvergenceRow row;
  static_cast<SpacetimeTerms&>(row) = terms;
  row.Pass = pass;
  row.Stage = stage;
  row.Iteration = iteration;
  row.MaxViolation = std::max(0.0, violation) * this->Problem.Spacing;
  row.Leash = leash;
  row.Seconds = this->Elapsed();
  row.SetShares(!this->Problem.Model.Air.IsEmpty());
  this->State.Log.push_back(std::move(row));
}

SpacetimeTerms SpacetimeRun::Measure(const StateVector& motion) const
{
  const TimeLevel full =
    TimeLevel::Full(this->Problem.Model.NumberOfFrames, this->Options.TemporalWindow);
  SpacetimeTerms terms;
  SpacetimeObjective(this->Problem.Model, this->State.Fields, full, this->Parallel,
                     FastestSphKernels(), false)
    .Evaluate(motion, nullptr, terms);
  return terms;
}

Result SpacetimeRun::Begin(StateVector start)
{
  const SpacetimeModel& model = this->Problem.Model;
  this->State.Motion = std::move(start);
  this->State.Fields = model.Fields;
  this->State.Fields.Cost = FieldCost(model, this->State.Fields);
  this->State.Plan = PlanSchedule(this->Problem, this->Options, this->Input.Scene.Bounds.Width());
  const SpacetimeTerms terms = this->Measure(this->State.Motion);
  if (!std::isfinite(terms.E))
  {
    return Result::Error("Tracks: the planned motion has no finite cost");
  }
  this->State.StartEnergy = terms.E;
  this->Record(0, "initial", 0, terms, 0.0, 0.0);
  StageProgress monitor(this->Progress, 0.0, 0.0, 1);
  monitor.Text = "spacetime: letting the objects give way";
  StateVector& motion = this->State.Motion;
  const TimeLevel full = TimeLevel::Full(model.NumberOfFrames, this->Options.TemporalWindow);
  const bool goesOn = model.Air.IsEmpty() || MakeInitialObjects(model, this->Problem.Table, full,
                                                                this->Parallel, monitor, motion);
  monitor.Text = "spacetime: moving the gas";
  SpacetimeObjective objective(model, this->State.Fields, full, this->Parallel, FastestSphKernels(),
                               false); // one frame after the other
  const bool moves = this->Options.MoveGas || !model.Air.IsEmpty();
  if (goesOn && moves && MakeInitialGas(objective, this->Parallel, monitor, motion))
  {
    this->Record(0, "gas moved", 0, this->Measure(motion), 0.0, 0.0);
  }
  this->Stopped = !monitor.Going;
  this->State.Beginning = motion;
  return Result::Ok();
}

void SpacetimeRun::MakeLevel(int coarseness)
{
  const SpacetimeModel& model = this->Problem.Model;
  const TimeLevel level =
    this->State.Plan.LevelOf(coarseness, model.NumberOfFrames, this->Options.TemporalWindow);
  this->View.emplace(model, level);
  this->State.Coarseness = coarseness;
  const TimeLevel& times = this->View->Level();
  this->Window = SpacetimeBudget(model, this->Options)
                   .WindowOf(times.NumberOfFrames(), this->Options.MemoryLimit);
  const int history = this->HasWindows(times) ? 0 : this->Options.HistorySize;
  this->Solver = std::make_unique<LevelSolver>(model, this->State.Fields, this->Problem.Table,
                                               times, this->Parallel, history);
}

void SpacetimeRun::EnterLevel(int coarseness)
{
  if (this->Solver && coarseness == this->State.Coarseness)
  {
    return;
  }
  this->LeaveLevel();
  this->MakeLevel(coarseness);
  this->State.Part = this->View->Take(this->State.Motion);
}

void SpacetimeRun::LeaveLevel()
{
  if (!this->Solver)
  {
    return;
  }
  this->Solver.reset(); // before the next one, which is as large
  this->State.Curvature = LbfgsMemory();
  this->View->Merge(std::exchange(this->State.Part, StateVector()), this->State.Motion);
}

bool SpacetimeRun::RunStage()
{
  const Stage& stage = this->State.Now();
  this->EnterLevel(stage.Coarseness);
  bool isDone = false;
  if (stage.IsUpdate())
  {
    isDone = this->UpdateFields(stage);
  }
  else
  {
    isDone = this->HasWindows(this->Solver->Level) ? this->MinimiseInWindows(stage)
                                                   : this->Minimise(stage);
  }
  if (isDone)
  {
    ++this->State.Next;
    return true;
  }
  if (this->State.Coarseness > 0 && !this->Stopped) // its part of the time is up
  {
    this->State.Next = this->State.Plan.FirstFine();
    return true;
  }
  return false;
}

} // namespace waft
