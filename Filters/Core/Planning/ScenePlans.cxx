// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/ScenePlans.h"

#include "Constraints/RowsOfObjects.h"

#include <algorithm>

namespace waft
{

namespace
{

std::vector<std::vector<int>> OwnRowsOf(const std::vector<MotionObject>& objects,
                                        const std::vector<Constraint>& rows,
                                        const std::vector<unsigned char>& isUsed)
{
  const RowsOfObjects places(rows);
  std::vector<std::vector<int>> own(objects.size());
  for (std::size_t o = 0; o < objects.size(); ++o)
  {
    for (const std::size_t place : places.Of(objects[o].ObjectId))
    {
      if (isUsed[place] != 0)
      {
        own[o].push_back(static_cast<int>(place));
      }
    }
  }
  return own;
}

/// A kept plan whose outcomes name indices in the list of all rows again.
ObjectPlan WithRows(ObjectPlan plan, const std::vector<int>& own)
{
  for (MarkOutcome& outcome : plan.Outcomes)
  {
    outcome.Constraint =
      outcome.Constraint < 0 ? -1 : own[static_cast<std::size_t>(outcome.Constraint)];
  }
  return plan;
}

/// The other way: outcomes count the object's own rows, whose indices in the list may change.
ObjectPlan WithOrdinals(ObjectPlan plan, const std::vector<int>& own)
{
  for (MarkOutcome& outcome : plan.Outcomes)
  {
    const auto found = std::lower_bound(own.begin(), own.end(), outcome.Constraint);
    outcome.Constraint = outcome.Constraint < 0 ? -1 : static_cast<int>(found - own.begin());
  }
  return plan;
}

/// As many at least: of a plan whose trees were dropped, those to its marks.
std::size_t BranchesOf(const ObjectPlan& plan)
{
  std::size_t count = 0;
  for (const SpanTrees& span : plan.Spans)
  {
    count += span.Trees[0].size() + span.Trees[1].size();
  }
  for (std::size_t k = 0; plan.Spans.empty() && k < plan.Outcomes.size(); ++k)
  {
    count += static_cast<std::size_t>(plan.Outcomes[k].NumberOfBranches);
  }
  return count;
}

std::size_t LimitOf(const PlanOptions& options)
{
  return static_cast<std::size_t>(std::max(0, options.MaximumNumberOfStoredBranches));
}

} // namespace

TreeRoom::TreeRoom(const ScenePlans& plans, const PlanOptions& options) :
  Branches(plans.Plans.size(), Unknown), Limit(LimitOf(options))
{
  for (std::size_t i = 0; i < this->Branches.size(); ++i)
  {
    this->Branches[i] = plans.IsKnown[i] ? BranchesOf(plans.Plans[i]) : Unknown;
  }
}

void TreeRoom::Take(std::size_t object, ObjectPlan& plan)
{
  const std::lock_guard<std::mutex> lock(this->Guard);
  this->Branches[object] = BranchesOf(plan);
  if (this->Leading <= object && this->Sum >= this->Limit)
  {
    plan.Spans = {};
  }
  for (; this->Leading < this->Branches.size() && this->Branches[this->Leading] != Unknown;
       ++this->Leading)
  {
    this->Sum += this->Branches[this->Leading];
  }
}

ScenePlans RecallPlans(const PlanInput& input, const PlanOptions& options,
                       const std::vector<Constraint>& rows,
                       const std::vector<unsigned char>& isUsed, PlanCache* memory)
{
  const std::size_t count = input.Objects.size();
  ScenePlans plans;
  plans.OwnRows = OwnRowsOf(input.Objects, rows, isUsed);
  plans.IsKnown.assign(count, 0);
  plans.IsDone = std::vector<std::atomic<bool>>(count);
  plans.Plans.resize(count);
  std::size_t branches = 0; // of those before, at least
  for (std::size_t i = 0; memory != nullptr && i < count; ++i)
  {
    plans.Keys.push_back(PlanKey(input.Objects[i], rows, plans.OwnRows[i], input.Guides));
    const ObjectPlan* known = memory->Find(options.Seed, input.Objects[i].ObjectId, plans.Keys[i]);
    if (known != nullptr && !(known->Spans.empty() && branches < LimitOf(options)))
    {
      branches += BranchesOf(*known);
      plans.Plans[i] = WithRows(*known, plans.OwnRows[i]);
      plans.IsKnown[i] = 1;
      plans.IsDone[i] = true;
    }
  }
  return plans;
}

void KeepPlans(const PlanInput& input, std::uint64_t seed, const ScenePlans& plans,
               PlanCache& memory)
{
  for (std::size_t i = 0; i < plans.Plans.size(); ++i)
  {
    if (plans.IsKnown[i] == 0 && plans.IsDone[i])
    {
      memory.Keep(seed, input.Objects[i].ObjectId, plans.Keys[i],
                  WithOrdinals(plans.Plans[i], plans.OwnRows[i]));
    }
  }
}

} // namespace waft
