// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Run/SolverState.h"

namespace waft
{

void Serialise(StateArchive& stream, SolverState& state)
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
  stream.List(state.Part);
  Serialise(stream, state.Curvature);
}

} // namespace waft
