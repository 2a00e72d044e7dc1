// SPDX-License-Identifier: BSD-3-Clause
// One free span, from a mark to the next or to nowhere: what is asked of it and what comes of it.
#pragma once

#include "Planning/Blending.h"
#include "Planning/StyleGauge.h"

#include <string>
#include <vector>

namespace waft
{

struct SpanRequest
{
  SpanEnd Start;
  SpanEnd Goal;
  bool HasGoal = true;
  double GoalRadius = 0.0; // anywhere in this ball is as good [m]
  int FirstFrame = 0;
  SpanClock Clock;
  bool HasContinuation = false;
  Piece Continuation;
  bool GoesOn = false;
  std::vector<Vec3> Before; // the two positions before the start, or none
  StyleHistory History;     // of the flights before
  std::vector<Vec3> Guide;  // a rough way from start to goal, or none
  double GuideWeight = 0.5; // 0..1
  /// What it starts from or comes to rest on moves: frames 0..Clock.Frames + 2, how far the path is
  /// from that to one that stands still [m]; or none.
  std::vector<Vec3> Ride;

  Vec3 RideAt(int frame) const
  {
    return this->Ride.empty() ? Vec3(Vec3::Zero()) : this->Ride[static_cast<std::size_t>(frame)];
  }
};

/// Which sample of which piece flies at a frame.
struct FrameSource
{
  int Piece = -1;
  int Sample = 0;
};

struct SpanResult
{
  bool ReachesGoal = false;
  std::vector<Vec3> Positions;         // frames 0..Clock.Frames, checked
  std::vector<Vec3> SecondDifferences; // second differences to keep when spans are united [m]
  std::vector<Piece> Pieces;
  std::vector<int> PieceFrames;     // first frame of each piece, within the span (may be negative)
  std::vector<FrameSource> Sources; // one a frame
  double RetimingFactor = 1.0;      // raw frames over frames of flight
  double Distance = 0.0; // gap that was closed, or to the goal when it was not reached [m]
  double Cost = 0.0;
  std::vector<Branch> Trees[2];
  bool HasContinuation = false;
  Piece Continuation;         // what is left of the last segment beyond the goal
  bool Halts = false;         // comes to a stop at its end, because the way went no farther
  bool IsHardLanding = false; // there was no time to come down gently
  bool HasLargeJerk = false;  // more than air ever is, where it was eased around something
  bool IsRuledOut = false;    // it was too far in the time, or the map shows no way to the goal
  std::string Message;
};

} // namespace waft
