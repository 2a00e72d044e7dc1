// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/SpanFit.h"

#include "Planning/ChainTiming.h"
#include "Planning/PlannerNumbers.h"
#include "Planning/Refinement.h"

#include <algorithm>
#include <cmath>

namespace waft
{

namespace
{

/// True when a step is longer than `top` [m].
bool IsTooFast(const std::vector<Vec3>& positions, double top)
{
  for (std::size_t k = 1; k < positions.size(); ++k)
  {
    if ((positions[k] - positions[k - 1]).norm() > top)
    {
      return true;
    }
  }
  return false;
}

/// True when the acceleration changes from a frame to the next by more than `most` [m per frame^3].
bool HasLargeJerk(const std::vector<Vec3>& positions, double most)
{
  for (std::size_t k = 3; k < positions.size(); ++k)
  {
    const Vec3 jerk =
      positions[k] - 3.0 * positions[k - 1] + 3.0 * positions[k - 2] - positions[k - 3];
    if (jerk.norm() > most)
    {
      return true;
    }
  }
  return false;
}

/// A pull holds its neighbours, too, less with the distance: along with the tree, not to a point,
/// which would be a jump of the velocity.
std::vector<double> Spread(const std::vector<double>& pulls)
{
  std::vector<double> result(pulls.size(), 0.0);
  const auto count = static_cast<int>(pulls.size());
  for (int k = 0; k < count; ++k)
  {
    for (int i = std::max(0, k - PlannerNumbers::PullReach);
         pulls[k] > 0.0 && i <= std::min(count - 1, k + PlannerNumbers::PullReach); ++i)
    {
      const double u = 1.0 - std::abs(i - k) / (PlannerNumbers::PullReach + 1.0);
      result[i] = std::max(result[i], u * u * u * pulls[k]);
    }
  }
  return result;
}

} // namespace

/// What is in the way after redistribution is drawn back to where the trees, which are clear, have
/// it; the gap is spread over the rest.
bool SpanFitter::Ease(SpanWarp& span, const std::vector<Vec3>& anchors, bool toGoal,
                      std::vector<Vec3>& positions) const
{
  const ClearanceField& field = toGoal ? this->Field : this->MissField;
  // The given ends themselves are judged elsewhere.
  const int last = toGoal ? span.Clock.Frames - 1 : span.Clock.Frames;
  const auto limit = static_cast<std::size_t>(PlannerNumbers::EasingFraction * span.Clock.Frames);
  const std::vector<SoftMark> guide = span.Problem.Soft;
  std::vector<double> pulls(positions.size(), 0.0);
  std::size_t before = limit + 1;
  for (int round = 0; last >= 1; ++round)
  {
    std::vector<int> hits;
    for (int k = 0; k < last && hits.size() < before;)
    {
      const int hit = field.FirstHit(positions, k + 1, last, this->Request.FirstFrame + k + 1, 1.0,
                                     this->CheckMargin);
      if (hit < 0)
      {
        break;
      }
      hits.push_back(hit);
      k = hit;
    }
    if (hits.empty())
    {
      return true;
    }
    // A landing is not eased: that would make it a fall again.
    const bool lands = span.Landing > 0 && !hits.empty() && hits.back() >= span.Landing;
    if (lands || round == PlannerNumbers::EasingRounds || hits.size() >= before)
    {
      return false; // or it does not get better
    }
    before = hits.size();
    for (int k : hits)
    {
      pulls[k] = pulls[k] > 0.0 ? PlannerNumbers::PullGrowth * pulls[k] : PlannerNumbers::FirstPull;
    }
    span.Problem.Soft = guide;
    const std::vector<double> spread = Spread(pulls);
    for (int k = 1; k < last; ++k)
    {
      if (spread[k] > 0.0)
      {
        span.Problem.Soft.push_back({ span.Before + k, anchors[k], spread[k] });
      }
    }
    positions = span.Frames();
  }
  return true;
}

bool SpanFitter::Fit(const PieceChain& chain, bool toGoal, SpanResult& result) const
{
  return this->Fit(chain, chain, toGoal, result);
}

/// grown: the chain as the trees have it, of as many samples.
bool SpanFitter::Fit(const PieceChain& chain, const PieceChain& grown, bool toGoal,
                     SpanResult& result) const
{
  SpanClock clock = this->Request.Clock;
  result.Halts = false;
  if (this->Request.HasGoal && !toGoal && clock.BrakeFrames == 0)
  {
    // A dead end: it stops there, so that it can turn.
    clock.BrakeFrames = std::min(
      static_cast<int>(std::lround(this->Library.Options().FramesPerSecond)), clock.Frames / 2);
    result.Halts = true;
  }
  std::vector<Vec3> path = RetimePath(BlendChain(this->Library, chain), clock);
  std::vector<Vec3> anchors = ChainTiming(this->Library, grown, clock).TreePositions();
  for (std::size_t k = 0; k < std::min(path.size(), this->Request.Ride.size()); ++k)
  {
    path[k] += this->Request.Ride[k];
    anchors[k] += this->Request.Ride[k];
  }
  SpanWarp span = LaySpan(this->Request, clock, path, anchors.back(), toGoal);
  std::vector<Vec3> positions = span.Frames();
  const double top = SpeedAllowance * this->Library.TopStep();
  result.IsHardLanding = false;
  if (toGoal)
  {
    // The mark comes before the manner.
    SpanWarp gentle = span;
    std::vector<Vec3> lowered = positions;
    BringDown(this->Request, this->Library, gentle, lowered);
    result.IsHardLanding = IsTooFast(lowered, top) && !IsTooFast(positions, top);
    if (!result.IsHardLanding)
    {
      span = std::move(gentle);
      positions = std::move(lowered);
    }
  }
  if (!this->Ease(span, anchors, toGoal, positions) || IsTooFast(positions, top))
  {
    return false;
  }
  result.Positions = positions;
  result.HasLargeJerk = HasLargeJerk(positions, this->Library.TopJerk());
  // Bends that marks and easing brought about stay when spans are united.
  result.SecondDifferences = span.Problem.Soft.empty() && span.Problem.Rows.empty()
                               ? SecondDifferences(path)
                               : SecondDifferences(positions);
  result.Pieces = chain.Pieces;
  const ChainTiming timing(this->Library, chain, clock);
  result.RetimingFactor = timing.RetimingFactor();
  result.PieceFrames = timing.PieceFrames();
  result.Sources = timing.Sources();
  const Piece& last = chain.Pieces.back();
  const auto end = static_cast<int>(this->Library.Samples(last.Segment).size()) - 1;
  result.HasContinuation =
    this->Request.GoesOn && end - last.Last >= this->Library.Window() && !result.Halts;
  result.Continuation = last;
  result.Continuation.First = last.Last;
  result.Continuation.Last = end;
  result.Continuation.Transform.Translation +=
    positions.back() - last.Transform * this->Library.Samples(last.Segment)[last.Last];
  return !this->Request.GoesOn || result.Halts || this->CanGoOn(positions, result);
}

/// A path that reaches its mark head on to a wall leaves the next flight no way.
bool SpanFitter::CanGoOn(const std::vector<Vec3>& positions, const SpanResult& result) const
{
  const int ahead = this->Library.Window() + PlannerNumbers::LookAhead;
  std::vector<Vec3> next{ positions.back() };
  const std::vector<Vec3>& samples = this->Library.Samples(result.Continuation.Segment);
  const Vec3 step = positions.back() - positions[positions.size() - 2];
  for (int k = 1; k <= ahead; ++k)
  {
    next.push_back(result.HasContinuation &&
                       result.Continuation.First + k <= result.Continuation.Last
                     ? Vec3(result.Continuation.Transform * samples[result.Continuation.First + k])
                     : Vec3(next.back() + step));
  }
  return this->Field.FirstHit(next, 1, ahead,
                              this->Request.FirstFrame + this->Request.Clock.Frames + 1, 1.0,
                              this->CheckMargin) < 0;
}

bool SpanFitter::FitRefined(const PieceChain& chain, bool toGoal, SpanResult& result) const
{
  if (!this->Fit(chain, toGoal, result))
  {
    return false;
  }
  PieceChain refined = chain;
  const double shift = PlannerNumbers::RefinementShift * this->Library.TypicalStep() *
                       this->Request.Clock.Frames /
                       static_cast<double>(std::max<std::size_t>(1, chain.Pieces.size()));
  if (RefineChain(this->Library, shift, refined).NumberOfReplaced > 0)
  {
    SpanResult better = result;
    if (this->Fit(refined, chain, toGoal, better))
    {
      result = better;
    }
  }
  return true;
}

} // namespace waft
