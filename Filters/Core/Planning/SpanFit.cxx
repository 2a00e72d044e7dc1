// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/SpanFit.h"

#include "Obstacles/Rest.h"
#include "Planning/Refinement.h"
#include "Planning/RoomMap.h"

#include <algorithm>
#include <cmath>

namespace waft
{

namespace
{

/// Rounds of easing, and the share of frames in the way beyond which it is not tried.
constexpr int EasingRounds = 6;
constexpr double EasingShare = 0.35;
/// Pull towards the tree at a frame that is in the way, and its growth from round to round. At the
/// first it bends about ten frames, at the last hardly more than the frame itself.
constexpr double FirstPull = 1e-3;
constexpr double PullGrowth = 6.0;
/// Frames to either side that a pull holds as well.
constexpr int PullReach = 4;
/// Pull of a guide of full weight on each frame: what bends within 18 frames is left as it flies.
constexpr double GuidePull = 1e-5;
/// Of the database's top speed, the mean fall before a landing above which the landing is faster.
constexpr double DivingShare = 0.6;

/// Which piece flies at each frame, by the middles of the overlaps; indices of samples are those of
/// the chain.
struct ChainClock
{
  std::vector<int> Beginnings;
  double Scale = 1.0; // samples per frame of flight

  ChainClock(const PieceChain& chain, const SpanClock& clock, int window) :
    Beginnings(chain.Beginnings(window)),
    Scale((chain.NumberOfSamples(window) - 1.0) / clock.FlightFrames()),
    HalfOverlap(0.5 * (window - 1))
  {
  }
  /// The piece of a sample, for samples that grow from call to call.
  std::size_t PieceAt(double index, std::size_t piece) const
  {
    while (piece + 1 < this->Beginnings.size() &&
           index >= this->Beginnings[piece + 1] + this->HalfOverlap)
    {
      ++piece;
    }
    return piece;
  }

private:
  double HalfOverlap;
};

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
bool HasKink(const std::vector<Vec3>& positions, double most)
{
  for (std::size_t k = 3; k < positions.size(); ++k)
  {
    const Vec3 jolt =
      positions[k] - 3.0 * positions[k - 1] + 3.0 * positions[k - 2] - positions[k - 3];
    if (jolt.norm() > most)
    {
      return true;
    }
  }
  return false;
}

/// A pull holds its neighbours, too, less with the distance: along with the tree, not to a point,
/// which would be a kink.
std::vector<double> Spread(const std::vector<double>& pulls)
{
  std::vector<double> result(pulls.size(), 0.0);
  const auto count = static_cast<int>(pulls.size());
  for (int k = 0; k < count; ++k)
  {
    for (int i = std::max(0, k - PullReach);
         pulls[k] > 0.0 && i <= std::min(count - 1, k + PullReach); ++i)
    {
      const double u = 1.0 - std::abs(i - k) / (PullReach + 1.0);
      result[i] = std::max(result[i], u * u * u * pulls[k]);
    }
  }
  return result;
}

/// Where the trees have the chain at each frame: clear of everything, but with a gap at the join.
std::vector<Vec3> TreePositions(const SegmentLibrary& library, const PieceChain& chain,
                                const SpanClock& clock)
{
  const ChainClock chainClock(chain, clock, library.Window());
  std::vector<Vec3> result;
  std::size_t piece = 0;
  for (int frame = 0; frame <= clock.Frames; ++frame)
  {
    const double index = clock.Flown(frame) * chainClock.Scale;
    piece = chainClock.PieceAt(index, piece);
    const Piece& body = chain.Pieces[piece];
    const std::vector<Vec3>& samples = library.Samples(body.Segment);
    const double own = std::clamp(body.First + index - chainClock.Beginnings[piece],
                                  static_cast<double>(body.First), static_cast<double>(body.Last));
    const int low = std::min(static_cast<int>(own), std::max(body.First, body.Last - 1));
    const Vec3& a = samples[low];
    const Vec3& b = samples[std::min(low + 1, body.Last)];
    result.push_back(body.Place * Vec3(a + (own - low) * (b - a)));
  }
  return result;
}

} // namespace

SpanFitter::Layout SpanFitter::LayOut(const std::vector<Vec3>& path, const Vec3& end,
                                      const SpanClock& clock, bool toGoal) const
{
  Layout layout;
  layout.Clock = clock;
  layout.Before = static_cast<int>(this->Request.Before.size());
  layout.After = this->Request.Goal.IsRest && toGoal ? 2 : 0;
  const int before = layout.Before;
  const int count = before + clock.Frames + 1 + layout.After;

  Vec3 goal = this->Request.Goal.Position;
  if (toGoal && this->Request.GoalRadius > 0.0)
  {
    const Vec3 offset = path.back() - goal;
    const double distance = offset.norm();
    goal += offset * std::min(1.0, 0.9 * this->Request.GoalRadius / std::max(distance, 1e-300));
  }
  WarpProblem& warp = layout.Warp;
  warp.SecondDifferences.assign(count, Vec3::Zero());
  warp.IsFixed.assign(count, 0);
  warp.Fixed.assign(count, Vec3::Zero());
  const std::vector<Vec3> bends = SecondDifferences(path);
  std::copy(bends.begin() + 1, bends.begin() + clock.Frames,
            warp.SecondDifferences.begin() + before + 1);
  const auto fix = [&](int k, const Vec3& value)
  {
    warp.IsFixed[k] = 1;
    warp.Fixed[k] = value;
  };
  for (int k = 0; k < before; ++k)
  {
    fix(k, this->Request.Before[k]);
  }
  fix(before, this->Request.Start.Position);
  if (before > 0 && clock.Frames > 1 && clock.LaunchFrames == 0)
  {
    warp.SecondDifferences[before] = bends[1];
  }
  for (int k = 0; k <= layout.After && toGoal; ++k)
  {
    fix(before + clock.Frames + k, goal);
  }
  if (!toGoal)
  {
    // The end stays where the trees, which are clear, have it.
    fix(before + clock.Frames, end);
  }
  if (before == 0 && this->Request.Start.HasVelocity && clock.Frames >= 3)
  {
    warp.Rows.push_back({ { 0, 1, 2 }, { -1.5, 2.0, -0.5 }, this->Request.Start.Velocity });
  }
  if (toGoal && this->Request.Guide.size() > 1)
  {
    const double pull = GuidePull * this->Request.GuideWeight * this->Request.GuideWeight;
    for (int k = 1; k < clock.Frames; ++k)
    {
      const double share = clock.Flown(k) / clock.FlightFrames();
      warp.Soft.push_back({ before + k, PointAlong(this->Request.Guide, share), pull });
    }
  }
  return layout;
}

std::vector<Vec3> SpanFitter::Frames(const Layout& layout) const
{
  const std::vector<Vec3> solved = SolveWarp(layout.Warp);
  return { solved.begin() + layout.Before,
           solved.begin() + layout.Before + layout.Clock.Frames + 1 };
}

/// In the last second before a rest it sinks evenly, no faster than the goal allows, and slows down
/// over the LandingTime. The height that this leaves over is spread over the rest of the span.
void SpanFitter::BringDown(Layout& layout, std::vector<Vec3>& positions) const
{
  const double second = this->Library.Options().FramesPerSecond;
  const auto cushion = static_cast<int>(std::lround(second * LandingTime));
  const auto inner = static_cast<int>(std::lround(0.9 * second));
  const auto outer = static_cast<int>(std::lround(1.5 * second));
  const int frames = layout.Clock.Frames;
  if (!(this->Request.Goal.Descent > 0.0) || layout.After == 0 || cushion < 2 ||
      frames - outer < layout.Clock.LaunchFrames + 3)
  {
    return;
  }
  const int a = frames - outer;
  const int b = frames - inner;
  layout.Landing = a;
  const double own = (positions[a].z() - positions[b].z()) / (b - a);
  // A goal that is near in time may be far below: the rest of the span must not have to dive.
  const double drop = this->Request.Start.Position.z() - this->Request.Goal.Position.z();
  const double affordable =
    (drop - DivingShare * this->Library.TopStep() * b) / (inner - 0.5 * cushion);
  const double most = std::max(this->Request.Goal.Descent, affordable);
  const double descent = std::clamp(own, 0.25 * this->Request.Goal.Descent, most);
  std::vector<Vec3>& bends = layout.Warp.SecondDifferences;
  for (int k = 1; k < frames; ++k)
  {
    const int left = frames - k; // to the ground
    double& bend = bends[layout.Before + k].z();
    if (left >= outer)
    {
      const double u = std::min(1.0, (left - outer) / (0.5 * second));
      bend *= u * u * (3.0 - 2.0 * u);
    }
    else
    {
      const double u = static_cast<double>(left) / cushion;
      bend = u < 1.0 ? descent * 6.0 * u * (1.0 - u) / cushion : 0.0;
    }
  }
  // Only the height is bound; along the ground the rows ask for what is there.
  LinearRow sinking{ { layout.Before + a, layout.Before + b },
                     { -1.0, 1.0 },
                     positions[b] - positions[a] };
  sinking.Value.z() = -descent * (b - a);
  LinearRow height{ { layout.Before + b }, { 1.0 }, positions[b] };
  height.Value.z() = positions[frames].z() + descent * (inner - 0.5 * cushion);
  layout.Warp.Rows.push_back(sinking);
  layout.Warp.Rows.push_back(height);
  positions = this->Frames(layout);
}

/// What is in the way after redistribution is drawn back to where the trees, which are clear, have
/// it; the gap is spread over the rest.
bool SpanFitter::Ease(Layout& layout, const std::vector<Vec3>& anchors, bool toGoal,
                      std::vector<Vec3>& positions) const
{
  const ClearanceField& field = toGoal ? this->Field : this->MissField;
  // The given ends themselves are judged elsewhere.
  const int last = toGoal ? layout.Clock.Frames - 1 : layout.Clock.Frames;
  const auto limit = static_cast<std::size_t>(EasingShare * layout.Clock.Frames);
  const std::vector<SoftMark> guide = layout.Warp.Soft;
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
    const bool lands = layout.Landing > 0 && !hits.empty() && hits.back() >= layout.Landing;
    if (lands || round == EasingRounds || hits.size() >= before)
    {
      return false; // or it does not get better
    }
    before = hits.size();
    for (int k : hits)
    {
      pulls[k] = pulls[k] > 0.0 ? PullGrowth * pulls[k] : FirstPull;
    }
    layout.Warp.Soft = guide;
    const std::vector<double> spread = Spread(pulls);
    for (int k = 1; k < last; ++k)
    {
      if (spread[k] > 0.0)
      {
        layout.Warp.Soft.push_back({ layout.Before + k, anchors[k], spread[k] });
      }
    }
    positions = this->Frames(layout);
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
  const std::vector<Vec3> path = RetimePath(BlendChain(this->Library, chain), clock);
  const std::vector<Vec3> anchors = TreePositions(this->Library, grown, clock);
  Layout layout = this->LayOut(path, anchors.back(), clock, toGoal);
  std::vector<Vec3> positions = this->Frames(layout);
  const double top = SpeedAllowance * this->Library.TopStep();
  result.IsHardLanding = false;
  if (toGoal)
  {
    // The mark comes before the manner.
    Layout gentle = layout;
    std::vector<Vec3> lowered = positions;
    this->BringDown(gentle, lowered);
    result.IsHardLanding = IsTooFast(lowered, top) && !IsTooFast(positions, top);
    if (!result.IsHardLanding)
    {
      layout = std::move(gentle);
      positions = std::move(lowered);
    }
  }
  if (!this->Ease(layout, anchors, toGoal, positions) || IsTooFast(positions, top))
  {
    return false;
  }
  result.Positions = positions;
  result.IsKinked = HasKink(positions, this->Library.TopJolt());
  // Bends that marks and easing brought about stay when spans are united.
  result.Bends = layout.Warp.Soft.empty() && layout.Warp.Rows.empty()
                   ? SecondDifferences(path)
                   : SecondDifferences(positions);
  result.Pieces = chain.Pieces;
  const ChainClock chainClock(chain, clock, this->Library.Window());
  result.RetimingFactor = chainClock.Scale;
  result.PieceFrames.clear();
  for (std::size_t i = 0; i < chain.Pieces.size(); ++i)
  {
    result.PieceFrames.push_back(static_cast<int>(
      std::lround((chainClock.Beginnings[i] - chain.Pieces[i].First) / chainClock.Scale)));
  }
  result.Sources.assign(static_cast<std::size_t>(clock.Frames) + 1, FrameSource());
  std::size_t piece = 0;
  for (int frame = 0; frame <= clock.Frames; ++frame)
  {
    const double index = clock.Flown(frame) * chainClock.Scale;
    piece = chainClock.PieceAt(index, piece);
    const Piece& body = chain.Pieces[piece];
    result.Sources[frame] = {
      static_cast<int>(piece),
      std::clamp(body.First + static_cast<int>(std::lround(index - chainClock.Beginnings[piece])),
                 body.First, body.Last)
    };
  }
  const Piece& last = chain.Pieces.back();
  const auto end = static_cast<int>(this->Library.Samples(last.Segment).size()) - 1;
  result.HasContinuation =
    this->Request.GoesOn && end - last.Last >= this->Library.Window() && !result.Halts;
  result.Continuation = last;
  result.Continuation.First = last.Last;
  result.Continuation.Last = end;
  result.Continuation.Place.Translation +=
    positions.back() - last.Place * this->Library.Samples(last.Segment)[last.Last];
  return !this->Request.GoesOn || result.Halts || this->CanGoOn(positions, result);
}

/// A path that reaches its mark head on to a wall leaves the next flight no way.
bool SpanFitter::CanGoOn(const std::vector<Vec3>& positions, const SpanResult& result) const
{
  const int ahead = this->Library.Window() + 4;
  std::vector<Vec3> next{ positions.back() };
  const std::vector<Vec3>& samples = this->Library.Samples(result.Continuation.Segment);
  const Vec3 step = positions.back() - positions[positions.size() - 2];
  for (int k = 1; k <= ahead; ++k)
  {
    next.push_back(result.HasContinuation &&
                       result.Continuation.First + k <= result.Continuation.Last
                     ? Vec3(result.Continuation.Place * samples[result.Continuation.First + k])
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
  const double shift = 0.1 * this->Library.TypicalStep() * this->Request.Clock.Frames /
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
