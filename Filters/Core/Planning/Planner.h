// SPDX-License-Identifier: BSD-3-Clause
// Stylistic motion planning (Shi et al. 2005, section 4): every object flies on segments of the
// motion database from mark to mark, around obstacles, in the time there is.
#pragma once

#include "Base/Communicator.h"
#include "Base/ForceFields.h"
#include "Base/Monitor.h"
#include "Base/Motion.h"
#include "Base/Parallel.h"
#include "Base/Result.h"
#include "Base/SceneFrame.h"
#include "Constraints/Constraint.h"
#include "Obstacles/ObstacleSet.h"
#include "Planning/Guide.h"
#include "Trajectory/Alignment.h"
#include "Trajectory/MotionDatabase.h"

#include <cmath>
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
  /// Who plans beside this rank, the first; the others Serve with ServePlans among their kinds, as
  /// PlanKind.
  Communicator* Ranks = nullptr;
};

/// Members have the defaults; Visit says the rest of each field that a user sets.
struct PlanOptions : RotationRange
{
  std::uint64_t Seed = 1;
  double ConnectionThreshold = 0.06;
  double JoinThreshold = 0.05;
  int MaximumNumberOfBranches = 20000;
  int NumberOfCandidates = 32;
  double RetimingLimit = 0.15;
  double GuideWeight = 0.5;
  /// Branches kept for output, over all objects, in the order of the objects.
  int MaximumNumberOfStoredBranches = 20000;

  Result Validate() const { return ValidateFields<PlanOptions>(*this); }

  /// What tells the plans of one object and seed apart.
  template <class Visitor, class... Holder>
  static void VisitStyle(Visitor&& visit, Holder&... of)
  {
    RotationRange::Visit(visit, of...);
    visit(OptionField{ "ConnectionThreshold",
                       limits::Above(0, 1e9),
                       "",
                       "Residual over chord of the shared window above which two representatives "
                       "do not follow each other.",
                       { 0.001, 1 } },
          of.ConnectionThreshold...);
    visit(OptionField{ "JoinThreshold",
                       limits::Above(0, 1e9),
                       "",
                       "Relative offset of velocity that a path found at once may cost; more is "
                       "granted as the search lasts.",
                       { 0.001, 1 } },
          of.JoinThreshold...);
    visit(OptionField{ "MaximumNumberOfBranches",
                       { 1, 1000000 },
                       "",
                       "Limit of branches of the two trees of one flight; beyond it a mark counts "
                       "as unreachable." },
          of.MaximumNumberOfBranches...);
    visit(
      OptionField{
        "NumberOfCandidates",
        { 1, 1000 },
        "",
        "Paths looked for in each flight; the one nearest to the style of the database is taken." },
      of.NumberOfCandidates...);
    visit(
      OptionField{ "RetimingLimit",
                   { 0, 0.5 },
                   "",
                   "Fraction by which a path may last longer or shorter before its time is scaled "
                   "to the frames there are." },
      of.RetimingLimit...);
    visit(
      OptionField{
        "GuideWeight",
        { 0, 1 },
        "",
        "How closely paths follow their guides: 0 not at all, 1 as closely as the style allows." }
        .With("Guides"),
      of.GuideWeight...);
  }

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    VisitStyle(visit, of...);
    visit(SeedField(), of.Seed...);
  }
};

/// One branch of a tree, as a polyline.
struct TreeBranch
{
  int ObjectId = 0;
  int Span = 0;      // index of the flight along the object's time line
  int Tree = 0;      // 0 from the start, 1 from the goal
  int Parent = -1;   // index in PlanOutput::Trees, -1: a root
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
  double TopSpeed = 0.0;               // of the database as it was used [m/s]
};

class PlanCache;

/// What PlanMotion does first: gives rows to objects and judges them, and flies nothing. Sets
/// Constraints, Report, TopSpeed and, of each object, its line. Fails as PlanMotion does.
Result JudgePlan(const PlanInput& input, const PlanOptions& options, const ParallelFor& parallelFor,
                 PlanOutput& output);

/// Objects are planned independently and in parallel: what an object does depends on its own rows,
/// the Seed and its ObjectId only. With a memory only those are planned whose own rows, data,
/// guide, database, obstacles, volume or options changed since they were planned last; the result
/// has the same bytes as without one (but for Seconds and IsPlanned). Rows that cannot be met are
/// named in the report and all the others are still met. Errors: a database that is not valid, no
/// frames, a row of an unknown object or frame, numbers that are not finite.
Result PlanMotion(const PlanInput& input, const PlanOptions& options,
                  const ParallelFor& parallelFor, Monitor& monitor, PlanOutput& output,
                  PlanCache* memory = nullptr);

} // namespace waft
