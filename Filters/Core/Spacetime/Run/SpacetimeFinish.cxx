// SPDX-License-Identifier: BSD-3-Clause
// What a run leaves: its motion, measured anew and exported.
#include "Spacetime/Run/SpacetimeRun.h"

#include "Constraints/ConstraintCheck.h"
#include "Spacetime/Fields/FieldUpdates.h"
#include "Spacetime/Scene/SpacetimeExport.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace waft
{

Result SpacetimeRun::Finish()
{
  const TimeLevel level =
    TimeLevel::Full(this->Setup.Model.NumberOfFrames, this->Options.TemporalWindow);
  const HardConstraints constraints(this->Setup.Model, level, this->Setup.Table, this->Parallel);
  KeptMotion kept;
  if (this->Region.IsEmpty())
  {
    constraints.Project(this->State);
    this->KeepTheBetter(constraints);
  }
  else if (this->Memory != nullptr)
  {
    kept = { &this->Region, &this->Memory->Positions };
  }
  std::vector<std::vector<Vec3>> positions;
  if (this->Ranks.IsFirst())
  {
    positions = ExportPositions(this->Input, this->Setup, kept, this->State, this->Output.Warnings);
  }
  this->Ranks.Broadcast(this->State.data(), this->State.size() * sizeof(float));
  if (this->Region.IsEmpty()) // the objects have moved since the wind was estimated
  {
    HoldWind(this->Setup.Model, level,
             ObjectPositions(this->Setup.Model, level.NumberOfFrames(), this->State));
  }
  if (Result result = this->MeasureResult(level, constraints); !result)
  {
    return result;
  }
  if (this->Ranks.IsFirst())
  {
    this->WriteOutput(level, std::move(positions));
  }
  return this->Stopped ? Result::Stopped() : Result::Ok();
}

// Left on a coarse level, whose steps and gas are not quite those of all frames, a run may have
// come to more than it began with.
void SpacetimeRun::KeepTheBetter(const HardConstraints& constraints)
{
  if (this->Beginning.empty())
  {
    return;
  }
  constraints.Project(this->Beginning);
  const double found = this->Measure().E;
  std::swap(this->State, this->Beginning);
  const double began = this->Measure().E;
  this->StartEnergy = std::max(this->StartEnergy, began); // plans need not keep to the rows
  if (found <= began)
  {
    std::swap(this->State, this->Beginning);
  }
  this->Beginning = StateVector();
}

// Neighbours are looked for anew: what is measured of a frame depends on that frame alone.
Result SpacetimeRun::MeasureResult(const TimeLevel& level, const HardConstraints& constraints)
{
  const FramePartition partition = PartitionOf(level, this->Ranks).HoldingAll();
  SpacetimeObjective objective(this->Setup.Model, level, this->Parallel, FastestSphKernels(), false,
                               &partition);
  SpacetimeTerms terms;
  objective.Evaluate(this->State, nullptr, terms);
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
  this->Record(this->Options.Passes, "final", 0, terms, constraints.MaxViolation(this->State), 0.0);
  return Result::Ok();
}

void SpacetimeRun::WriteOutput(const TimeLevel& level, std::vector<std::vector<Vec3>> positions)
{
  SpacetimeObjective objective(this->Setup.Model, level, this->Parallel, FastestSphKernels(),
                               false);
  (void)ExportFields(this->Input, this->Setup, objective, this->State, positions, this->Own,
                     this->Output);
  this->Output.Report = this->Setup.Report;
  MeasureResiduals(this->Input.Constraints, this->Output.Tracks, this->Setup.Objects,
                   this->Setup.Obstacles, this->Input.Scene, this->Output.Report);
  const bool finished = this->Next >= this->Program.Steps.size();
  if (this->IsCut && !finished)
  {
    this->Output.Warnings.push_back("TimeLimit: reached before the last stage; the best so far");
  }
  const double energy = this->Output.Convergence.back().E;
  if (finished && this->Region.IsEmpty() &&
      this->StartEnergy - energy <= std::max(1e-6, this->Options.Tolerance) * this->StartEnergy)
  {
    char text[200];
    std::snprintf(
      text, sizeof(text),
      "spacetime: nothing can be bettered by more than Tolerance: E was %.6g and is %.6g",
      this->StartEnergy, energy);
    this->Output.Warnings.push_back(text);
  }
  if (finished && !this->IsCut && !this->Options.CheckpointFile.empty())
  {
    std::remove(this->Options.CheckpointFile.c_str());
  }
  this->Remember(std::move(positions));
}

} // namespace waft
