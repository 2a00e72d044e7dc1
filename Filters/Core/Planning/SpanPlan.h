// SPDX-License-Identifier: BSD-3-Clause
// One free span: search, redistribution, refinement, blending, retiming, and the check of what
// came out.
#pragma once

#include "Planning/Blending.h"
#include "Planning/RoomMap.h"
#include "Planning/StyleGauge.h"

#include <atomic>
#include <functional>
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
  int GoalConstraint = -1; // the row, whose contact is void when it is not reached
  int FirstFrame = 0;
  SpanClock Clock;
  bool HasContinuation = false;
  Piece Continuation;
  bool GoesOn = false;
  std::vector<Vec3> Before; // the two positions before the start, or none
  StyleHistory History;     // of the flights before
};

struct SpanPlanOptions
{
  double RetimingLimit = 0.15;
  double JoinThreshold = 0.05; // score at which a join is taken at once
  double Margin = 0.02;        // m, kept beyond the clearance radius while growing
  double CheckMargin = 0.001;  // m, kept beyond it by what comes out
  int MaximumNumberOfBranches = 20000;
  int NumberOfCandidates = 32;   // paths found, of which the one nearest to the style is taken
  double FrameStep = 1.0 / 30.0; // s
  const std::atomic<bool>* Stop = nullptr; // asked for while searching
  const StyleGauge* Gauge = nullptr;       // or null: the first path found is taken
  std::function<const RoomMap*()> Rooms;   // asked where the straight way is blocked, or empty
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
  std::vector<Vec3> Positions; // frames 0..Clock.Frames, checked
  std::vector<Vec3> Bends;     // second differences of the blended chain, the style to keep [m]
  std::vector<Piece> Pieces;
  std::vector<int> PieceFrames;     // first frame of each piece, within the span (may be negative)
  std::vector<FrameSource> Sources; // one a frame
  double RetimingFactor = 1.0;      // raw frames over frames of flight
  double Distance = 0.0; // gap that was closed, or to the goal when it was not reached [m]
  double Cost = 0.0;
  std::vector<Branch> Trees[2];
  bool HasContinuation = false;
  Piece Continuation; // what is left of the last segment beyond the goal
  bool Halts = false; // comes to a stop at its end, because the way went no farther
  std::string Message;
};

/// Always returns a path, as near as possible when the goal was not reached.
SpanResult PlanSpan(const SegmentLibrary& library, const ClearanceField& field,
                    const SpanRequest& request, const SpanPlanOptions& options, Random random);

} // namespace waft
