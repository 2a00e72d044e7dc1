// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Run/SolverState.h"

namespace waft
{

void Serialise(StateArchive& stream, SolverState& state, std::size_t frameSize,
               const std::function<FramePartition()>& partition)
{
  Serialise(stream, state.Plan);
  stream.Values(state.Next, state.IsInside, state.Coarseness, state.StartEnergy, state.Seconds);
  stream.List(state.Log, [](StateArchive& s, ConvergenceRow& row) { Serialise(s, row); });
  Serialise(stream, state.Fields);
  stream.List(state.Motion);
  stream.List(state.Beginning);
  stream.Values(state.Sweep.Sweep, state.Sweep.Index);
  Serialise(stream, state.Sweep.Terms);
  stream.List(state.Sweep.Energies);
  const FramePartition pieces = partition();
  pieces.Serialise(stream, state.Part, frameSize);
  Serialise(stream, state.Curvature, pieces, frameSize);
}

} // namespace waft
