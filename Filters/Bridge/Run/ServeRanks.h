// SPDX-License-Identifier: BSD-3-Clause
// What other ranks do for the first.
#pragma once

#include "Base/Communicator.h"

namespace waft
{

/// Works for rank 0, on all other ranks, until it calls Release: all kinds of work that are shared.
void ServeRanks(Communicator& ranks);

} // namespace waft
