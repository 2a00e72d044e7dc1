// SPDX-License-Identifier: BSD-3-Clause
// Two rapidly-exploring random trees of database segments, one from the start and one from the
// goal of a free span (Shi et al. 2005, section 4 and Fig. 3).
#pragma once

#include "Base/Random.h"
#include "Planning/ClearanceField.h"
#include "Planning/SegmentLibrary.h"

#include <vector>

namespace waft
{

/// A placed piece of a segment: its samples First..Last.
struct Piece
{
  int Segment = 0;
  int Top = 0; // its top-level cluster
  int First = 0;
  int Last = 0;
  Placement Transform;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Segment...);
    visit(of.Top...);
    visit(of.First...);
    visit(of.Last...);
    visit(of.Transform...);
  }
};

struct SpanEnd
{
  Vec3 Position = Vec3::Zero();
  bool HasVelocity = false;
  Vec3 Velocity = Vec3::Zero(); // wanted [m per frame]
  bool IsRest = false;          // the object lies still there
  double Descent = 0.0; // before a rest: fastest fall in the last second, 0: any [m per frame]
};

/// A stretch of flight between two marks. `Frames` are frames of flight at the database's own
/// speed: what landing and lift-off lose by braking is already taken off.
struct SpanTask
{
  SpanEnd Start;
  SpanEnd Goal;
  int Frames = 0;
  double FirstFrame = 0.0; // on the scene's time line
  bool HasContinuation = false;
  Piece Continuation;    // what is left of the segment that reached the start
  bool GoesOn = false;   // flight continues beyond the goal
  std::vector<Vec3> Way; // a coarse way around obstacles, or empty: straight
};

struct SpanSearchOptions
{
  double RetimingLimit = 0.15; // |raw frames - frames| / frames at most
  double Margin = 0.02;        // m, more than the clearance radius is kept while growing
};

struct Branch
{
  Piece Body;
  int Parent = -1;
  int Elapsed = 0; // frames from the tree's root to the free end
  Vec3 FreeEnd = Vec3::Zero();
  double Cost = 0.0;     // of the connection to the parent
  double Mismatch = 0.0; // of the root's velocity with that wanted, over the typical speed
  int Failures = 0;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Body...);
    visit(of.Parent...);
    visit(of.Elapsed...);
    visit(of.FreeEnd...);
    visit(of.Cost...);
    visit(of.Mismatch...);
    visit(of.Failures...);
  }
};

/// A way from start to goal: a forward branch, then either a backward branch or a last piece whose
/// cut end lies at the goal, or one single piece.
struct Join
{
  int Forward = -1;
  int Backward = -1;
  bool HasLastPiece = false;
  Piece LastPiece;
  int RawFrames = 0;
  double Distance = 0.0; // gap to close [m]
  double Angle = 0.0; // about the vertical, from where the table puts it to where it stands [rad]
  double Score = 0.0; // dimensionless: relative offset of velocity, turn and retiming it costs
};

class SpanSearch
{
public:
  SpanSearch(const SegmentLibrary& library, const ClearanceField& field, const SpanTask& task,
             const SpanSearchOptions& options, Random random);

  /// One attempt: a seed point, the seed node, the segment whose free end comes closest, collision,
  /// minimum connection cost. Trees alternate.
  void Step();
  /// From now on rough connections count, too.
  void AllowRough() { this->TakesRough = true; }
  /// True when no obstacle stands in the gap of a join: through a wall no path can be laid.
  bool IsGapClear(const Join& join) const;
  /// The best join not handed out yet, when its score is at most the threshold.
  bool Take(double threshold, Join& join);
  /// The forward paths that come nearest to the goal about in time.
  const std::vector<Join>& Approaches() const { return this->Nearest; }
  /// Pieces from start to goal of a join; the angle at the join and the index of the join in the
  /// list.
  std::vector<Piece> Chain(const Join& join, int& joinIndex) const;

  int NumberOfBranches() const
  {
    return static_cast<int>(this->Trees[0].size() + this->Trees[1].size());
  }
  const std::vector<Branch>& Tree(int which) const { return this->Trees[which]; }

  /// The seed node for a point at an elapsed time: least squared distance in space and time; -1
  /// when none can grow.
  int SeedNode(int tree, const Vec3& seed, double elapsed) const;
  /// The neighbour whose free end comes closest to the seed when attached to the branch.
  const Neighbour* BestSegment(int tree, const Branch& parent, const Vec3& seed) const;

private:
  void AddRoots(int tree, int count);
  bool AddRoot(int tree, const Piece& piece, double mismatch);
  void AddSinglePieces();
  void Insert(int tree, const Branch& branch);
  void MeetOther(int tree, int index);
  void CloseOnGoal(int index);
  void Offer(const Join& join);
  void OfferApproach(const Join& join);
  bool IsFree(const Piece& piece, double firstFrame) const;
  bool CanEndHere(const Piece& piece) const;
  double Score(double gap, double angle, int rawFrames, double mismatch) const;
  Vec3 Seed(int tree, double& frame);
  void RecordProgress(int tree, const Vec3& end);

  const SegmentLibrary& Library;
  const ClearanceField& Field;
  const SpanTask& Task;
  SpanSearchOptions Options;
  Random Stream;
  Box SeedBox;
  std::vector<double> WayFractions; // of the length of the task's way, one a point
  double Reached[2] = { 0.0, 1.0 }; // fractions of the way the trees have come to
  int Turn = 0;
  int Window = 0;
  int RootFailures[2] = { 0, 0 };
  bool TakesRough = false; // connections that are not smooth count, too
  std::vector<Branch> Trees[2];
  std::vector<Join> Joins; // best first
  std::vector<Join> Nearest;
};

} // namespace waft
