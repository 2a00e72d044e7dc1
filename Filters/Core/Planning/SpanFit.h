// SPDX-License-Identifier: BSD-3-Clause
// A chain of pieces made the flight of one span: blended, retimed, laid through its marks, brought
// down gently where it lands, eased away from what it was pushed into, checked.
#pragma once

#include "Planning/Blending.h"
#include "Planning/StyleGauge.h"
#include "Planning/Warp.h"

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
  std::vector<Vec3> Guide;  // a rough way from start to goal, or none
  double GuideWeight = 0.5; // 0..1
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
  std::vector<Vec3> Bends;     // second differences to keep when spans are united [m]
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
  bool IsKinked = false;      // more than air ever is, where it was eased around something
  bool IsRuledOut = false;    // it was too far in the time, or the map shows no way to the goal
  std::string Message;
};

/// How much faster than the database a step may be, of the 1.5 times that are promised.
constexpr double SpeedAllowance = 1.4;

class SpanFitter
{
public:
  /// field holds for paths that reach the goal, missField for the others; checkMargin [m] is kept
  /// beyond the clearance radius.
  SpanFitter(const SegmentLibrary& library, const ClearanceField& field,
             const ClearanceField& missField, const SpanRequest& request, double checkMargin) :
    Library(library),
    Field(field), MissField(missField), Request(request), CheckMargin(checkMargin)
  {
  }

  /// The chain from the start to the goal, or, when toGoal is false, to where it leads by itself.
  /// False when that is too fast, hits something, or cannot go on beyond its mark.
  bool Fit(const PieceChain& chain, bool toGoal, SpanResult& result) const;
  /// The same, with the chain refined where that is of use and passes, too.
  bool FitRefined(const PieceChain& chain, bool toGoal, SpanResult& result) const;

private:
  /// The span's samples within a warp: those before, the frames, and those of lying still after.
  struct Layout
  {
    SpanClock Clock;
    int Before = 0;
    int After = 0;
    int Landing = 0; // frame from which it is brought down, 0: it is not
    WarpProblem Warp;
  };
  /// end: where a path leads that is not to the goal.
  Layout LayOut(const std::vector<Vec3>& path, const Vec3& end, const SpanClock& clock,
                bool toGoal) const;
  std::vector<Vec3> Frames(const Layout& layout) const;
  void BringDown(Layout& layout, std::vector<Vec3>& positions) const;
  bool Ease(Layout& layout, const std::vector<Vec3>& anchors, bool toGoal,
            std::vector<Vec3>& positions) const;
  bool Fit(const PieceChain& chain, const PieceChain& grown, bool toGoal, SpanResult& result) const;
  bool CanGoOn(const std::vector<Vec3>& positions, const SpanResult& result) const;

  const SegmentLibrary& Library;
  const ClearanceField& Field;
  const ClearanceField& MissField;
  const SpanRequest& Request;
  double CheckMargin;
};

} // namespace waft
