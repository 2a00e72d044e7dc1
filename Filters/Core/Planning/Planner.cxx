// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/Planner.h"

#include "Constraints/ConstraintCheck.h"
#include "Constraints/Keyframes.h"
#include "Planning/InputCheck.h"
#include "Planning/PlanCache.h"
#include "Planning/PlanReport.h"
#include "Planning/PlannerNumbers.h"
#include "Planning/RowConflicts.h"
#include "Planning/RowCover.h"
#include "Planning/ScenePlans.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace waft
{

namespace
{

void StoreTrees(const SegmentLibrary& library, int objectId, const std::vector<SpanTrees>& spans,
                std::size_t limit, std::vector<TreeBranch>& output)
{
  for (std::size_t s = 0; s < spans.size(); ++s)
  {
    for (int tree = 0; tree < 2; ++tree)
    {
      const auto base = static_cast<int>(output.size());
      for (const Branch& branch : spans[s].Trees[tree])
      {
        if (output.size() >= limit)
        {
          return;
        }
        TreeBranch stored;
        stored.ObjectId = objectId;
        stored.Span = static_cast<int>(s);
        stored.Tree = tree;
        stored.Parent = branch.Parent < 0 ? -1 : base + branch.Parent;
        stored.Segment = branch.Body.Segment;
        stored.Cost = branch.Cost;
        stored.Frame =
          tree == 0 ? spans[s].FirstFrame + branch.Elapsed : spans[s].LastFrame - branch.Elapsed;
        const std::vector<Vec3>& samples = library.Samples(branch.Body.Segment);
        for (int k = branch.Body.First; k <= branch.Body.Last; ++k)
        {
          stored.Points.push_back(branch.Body.Transform * samples[k]);
        }
        output.push_back(std::move(stored));
      }
    }
  }
}

/// One a row: does it bind, as far as the report says?
std::vector<unsigned char> FindBinding(const PlanOutput& output)
{
  std::vector<unsigned char> isBinding;
  for (const Constraint& row : output.Constraints)
  {
    isBinding.push_back(IsBinding(row, output.Report) ? 1 : 0);
  }
  return isBinding;
}

/// Sets Constraints, Report and TopSpeed; returns for each row whether it is to be met.
std::vector<unsigned char> AssignAndJudge(const PlanInput& input, const SegmentLibrary& library,
                                          PlanOutput& output)
{
  const SpeedLimit limit(library.TopStep(), library.Options().FramesPerSecond,
                         library.ShortestSpan(),
                         PlannerNumbers::SamePosition * input.Scene.Bounds.Width());
  const auto judge = [&]()
  {
    output.Report =
      JudgeWithSpeeds(output.Constraints, input.Objects, input.Obstacles, input.Scene, limit);
    return FindBinding(output);
  };
  output.TopSpeed = library.Database().TopSpeed;
  output.Constraints = input.Constraints;
  AssignKeyframes(input.Objects, output.Constraints);
  std::vector<unsigned char> isUsed = judge();
  if (std::any_of(output.Constraints.begin(), output.Constraints.end(),
                  [](const Constraint& row) { return row.ObjectId < 0; }))
  {
    CoverRows(input.Objects, isUsed, input.Obstacles, limit, output.Constraints);
    isUsed = judge();
  }
  return isUsed;
}

/// The database as plans use it, out of the memory where there is one.
Result TakeTools(const PlanInput& input, const PlanOptions& options, const ParallelFor& parallelFor,
                 PlanCache* memory, std::shared_ptr<const PlanTools>& tools)
{
  const SegmentLibraryOptions library = LibraryOptionsOf(options, input.Database, input.Scene);
  if (memory == nullptr)
  {
    return MakePlanTools(input.Database, library, parallelFor, tools);
  }
  memory->Begin(input, options);
  return memory->Tools(input, library, parallelFor, tools);
}

/// Those that are whole, in the order of the objects, so that ids do not depend on threads.
void GiveOut(const PlanInput& input, const PlanOptions& options, const SegmentLibrary& library,
             ScenePlans& plans, PlanOutput& output)
{
  for (std::size_t i = 0; i < input.Objects.size(); ++i)
  {
    if (!plans.IsDone[i])
    {
      continue;
    }
    ObjectPlan& plan = plans.Plans[i];
    Track track;
    track.TakeTimes(input.Objects[i]);
    track.Positions = std::move(plan.Positions);
    Annotate(library, plan.Uses, plan.Samples, input.Scene.Time.FramesPerSecond, track,
             output.Vortices);
    output.Tracks.push_back(std::move(track));
    StoreTrees(library, input.Objects[i].ObjectId, plan.Spans,
               static_cast<std::size_t>(std::max(0, options.MaximumNumberOfStoredBranches)),
               output.Trees);
    ReportObject(input.Objects[i], plan, plans.IsKnown[i] == 0, output);
  }
}

/// What is said about all of them once all tracks are there.
void CompleteReport(const PlanInput& input, PlanOutput& output)
{
  ReportStarts(input, output);
  MarkUnmet(output.Report, output.Constraints);
  MeasureResiduals(output.Constraints, output.Tracks, input.Objects, input.Obstacles, input.Scene,
                   output.Report);
  CountLines(output);
}

} // namespace

Result JudgePlan(const PlanInput& input, const PlanOptions& options, const ParallelFor& parallelFor,
                 PlanOutput& output)
{
  output = PlanOutput();
  WAFT_RETURN_IF_FAILED(options.Validate());
  WAFT_RETURN_IF_FAILED(CheckPlanInput(input));
  std::shared_ptr<const PlanTools> tools;
  WAFT_RETURN_IF_FAILED(TakeTools(input, options, parallelFor, nullptr, tools));
  AssignAndJudge(input, tools->Library, output);
  for (const MotionObject& object : input.Objects)
  {
    output.Objects.emplace_back();
    output.Objects.back().ObjectId = object.ObjectId;
  }
  ReportStarts(input, output);
  MarkUnmet(output.Report, output.Constraints);
  CountLines(output);
  return Result::Ok();
}

Result PlanMotion(const PlanInput& input, const PlanOptions& options,
                  const ParallelFor& parallelFor, Monitor& monitor, PlanOutput& output,
                  PlanCache* memory)
{
  output = PlanOutput();
  WAFT_RETURN_IF_FAILED(options.Validate());
  WAFT_RETURN_IF_FAILED(CheckPlanInput(input));
  std::shared_ptr<const PlanTools> tools;
  WAFT_RETURN_IF_FAILED(TakeTools(input, options, parallelFor, memory, tools));
  if (!monitor.Tick(0.02, "Assigning objects to targets"))
  {
    return Result::Stopped();
  }
  const std::vector<unsigned char> isUsed = AssignAndJudge(input, tools->Library, output);
  bool goesOn = monitor.Tick(0.04, "Planning");
  ScenePlans plans = RecallPlans(input, options, output.Constraints, isUsed, memory);
  if (goesOn)
  {
    const Result flown = FlyUnknown(input, options, *tools, output.Constraints, isUsed, parallelFor,
                                    monitor, plans, output.Tracks);
    WAFT_RETURN_IF_FAILED(flown);
    goesOn = !flown.IsStopped();
  }
  if (memory != nullptr)
  {
    KeepPlans(input, options.Seed, plans, *memory);
  }
  GiveOut(input, options, tools->Library, plans, output);
  CompleteReport(input, output);
  return goesOn ? Result::Ok() : Result::Stopped();
}

} // namespace waft
