// SPDX-License-Identifier: BSD-3-Clause
// What the stages of a run do: minimise E with the fields as they are, or estimate these anew.
#include "Spacetime/Paper/FieldUpdates.h"
#include "Spacetime/Run/SpacetimeRun.h"
#include "Spacetime/Run/StageProgress.h"

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace waft
{

bool SpacetimeRun::Minimise(const Stage& stage)
{
  const std::string name = stage.Name();
  StageProgress monitor(this->Progress, this->FractionAt(this->State.Next),
                        this->FractionAt(this->State.Next + 1), stage.Iterations);
  monitor.Text = "spacetime: " + name;
  LevelSolver& solver = *this->Solver;
  StateVector& state = this->State.Part;
  solver.Constraints.SetLeash(stage.Leash / this->Problem.Spacing);
  LbfgsOptions options;
  options.MaximumNumberOfIterations = stage.Iterations;
  options.Tolerance = this->Options.Tolerance;
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
    this->PublishMotion();
    this->IsCut = this->IsCut || isUp;
    return !isUp;
  };
  const LbfgsEnd end = solver.Minimise(options, observer, &monitor, this->State.Curvature, state);
  this->Stopped = this->Stopped || !monitor.Going;
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
  std::vector<int> dropped;
  bool going = true;
  const double violation = solver.Constraints.MaxViolation(state);
  FieldChoice choice;
  choice.Vortices = this->Options.FitVortexFields && !fields.Vortices.empty();
  choice.Wind = this->Options.EstimateWind;
  const auto record = [&](const char* what)
  {
    std::string name = what + std::to_string(log.size());
    for (const int id : dropped)
    {
      name += ", vortex " + std::to_string(id) + " left out";
    }
    this->Record(stage.Pass, name, 0, terms, violation, 0.0);
  };
  if (choice.Vortices || choice.Wind)
  {
    monitor.Text = "spacetime: solving for the air's fields";
    going = SolveFields(fields, objective, state, choice, this->Parallel, &monitor, terms, dropped);
    if (going)
    {
      record("fields ");
    }
  }
  if (going && stage.FitsVortices && choice.Vortices)
  {
    monitor.Text = "spacetime: fitting vortices";
    going =
      RefitVortices(fields, this->Problem, objective, this->Input.Tracks, this->Input.Scene.Bounds,
                    this->Input.Scene.Seed, state, choice, this->Parallel, monitor, terms, dropped);
    if (going)
    {
      record("vortices ");
    }
  }
  if (!going) // done as a whole or not at all
  {
    fields = before;
    log.resize(rows);
    this->Stopped = true;
  }
  return going;
}

} // namespace waft
