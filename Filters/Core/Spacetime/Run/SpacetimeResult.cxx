// SPDX-License-Identifier: BSD-3-Clause
// What a run leaves: its motion, measured anew and exported.
#include "Spacetime/Run/SpacetimeRun.h"

#include "Constraints/ConstraintCheck.h"
#include "Spacetime/Paper/FieldsPart.h"
#include "Spacetime/Scene/SpacetimeExport.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace waft
{
namespace
{

constexpr double LeastRepair = 1e-5; // of the volume's width
constexpr auto BetweenPictures = std::chrono::milliseconds(500);

} // namespace

void SpacetimeRun::PublishMotion()
{
  const auto now = std::chrono::steady_clock::now();
  if (!this->Progress.Publishes() || now - this->Published < BetweenPictures)
  {
    return;
  }
  this->Published = now;
  StateVector motion = this->State.Motion;
  this->View->Merge(StateVector(this->State.Part), motion);
  const std::size_t objects = this->Output.Tracks.size();
  const std::vector<Vec3> places = ObjectPositions(
    this->Problem.Model, static_cast<std::size_t>(this->Problem.Model.NumberOfFrames), motion);
  for (std::size_t k = 0; k < places.size(); ++k)
  {
    this->Output.Tracks[k % objects].Positions[k / objects] = this->Problem.ToWorld(places[k]);
  }
  this->Output.Convergence = this->State.Log;
}

Result SpacetimeRun::Export()
{
  const TimeLevel level =
    TimeLevel::Full(this->Problem.Model.NumberOfFrames, this->Options.TemporalWindow);
  const HardConstraints constraints(this->Problem.Model, level, this->Problem.Table,
                                    this->Parallel);
  StateVector& motion = this->State.Motion;
  constraints.Project(motion);
  this->KeepTheBetter(constraints);
  this->TickMeasuring();
  const std::vector<Vec3> solved =
    ObjectPositions(this->Problem.Model, level.NumberOfFrames(), motion);
  const std::vector<std::vector<Vec3>> positions =
    ExportPositions(this->Input, this->Problem, motion, this->Output.Warnings);
  this->MeasureRepairs(solved, positions);
  SpacetimeObjective objective(this->Problem.Model, this->State.Fields, level, this->Parallel,
                               FastestSphKernels(), false);
  FieldExport fields(this->Input, this->Problem, motion);
  WAFT_RETURN_IF_FAILED(this->MeasureResult(objective, constraints, fields));
  this->TickMeasuring();
  (void)fields.Write(objective, positions, this->Progress, this->Output);
  this->WriteOutput();
  return this->Stopped ? Result::Stopped() : Result::Ok();
}

// Left on a coarse level, whose steps and gas are not quite those of all frames, a run may have
// come to more than it began with.
void SpacetimeRun::KeepTheBetter(const HardConstraints& constraints)
{
  // Who stopped it does not wait for what the last iteration has reported.
  const bool isKnown = this->Stopped && this->State.Coarseness == 0 && !this->State.Log.empty() &&
                       this->State.Log.back().E < this->State.StartEnergy;
  if (this->State.Beginning.empty() || isKnown)
  {
    this->State.Beginning = StateVector();
    return;
  }
  constraints.Project(this->State.Beginning);
  const double found = this->Measure(this->State.Motion).E;
  this->TickMeasuring();
  std::swap(this->State.Motion, this->State.Beginning);
  const double began = this->Measure(this->State.Motion).E;
  this->State.StartEnergy =
    std::max(this->State.StartEnergy, began); // plans need not keep to the rows
  if (found <= began)
  {
    std::swap(this->State.Motion, this->State.Beginning);
  }
  this->State.Beginning = StateVector();
}

// What the export moved objects by, beyond rounding, to keep what is asked for.
void SpacetimeRun::MeasureRepairs(const std::vector<Vec3>& solved,
                                  const std::vector<std::vector<Vec3>>& exported)
{
  const std::size_t objects = exported.size();
  const double least = LeastRepair * this->Input.Scene.Bounds.Width();
  std::size_t moved = 0;
  double largest = 0.0;
  for (std::size_t k = 0; k < solved.size(); ++k)
  {
    const Vec3 position = this->Problem.ToWorld(solved[k]);
    const double distance = (exported[k % objects][k / objects] - position).norm();
    moved += distance > least ? 1 : 0;
    largest = std::max(largest, distance);
  }
  this->Output.RepairedFraction =
    solved.empty() ? 0.0 : static_cast<double>(moved) / static_cast<double>(solved.size());
  this->Output.LargestRepair = largest;
}

void SpacetimeRun::TickMeasuring()
{
  (void)this->Progress.Tick(1.0, "measuring the motion"); // there is nothing left to be stopped
}

// Neighbours are looked for anew: what is measured of a frame depends on that frame alone.
Result SpacetimeRun::MeasureResult(SpacetimeObjective& objective,
                                   const HardConstraints& constraints, FieldExport& fields)
{
  SpacetimeTerms terms;
  objective.Evaluate(this->State.Motion, nullptr, terms, nullptr,
                     [&](std::size_t j, FrameTerms& of) { fields.Visit(j, of); });
  if (!std::isfinite(terms.E))
  {
    return Result::Error("spacetime: the cost of the result is not finite");
  }
  std::vector<double> ex, ev;
  std::vector<int> steps;
  objective.ObjectResiduals(ex, ev, steps);
  for (std::size_t o = 0; o < ex.size(); ++o)
  {
    const double n = std::max(1, steps[o]);
    this->Output.PositionResiduals.push_back(std::sqrt(2.0 * ex[o] / n));
    this->Output.VelocityResiduals.push_back(std::sqrt(2.0 * ev[o] / n));
  }
  this->Record(this->Options.Passes, "final", 0, terms,
               constraints.MaxViolation(this->State.Motion), 0.0);
  if (!this->Stopped) // who stopped it does not wait
  {
    this->Output.VorticesPart =
      PartOfVortices(objective, this->State.Motion, this->Options.EstimateWind, this->Parallel);
    FieldChoice choice;
    choice.Vortices = this->Options.FitVortexFields && !this->State.Fields.Vortices.empty();
    choice.Wind = this->Options.EstimateWind;
    this->Output.Explained = PartOfFields(objective, this->State.Motion, choice, this->Parallel);
    this->TickMeasuring();
  }
  return Result::Ok();
}

void SpacetimeRun::WriteOutput()
{
  this->Output.Report = this->Problem.Report;
  MeasureResiduals(this->Input.Constraints, this->Output.Tracks, this->Problem.Objects,
                   this->Problem.Obstacles, this->Input.Scene, this->Output.Report);
  const bool finished = this->State.IsDone();
  if (this->IsCut)
  {
    this->Output.Warnings.push_back(
      finished
        ? "half of the time limit was up before the optimiser's coarse levels were done: with "
          "more time the motion may be better (TimeLimit: its half)"
        : "the time limit was up before the optimiser's last stage: the motion is the best "
          "so far, more time betters it (TimeLimit: reached before the last stage)");
  }
  const double energy = this->State.Log.back().E;
  if (finished && this->State.StartEnergy - energy <=
                    std::max(1e-6, this->Options.Tolerance) * this->State.StartEnergy)
  {
    char text[250];
    std::snprintf(
      text, sizeof(text),
      "spacetime: the motion stays as it was, since nothing can be bettered by more than "
      "Tolerance: E was %.6g and is %.6g",
      this->State.StartEnergy, energy);
    this->Output.Warnings.push_back(text);
  }
  this->Output.Convergence = std::move(this->State.Log);
}

} // namespace waft
