// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Run/Spacetime.h"

#include "Spacetime/Fields/WindEstimate.h"
#include "Spacetime/Run/SpacetimeBudget.h"
#include "Spacetime/Run/SpacetimeRun.h"

#include <utility>

namespace waft
{
namespace
{

Result Solve(const SpacetimeInput& input, const SpacetimeOptions& options,
             const ParallelFor& parallel, Monitor& monitor, SpacetimeOutput& output)
{
  SpacetimeSetup problem;
  WAFT_RETURN_IF_FAILED(MakeSetup(input, options, problem));
  WAFT_RETURN_IF_FAILED(
    SpacetimeBudget(problem.Model, options)
      .Validate(static_cast<std::size_t>(problem.Model.NumberOfFrames), options));
  StateVector start = std::move(problem.Start);
  return SpacetimeRun(input, options, problem, parallel, monitor, output).Run(std::move(start));
}

} // namespace

std::array<int, 3> WindLatticeDimensions(const Box& volume, const SpacetimeOptions& options)
{
  return WindLatticeOf(volume.Size(), options.WindCells);
}

Result RunSpacetime(const SpacetimeInput& input, const SpacetimeOptions& options,
                    const ParallelFor& parallel, Monitor& monitor, SpacetimeOutput& output)
{
  output = SpacetimeOutput();
  const Result result = Solve(input, options, parallel, monitor, output);
  if (!result)
  {
    output = SpacetimeOutput();
  }
  return result;
}

} // namespace waft
