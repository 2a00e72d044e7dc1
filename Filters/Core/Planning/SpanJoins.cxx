// SPDX-License-Identifier: BSD-3-Clause
// How the two trees meet: joins found, kept in order of their score, and handed out.
#include "Planning/PlannerNumbers.h"
#include "Planning/SpanSearch.h"

#include <algorithm>
#include <cmath>

namespace waft
{

double SpanSearch::Score(double gap, double angle, int rawFrames, double mismatch) const
{
  const double frames = this->Task.Frames;
  return gap / (this->Library.TypicalStep() * frames) +
         PlannerNumbers::AngleCost * std::abs(angle) +
         PlannerNumbers::RetimingCost * std::abs(rawFrames - frames) / frames +
         PlannerNumbers::MismatchCost * mismatch;
}

void SpanSearch::MeetOther(int tree, int index)
{
  const double limit = this->Options.RetimingLimit * this->Task.Frames;
  const Branch& own = this->Trees[tree][index];
  const std::vector<Branch>& others = this->Trees[1 - tree];
  const double worst = this->Joins.size() < PlannerNumbers::KeptJoins ? PlannerNumbers::WorstScore
                                                                      : this->Joins.back().Score;
  const double reach = worst * this->Library.TypicalStep() * this->Task.Frames;
  const double far = reach + PlannerNumbers::WindowLength * this->Library.Database().Volume.Width();
  for (std::size_t i = 0; i < others.size(); ++i)
  {
    const Branch& other = others[i];
    const int raw = own.Elapsed + other.Elapsed - (this->Window - 1);
    if (std::abs(raw - this->Task.Frames) > limit ||
        (own.FreeEnd - other.FreeEnd).squaredNorm() > far * far)
    {
      continue;
    }
    const Branch& forward = tree == 0 ? own : other;
    const Branch& backward = tree == 0 ? other : own;
    const Neighbour* entry = this->Library.Connection(forward.Body.Top, backward.Body.Top);
    if (entry == nullptr || (!entry->IsSmooth && !this->TakesRough))
    {
      continue;
    }
    const Placement predicted = forward.Body.Transform * entry->Transform;
    const Vec3 head = this->Library.Samples(backward.Body.Segment).front();
    const Mat3 turn = backward.Body.Transform.Rotation * predicted.Rotation.transpose();
    Join join;
    join.Forward = tree == 0 ? index : static_cast<int>(i);
    join.Backward = tree == 0 ? static_cast<int>(i) : index;
    join.RawFrames = raw;
    join.Distance = (backward.Body.Transform * head - predicted * head).norm();
    join.Angle = std::atan2(turn(1, 0) - turn(0, 1), turn(0, 0) + turn(1, 1));
    join.Score = this->Score(join.Distance, join.Angle, raw, own.Mismatch + other.Mismatch);
    if (join.Score < worst)
    {
      this->Offer(join);
    }
  }
}

void SpanSearch::CloseOnGoal(int index)
{
  const Branch& parent = this->Trees[0][index];
  const double limit = this->Options.RetimingLimit * this->Task.Frames;
  const double typical = this->Library.TypicalStep() * this->Task.Frames;
  const Vec3 goal = parent.Body.Transform.Inverse() * this->Task.Goal.Position;
  const int overlap = this->Window - 1;
  // A root that passes the goal by itself would be a single piece; here one more is attached.
  for (const Neighbour& entry : this->Library.Successors(parent.Body.Top))
  {
    if (!entry.IsSmooth && !this->TakesRough)
    {
      continue;
    }
    const std::vector<Vec3>& samples = this->Library.Samples(this->Library.SegmentOfTop(entry.Top));
    const auto end = static_cast<int>(samples.size()) - 1;
    const int low = std::max(this->Window, static_cast<int>(std::ceil(this->Task.Frames - limit)) -
                                             parent.Elapsed + overlap);
    const int high = std::min(end, static_cast<int>(std::floor(this->Task.Frames + limit)) -
                                     parent.Elapsed + overlap);
    Join best;
    best.Score = 1e30;
    for (int last = low; last <= high; ++last)
    {
      const double gap = (entry.Transform * samples[last] - goal).norm();
      if (gap > PlannerNumbers::WorstScore * typical)
      {
        continue;
      }
      const int raw = parent.Elapsed - overlap + last;
      const double score = this->Score(gap, 0.0, raw, parent.Mismatch);
      if (score < best.Score)
      {
        best.Score = score;
        best.RawFrames = raw;
        best.Distance = gap;
        best.LastPiece.Last = last;
      }
    }
    const bool offered =
      this->Joins.size() < PlannerNumbers::KeptJoins || best.Score < this->Joins.back().Score;
    const bool nearer = this->Nearest.size() < PlannerNumbers::KeptApproaches ||
                        best.Distance < this->Nearest.back().Distance;
    if (best.Score > 1e29 || (!offered && !nearer))
    {
      continue;
    }
    best.Forward = index;
    best.HasLastPiece = true;
    best.LastPiece.Top = entry.Top;
    best.LastPiece.Segment = this->Library.SegmentOfTop(entry.Top);
    best.LastPiece.Transform = parent.Body.Transform * entry.Transform;
    const Vec3 hinge = best.LastPiece.Transform * samples.front();
    this->Library.LimitTilt(best.LastPiece.Transform.Rotation);
    best.LastPiece.Transform.Translation =
      hinge - best.LastPiece.Transform.Rotation * samples.front();
    best.Distance =
      (best.LastPiece.Transform * samples[best.LastPiece.Last] - this->Task.Goal.Position).norm();
    best.Score = this->Score(best.Distance, 0.0, best.RawFrames, parent.Mismatch);
    if (this->Task.Goal.HasVelocity)
    {
      const Vec3 own =
        best.LastPiece.Transform.Rotation * CentralStep(samples, best.LastPiece.Last);
      best.Score += PlannerNumbers::MismatchCost * (own - this->Task.Goal.Velocity).norm() /
                    this->Library.TypicalStep();
    }
    if (this->Task.Goal.IsRest && !this->CanEndHere(best.LastPiece))
    {
      continue;
    }
    this->Offer(best);
    if (nearer && this->IsFree(best.LastPiece, this->Task.FirstFrame + parent.Elapsed - overlap))
    {
      this->OfferApproach(best);
    }
  }
}

void SpanSearch::Offer(const Join& join)
{
  const auto at = std::upper_bound(this->Joins.begin(), this->Joins.end(), join,
                                   [](const Join& a, const Join& b) { return a.Score < b.Score; });
  this->Joins.insert(at, join);
  if (this->Joins.size() > PlannerNumbers::KeptJoins)
  {
    this->Joins.pop_back();
  }
}

void SpanSearch::OfferApproach(const Join& join)
{
  const auto at =
    std::upper_bound(this->Nearest.begin(), this->Nearest.end(), join,
                     [](const Join& a, const Join& b) { return a.Distance < b.Distance; });
  this->Nearest.insert(at, join);
  if (this->Nearest.size() > PlannerNumbers::KeptApproaches)
  {
    this->Nearest.pop_back();
  }
}

bool SpanSearch::IsGapClear(const Join& join) const
{
  const ObstacleSet* obstacles = this->Field.Obstacles;
  if (obstacles == nullptr || obstacles->IsEmpty() || obstacles->HasMoving() ||
      this->Task.Goal.IsRest)
  {
    return true;
  }
  Vec3 from;
  Vec3 to;
  if (join.HasLastPiece)
  {
    from =
      join.LastPiece.Transform * this->Library.Samples(join.LastPiece.Segment)[join.LastPiece.Last];
    to = this->Task.Goal.Position;
  }
  else
  {
    from = this->Trees[0][join.Forward].FreeEnd;
    to = this->Trees[1][join.Backward].FreeEnd;
  }
  return obstacles->IsClear(from, 0.0, to, 0.0, 0.0);
}

bool SpanSearch::Take(double threshold, Join& join)
{
  if (this->Joins.empty() || this->Joins.front().Score > threshold)
  {
    return false;
  }
  join = this->Joins.front();
  this->Joins.erase(this->Joins.begin());
  return true;
}

std::vector<Piece> SpanSearch::Chain(const Join& join, int& joinIndex) const
{
  std::vector<Piece> chain;
  for (int i = join.Forward; i >= 0; i = this->Trees[0][i].Parent)
  {
    chain.push_back(this->Trees[0][i].Body);
  }
  std::reverse(chain.begin(), chain.end());
  joinIndex = static_cast<int>(chain.size());
  if (join.HasLastPiece)
  {
    chain.push_back(join.LastPiece);
  }
  for (int i = join.Backward; i >= 0; i = this->Trees[1][i].Parent)
  {
    chain.push_back(this->Trees[1][i].Body);
  }
  return chain;
}

} // namespace waft
