// SPDX-License-Identifier: BSD-3-Clause
// Simulations that are whole, kept as files, so that a database that was stopped can be gone on
// with.
#pragma once

#include "Base/Result.h"
#include "Base/StateArchive.h"
#include "Trajectory/TrajectoryClusters.h"

#include <string>

namespace waft
{

/// All that a database is made from.
template <class Traced>
void MoveTraced(StateArchive& stream, Traced& traced)
{
  stream.Values(traced.Vortices);
  stream.Length(traced.Tracks);
  for (auto& track : traced.Tracks)
  {
    stream.Values(track.ObjectId, track.Positions, track.ForceTypes, track.VortexIds,
                  track.WindAccelerations);
  }
}

/// A folder with one file a simulation. Each file says what it was made from; what does not fit or
/// was damaged counts as missing.
class TracedFiles
{
public:
  /// folder: made when the first file is written; empty: nothing is kept, nothing found.
  /// parameters: text that tells a simulation of this index from those of other runs.
  TracedFiles(std::string folder, std::string parameters);

  /// True when the simulation was there. All but VortexAccelerations of its tracks come back as
  /// they were.
  bool Read(int simulation, TracedSimulation& traced) const;
  /// The file appears whole or not at all.
  Result Write(int simulation, const TracedSimulation& traced) const;

private:
  std::string PathOf(int simulation) const;

  std::string Folder;
  std::string Parameters;
};

} // namespace waft
