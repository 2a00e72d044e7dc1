// SPDX-License-Identifier: BSD-3-Clause
// Where a run goes on from: the motion kept by the last one.
#include "Spacetime/Paper/FieldPenalty.h"
#include "Spacetime/Run/Schedule.h"
#include "Spacetime/Run/SpacetimeBudget.h"
#include "Spacetime/Run/SpacetimeEdit.h"
#include "Spacetime/Run/SpacetimeRun.h"

#include <cmath>
#include <utility>

namespace waft
{

bool SpacetimeRun::Rebase()
{
  if (!this->Options.WarmStart || this->Memory == nullptr || this->Memory->IsEmpty())
  {
    return false;
  }
  const ProblemDigest& digest = this->Digest;
  const SpacetimeWarmStart& memory = *this->Memory;
  if (digest.Shape != memory.Digest.Shape)
  {
    return false;
  }
  if (!this->Problem.Model.Air.IsEmpty() && digest.Physics != memory.Digest.Physics)
  {
    return false; // the tracks fly in this air, the last motion may have flown in another
  }
  // Vortices that came with new plans are not taken in, those that somebody changed are.
  const bool isPlanned = digest.Requests != memory.Digest.Requests;
  const bool hasNewVortices = isPlanned ? digest.SceneVortices != memory.Digest.SceneVortices
                                        : digest.Vortices != memory.Digest.Vortices;
  const SpacetimeModel& model = this->Problem.Model;
  SolverState& state = this->State;
  state.Fields.Vortices = hasNewVortices ? model.Fields.Vortices : memory.State.Fields.Vortices;
  state.Fields.Wind = this->Options.EstimateWind ? memory.State.Fields.Wind : SplineWind();
  state.Fields.Cost = FieldCost(model, state.Fields);
  state.Motion = memory.State.Motion;
  MoveToPlan(memory, this->Options, this->Problem, state.Motion);
  TimeLevel level = TimeLevel::Full(model.NumberOfFrames, this->Options.TemporalWindow);
  if (isPlanned && !hasNewVortices && memory.State.IsDone() &&
      digest.Physics == memory.Digest.Physics && this->Options.EditDuration > 0.0 &&
      this->Options.EditRadius > 0.0)
  {
    this->Region = FindEditRegion(memory, digest, this->Options, this->Problem, state.Motion);
  }
  const std::size_t span = static_cast<std::size_t>(this->Region.Last - this->Region.First + 1);
  const SpacetimeBudget budget(model, this->Options);
  if (budget.WindowOf(span + budget.Halo, this->Options.MemoryLimit) < span + budget.Halo)
  {
    this->Region = EditRegion(); // all is solved on, in windows
  }
  if (!this->Region.IsEmpty())
  {
    this->ResetOutside(memory.State.Motion, state.Motion);
    level.FirstFree = static_cast<std::size_t>(this->Region.First);
    level.LastFree = static_cast<std::size_t>(this->Region.Last);
  }
  HardConstraints(model, level, this->Problem.Table, this->Parallel, this->Region.Movable)
    .Project(state.Motion);
  const SpacetimeTerms terms = this->Measure(state.Motion);
  if (!std::isfinite(terms.E))
  {
    this->Output.Warnings.push_back(
      "the motion so far has no finite cost under what changed: solved from the start (WarmStart)");
    state = SolverState();
    this->Region = EditRegion();
    return false;
  }
  state.StartEnergy = terms.E;
  if (!this->Region.IsEmpty())
  {
    state.Plan = PlanEdit(this->Options);
  }
  else if (memory.State.IsDone())
  {
    state.Plan = PlanAgain(this->Problem, this->Options, hasNewVortices);
  }
  else
  {
    state.Plan = PlanSchedule(this->Problem, this->Options, this->Input.Scene.Bounds.Width());
    state.Next = state.Plan.Find(memory.State.Now());
  }
  this->Record(0, "so far", 0, terms, 0.0, 0.0);
  return true;
}

// Bodies outside the region are where they were, to the bit.
void SpacetimeRun::ResetOutside(const StateVector& before, StateVector& motion) const
{
  const SpacetimeModel& model = this->Problem.Model;
  for (int frame = 0; frame < model.NumberOfFrames; ++frame)
  {
    for (std::size_t body = 0; body < model.NumberOfBodies(); ++body)
    {
      for (std::size_t row = 0; row < 6 && !this->Region.Moves(frame, body); ++row)
      {
        const std::size_t at = frame * model.FrameSize() + row * model.Stride() + body;
        motion[at] = before[at];
      }
    }
  }
}

void SpacetimeRun::Remember(std::vector<std::vector<Vec3>> positions)
{
  if (this->Memory == nullptr)
  {
    return;
  }
  SpacetimeWarmStart& memory = *this->Memory;
  memory.Digest = std::move(this->Digest);
  memory.Planned = this->Problem.Table.Planned;
  memory.Positions = std::move(positions);
  memory.State = std::move(this->State);
  while (!memory.State.IsDone() && memory.State.Now().IsUpdate())
  {
    ++memory.State.Next;
  }
}

} // namespace waft
