// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Spacetime.h"

#include "Obstacles/ConstraintCheck.h"
#include "Spacetime/FieldUpdates.h"
#include "Spacetime/GasStart.h"
#include "Spacetime/Lbfgs.h"
#include "Spacetime/SpacetimeExport.h"
#include "Spacetime/SpacetimeSetup.h"
#include "Spacetime/TimeLevels.h"
#include "Spacetime/WindEstimate.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>

namespace waft
{
namespace
{

constexpr int LeashSteps = 5;           // radii 0.01 L 2^k, k = 0..4
constexpr double FirstLeash = 0.01;     // of L
constexpr int CoarseStride = 2;         // frames; a larger one lets gas escape
constexpr double WorthCoarsening = 0.8; // a coarse level has fewer frames than this share of all
constexpr double CoarseTimeShare = 0.5; // of a time limit, for the coarse level

/// A level of time with everything that solves on it.
struct LevelSolver
{
  LevelSolver(const SpacetimeModel& model, TimeLevel times, const ConstraintTable& table,
              const ParallelFor& parallel, int history) :
    Level(std::move(times)),
    Objective(model, this->Level, parallel, FastestSphKernels()),
    Preconditioner(model, this->Level, parallel), Constraints(model, this->Level, table, parallel),
    Solver(this->Level.NumberOfFrames(), model.FrameSize(), parallel, history)
  {
  }
  TimeLevel Level;
  SpacetimeObjective Objective;
  TimelinePreconditioner Preconditioner;
  HardConstraints Constraints;
  Lbfgs Solver;
};

/// Progress of one stage as a part of the whole.
class StageMonitor : public Monitor
{
public:
  StageMonitor(Monitor& outer, double from, double to, int steps) :
    Outer(outer), From(from), To(to), Steps(std::max(1, steps))
  {
  }
  bool Tick(double fraction, const std::string&) override
  {
    const double done = std::min(1.0, (this->Done + fraction) / this->Steps);
    this->Going =
      this->Outer.Tick(this->From + (this->To - this->From) * done, this->Text) && this->Going;
    return this->Going;
  }
  int Done = 0;
  std::string Text;
  bool Going = true;

private:
  Monitor& Outer;
  double From, To;
  int Steps;
};

class SpacetimeRun
{
public:
  SpacetimeRun(const SpacetimeInput& input, const SpacetimeOptions& options,
               const ParallelFor& parallel, Monitor& monitor, SpacetimeOutput& output) :
    Input(input),
    Options(options), Parallel(parallel), Progress(monitor), Output(output),
    Clock(std::chrono::steady_clock::now())
  {
  }

  Result Run();

private:
  double Seconds() const
  {
    const std::chrono::duration<double> d = std::chrono::steady_clock::now() - this->Clock;
    return d.count();
  }
  bool TimeIsUp() const
  {
    return this->Options.TimeLimit > 0.0 && this->Seconds() > this->Options.TimeLimit * this->Share;
  }
  void Record(int pass, const std::string& stage, int iteration, const SpacetimeTerms& terms,
              double violation, double leash);
  /// The following return false when the run was stopped.
  bool Minimize(LevelSolver& solver, StateVector& state, int pass, const std::string& stage,
                int iterations, double leash);
  bool UpdateFields(LevelSolver& solver, const StateVector& state, int pass, bool vortices);
  /// Of each of the two stages that follow a coarse level: large changes are made there, for half
  /// the work.
  int LastIterations() const { return (this->Options.MaximumNumberOfIterations + 2) / 3; }
  bool SolveCoarse();
  bool SolveFine(LevelSolver& fine);
  void Plan();

  const SpacetimeInput& Input;
  const SpacetimeOptions& Options;
  ParallelFor Parallel;
  Monitor& Progress;
  SpacetimeOutput& Output;
  std::chrono::steady_clock::time_point Clock;
  SpacetimeSetup Setup;
  StateVector State;
  double Share = 1.0;      // of the time limit, that the present level may use
  double Work = 0.0;       // done, in evaluations at full resolution
  double AllWork = 1.0;    // expected
  std::vector<int> Coarse; // frames; empty: none worth while
  bool Stopped = false;    // by the monitor
};

void SpacetimeRun::Record(int pass, const std::string& stage, int iteration,
                          const SpacetimeTerms& terms, double violation, double leash)
{
  ConvergenceRow row;
  row.Pass = pass;
  row.Stage = stage;
  row.Iteration = iteration;
  row.E = terms.E;
  row.Ex = terms.Ex;
  row.Ev = terms.Ev;
  row.Ec = terms.Ec;
  row.MaxViolation = std::max(0.0, violation) * this->Setup.Spacing;
  row.Leash = leash;
  row.Seconds = this->Seconds();
  this->Output.Convergence.push_back(std::move(row));
}

bool SpacetimeRun::Minimize(LevelSolver& solver, StateVector& state, int pass,
                            const std::string& stage, int iterations, double leash)
{
  const double scale =
    static_cast<double>(solver.Level.NumberOfFrames()) / this->Setup.Model.NumberOfFrames;
  const double from = this->Work / this->AllWork;
  this->Work += scale * iterations;
  StageMonitor monitor(this->Progress, std::min(1.0, from),
                       std::min(1.0, this->Work / this->AllWork), iterations);
  monitor.Text = "spacetime: " + stage;
  solver.Constraints.SetLeash(leash / this->Setup.Spacing);
  LbfgsOptions options;
  options.MaximumNumberOfIterations = iterations;
  options.Tolerance = this->Options.Tolerance;
  const auto observer = [&](int iteration, const SpacetimeTerms& terms)
  {
    this->Record(pass, stage, iteration, terms, solver.Constraints.MaxViolation(state), leash);
    monitor.Done = iteration;
    char text[160];
    std::snprintf(text, sizeof(text), "spacetime: %s, iteration %d, E = %.4g", stage.c_str(),
                  iteration, terms.E);
    monitor.Text = text;
    return !this->TimeIsUp();
  };
  const LbfgsEnd end =
    solver.Solver.Minimize(solver.Objective, solver.Preconditioner, solver.Constraints, options,
                           observer, &monitor, state);
  this->Stopped = this->Stopped || !monitor.Going;
  return end != LbfgsEnd::Stopped;
}

bool SpacetimeRun::UpdateFields(LevelSolver& solver, const StateVector& state, int pass,
                                bool vortices)
{
  StageMonitor monitor(this->Progress, std::min(1.0, this->Work / this->AllWork),
                       std::min(1.0, this->Work / this->AllWork), 1);
  SpacetimeTerms terms;
  bool going = true;
  const double violation = solver.Constraints.MaxViolation(state);
  if (vortices && this->Options.FitVortexFields && !this->Setup.Model.Vortices.empty())
  {
    monitor.Text = "spacetime: fitting vortices";
    going = UpdateVortices(this->Setup, solver.Objective, this->Input.Tracks,
                           this->Input.Scene.Bounds, this->Input.Scene.Seed, state, monitor, terms);
    if (going)
    {
      this->Record(pass, "vortices " + std::to_string(pass), 0, terms, violation, 0.0);
    }
  }
  if (going && this->Options.EstimateWind)
  {
    monitor.Text = "spacetime: estimating the wind";
    going = UpdateWind(this->Setup.Model, solver.Objective, state, this->Parallel, &monitor, terms);
    if (going)
    {
      this->Record(pass, "wind " + std::to_string(this->Output.Convergence.size()), 0, terms,
                   violation, 0.0);
    }
  }
  this->Stopped = this->Stopped || !monitor.Going;
  return going;
}

bool SpacetimeRun::SolveCoarse()
{
  LevelSolver coarse(this->Setup.Model, TimeLevel::Make(this->Coarse, this->Options.TemporalWindow),
                     this->Setup.Table, this->Parallel, this->Options.HistorySize);
  StateVector state = Restrict(this->Setup.Model, coarse.Level, this->State);
  const int iterations = this->Options.MaximumNumberOfIterations;
  bool going = true;
  for (int step = 0; step < LeashSteps && this->Options.UseLeash && going; ++step)
  {
    const double radius = FirstLeash * this->Input.Scene.Bounds.Width() * (1 << step);
    char name[64];
    std::snprintf(name, sizeof(name), "leash %.3g m, coarse", radius);
    going = this->Minimize(coarse, state, 1, name, this->Options.LeashIterations, radius);
  }
  for (int pass = 1; pass <= this->Options.Passes && going; ++pass)
  {
    const std::string name = "free " + std::to_string(pass) + ", coarse";
    going = this->Minimize(coarse, state, pass, name + " a", iterations / 2, 0.0) &&
            this->UpdateFields(coarse, state, pass, false) &&
            this->Minimize(coarse, state, pass, name + " b", iterations / 2, 0.0) &&
            this->UpdateFields(coarse, state, pass, true);
  }
  Prolong(this->Setup.Model, coarse.Level, state, this->State);
  return going;
}

bool SpacetimeRun::SolveFine(LevelSolver& fine)
{
  const int iterations = this->Options.MaximumNumberOfIterations;
  const int last = this->Coarse.empty() ? iterations : this->LastIterations();
  const int pass = this->Options.Passes;
  bool going = true;
  for (int step = 0; step < LeashSteps && this->Options.UseLeash && this->Coarse.empty() && going;
       ++step)
  {
    const double radius = FirstLeash * this->Input.Scene.Bounds.Width() * (1 << step);
    char name[64];
    std::snprintf(name, sizeof(name), "leash %.3g m", radius);
    going = this->Minimize(fine, this->State, 1, name, this->Options.LeashIterations, radius);
  }
  for (int k = 1; k <= pass && this->Coarse.empty() && going; ++k)
  {
    going = this->Minimize(fine, this->State, k, "free " + std::to_string(k), iterations, 0.0) &&
            this->UpdateFields(fine, this->State, k, true);
  }
  return going && this->Minimize(fine, this->State, pass, "fine a", last, 0.0) &&
         this->UpdateFields(fine, this->State, pass, false) &&
         this->Minimize(fine, this->State, pass, "fine b", last, 0.0);
}

void SpacetimeRun::Plan()
{
  const SpacetimeModel& model = this->Setup.Model;
  const std::vector<int> coarse = CoarseFrames(model, this->Setup.Table, CoarseStride);
  const double early = this->Options.Passes * this->Options.MaximumNumberOfIterations +
                       (this->Options.UseLeash ? LeashSteps * this->Options.LeashIterations : 0);
  if (static_cast<double>(coarse.size()) < WorthCoarsening * model.NumberOfFrames &&
      coarse.size() >= 4)
  {
    this->Coarse = coarse;
  }
  const double work =
    2.0 * (this->Coarse.empty() ? this->Options.MaximumNumberOfIterations : this->LastIterations());
  const double share =
    this->Coarse.empty() ? 1.0 : static_cast<double>(coarse.size()) / model.NumberOfFrames;
  this->AllWork = 1.03 * (work + share * early);
}

Result SpacetimeRun::Run()
{
  if (Result result = MakeSetup(this->Input, this->Options, this->Setup); !result)
  {
    return result;
  }
  this->Output.Spacing = this->Setup.Spacing;
  this->State = std::move(this->Setup.Start);
  this->Plan();
  const SpacetimeModel& model = this->Setup.Model;
  const TimeLevel full = TimeLevel::Full(model.NumberOfFrames, this->Options.TemporalWindow);
  SpacetimeTerms terms;
  {
    SpacetimeObjective objective(model, full, this->Parallel, FastestSphKernels());
    objective.Evaluate(this->State, nullptr, terms);
    if (!std::isfinite(terms.E))
    {
      return Result::Error("Tracks: the planned motion has no finite cost");
    }
    this->Record(0, "initial", 0, terms, 0.0, 0.0);
    StageMonitor monitor(this->Progress, 0.0, 0.0, 1);
    monitor.Text = "spacetime: moving the gas";
    if (StartGas(objective, this->Parallel, monitor, this->State))
    {
      objective.Evaluate(this->State, nullptr, terms);
      this->Record(0, "gas moved", 0, terms, 0.0, 0.0);
    }
    this->Stopped = !monitor.Going;
  }

  bool going = !this->Stopped;
  if (going && !this->Coarse.empty())
  {
    this->Share = CoarseTimeShare;
    going = this->SolveCoarse() || !this->Stopped;
    this->Share = 1.0;
  }
  LevelSolver fine(this->Setup.Model, full, this->Setup.Table, this->Parallel,
                   this->Options.HistorySize);
  bool finished = false;
  if (going)
  {
    finished = this->SolveFine(fine);
  }
  fine.Constraints.SetLeash(0.0);
  fine.Constraints.Project(this->State);
  const std::vector<std::vector<Vec3>> positions =
    ExportPositions(this->Input, this->Setup, this->State, this->Output.Warnings);
  HoldWind(this->Setup.Model, full, this->State); // the objects have moved since it was estimated
  fine.Objective.Evaluate(this->State, nullptr, terms);
  if (!std::isfinite(terms.E))
  {
    return Result::Error("spacetime: the cost of the result is not finite");
  }
  std::vector<double> ex, ev;
  std::vector<int> steps;
  fine.Objective.ObjectResiduals(ex, ev, steps);
  for (std::size_t o = 0; o < ex.size(); ++o)
  {
    const double n = std::max(1, steps[o]);
    this->Output.PositionResiduals.push_back(std::sqrt(2.0 * ex[o] / n));
    this->Output.VelocityResiduals.push_back(std::sqrt(2.0 * ev[o] / n));
  }
  (void)ExportFields(this->Input, this->Setup, fine.Objective, this->State, positions,
                     this->Progress, this->Output);
  this->Output.Report = this->Setup.Report;
  MeasureResiduals(this->Input.Constraints, this->Output.Tracks, this->Setup.Objects,
                   this->Setup.Obstacles, this->Input.Scene, this->Output.Report);
  this->Record(this->Options.Passes, "final", 0, terms, fine.Constraints.MaxViolation(this->State),
               0.0);
  const bool limited = this->Options.TimeLimit > 0.0 && this->Seconds() > this->Options.TimeLimit;
  if (limited && !finished)
  {
    this->Output.Warnings.push_back("TimeLimit: reached before the last stage; the best so far");
  }
  return this->Stopped ? Result::Stopped() : Result::Ok();
}

Result CheckRange(const char* name, double value, double low, double high)
{
  if (value >= low && value <= high)
  {
    return Result::Ok();
  }
  char text[160];
  std::snprintf(text, sizeof(text), "%s: %g, a number from %g to %g expected", name, value, low,
                high);
  return Result::Error(text);
}

} // namespace

Result SpacetimeOptions::Validate() const
{
  constexpr double Large = 1e9;
  for (const Result& result :
       { CheckRange("NumberOfGasParticles", this->NumberOfGasParticles, 64, 200000),
         CheckRange("NumberOfObjectParticles", this->NumberOfObjectParticles, 1, 100000),
         CheckRange("PositionWeight", this->PositionWeight, 1e-6, Large),
         CheckRange("VelocityWeight", this->VelocityWeight, 1e-6, Large),
         CheckRange("CoherenceWeight", this->CoherenceWeight, 0.0, Large),
         CheckRange("SpatialShare", this->SpatialShare, 0.0, 1.0),
         CheckRange("TemporalWindow", this->TemporalWindow, 1, 30),
         CheckRange("SmoothingLength", this->SmoothingLength, 0.8, 2.0),
         CheckRange("CourantNumber", this->CourantNumber, 0.1, 1.0),
         CheckRange("Viscosity", this->Viscosity, 0.0, 2.0),
         CheckRange("XsphFactor", this->XsphFactor, 0.0, 1.0),
         CheckRange("PressureExponent", this->PressureExponent, 1.0, 7.0),
         CheckRange("EffectiveGravity", this->EffectiveGravity, 0.0, 20.0),
         CheckRange("ContactDistance", this->ContactDistance, -Large, Large),
         CheckRange("WindDrag", this->WindDrag, 0.0, 100.0),
         CheckRange("MaximumNumberOfVortices", this->MaximumNumberOfVortices, 0, 1000),
         CheckRange("Passes", this->Passes, 1, 10),
         CheckRange("LeashIterations", this->LeashIterations, 1, 10000),
         CheckRange("MaximumNumberOfIterations", this->MaximumNumberOfIterations, 0, 100000),
         CheckRange("Tolerance", this->Tolerance, 0.0, 1.0),
         CheckRange("TimeLimit", this->TimeLimit, 0.0, Large),
         CheckRange("HistorySize", this->HistorySize, 1, 20) })
  {
    if (!result)
    {
      return result;
    }
  }
  return Result::Ok();
}

std::array<int, 3> WindLatticeDimensions(const Box& volume)
{
  return WindLatticeOf(volume.Size());
}

Result RunSpacetime(const SpacetimeInput& input, const SpacetimeOptions& options,
                    const ParallelFor& parallel, Monitor& monitor, SpacetimeOutput& output)
{
  output = SpacetimeOutput();
  const Result result = SpacetimeRun(input, options, parallel, monitor, output).Run();
  if (!result)
  {
    output = SpacetimeOutput();
  }
  return result;
}

} // namespace waft
