// SPDX-License-Identifier: BSD-3-Clause
// Where the two trees begin, and paths of a single piece.
#include "Planning/PlannerNumbers.h"
#include "Planning/SpanSearch.h"

#include <algorithm>
#include <cmath>

namespace waft
{

namespace
{

Mat3 Yaw(double angle)
{
  return Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
}

/// The rotation about the vertical that turns a towards b, both seen from above.
double YawBetween(const Vec3& a, const Vec3& b)
{
  return std::atan2(a.x() * b.y() - a.y() * b.x(), a.x() * b.x() + a.y() * b.y());
}

} // namespace

bool SpanSearch::CanEndHere(const Piece& piece) const
{
  // A body lands from above.
  const std::vector<Vec3>& samples = this->Library.Samples(piece.Segment);
  const double low = (piece.Transform * samples[piece.Last]).z() - PlannerNumbers::LandingSlack;
  for (int k = std::max(piece.First, piece.Last - PlannerNumbers::LandingLook); k < piece.Last; ++k)
  {
    if ((piece.Transform * samples[k]).z() < low)
    {
      return false;
    }
  }
  return true;
}

bool SpanSearch::AddRoot(int tree, const Piece& piece, double mismatch)
{
  Branch branch;
  branch.Body = piece;
  branch.Elapsed = piece.Last - piece.First;
  branch.Mismatch = mismatch;
  const std::vector<Vec3>& samples = this->Library.Samples(piece.Segment);
  branch.FreeEnd = piece.Transform * samples[tree == 0 ? piece.Last : piece.First];
  const double first =
    tree == 0 ? this->Task.FirstFrame : this->Task.FirstFrame + this->Task.Frames - branch.Elapsed;
  if (branch.Elapsed > this->Task.Frames * (1.0 + this->Options.RetimingLimit) ||
      !this->IsFree(piece, first))
  {
    return false;
  }
  this->Insert(tree, branch);
  return true;
}

void SpanSearch::AddRoots(int tree, int count)
{
  const SpanEnd& end = tree == 0 ? this->Task.Start : this->Task.Goal;
  for (int i = 0; i < count; ++i)
  {
    Piece best;
    double bestMismatch = 1e30;
    // With a velocity to match the best of several draws is tried; without, each draw is as good.
    // Where no way on has that velocity, the seam is healed afterwards.
    const bool matches =
      end.HasVelocity &&
      (!this->Trees[tree].empty() || this->RootFailures[tree] < PlannerNumbers::RootFailures);
    const int draws = matches ? PlannerNumbers::RootDraws : 1;
    for (int draw = 0; draw < draws; ++draw)
    {
      Piece piece;
      piece.Top = static_cast<int>(
        this->Stream.Index(static_cast<std::uint32_t>(this->Library.NumberOfTops())));
      piece.Segment = this->Library.SegmentOfTop(piece.Top);
      const std::vector<Vec3>& samples = this->Library.Samples(piece.Segment);
      const auto last = static_cast<int>(samples.size()) - 1;
      const int room = last - this->Window;
      const int cut = static_cast<int>(this->Stream.Index(static_cast<std::uint32_t>(room + 1)));
      piece.First = tree == 0 ? cut : 0;
      piece.Last = tree == 0 ? last : this->Window + cut;
      const int at = tree == 0 ? piece.First : piece.Last;
      double yaw = this->Stream.Uniform(-M_PI, M_PI);
      double mismatch = 0.0;
      if (matches)
      {
        const Vec3 own = CentralStep(samples, at);
        yaw = YawBetween(own, end.Velocity);
        mismatch = (Yaw(yaw) * own - end.Velocity).norm() / this->Library.TypicalStep();
      }
      if (mismatch < bestMismatch)
      {
        piece.Transform.Rotation = Yaw(yaw);
        piece.Transform.Translation = end.Position - piece.Transform.Rotation * samples[at];
        best = piece;
        bestMismatch = mismatch;
      }
    }
    const bool lands = tree == 1 && end.IsRest;
    if ((lands && !this->CanEndHere(best)) || !this->AddRoot(tree, best, bestMismatch))
    {
      ++this->RootFailures[tree];
    }
  }
}

void SpanSearch::AddSinglePieces()
{
  const Vec3 wanted = this->Task.Goal.Position - this->Task.Start.Position;
  const double limit = this->Options.RetimingLimit * this->Task.Frames;
  for (int top = 0; top < this->Library.NumberOfTops(); ++top)
  {
    Piece piece;
    piece.Top = top;
    piece.Segment = this->Library.SegmentOfTop(top);
    const std::vector<Vec3>& samples = this->Library.Samples(piece.Segment);
    const auto count = static_cast<int>(samples.size());
    for (int first = 0; first < count; first += PlannerNumbers::SinglePieceStride)
    {
      Join best;
      best.Score = 1e30;
      for (int last = first + 1; last < count; ++last)
      {
        const int raw = last - first;
        if (std::abs(raw - this->Task.Frames) > limit)
        {
          continue;
        }
        const Vec3 way = samples[last] - samples[first];
        const Mat3 turn = Yaw(YawBetween(way, wanted));
        double mismatch = 0.0;
        if (this->Task.Start.HasVelocity)
        {
          mismatch += (turn * CentralStep(samples, first) - this->Task.Start.Velocity).norm();
        }
        if (this->Task.Goal.HasVelocity)
        {
          mismatch += (turn * CentralStep(samples, last) - this->Task.Goal.Velocity).norm();
        }
        Join join;
        join.HasLastPiece = true;
        join.LastPiece = piece;
        join.LastPiece.First = first;
        join.LastPiece.Last = last;
        join.LastPiece.Transform = { turn, this->Task.Start.Position - turn * samples[first] };
        join.RawFrames = raw;
        join.Distance = (turn * way - wanted).norm();
        join.Score = this->Score(join.Distance, 0.0, raw, mismatch / this->Library.TypicalStep());
        if (join.Score < best.Score)
        {
          best = join;
        }
      }
      if (best.HasLastPiece && (!this->Task.Goal.IsRest || this->CanEndHere(best.LastPiece)))
      {
        this->Offer(best);
        this->OfferApproach(best);
      }
    }
  }
}

} // namespace waft
