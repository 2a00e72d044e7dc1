// SPDX-License-Identifier: BSD-3-Clause
// The planner's numbers that nobody sets, each with its unit and what it means; and how it was
// found where that was kept. Lengths are relative (to widths of the volume, radii of the body or
// flights of the database) unless in m.
#pragma once

#include <array>
#include <cstddef>

namespace waft
{

struct PlannerNumbers
{
  /// @name The whole plan, lengths in widths of the volume.
  ///@{
  static constexpr double Tolerance = 2e-4;     // by which a path may miss the clearance
  static constexpr double GrowingMargin = 5e-3; // kept beyond the clearance while trees grow
  static constexpr double CheckMargin = 2e-4;   // kept beyond it by what comes out
  static constexpr double SamePosition = 2e-9;  // apart, positions are taken as one
  static constexpr double GuideEnd = 0.02;      // radius of the mark at the end of a guide
  static constexpr double FarFactor = 2.0;      // frame rates farther apart are remarked; sides are
                                                // brought as near to those of the database
  /// Cells of the maps along the width: the fine one finds passages hardly wider than the body.
  static constexpr std::array<int, 2> MapCells{ 32, 64 };
  ///@}

  /// @name Rows shared out among objects.
  ///@{
  /// Of the database's top speed: at 0.8 of it nearly every leg is met, at the whole hardly any.
  static constexpr double EasyHaste = 0.85;
  /// Assignments that may be solved until one holds with certainty the least cost: so many, or as
  /// many as there are of this number of pairs in all.
  static constexpr std::size_t MostSolutions = 400;
  static constexpr std::size_t MostPairs = 40000000;
  /// Rows and stretches of time between fixed positions that are shared out all together; more of
  /// them one after the other, since memory grows with the square.
  static constexpr std::size_t MostTogether = 3000;
  ///@}

  /// @name Marks of an object.
  ///@{
  static constexpr double HaltingSpeed = 0.02; // m/s; what is to be slower is to halt
  /// Fastest fall in the last second before a rest over the SettlingSpeed: what the air may add
  /// near the ground.
  static constexpr double LandingDescent = 1.1;
  /// Other ways to a mark that are tried when there is no way on from where a flight came to it.
  static constexpr int Returns = 3;
  /// Of the farthest point that a drawn stretch can reach, where it goes when its mark is farther.
  static constexpr double DrawnFraction = 0.7;
  static constexpr double SeamRate = 3.0; // 1/s; seams are healed over its inverse to either side
  /// Top speed of the repair over the database's: a little above SpeedAllowance.
  static constexpr double RepairAllowance = 1.45;
  static constexpr int RepairRounds = 40;
  static constexpr int RepairReach = 5;       // frames to either side that are pushed along
  static constexpr double RepairBeyond = 2.0; // times the tolerance, beyond what is asked for
  static constexpr double RepairPull = 0.05;  // weight of a push, over that of a second difference
  static constexpr double LaidOn = 4.0;       // times the tolerance: so far below a plane of rest
  ///@}

  /// @name Maps of free space.
  ///@{
  static constexpr int EntryCells = 3;          // in which an end that does not fit is entered
  static constexpr double EnoughSpacings = 2.0; // room beyond which no way is better: of a cell,
  static constexpr double EnoughRadii = 4.0;    // and of the clearance, the larger
  static constexpr double NarrowDetour = 0.5;  // of its length, for a cell as wide as the clearance
  static constexpr double SightFraction = 0.5; // of the clearance, free between two cells
  ///@}

  /// @name Seeds of the trees.
  ///@{
  static constexpr double SeedReach = 0.3; // of half of what is flown at top speed, about both ends
  static constexpr double SeedRadii = 2.0; // of the body, at least
  static constexpr double SeedsAboutLine = 0.5; // fraction of seeds about the straight line,
  static constexpr double SeedsAboutWay = 0.8;  // or about a way; others are anywhere
  static constexpr double SeedSpread = 0.35; // of what is flown in all, half way between the ends
  static constexpr double WaySpread = 4.0;   // the same about a way around obstacles [body radii]
  /// Of seeds about a way, how many are where the trees have come to, and the fraction of the way
  /// meant by that: trees find through narrower windows.
  static constexpr double FrontFraction = 0.5;
  static constexpr double FrontLength = 0.06;
  static constexpr double FrontBack = 0.5; // of FrontLength, behind where they have come to
  ///@}

  /// @name Growing the trees.
  ///@{
  static constexpr int FirstRoots = 8;    // of each tree
  static constexpr int TurnsPerRoot = 16; // of both trees, between two more roots of each
  static constexpr int RootDraws = 48;    // of which the nearest to a velocity is a root
  static constexpr int RootFailures = 40; // after which a velocity is not asked for any more
  static constexpr int FailuresUntilGivenUp = 12; // of a node
  static constexpr int SinglePieceStride = 2;     // frames between cuts tried of a single piece
  static constexpr int LandingLook = 30;          // frames in which a landing comes from above
  static constexpr double LandingSlack = 1e-6;    // m, of that
  ///@}

  /// @name Joins of the trees. Their score is relative: the gap is in typical flights of the span.
  ///@{
  static constexpr double AngleCost = 0.25;   // a rad that the join turns
  static constexpr double RetimingCost = 0.5; // a fraction of time by which pieces are retimed
  static constexpr double MismatchCost = 0.1; // a typical speed that an end's velocity is off
  static constexpr double WorstScore = 1.5;   // of a join that is kept at all
  /// Of the width of the database's volume: free ends of two pieces that fit may be so far.
  static constexpr double WindowLength = 0.125;
  static constexpr std::size_t KeptJoins = 32;      // best first
  static constexpr std::size_t KeptApproaches = 12; // nearest first
  ///@}

  /// @name How long trees grow, and what is asked of a join meanwhile.
  ///@{
  static constexpr int StepsPerBranch = 6;     // over MaximumNumberOfBranches, at most
  static constexpr int RoughAfter = 3000;      // steps without a path: rough connections count, too
  static constexpr int RoughAfterInMaze = 600; // the same along a way
  static constexpr double Patience = 300.0;    // steps in which the JoinThreshold doubles
  static constexpr double MildestThreshold = 0.6; // score
  static constexpr double LastThreshold = 1.0;    // at the end, when no path was found
  static constexpr int MoreSteps = 3; // over those to the first path, to find better ones,
  static constexpr int MoreStepsAtLeast = 200;
  static constexpr int StepsTowards = 200;    // towards what is too far
  static constexpr int RuledOutBranches = 20; // one in so many where the map shows no way
  static constexpr double ClearSight = 0.9;   // of the radius: such a straight way needs no map
  ///@}

  /// @name Choosing among paths. Distances of style are below 2.
  ///@{
  /// s without a mark, up to which all candidates are looked for. Of twice as long a flight twice
  /// as much is to be fitted for each, and twice as many fail; it shows more of its style by
  /// itself.
  static constexpr double LongFlight = 20.0;
  static constexpr int FewestCandidates = 3;        // of a longer one
  static constexpr double HardLandingPenalty = 4.0; // more than any difference in style
  static constexpr double JerkPenalty = 1.0;        // half of what styles can differ by
  /// Of a path twice as fierce as air ever is, against the distances of style.
  static constexpr double AccelerationExcessWeight = 0.1;
  static constexpr int Quantiles = 200; // that keep a distribution of the database
  /// Accelerations of a path that has little time are farther from the database's in any case; its
  /// shape need not be.
  static constexpr double CurvatureWeight = 1.25;
  static constexpr double AccelerationWeight = 0.75;
  static constexpr double HighQuantile = 0.99; // of accelerations lie below what counts as fierce
  ///@}

  /// @name Free flights, where no mark is reached; see the order of what is tried in SpanPlan.cxx.
  ///@{
  static constexpr int FlightsOn = 6;           // that go on with the velocity at the start
  static constexpr int FlightsAnew = 2;         // with any velocity: the seam is left to be healed
  static constexpr int FlightSteps = 2000;      // of one
  static constexpr double FirstMismatch = 0.05; // of the velocity at the start, relative
  static constexpr double MismatchGrowth = 0.002; // with each draw that misses
  /// Frames in which an object comes to hover, from gentle to sudden.
  static constexpr std::array<double, 4> Pauses{ 8.0, 4.0, 2.0, 1.0 };
  ///@}

  /// @name A chain of pieces made one path.
  ///@{
  /// s to either side of a connection, over which its pieces are handed over. Over the window alone
  /// what is left of the difference in velocity would take several times the air's accelerations.
  static constexpr double HandoverTime = 1.25;
  static constexpr double RefinementShift = 0.1; // of a typical piece, its end may move
  static constexpr int RotationSteps = 3;        // of Gauss-Newton: the yaw before is near
  static constexpr double RotationRidge = 1e-2;  // of the trace: straight windows do not spin
  static constexpr int LookAhead = 4;            // frames beyond a window that must be free
  static constexpr double GoalFraction = 0.9;    // of a mark's ball that is used
  /// Pull of a guide of full weight on each frame: what bends within 18 frames is left as it flies.
  static constexpr double GuidePull = 1e-5;
  ///@}

  /// @name Easing around obstacles.
  ///@{
  static constexpr int EasingRounds = 6;
  static constexpr double EasingFraction = 0.35; // of frames in the way: beyond it is not tried
  /// Pull towards the tree at a frame that is in the way, and its growth from round to round. At
  /// the first it bends about ten frames, at the last hardly more than the frame itself.
  static constexpr double FirstPull = 1e-3;
  static constexpr double PullGrowth = 6.0;
  static constexpr int PullReach = 4; // frames to either side that a pull holds as well
  ///@}

  /// @name Landings.
  ///@{
  static constexpr double SinkTime = 0.9;     // s before the ground, from where the height is given
  static constexpr double SettleTime = 1.5;   // s, from where the fall is even
  static constexpr double FadeTime = 0.5;     // s before that, over which bends fade
  static constexpr double SlowestSink = 0.25; // of the descent asked for
  /// Of the database's top speed, the mean fall before a landing above which the landing is faster.
  static constexpr double DivingFraction = 0.6;
  ///@}

  /// @name Spans united.
  ///@{
  static constexpr int HealingRounds = 3;
  static constexpr double RowLeft = 0.9;  // of a row's radius: beyond it is imposed,
  static constexpr double RowGiven = 0.8; // at so much of it
  ///@}
};

} // namespace waft
