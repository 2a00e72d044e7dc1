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

} // namespace waft
