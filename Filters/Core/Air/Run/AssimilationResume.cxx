// SPDX-License-Identifier: BSD-3-Clause
// Where a run goes on from: a checkpoint of one that was ended, or a finished one that is edited.
#include "Air/Drift/DriftContacts.h"
#include "Air/Run/AssimilationRun.h"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace waft
{

AssimilationState AssimilationRun::State() const
{
  AssimilationState state;
  state.Key = this->Key;
  state.Candidate = this->Candidate;
  state.Forces = this->Scene.Forces;
  state.Forces.Wind = FieldSeries();
  state.Paths = this->Paths;
  for (const Drifter& drifter : this->Drifters)
  {
    state.TouchDowns.emplace_back();
    state.LiftOffs.emplace_back();
    for (std::size_t l = 0; l < drifter.NumberOfLandings(); ++l)
    {
      state.TouchDowns.back().push_back(drifter.TouchDown(l));
      state.LiftOffs.back().push_back(drifter.LiftOff(l));
    }
  }
  state.Table = this->Output.Rounds;
  return state;
}

void AssimilationRun::Take(AssimilationState& state)
{
  this->Candidate = state.Candidate;
  this->Scene.Forces = state.Forces;
  this->Scene.Forces.Wind = this->Input.Wind;
  this->Drawn = *state.Air;
  this->Output.Rounds = state.Table;
}

void AssimilationRun::TakePath(std::size_t o, const AssimilationState& state)
{
  Drifter& drifter = this->Drifters[o];
  this->Paths[o] = state.Paths[o];
  const std::vector<int>& down = state.TouchDowns[o];
  const std::vector<int>& up = state.LiftOffs[o];
  if (down.size() == drifter.NumberOfLandings() + 1 && down.back() >= 0 &&
      down.back() < drifter.NumberOfFrames())
  {
    drifter.LandFreely(down.back(), state.Paths[o][static_cast<std::size_t>(down.back())]);
  }
  for (std::size_t l = 0; l < std::min({ drifter.NumberOfLandings(), down.size(), up.size() }); ++l)
  {
    drifter.SetTouchDown(l, down[l]);
    drifter.SetLiftOff(l, up[l]);
  }
}

bool AssimilationRun::HasPaths(const AssimilationState& state) const
{
  const std::size_t frames = this->Input.Tracks.front().Positions.size();
  return !state.IsEmpty() && state.Paths.size() == this->Drifters.size() &&
         state.TouchDowns.size() == this->Drifters.size() &&
         state.LiftOffs.size() == this->Drifters.size() &&
         state.Air->Velocity.Values.size() == frames &&
         std::all_of(state.Paths.begin(), state.Paths.end(),
                     [frames](const std::vector<Vec3>& path) { return path.size() == frames; });
}

void AssimilationRun::KeepCheckpoint(int rounds, const Result& result)
{
  if (this->Options.CheckpointFile.empty() || this->HasCheckpointFailed || result.IsStopped())
  {
    return;
  }
  AssimilationState state = this->State();
  state.Rounds = rounds;
  state.Air = { std::shared_ptr<void>(), &this->Drawn }; // for the time of the writing
  const Result written = WriteState(this->Options.CheckpointFile, state, this->Parallel);
  if (!written)
  {
    this->HasCheckpointFailed = true;
    this->Output.Warnings.push_back("no checkpoint is kept: " + written.Message() +
                                    " (CheckpointFile)");
  }
}

bool AssimilationRun::Resume(int& rounds)
{
  const std::string& path = this->Options.CheckpointFile;
  if (path.empty())
  {
    return false;
  }
  AssimilationState state;
  std::string lack = ReadState(path, state);
  if (lack.empty() && state.IsEmpty())
  {
    return false;
  }
  if (lack.empty() && !(state.Key.IsSame(this->Key) && this->HasPaths(state)))
  {
    lack = "belongs to other inputs or properties";
  }
  if (!lack.empty())
  {
    this->Output.Warnings.push_back("the checkpoint " + path + " " + lack +
                                    ": ignored, done from the start (CheckpointFile)");
    return false;
  }
  this->Take(state);
  for (std::size_t o = 0; o < this->Drifters.size(); ++o)
  {
    this->TakePath(o, state);
  }
  rounds = state.Rounds;
  return true;
}

bool AssimilationRun::Edit(AssimilationState* memory)
{
  AssimilationState kept;
  std::string lack;
  if (memory != nullptr && this->Options.WarmStart && memory->IsFinished)
  {
    kept = *memory;
  }
  else if (!this->Options.EditOf.empty())
  {
    lack = ReadState(this->Options.EditOf, kept);
    lack = lack.empty() && !kept.IsFinished ? "holds no finished run" : lack;
    if (!lack.empty() || !kept.Key.IsOfSameAir(this->Key) || !this->HasPaths(kept))
    {
      this->Output.Warnings.push_back(
        "the air to be kept, " + this->Options.EditOf + ", " +
        (lack.empty() ? "is of another scene, other objects or other properties" : lack) +
        ": ignored, done from the start (EditOf)");
      return false;
    }
  }
  // A plan that is another one without new rows asks for another motion as a whole.
  if (!kept.IsFinished || !kept.Key.IsOfSameAir(this->Key) || !this->HasPaths(kept) ||
      (kept.Key.Wanted == this->Key.Wanted && kept.Key.Planned != this->Key.Planned))
  {
    return false;
  }
  this->Take(kept);
  this->IsOld.assign(this->Drifters.size(), 0);
  for (std::size_t o = 0; o < this->Drifters.size(); ++o)
  {
    if (kept.Key.Wanted[o] == this->Key.Wanted[o])
    {
      this->TakePath(o, kept);
      this->IsOld[o] = 1;
    }
  }
  if (!kept.Key.IsSame(this->Key))
  {
    (void)this->FirstDrift();
    PartMonitor drifting(this->Caller, DriftEnd, 1.0, "Letting the objects drift to their marks");
    (void)this->DriftOn(DriftIterations, drifting);
    this->Note("edit", nullptr);
  }
  return true;
}

void AssimilationRun::Leave(AssimilationState* memory)
{
  if (!this->Options.CheckpointFile.empty())
  {
    (void)std::remove(this->Options.CheckpointFile.c_str());
  }
  if (memory == nullptr && this->Options.StateFile.empty())
  {
    return;
  }
  AssimilationState state = this->State();
  state.IsFinished = true;
  state.Air = this->Output.Air;
  if (!this->Options.StateFile.empty())
  {
    const Result written = WriteState(this->Options.StateFile, state, this->Parallel);
    if (!written)
    {
      this->Output.Warnings.push_back("no air is kept for edits: " + written.Message() +
                                      " (StateFile)");
    }
  }
  if (memory != nullptr)
  {
    *memory = std::move(state);
  }
}

} // namespace waft
