// SPDX-License-Identifier: BSD-3-Clause
// What a database says about its making: enough to make it again, and nothing of where or when.
#pragma once

#include "Database/DatabaseBuild.h"

#include <map>
#include <string>

namespace waft
{

/// Keys and values as text; numbers with 17 significant digits. The parameters of the clustering
/// are in it, as ClusterTrajectories gives them.
std::map<std::string, std::string> ProvenanceOf(const DatabaseOptions& options);

/// A line for each of the parameters that the simulations depend on; neither their number nor what
/// is made of them is among these.
std::string SimulationText(const DatabaseOptions& options);

} // namespace waft
