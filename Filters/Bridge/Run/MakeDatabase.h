// SPDX-License-Identifier: BSD-3-Clause
// Files of motion databases: made from simulations, and looked at before they are read.
#pragma once

#include "Base/Communicator.h"
#include "Base/Result.h"
#include "Bridge/Run/FlyScene.h"
#include "Database/DatabaseBuild.h"
#include "Trajectory/Coverage.h"

#include <string>
#include <vector>

namespace waft
{

/// Finishes a change of a database that was cut short, and fails unless it is one by its structure,
/// whose blocks are files beside it that no link leads to.
Result CheckDatabase(const std::string& path);

/// Simulates, traces, cuts and clusters; writes `path` (.vtm and the folder beside it) and its
/// coverage beside it (.coverage.csv), whole or not at all. Simulations that are whole wait in
/// PATH.kept while others are missing; resumes: a run of the same options goes on from there.
/// Stopped, the database is that of those that are whole, and isStopped says so; with none it fails
/// with ErrorKind::Stopped. coverage: of each simulation but the first, what it brought.
Result MakeDatabaseFile(const std::string& path, const DatabaseOptions& options, bool resumes,
                        Communicator* ranks, FlightMonitor& monitor,
                        std::vector<CoveragePoint>& coverage, bool& isStopped);

} // namespace waft
