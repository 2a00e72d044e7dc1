// SPDX-License-Identifier: BSD-3-Clause
// What the stages of a run do: minimise E with the fields as they are, or estimate these anew.
#include "Spacetime/Paper/FieldUpdates.h"
#include "Spacetime/Run/SpacetimeRun.h"
#include "Spacetime/Run/StageProgress.h"

#include <cstdio>
#include <utility>

namespace waft
{

bool SpacetimeRun::Minimize(const Stage& stage)
{
  const std::string name = stage.Name();
  StageProgress monitor(this->Progress, this->FractionAt(this->State.Next),
                        this->FractionAt(this->State.Next + 1), stage.Iterations);
  monitor.Text = "spacetime: " + name;
  LevelSolver& solver = *this->Solver;
  monitor.Done = this->State.IsInside ? this->State.Curvature.NumberOfIterations() : 0;
  StateVector& state = this->State.Part;
  solver.Constraints.SetLeash(stage.Leash / this->Problem.Spacing);
  LbfgsOptions options;
  options.MaximumNumberOfIterations = stage.Iterations;
  options.Tolerance = this->Options.Tolerance;
  options.GoesOn = std::exchange(this->State.IsInside, true);
  const auto observer = [&](int iteration, const SpacetimeTerms& terms)
  {
    this->Record(stage.Pass, name, iteration, terms, solver.Constraints.MaxViolation(state),
                 stage.Leash);
    monitor.Done = iteration;
    char text[160];
    std::snprintf(text, sizeof(text), "spacetime: %s, iteration %d, E = %.4g", name.c_str(),
                  iteration, terms.E);
    monitor.Text = text;
    const bool isUp = this->TimeIsUp();
    this->KeepCheckpoint(isUp);
    this->MarkState();
    this->ShowMotion();
    this->IsCut = this->IsCut || isUp;
    return !isUp;
  };
  const LbfgsEnd end = solver.Minimize(options, observer, &monitor, this->State.Curvature, state);
  this->Stopped = this->Stopped || !monitor.Going;
  this->KeepState();
  return end != LbfgsEnd::Stopped;
}

bool SpacetimeRun::UpdateFields(const Stage& stage)
{
  const double done = this->FractionAt(this->State.Next);
  StageProgress monitor(this->Progress, done, done, 1);
  LevelSolver& solver = *this->Solver;
  SpacetimeObjective& objective = solver.Objective;
  const StateVector& state = this->State.Part;
  AirFields& fields = this->State.Fields;
  const AirFields before = fields;
  std::vector<ConvergenceRow>& log = this->State.Log;
  const std::size_t rows = log.size();
  SpacetimeTerms terms;
  bool going = true;
  const double violation = solver.Constraints.MaxViolation(state);
  if (stage.FitsVortices && this->Options.FitVortexFields && !fields.Vortices.empty())
  {
    monitor.Text = "spacetime: fitting vortices";
    going = UpdateVortices(fields, this->Problem, objective, this->Input.Tracks,
                           this->Input.Scene.Bounds, this->Input.Scene.Seed, state, monitor, terms);
    if (going)
    {
      this->Record(stage.Pass, "vortices " + std::to_string(stage.Pass), 0, terms, violation, 0.0);
    }
  }
  if (going && this->Options.EstimateWind)
  {
    monitor.Text = "spacetime: estimating the wind";
    going = UpdateWind(fields, objective, state, this->Parallel, &monitor, terms);
    if (going)
    {
      this->Record(stage.Pass, "wind " + std::to_string(log.size()), 0, terms, violation, 0.0);
    }
  }
  if (!going) // done as a whole or not at all
  {
    fields = before;
    log.resize(rows);
    this->Stopped = true;
    this->KeepState();
  }
  return going;
}

} // namespace waft
