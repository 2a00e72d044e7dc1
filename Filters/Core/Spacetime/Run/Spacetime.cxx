// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Run/Spacetime.h"

#include "Spacetime/Fields/WindEstimate.h"
#include "Spacetime/Run/SpacetimeExchange.h"
#include "Spacetime/Run/SpacetimeRun.h"

namespace waft
{

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
      Exchange(stream, const_cast<SpacetimeInput&>(input)); // which writing leaves as it is
      Exchange(stream, const_cast<SpacetimeOptions&>(options));
    }
    result = SpacetimeRun(input, options, parallel, monitor, output, memory, all).Run();
  }
  else
  {
    BroadcastStream stream(all);
    SpacetimeInput received;
    SpacetimeOptions asked;
    Exchange(stream, received);
    Exchange(stream, asked);
    result = SpacetimeRun(received, asked, parallel, monitor, output, nullptr, all).Run();
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
