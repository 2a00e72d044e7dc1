// SPDX-License-Identifier: BSD-3-Clause
// Stylistic motion planning (Shi et al. 2005, section 4): every object flies on segments of the
// motion database from mark to mark, around obstacles, in the time there is.
#pragma once

#include "Base/ForceFields.h"
#include "Base/Monitor.h"
#include "Base/Motion.h"
#include "Base/Parallel.h"
#include "Base/Result.h"
#include "Constraints/Constraint.h"
#include "Obstacles/ObstacleSet.h"
#include "Planning/Guide.h"
#include "Trajectory/Alignment.h"
#include "Trajectory/MotionDatabase.h"

#include <cstdint>
#include <string>
#include <vector>

namespace waft
{

struct PlanInput
{
  const MotionDatabase& Database;
  const std::vector<MotionObject>& Objects;
  const std::vector<Constraint>& Constraints;
  const ObstacleSet& Obstacles;
  SceneInfo Scene;
  std::vector<Guide> Guides = {}; // at most one an object
};

struct PlanOptions
{
  std::uint64_t Seed = 1;
  RotationFreedom Freedom = RotationFreedom::YawAndTilt;
  double MaximumTilt = DefaultMaxTilt; // rad
  /// Residual over chord (Eq. 1) above which two segments are not connectible.
  double ConnectionThreshold = 0.06;
  /// Relative offset of velocity at which a join is taken at once; it grows as the search lasts.
  double JoinThreshold = 0.05;
  /// Limit of branches of the two trees of one span.
  int MaximumNumberOfBranches = 20000;
  /// Paths looked for in each span; the one nearest to the database's curvatures and accelerations
  /// is taken.
  int NumberOfCandidates = 32;
  /// Frames that a path lasts may differ from the frames there are by this share before retiming.
  double RetimingLimit = 0.15;
  /// How closely paths follow their guides, 0 (not at all) to 1.
  double GuideWeight = 0.5;
  /// Branches kept for output, over all objects, in the order of the objects.
  int MaximumNumberOfStoredBranches = 20000;

  Result Validate() const;
};

/// One branch of a tree, as a polyline.
struct TreeBranch
{
  int ObjectId = 0;
  int Span = 0;      // place of the flight along the object's time line
  int Tree = 0;      // 0 from the start, 1 from the goal
  int Parent = -1;   // place in PlanOutput::Trees, -1: a root
  int Segment = 0;   // of the database
  double Cost = 0.0; // of the connection to the parent
  int Frame = 0;     // of the free end
  std::vector<Vec3> Points;
};

/// What one flight to a mark took.
struct FlightRow
{
  int ObjectId = 0;
  int Row = 0;
  int Target = 0;
  int Frame = 0;
  bool IsReached = true;
  double RetimingFactor = 1.0;
  double Cost = 0.0;        // of the path laid
  int NumberOfBranches = 0; // of both trees; 0: drawn, not searched
  double Seconds = 0.0;     // wall time; it varies from run to run
};

/// What one object's plan came to.
struct ObjectRow
{
  int ObjectId = 0;
  int NumberOfRows = 0; // lines of the report that are about it
  int NumberOfMet = 0;
  ConstraintStatus Status = ConstraintStatus::Met; // the worst of its lines and of its start
  double Cost = 0.0;                               // of all its flights to marks
  int NumberOfBranches = 0;
  double Seconds = 0.0;  // wall time of its own planning, now or when it was planned
  bool IsPlanned = true; // false: taken from an earlier run that it would only repeat
  std::string Message;   // its start, or where it comes too near to something
};

struct PlanOutput
{
  std::vector<Track> Tracks; // one an object, in their order, NumberOfFrames samples
  std::vector<TreeBranch> Trees;
  std::vector<ReportRow> Report;
  std::vector<Constraint> Constraints; // as given, every row assigned
  std::vector<Vortex> Vortices;        // of the segments used, moved with them
  std::vector<FlightRow> Flights;      // in the order of the objects, then of time
  std::vector<ObjectRow> Objects;      // one an object that was planned, in their order
};

class PlanMemory;

/// Objects are planned independently and in parallel: what an object does depends on its own rows,
/// the Seed and its ObjectId only. With a memory only those are planned whose own rows, data,
/// guide, database, obstacles, volume or options changed since they were planned last; the result
/// has the same bytes as without one (but for Seconds and IsPlanned). Rows that cannot be met are
/// named in the report and all the others are still met. Errors: a database that is not valid, no
/// frames, a row of an unknown object or frame, numbers that are not finite.
Result PlanMotion(const PlanInput& input, const PlanOptions& options,
                  const ParallelFor& parallelFor, Monitor& monitor, PlanOutput& output,
                  PlanMemory* memory = nullptr);

} // namespace waft
