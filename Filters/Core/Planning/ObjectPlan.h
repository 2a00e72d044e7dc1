// SPDX-License-Identifier: BSD-3-Clause
// The whole path of one object: its spans one after the other, then all of them made one motion.
#pragma once

#include "Constraints/Constraint.h"
#include "Planning/ClearPath.h"
#include "Planning/Itinerary.h"
#include "Planning/SpanPlan.h"
#include "Planning/Vortices.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace waft
{

struct ObjectPlanOptions
{
  std::uint64_t Seed = 1;
  SpanPlanOptions Span;
  double Tolerance = 0.0005; // m, by which the swept centre may miss the clearance radius
};

/// What happened to one mark.
struct MarkOutcome
{
  int Constraint = -1;
  bool IsReached = true;
  double RetimingFactor = 1.0;
  double Cost = 0.0;
  int NumberOfBranches = 0;
  double Seconds = 0.0; // spent on the flight to it
  std::string Message;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Constraint...);
    visit(of.IsReached...);
    visit(of.RetimingFactor...);
    visit(of.Cost...);
    visit(of.NumberOfBranches...);
    visit(of.Seconds...);
    visit(of.Message...);
  }
};

/// The trees of one span.
struct SpanTrees
{
  int FirstFrame = 0;
  int LastFrame = 0;
  std::array<std::vector<Branch>, 2> Trees;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.FirstFrame...);
    visit(of.LastFrame...);
    visit(of.Trees...);
  }
};

struct ObjectPlan
{
  std::vector<Vec3> Positions; // one a frame
  std::vector<SegmentUse> Uses;
  std::vector<UseSample> Samples; // one a frame
  std::vector<MarkOutcome> Outcomes;
  std::vector<SpanTrees> Spans;
  PathShortfall Shortfall; // of the clearance
  double Seconds = 0.0;    // spent on all of it

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Positions...);
    visit(of.Uses...);
    visit(of.Samples...);
    visit(of.Outcomes...);
    visit(of.Spans...);
    visit(of.Shortfall...);
    visit(of.Seconds...);
  }
};

ObjectPlan PlanObject(const SegmentLibrary& library, const MotionObject& object,
                      const Itinerary& itinerary, const ObstacleSet& obstacles,
                      const SceneInfo& scene, const ObjectPlanOptions& options);

} // namespace waft
