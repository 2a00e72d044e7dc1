// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/SpanSearch.h"

#include "Planning/FreeSpaceGrid.h"
#include "Planning/PlannerNumbers.h"

#include <algorithm>
#include <cmath>

namespace waft
{

SpanSearch::SpanSearch(const SegmentLibrary& library, const ClearanceField& field,
                       const SpanTask& task, const SpanSearchOptions& options, Random random) :
  Library(library),
  Field(field), Task(task), Options(options), Stream(random), Window(library.Window())
{
  // No point farther from both ends than the top speed allows is worth a seed.
  const double reach = library.TopStep() * task.Frames * 0.5;
  const Vec3 centre = 0.5 * (task.Start.Position + task.Goal.Position);
  const Vec3 half = 0.5 * (task.Goal.Position - task.Start.Position).cwiseAbs() +
                    Vec3::Constant(std::max(PlannerNumbers::SeedReach * reach,
                                            PlannerNumbers::SeedRadii * field.Rule.Radius));
  this->SeedBox.Min = field.Bounds.Min.cwiseMax(centre - half);
  this->SeedBox.Max = field.Bounds.Max.cwiseMin(centre + half);
  for (std::size_t k = 0; k < task.Way.size(); ++k)
  {
    this->WayFractions.push_back(
      k == 0 ? 0.0 : this->WayFractions.back() + (task.Way[k] - task.Way[k - 1]).norm());
  }
  const double length =
    this->WayFractions.empty() ? 1.0 : std::max(this->WayFractions.back(), 1e-300);
  for (double& fraction : this->WayFractions)
  {
    fraction /= length;
  }
  for (const Vec3& x : task.Way)
  {
    this->SeedBox.Add(x);
  }
  if (task.Frames <= library.LongestSegment())
  {
    this->AddSinglePieces();
  }
  if (task.HasContinuation && task.Continuation.Last - task.Continuation.First >= this->Window)
  {
    this->AddRoot(0, task.Continuation, 0.0);
  }
  this->AddRoots(0, PlannerNumbers::FirstRoots);
  this->AddRoots(1, PlannerNumbers::FirstRoots);
}

bool SpanSearch::IsFree(const Piece& piece, double firstFrame) const
{
  const std::vector<Vec3>& samples = this->Library.Samples(piece.Segment);
  std::vector<Vec3> placed(static_cast<std::size_t>(piece.Last) + 1);
  for (int k = piece.First; k <= piece.Last; ++k)
  {
    placed[k] = piece.Transform * samples[k];
  }
  return this->Field.FirstHit(placed, piece.First, piece.Last, firstFrame, 1.0,
                              this->Options.Margin) < 0;
}

Vec3 SpanSearch::Seed(int tree, double& frame)
{
  const bool hasWay = !this->Task.Way.empty();
  double u = this->Stream.Uniform();
  if (hasWay && this->Stream.Uniform() < PlannerNumbers::FrontFraction)
  {
    // About where the tree has come to, rather beyond: through the next window.
    const double ahead = PlannerNumbers::FrontLength * (2.0 * u - PlannerNumbers::FrontBack);
    u = std::clamp(tree == 0 ? this->Reached[0] + ahead : this->Reached[1] - ahead, 0.0, 1.0);
  }
  frame = u * this->Task.Frames;
  if (this->Stream.Uniform() <
      (hasWay ? PlannerNumbers::SeedsAboutWay : PlannerNumbers::SeedsAboutLine))
  {
    // About the way, as far from it as there is time for, or in a maze as there is room.
    const double time = PlannerNumbers::SeedSpread * this->Library.TypicalStep() *
                        this->Task.Frames * std::sqrt(u * (1.0 - u));
    const double spread =
      hasWay ? std::min(time, PlannerNumbers::WaySpread * this->Field.Rule.Radius) : time;
    const Vec3 offset(this->Stream.Normal(), this->Stream.Normal(), this->Stream.Normal());
    const Vec3 x =
      spread * offset + (hasWay ? PointAlong(this->Task.Way, u)
                                : Vec3(this->Task.Start.Position +
                                       u * (this->Task.Goal.Position - this->Task.Start.Position)));
    return x.cwiseMax(this->SeedBox.Min).cwiseMin(this->SeedBox.Max);
  }
  return this->Stream.InBox(this->SeedBox);
}

/// How far along the way a tree has come: to the point of the way that is nearest to a free end and
/// in its sight.
void SpanSearch::RecordProgress(int tree, const Vec3& end)
{
  const std::vector<Vec3>& way = this->Task.Way;
  std::size_t nearest = 0;
  for (std::size_t k = 1; k < way.size(); ++k)
  {
    nearest = (way[k] - end).squaredNorm() < (way[nearest] - end).squaredNorm() ? k : nearest;
  }
  if (way.empty() ||
      (way[nearest] - end).norm() > PlannerNumbers::WaySpread * this->Field.Rule.Radius)
  {
    return;
  }
  const double fraction = this->WayFractions[nearest];
  if ((tree == 0 ? fraction > this->Reached[0] : fraction < this->Reached[1]) &&
      this->Field.Obstacles->IsClear(end, 0.0, way[nearest], 0.0, 0.0))
  {
    this->Reached[tree] = fraction;
  }
}

int SpanSearch::SeedNode(int tree, const Vec3& seed, double elapsed) const
{
  const double step = this->Library.TypicalStep();
  int best = -1;
  double bestDistance = 1e300;
  const std::vector<Branch>& branches = this->Trees[tree];
  for (std::size_t i = 0; i < branches.size(); ++i)
  {
    const Branch& branch = branches[i];
    if (branch.Elapsed >= this->Task.Frames ||
        branch.Failures >= PlannerNumbers::FailuresUntilGivenUp)
    {
      continue;
    }
    const double late = step * (branch.Elapsed - elapsed);
    const double distance = (branch.FreeEnd - seed).squaredNorm() + late * late;
    if (distance < bestDistance)
    {
      bestDistance = distance;
      best = static_cast<int>(i);
    }
  }
  return best;
}

const Neighbour* SpanSearch::BestSegment(int tree, const Branch& parent, const Vec3& seed) const
{
  const std::vector<Neighbour>& list = tree == 0 ? this->Library.Successors(parent.Body.Top)
                                                 : this->Library.Predecessors(parent.Body.Top);
  const Vec3 local = parent.Body.Transform.Inverse() * seed;
  const Neighbour* best = nullptr;
  double bestDistance = 1e300;
  for (const Neighbour& entry : list)
  {
    if (!entry.IsSmooth && !this->TakesRough)
    {
      continue;
    }
    const double distance = (entry.FreeEnd - local).squaredNorm();
    if (distance < bestDistance)
    {
      bestDistance = distance;
      best = &entry;
    }
  }
  return best;
}

void SpanSearch::Step()
{
  const int tree = this->Turn++ % 2;
  if (this->Turn % PlannerNumbers::TurnsPerRoot < 2 && !(tree == 0 && this->Task.HasContinuation))
  {
    this->AddRoots(tree, 1);
  }
  double frame = 0.0;
  const Vec3 seed = this->Seed(tree, frame);
  const int node = this->SeedNode(tree, seed, tree == 0 ? frame : this->Task.Frames - frame);
  if (node < 0)
  {
    this->AddRoots(tree, 1);
    return;
  }
  const Branch parent = this->Trees[tree][node];
  const Neighbour* entry = this->BestSegment(tree, parent, seed);
  if (entry == nullptr)
  {
    this->Trees[tree][node].Failures = PlannerNumbers::FailuresUntilGivenUp;
    return;
  }
  Branch branch;
  branch.Parent = node;
  branch.Cost = entry->Cost;
  branch.Mismatch = parent.Mismatch;
  branch.Body.Top = entry->Top;
  branch.Body.Segment = this->Library.SegmentOfTop(entry->Top);
  const std::vector<Vec3>& samples = this->Library.Samples(branch.Body.Segment);
  branch.Body.Last = static_cast<int>(samples.size()) - 1;
  branch.Body.Transform = parent.Body.Transform * entry->Transform;
  // The tilt adds up along a chain; beyond the limit it is turned back about the shared window.
  const Vec3 hinge = branch.Body.Transform * (tree == 0 ? samples.front() : samples.back());
  this->Library.LimitTilt(branch.Body.Transform.Rotation);
  branch.Body.Transform.Translation =
    hinge - branch.Body.Transform.Rotation * (tree == 0 ? samples.front() : samples.back());
  branch.FreeEnd = branch.Body.Transform * (tree == 0 ? samples.back() : samples.front());
  branch.Elapsed = parent.Elapsed + branch.Body.Last - (this->Window - 1);
  const double firstFrame = tree == 0 ? this->Task.FirstFrame + parent.Elapsed - (this->Window - 1)
                                      : this->Task.FirstFrame + this->Task.Frames - branch.Elapsed;
  if (branch.Elapsed > this->Task.Frames * (1.0 + this->Options.RetimingLimit) ||
      !this->IsFree(branch.Body, firstFrame))
  {
    ++this->Trees[tree][node].Failures;
    return;
  }
  this->Insert(tree, branch);
}

void SpanSearch::Insert(int tree, const Branch& branch)
{
  this->Trees[tree].push_back(branch);
  this->RecordProgress(tree, branch.FreeEnd);
  const auto index = static_cast<int>(this->Trees[tree].size()) - 1;
  this->MeetOther(tree, index);
  if (tree == 0)
  {
    this->CloseOnGoal(index);
  }
}

} // namespace waft
