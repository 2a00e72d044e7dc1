// SPDX-License-Identifier: BSD-3-Clause
// Where a run goes on from: a checkpoint of one that was ended, or the motion kept by the last one.
#include "Spacetime/Run/SpacetimeExchange.h"
#include "Spacetime/Run/SpacetimeRun.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace waft
{
namespace
{

constexpr const char* Format = "Waft spacetime checkpoint 6";
constexpr double WritingFraction = 1.0 / 30.0; // of the time, for checkpoints

void ExchangeStep(StateArchive& stream, SpacetimeStep& step)
{
  stream.Values(step.Coarseness, step.IsUpdate, step.FitsVortices, step.Pass, step.Iterations,
                step.Leash);
  stream.Text(step.Name);
}

} // namespace

// The order is that of reading: the solver can be made once level and frames are known.
void SpacetimeRun::ExchangeCheckpoint(StateArchive& stream)
{
  std::uint64_t next = this->Next;
  int coarseness = this->Coarseness;
  stream.List(this->Program.Steps, ExchangeStep);
  stream.List(this->Program.CoarseFrames,
              [](StateArchive& s, std::vector<int>& frames) { s.List(frames); });
  stream.Values(next, this->IsInside, coarseness, this->GoesOn, this->StartEnergy, this->Before);
  stream.List(this->Output.Convergence,
              [](StateArchive& s, ConvergenceRow& row) { Exchange(s, row); });
  stream.List(this->Beginning);
  stream.List(this->Setup.Model.Vortices, [](StateArchive& s, Vortex& v) { Exchange(s, v); });
  Exchange(stream, this->Setup.Model.Wind);
  if (stream.IsReading())
  {
    this->Next = static_cast<std::size_t>(next);
    coarseness = std::clamp(coarseness, 0, this->Program.Coarsest());
    this->Coarseness = coarseness;
    this->State.assign(this->Setup.Model.NumberOfFrames * this->Setup.Model.FrameSize(), 0.0f);
  }
  if (stream.IsReading())
  {
    const std::size_t frames = coarseness > 0
                                 ? this->Program.CoarseFrames[coarseness - 1].size()
                                 : static_cast<std::size_t>(this->Setup.Model.NumberOfFrames);
    StateVector& state = coarseness > 0 ? this->PartState : this->State;
    stream.List(state);
    state.resize(frames * this->Setup.Model.FrameSize()); // a file may end before its time
    this->EnterLevel(coarseness);
  }
  else
  {
    this->Solver->Partition.Exchange(stream, this->LevelState(), this->Setup.Model.FrameSize());
  }
  this->Solver->Objective.ExchangeLists(stream);
  if (this->Solver->Solver)
  {
    this->Solver->Solver->Exchange(stream);
    return;
  }
  stream.Values(this->Current.Sweep, this->Current.Index);
  Exchange(stream, this->Current.Terms);
  stream.List(this->Current.Energies);
}

// An edit is short, and its end depends on what only this process has.
bool SpacetimeRun::KeepsCheckpoints() const
{
  return !this->Options.CheckpointFile.empty() && !this->IsCut && this->Region.IsEmpty();
}

void SpacetimeRun::KeepCheckpoint(bool now)
{
  if (!this->KeepsCheckpoints())
  {
    return;
  }
  double interval = this->Options.CheckpointInterval;
  if (interval > 0.0)
  {
    interval = std::max(interval, this->CheckpointCost / WritingFraction);
  }
  const bool isDue = now || this->Elapsed() - this->LastCheckpoint >= interval;
  if (this->Ranks.Decide(isDue && !this->HasCheckpointFailed))
  {
    this->WriteCheckpoint();
  }
}

void SpacetimeRun::MarkState()
{
  if (this->KeepsCheckpoints())
  {
    this->Solver->Objective.MarkLists();
  }
}

// Of a step that was stopped all but the lists is as it was at the mark.
void SpacetimeRun::KeepState()
{
  if (this->Stopped && this->KeepsCheckpoints() && this->Ranks.Decide(!this->HasCheckpointFailed))
  {
    this->Solver->Objective.RewindLists();
    this->WriteCheckpoint();
  }
}

void SpacetimeRun::WriteCheckpoint()
{
  const double from = this->Elapsed();
  std::unique_ptr<StateFileWriter> file;
  if (this->Ranks.IsFirst())
  {
    file = std::make_unique<StateFileWriter>(this->Options.CheckpointFile);
  }
  RankFileStream stream(this->Ranks, file.get(), false);
  std::string format = Format;
  std::uint64_t key = DigestOfRun(this->Input, this->Options);
  stream.Text(format);
  stream.Value(key);
  const double before = std::exchange(this->Before, this->Seconds());
  this->ExchangeCheckpoint(stream);
  this->Before = before;
  const Result result = file ? file->Commit() : Result::Ok();
  if (!result)
  {
    this->HasCheckpointFailed = true;
    this->Output.Warnings.push_back("CheckpointFile: " + result.Message());
  }
  this->LastCheckpoint = this->Elapsed();
  this->CheckpointCost = this->LastCheckpoint - from;
}

bool SpacetimeRun::Resume()
{
  const std::string& path = this->Options.CheckpointFile;
  const bool isFirst = this->Ranks.IsFirst();
  if (path.empty() || !this->Ranks.Decide(isFirst && StateFileReader(path).IsGood()))
  {
    return false;
  }
  const auto ignore = [&](const char* reason)
  {
    this->Output.Warnings.push_back("CheckpointFile: " + path + " " + reason +
                                    ": ignored, solved from the start");
    return false;
  };
  if (!this->Ranks.Decide(isFirst && IsWholeStateFile(path)))
  {
    return ignore("is damaged");
  }
  std::unique_ptr<StateFileReader> file;
  if (isFirst)
  {
    file = std::make_unique<StateFileReader>(path);
  }
  RankFileStream stream(this->Ranks, file.get(), true);
  std::string format;
  std::uint64_t key = 0;
  stream.Text(format);
  if (format != Format)
  {
    return ignore("is no checkpoint of this version");
  }
  stream.Value(key);
  if (!this->Ranks.Decide(key == DigestOfRun(this->Input, this->Options)))
  {
    return ignore("belongs to other inputs or properties");
  }
  this->ExchangeCheckpoint(stream);
  if (!this->Ranks.Decide(!file || file->IsAtEnd()) || !stream.IsGood() ||
      this->Next >= this->Program.Steps.size())
  {
    this->Solver.reset();
    this->PartState = StateVector();
    this->Coarseness = 0;
    this->GoesOn = false;
    this->IsInside = false;
    this->Next = 0;
    this->Before = 0.0;
    this->Output.Convergence.clear();
    this->Beginning = StateVector();
    (void)MakeSetup(this->Input, this->Options, this->Setup); // as it went a moment ago
    return ignore("is incomplete");
  }
  return true;
}

bool SpacetimeRun::GoOn()
{
  if (!this->Options.WarmStart ||
      !this->Ranks.Decide(this->Memory != nullptr && !this->Memory->IsEmpty()))
  {
    return false;
  }
  const ProblemDigest digest = DigestOfProblem(this->Input, this->Options, this->Setup);
  SpacetimeWarmStart received;
  SpacetimeWarmStart& memory = this->Ranks.IsFirst() ? *this->Memory : received;
  if (this->Ranks.Size() > 1)
  {
    BroadcastStream stream(this->Ranks);
    Exchange(stream, memory);
  }
  if (digest.Shape != memory.Digest.Shape)
  {
    return false;
  }
  // Vortices that came with new plans are not taken in, those that somebody changed are.
  const bool isPlanned = digest.Requests != memory.Digest.Requests;
  const bool hasNewVortices = isPlanned ? digest.SceneVortices != memory.Digest.SceneVortices
                                        : digest.Vortices != memory.Digest.Vortices;
  SpacetimeModel& model = this->Setup.Model;
  const std::vector<Vortex> given = model.Vortices;
  if (!hasNewVortices)
  {
    model.Vortices = memory.Vortices;
  }
  model.Wind = this->Options.EstimateWind ? memory.Wind : SplineWind();
  this->State = memory.State;
  MoveToPlan(memory, this->Options, this->Setup, this->State);
  TimeLevel level = TimeLevel::Full(model.NumberOfFrames, this->Options.TemporalWindow);
  if (isPlanned && !hasNewVortices && memory.Stage.empty() &&
      digest.Physics == memory.Digest.Physics && this->Options.EditDuration > 0.0 &&
      this->Options.EditRadius > 0.0)
  {
    this->Region = FindEditRegion(memory, digest, this->Options, this->Setup, this->State);
  }
  const std::size_t span = static_cast<std::size_t>(this->Region.Last - this->Region.First + 1);
  const SpacetimeBudget budget(model, this->Options);
  if (budget.WindowOf(span + budget.Halo, this->Options.MemoryLimit) < span + budget.Halo)
  {
    this->Region = EditRegion(); // all is solved on, in windows
  }
  if (!this->Region.IsEmpty())
  {
    this->ResetOutside(memory.State);
    level.FirstFree = static_cast<std::size_t>(this->Region.First);
    level.LastFree = static_cast<std::size_t>(this->Region.Last);
  }
  HardConstraints(model, level, this->Setup.Table, this->Parallel, this->Region.Movable)
    .Project(this->State);
  const SpacetimeTerms terms = this->Measure();
  if (!std::isfinite(terms.E))
  {
    this->Output.Warnings.push_back(
      "WarmStart: the motion so far has no finite cost under what changed: solved from the start");
    model.Vortices = given;
    model.Wind = SplineWind();
    this->Region = EditRegion();
    return false;
  }
  this->GoesOn = true;
  this->StartEnergy = terms.E;
  if (!this->Region.IsEmpty())
  {
    this->Program = PlanEdit(this->Options);
  }
  else if (memory.Stage.empty())
  {
    this->Program = PlanAgain(this->Options, hasNewVortices);
  }
  else
  {
    this->Program = PlanProgram(this->Setup, this->Options, this->Input.Scene.Bounds.Width());
    this->Next = this->Program.Find(memory.Stage);
  }
  this->Record(0, "so far", 0, terms, 0.0, 0.0);
  return true;
}

// Bodies outside the region are where they were, to the bit.
void SpacetimeRun::ResetOutside(const StateVector& before)
{
  const SpacetimeModel& model = this->Setup.Model;
  for (int frame = 0; frame < model.NumberOfFrames; ++frame)
  {
    for (std::size_t body = 0; body < model.NumberOfBodies(); ++body)
    {
      for (std::size_t row = 0; row < 6 && !this->Region.Moves(frame, body); ++row)
      {
        const std::size_t at = frame * model.FrameSize() + row * model.Stride() + body;
        this->State[at] = before[at];
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
  memory.Digest = DigestOfProblem(this->Input, this->Options, this->Setup);
  memory.State = std::move(this->State);
  memory.Vortices = this->Setup.Model.Vortices;
  memory.Wind = this->Setup.Model.Wind;
  memory.Planned = this->Setup.Table.Planned;
  memory.Positions = std::move(positions);
  const std::vector<SpacetimeStep>& steps = this->Program.Steps;
  std::size_t at = this->Next;
  while (at < steps.size() && steps[at].IsUpdate)
  {
    ++at;
  }
  memory.Stage = at < steps.size() ? steps[at].Name : "";
}

} // namespace waft
