// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Run/SpacetimeRun.h"

#include "Spacetime/Fields/FieldUpdates.h"
#include "Spacetime/Model/LevelTransfer.h"
#include "Spacetime/Run/StepMonitor.h"
#include "Spacetime/Scene/InitialGas.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace waft
{
namespace
{

constexpr double CoarseTimeFraction = 0.5; // of a time limit, for the coarse levels

} // namespace

SpacetimeRun::SpacetimeRun(const SpacetimeInput& input, const SpacetimeOptions& options,
                           const ParallelFor& parallel, Monitor& monitor, SpacetimeOutput& output,
                           SpacetimeWarmStart* memory, Communicator& ranks) :
  Input(input),
  Options(options), Parallel(parallel), Ranks(ranks), Own(monitor), Progress(monitor, ranks),
  Output(output), Memory(memory), Clock(std::chrono::steady_clock::now())
{
}

double SpacetimeRun::Elapsed() const
{
  const std::chrono::duration<double> d = std::chrono::steady_clock::now() - this->Clock;
  return d.count();
}

bool SpacetimeRun::TimeIsUp() const
{
  const double fraction = this->Coarseness > 0 ? CoarseTimeFraction : 1.0;
  const double limit = this->Options.TimeLimit * fraction;
  return limit > 0.0 && this->Ranks.Decide(this->Elapsed() > limit);
}

void SpacetimeRun::Record(int pass, const std::string& stage, int iteration,
                          const SpacetimeTerms& terms, double violation, double leash)
{
  ConvergenceRow row;
  static_cast<SpacetimeTerms&>(row) = terms;
  row.Pass = pass;
  row.Stage = stage;
  row.Iteration = iteration;
  row.MaxViolation = std::max(0.0, violation) * this->Setup.Spacing;
  row.Leash = leash;
  row.Seconds = this->Seconds();
  this->Output.Convergence.push_back(std::move(row));
}

SpacetimeTerms SpacetimeRun::Measure()
{
  const TimeLevel full =
    TimeLevel::Full(this->Setup.Model.NumberOfFrames, this->Options.TemporalWindow);
  const FramePartition partition = PartitionOf(full, this->Ranks).HoldingAll();
  SpacetimeObjective objective(this->Setup.Model, full, this->Parallel, FastestSphKernels(), false,
                               &partition);
  SpacetimeTerms terms;
  objective.Evaluate(this->State, nullptr, terms);
  return terms;
}

Result SpacetimeRun::Begin()
{
  this->State = std::move(this->Setup.Start);
  this->Program = PlanProgram(this->Setup, this->Options, this->Input.Scene.Bounds.Width());
  const SpacetimeTerms terms = this->Measure();
  if (!std::isfinite(terms.E))
  {
    return Result::Error("Tracks: the planned motion has no finite cost");
  }
  this->StartEnergy = terms.E;
  this->Record(0, "initial", 0, terms, 0.0, 0.0);
  bool isMoved = false;
  StepMonitor monitor(this->Own, 0.0, 0.0, 1);
  monitor.Text = "spacetime: moving the gas";
  if (this->Ranks.IsFirst()) // one frame after the other: there is nothing to partition
  {
    const SpacetimeModel& model = this->Setup.Model;
    const TimeLevel full = TimeLevel::Full(model.NumberOfFrames, this->Options.TemporalWindow);
    SpacetimeObjective objective(model, full, this->Parallel, FastestSphKernels(), false);
    isMoved = MakeInitialGas(objective, this->Parallel, monitor, this->State);
  }
  if (this->Ranks.Decide(isMoved))
  {
    this->Ranks.Broadcast(this->State.data(), this->State.size() * sizeof(float));
    this->Record(0, "gas moved", 0, this->Measure(), 0.0, 0.0);
  }
  this->Stopped = !this->Ranks.Decide(monitor.Going);
  this->Beginning = this->State;
  return Result::Ok();
}

void SpacetimeRun::EnterLevel(int coarseness)
{
  if (this->Solver && coarseness == this->Coarseness)
  {
    return;
  }
  this->LeaveLevel();
  const SpacetimeModel& model = this->Setup.Model;
  TimeLevel level =
    this->Program.LevelOf(coarseness, model.NumberOfFrames, this->Options.TemporalWindow);
  if (coarseness > 0 && this->PartState.empty())
  {
    this->PartState = Restrict(model, level, this->State);
  }
  if (!this->Region.IsEmpty())
  {
    level = level.Part(static_cast<std::size_t>(this->Region.First),
                       static_cast<std::size_t>(this->Region.Last));
    const float* begin = this->State.data() + level.Frames.front() * model.FrameSize();
    this->PartState.assign(begin, begin + level.NumberOfFrames() * model.FrameSize());
  }
  this->Coarseness = coarseness;
  const SpacetimeBudget budget(model, this->Options);
  this->Window = budget.WindowOf(level.NumberOfFrames(), this->Options.MemoryLimit);
  const int history = this->HasWindows(level) ? 0 : this->Options.HistorySize;
  this->Solver =
    std::make_unique<LevelSolver>(this->Setup.Model, this->Setup.Table, std::move(level),
                                  this->Parallel, this->Ranks, history, this->Region.Movable);
  if (this->IsPartitioned())
  {
    const bool isPart = coarseness > 0 || !this->Region.IsEmpty();
    this->PartState = this->Solver->Partition.Take(
      std::move(isPart ? this->PartState : this->State), model.FrameSize());
    if (this->Region.IsEmpty())
    {
      this->State = StateVector(); // LeaveLevel makes it anew
    }
  }
}

void SpacetimeRun::LeaveLevel()
{
  if (!this->Solver)
  {
    return;
  }
  const SpacetimeModel& model = this->Setup.Model;
  const TimeLevel level = this->Solver->Level;
  const FramePartition partition = this->Solver->Partition;
  const bool isPartitioned = this->IsPartitioned();
  this->Solver.reset(); // before the next one, which is as large
  if (isPartitioned)
  {
    this->PartState = partition.Whole(std::move(this->PartState), model.FrameSize());
  }
  if (this->Coarseness > 0)
  {
    this->State.resize(model.NumberOfFrames * model.FrameSize());
    Prolong(model, level, this->PartState, this->State);
  }
  else if (!this->Region.IsEmpty())
  {
    std::copy(this->PartState.begin(), this->PartState.end(),
              this->State.data() + level.Frames.front() * model.FrameSize());
  }
  else if (isPartitioned)
  {
    this->State = std::move(this->PartState);
  }
  this->PartState = StateVector();
}

void SpacetimeRun::TakeSteps()
{
  const std::vector<SpacetimeStep>& steps = this->Program.Steps;
  while (!this->Stopped && this->Next < steps.size())
  {
    const SpacetimeStep& step = steps[this->Next];
    this->EnterLevel(step.Coarseness);
    this->MarkState();
    const bool windows = !step.IsUpdate && this->HasWindows(this->Solver->Level);
    if (step.IsUpdate ? this->UpdateFields(step)
                      : (windows ? this->MinimizeInWindows(step) : this->Minimize(step)))
    {
      ++this->Next;
    }
    else if (this->Coarseness > 0 && !this->Stopped) // its partition of the time is up
    {
      this->Next = this->Program.FirstFine();
    }
    else
    {
      break;
    }
    this->IsInside = false;
  }
  this->LeaveLevel();
}

bool SpacetimeRun::Minimize(const SpacetimeStep& step)
{
  const int frames = this->Setup.Model.NumberOfFrames;
  const double from = 1.0 - this->Program.Work(this->Next, frames) / this->AllWork;
  const double to = 1.0 - this->Program.Work(this->Next + 1, frames) / this->AllWork;
  StepMonitor monitor(this->Progress, from, to, step.Iterations);
  monitor.Text = "spacetime: " + step.Name;
  LevelSolver& solver = *this->Solver;
  monitor.Done = this->IsInside ? solver.Solver->NumberOfIterations() : 0;
  StateVector& state = this->LevelState();
  solver.Constraints.SetLeash(step.Leash / this->Setup.Spacing);
  LbfgsOptions options;
  options.MaximumNumberOfIterations = step.Iterations;
  options.Tolerance = this->Options.Tolerance;
  options.GoesOn = std::exchange(this->IsInside, true);
  const auto observer = [&](int iteration, const SpacetimeTerms& terms)
  {
    this->Record(step.Pass, step.Name, iteration, terms, solver.Constraints.MaxViolation(state),
                 step.Leash);
    monitor.Done = iteration;
    char text[160];
    std::snprintf(text, sizeof(text), "spacetime: %s, iteration %d, E = %.4g", step.Name.c_str(),
                  iteration, terms.E);
    monitor.Text = text;
    const bool isUp = this->TimeIsUp();
    this->KeepCheckpoint(isUp);
    this->MarkState();
    this->IsCut = this->IsCut || isUp;
    return !isUp;
  };
  const LbfgsEnd end =
    solver.Solver->Minimize(solver.Objective, solver.Preconditioner, solver.Constraints, options,
                            observer, &monitor, state);
  this->Stopped = this->Stopped || !monitor.Going;
  this->KeepState();
  return end != LbfgsEnd::Stopped;
}

bool SpacetimeRun::UpdateFields(const SpacetimeStep& step)
{
  const double done =
    1.0 - this->Program.Work(this->Next, this->Setup.Model.NumberOfFrames) / this->AllWork;
  StepMonitor monitor(this->Progress, done, done, 1);
  StepMonitor fitMonitor(this->Own, done, done, 1);
  LevelSolver& solver = *this->Solver;
  const StateVector& state = this->LevelState();
  SpacetimeModel& model = this->Setup.Model;
  const std::vector<Vortex> vortices = model.Vortices;
  const SplineWind wind = model.Wind;
  const std::size_t rows = this->Output.Convergence.size();
  SpacetimeTerms terms;
  bool going = true;
  const double violation = solver.Constraints.MaxViolation(state);
  if (step.FitsVortices && this->Options.FitVortexFields && !model.Vortices.empty())
  {
    monitor.Text = fitMonitor.Text = "spacetime: fitting vortices";
    going = UpdateVortices(model, this->Setup, solver.Objective, this->Input.Tracks,
                           this->Input.Scene.Bounds, this->Input.Scene.Seed, state, monitor,
                           fitMonitor, terms);
    if (going)
    {
      this->Record(step.Pass, "vortices " + std::to_string(step.Pass), 0, terms, violation, 0.0);
    }
  }
  if (going && this->Options.EstimateWind)
  {
    monitor.Text = "spacetime: estimating the wind";
    going = UpdateWind(model, solver.Objective, state, this->Parallel, &monitor, terms);
    if (going)
    {
      this->Record(step.Pass, "wind " + std::to_string(this->Output.Convergence.size()), 0, terms,
                   violation, 0.0);
    }
  }
  if (!going) // done as a whole or not at all
  {
    model.Vortices = vortices;
    model.Wind = wind;
    this->Output.Convergence.resize(rows);
    this->Stopped = true;
    this->KeepState();
  }
  return going;
}

Result SpacetimeRun::Run()
{
  if (Result result = MakeSetup(this->Input, this->Options, this->Setup); !result)
  {
    return result;
  }
  const SpacetimeModel& model = this->Setup.Model;
  WAFT_RETURN_IF_FAILED(SpacetimeBudget(model, this->Options)
                          .Validate(static_cast<std::size_t>(model.NumberOfFrames), this->Options));
  this->Output.Spacing = this->Setup.Spacing;
  if (!this->Resume() && !this->GoOn())
  {
    if (Result result = this->Begin(); !result)
    {
      return result;
    }
  }
  constexpr double ForUpdates = 1.03;
  this->AllWork =
    std::max(1.0, ForUpdates * this->Program.Work(0, this->Setup.Model.NumberOfFrames));
  this->TakeSteps();
  return this->Finish();
}

} // namespace waft
