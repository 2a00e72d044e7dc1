// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Spacetime.h"

#include "Spacetime/SpacetimeExchange.h"
#include "Spacetime/SpacetimeRun.h"
#include "Spacetime/WindEstimate.h"

#include <cstdio>

namespace waft
{
namespace
{

Result CheckRange(const char* name, double value, double low, double high)
{
  if (value >= low && value <= high)
  {
    return Result::Ok();
  }
  char text[160];
  std::snprintf(text, sizeof(text), "%s: %g, a number from %g to %g expected", name, value, low,
                high);
  return Result::Error(text);
}

} // namespace

Result SpacetimeOptions::Validate() const
{
  constexpr double Large = 1e9;
  for (const Result& result :
       { CheckRange("NumberOfGasParticles", this->NumberOfGasParticles, 64, 200000),
         CheckRange("NumberOfObjectParticles", this->NumberOfObjectParticles, 1, 100000),
         CheckRange("PositionWeight", this->PositionWeight, 1e-6, Large),
         CheckRange("VelocityWeight", this->VelocityWeight, 1e-6, Large),
         CheckRange("CoherenceWeight", this->CoherenceWeight, 0.0, Large),
         CheckRange("SpatialShare", this->SpatialShare, 0.0, 1.0),
         CheckRange("ObjectCoherence", this->ObjectCoherence, 0.0, Large),
         CheckRange("ObjectPosition", this->ObjectPosition, 1e-3, Large),
         CheckRange("TemporalWindow", this->TemporalWindow, 1, 30),
         CheckRange("SmoothingLength", this->SmoothingLength, 0.8, 2.0),
         CheckRange("CourantNumber", this->CourantNumber, 0.1, 1.0),
         CheckRange("Viscosity", this->Viscosity, 0.0, 2.0),
         CheckRange("XsphFactor", this->XsphFactor, 0.0, 1.0),
         CheckRange("PressureExponent", this->PressureExponent, 1.0, 7.0),
         CheckRange("EffectiveGravity", this->EffectiveGravity, 0.0, 20.0),
         CheckRange("ContactDistance", this->ContactDistance, -Large, Large),
         CheckRange("WindDrag", this->WindDrag, 0.0, 100.0),
         CheckRange("MaximumNumberOfVortices", this->MaximumNumberOfVortices, 0, 1000),
         CheckRange("Passes", this->Passes, 1, 10),
         CheckRange("LeashIterations", this->LeashIterations, 1, 10000),
         CheckRange("MaximumNumberOfIterations", this->MaximumNumberOfIterations, 0, 100000),
         CheckRange("Tolerance", this->Tolerance, 0.0, 1.0),
         CheckRange("TimeLimit", this->TimeLimit, 0.0, Large),
         CheckRange("HistorySize", this->HistorySize, 1, 20),
         CheckRange("EditDuration", this->EditDuration, 0.0, Large),
         CheckRange("EditRadius", this->EditRadius, 0.0, Large),
         CheckRange("MemoryLimit", this->MemoryLimit, 0.0, Large),
         CheckRange("CheckpointInterval", this->CheckpointInterval, 0.0, Large) })
  {
    if (!result)
    {
      return result;
    }
  }
  return Result::Ok();
}

std::array<int, 3> WindLatticeDimensions(const Box& volume)
{
  return WindLatticeOf(volume.Size());
}

Result RunSpacetime(const SpacetimeInput& input, const SpacetimeOptions& options,
                    const ParallelFor& parallel, Monitor& monitor, SpacetimeOutput& output,
                    SpacetimeMemory* memory, Communicator* ranks)
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
      *memory = SpacetimeMemory();
    }
  }
  return result;
}

} // namespace waft
