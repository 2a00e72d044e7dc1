// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Run/AssimilationResume.h"

#include "Air/Run/AirSetup.h"
#include "Air/Run/AirWhen.h"
#include "Air/Run/AirWho.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace waft
{
namespace
{

// All but the fields.
AssimilationState Kept(const AirContext& run, const AirState& state,
                       const AssimilationOutput& output)
{
  AssimilationState kept;
  kept.Key = KeyOf(run.Input, run.Options, run.Rows);
  kept.Who = WhoOf(run);
  kept.Plans = PlansOf(run);
  kept.Formations = run.Formations;
  kept.Candidate = state.Candidate;
  kept.Forces = state.Scene.Forces;
  kept.Forces.Wind = FieldSeries();
  kept.Paths = state.Bodies.Paths;
  kept.Poses = state.Bodies.Poses;
  for (const BodyProblem& body : state.Bodies.Problems)
  {
    kept.TouchDowns.emplace_back();
    kept.LiftOffs.emplace_back();
    for (std::size_t l = 0; l < body.NumberOfLandings(); ++l)
    {
      kept.TouchDowns.back().push_back(body.TouchDown(l));
      kept.LiftOffs.back().push_back(body.LiftOff(l));
    }
  }
  kept.Table = output.Rounds;
  return kept;
}

void Take(const AirContext& run, const AssimilationState& kept, AirState& state,
          AssimilationOutput& output)
{
  state.Candidate = kept.Candidate;
  state.Scene.Forces = kept.Forces;
  state.Scene.Forces.Wind = run.Input.Wind;
  state.Sampled = *kept.Air;
  output.Rounds = kept.Table;
}

void TakePath(std::size_t o, const AssimilationState& kept, AirBodies& bodies)
{
  BodyProblem& body = bodies.Problems[o];
  bodies.Paths[o] = kept.Paths[o];
  if (!kept.Poses.empty())
  {
    bodies.Poses.resize(bodies.Size());
    bodies.Poses[o] = kept.Poses[o];
    body.SetSlips(kept.Poses[o].Slips);
  }
  const std::vector<int>& down = kept.TouchDowns[o];
  const std::vector<int>& up = kept.LiftOffs[o];
  if (down.size() == body.NumberOfLandings() + 1 && down.back() >= 0 &&
      down.back() < body.NumberOfFrames())
  {
    body.LandFreely(down.back(), kept.Paths[o][static_cast<std::size_t>(down.back())]);
  }
  for (std::size_t l = 0; l < std::min({ body.NumberOfLandings(), down.size(), up.size() }); ++l)
  {
    body.SetTouchDown(l, down[l]);
    body.SetLiftOff(l, up[l]);
  }
}

// Whether it is of as many objects and frames.
bool HasPaths(const AssimilationState& kept, const AirContext& run)
{
  const std::size_t count = run.Input.Tracks.size();
  const std::size_t frames = run.Input.Tracks.front().Positions.size();
  return !kept.IsEmpty() && kept.Paths.size() == count && kept.TouchDowns.size() == count &&
         kept.LiftOffs.size() == count && (kept.Poses.empty() || kept.Poses.size() == count) &&
         kept.Air->Velocity.Values.size() == frames &&
         std::all_of(kept.Paths.begin(), kept.Paths.end(),
                     [frames](const std::vector<Vec3>& path) { return path.size() == frames; });
}

} // namespace

CheckpointFile CheckpointOf(const AirContext& run, AssimilationOutput& output)
{
  return { { run.Options.CheckpointFile, AssimilationKind, DigestOf(run.Key), "done" },
           output.Warnings };
}

void KeepCheckpoint(const AirContext& run, const AirState& state, const AssimilationOutput& output,
                    CheckpointFile& checkpoint)
{
  if (!checkpoint.IsDue())
  {
    return;
  }
  AssimilationState kept = Kept(run, state, output);
  kept.IsSimulated = state.IsSimulated;
  kept.Air = { std::shared_ptr<void>(), &state.Sampled }; // for the time of the writing
  kept.Plain = { std::shared_ptr<void>(), &state.Plain };
  checkpoint.Write([&](StateArchive& file) { WriteState(file, kept, run.Parallel); });
}

bool Resume(AirContext& run, CheckpointFile& checkpoint, AirState& state,
            AssimilationOutput& output)
{
  AssimilationState kept;
  const auto content = [&](StateArchive& file)
  {
    ReadState(file, kept);
    return HasPaths(kept, run);
  };
  if (!checkpoint.Read(content))
  {
    return false;
  }
  run.Formations = kept.Formations;
  if (!TakeWho(kept.Who, kept.Plans, run, state.Bodies, output))
  {
    return false;
  }
  Take(run, kept, state, output);
  for (std::size_t o = 0; o < state.Bodies.Size(); ++o)
  {
    TakePath(o, kept, state.Bodies);
  }
  state.IsSimulated = kept.IsSimulated;
  state.Plain = *kept.Plain;
  return true;
}

bool TakeEdit(AirContext& run, const AssimilationState* memory, AirState& state,
              AssimilationOutput& output)
{
  AssimilationState kept;
  std::string lack;
  if (memory != nullptr && run.Options.WarmStart && memory->IsFinished)
  {
    kept = *memory;
  }
  else if (!run.Options.EditOf.empty())
  {
    lack = ReadState(run.Options.EditOf, kept);
    lack = lack.empty() && !kept.IsFinished ? "holds no finished run" : lack;
    if (!lack.empty() || !kept.Key.IsOfSameAir(run.Key) || !HasPaths(kept, run))
    {
      output.Warnings.push_back(
        "the air to be kept, " + run.Options.EditOf + ", " +
        (lack.empty() ? "is of another scene, other objects or other properties" : lack) +
        ": ignored, done from the start (EditOf)");
      return false;
    }
  }
  run.Formations = kept.Formations;
  if (!kept.IsFinished || !kept.Key.IsOfSameAir(run.Key) || !HasPaths(kept, run) ||
      !TakeWho(kept.Who, kept.Plans, run, state.Bodies, output))
  {
    return false;
  }
  int chosen = 0;
  if (!ChooseWhen(run, kept.Air->Velocity, state.Bodies, output, chosen) ||
      !MoveFormations(run, kept.Air->Velocity, state.Bodies, output))
  {
    return false;
  }
  const AssimilationKey now = KeyOf(run.Input, run.Options, run.Rows);
  // A plan that is another one without new rows asks for another motion as a whole.
  if (kept.Key.Wanted == now.Wanted && kept.Key.Planned != now.Planned)
  {
    run.Rows = run.Input.Constraints;
    for (std::size_t o = 0; o < run.Plans.size(); ++o)
    {
      run.Plans[o] = run.Input.Tracks[o].Positions;
    }
    (void)SetUpBodies(run, state.Bodies, output); // as it was
    return false;
  }
  Take(run, kept, state, output);
  state.Bodies.IsOld.assign(state.Bodies.Size(), 0);
  for (std::size_t o = 0; o < state.Bodies.Size(); ++o)
  {
    if (kept.Key.Wanted[o] == now.Wanted[o])
    {
      TakePath(o, kept, state.Bodies);
      state.Bodies.IsOld[o] = 1;
    }
  }
  return true;
}

void Leave(const AirContext& run, const AirState& state, AssimilationOutput& output,
           AssimilationState* memory)
{
  if (memory == nullptr && run.Options.StateFile.empty())
  {
    return;
  }
  AssimilationState kept = Kept(run, state, output);
  kept.IsFinished = true;
  kept.Air = output.Air;
  if (!run.Options.StateFile.empty())
  {
    const Result written = WriteState(run.Options.StateFile, kept, run.Parallel);
    if (!written)
    {
      output.Warnings.push_back("no air is kept for edits: " + written.Message() + " (StateFile)");
    }
  }
  if (memory != nullptr)
  {
    *memory = std::move(kept);
  }
}

} // namespace waft
