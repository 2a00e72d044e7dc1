// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Run/Schedule.h"

#include "Spacetime/Paper/PaperSchedule.h"

namespace waft
{

Schedule PlanSchedule(const SpacetimeSetup& setup, const SpacetimeOptions& options, double width)
{
  return setup.Model.Air.IsEmpty() ? PlanPasses(setup, options, width) : PlanInAir(options);
}

Schedule PlanInAir(const SpacetimeOptions& options)
{
  Schedule schedule;
  schedule.Stages.push_back(
    Minimise(StageKind::Fine, 0, options.Passes, '\0', 2 * LastIterations(options) / 3));
  return schedule;
}

} // namespace waft
