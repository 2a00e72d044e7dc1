// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Run/Spacetime.h"

#include "Spacetime/Fields/WindEstimate.h"
#include "Spacetime/Run/SpacetimeBudget.h"
#include "Spacetime/Run/SpacetimeRun.h"
#include "Spacetime/Run/SpacetimeSerialise.h"

#include <utility>

namespace waft
{
namespace
{

Result RunHere(const SpacetimeInput& input, const SpacetimeOptions& options,
               const ParallelFor& parallel, Monitor& monitor, SpacetimeOutput& output,
               SpacetimeWarmStart* memory, Communicator& ranks)
{
  SpacetimeSetup problem;
  WAFT_RETURN_IF_FAILED(MakeSetup(input, options, problem));
  WAFT_RETURN_IF_FAILED(
    SpacetimeBudget(problem.Model, options)
      .Validate(static_cast<std::size_t>(problem.Model.NumberOfFrames), options));
  StateVector start = std::move(problem.Start);
  return SpacetimeRun(input, options, problem, parallel, monitor, output, memory, ranks)
    .Run(std::move(start));
}

} // namespace

std::array<int, 3> WindLatticeDimensions(const Box& volume)
{
  return WindLatticeOf(volume.Size());
}

Result RunSpacetime(const SpacetimeInput& input, const SpacetimeOptions& options,
                    const ParallelFor& parallel, Monitor& monitor, SpacetimeOutput& output,
                    SpacetimeWarmStart* memory, Communicator* ranks)
{
  output = SpacetimeOutput();
  SerialCommunicator alone;
  Communicator& all = ranks != nullptr ? *ranks : alone;
  Result result = Result::Ok();
  if (all.IsFirst())
  {
    if (all.Size() > 1)
    {
      BroadcastStream stream(all);
      Serialise(stream, const_cast<SpacetimeInput&>(input)); // which writing leaves as it is
      Serialise(stream, const_cast<SpacetimeOptions&>(options));
    }
    result = RunHere(input, options, parallel, monitor, output, memory, all);
  }
  else
  {
    BroadcastStream stream(all);
    SpacetimeInput received;
    SpacetimeOptions asked;
    Serialise(stream, received);
    Serialise(stream, asked);
    result = RunHere(received, asked, parallel, monitor, output, nullptr, all);
  }
  if (!result || !all.IsFirst())
  {
    output = SpacetimeOutput();
    if (memory != nullptr)
    {
      *memory = SpacetimeWarmStart();
    }
  }
  return result;
}

} // namespace waft
