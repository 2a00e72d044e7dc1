// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Run/Spacetime.h"

#include "Spacetime/Fields/WindEstimate.h"
#include "Spacetime/Run/RankedObjective.h"
#include "Spacetime/Run/SpacetimeBudget.h"
#include "Spacetime/Run/SpacetimeRun.h"
#include "Spacetime/Run/SpacetimeSerialise.h"

#include <utility>

namespace waft
{
namespace
{

Result Solve(const SpacetimeInput& input, const SpacetimeOptions& options,
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

/// The outcome for the other ranks, also where this one is left by an exception.
struct Ending
{
  Communicator& Ranks;
  Result Outcome = Result::Error("the first process has failed");

  ~Ending() { EndEvaluations(this->Outcome, this->Ranks); }
};

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
  BroadcastStream stream(all);
  Result result = Result::Ok();
  if (all.IsFirst())
  {
    if (all.Size() > 1)
    {
      Serialise(stream, const_cast<SpacetimeInput&>(input)); // which writing leaves as it is
      Serialise(stream, const_cast<SpacetimeOptions&>(options));
    }
    Ending ending{ all };
    result = ending.Outcome = Solve(input, options, parallel, monitor, output, memory, all);
  }
  else
  {
    SpacetimeInput received;
    SpacetimeOptions asked;
    Serialise(stream, received);
    Serialise(stream, asked);
    SpacetimeSetup problem;
    (void)MakeSetup(received, asked, problem); // rank 0 says what is wrong
    result = ServeEvaluations(problem.Model, parallel, all);
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
