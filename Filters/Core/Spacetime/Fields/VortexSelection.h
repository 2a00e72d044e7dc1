// SPDX-License-Identifier: BSD-3-Clause
// The few vortices that one body of air can have, out of those that many planned paths bring.
#pragma once

#include "Base/ForceFields.h"
#include "Base/Motion.h"
#include "Base/Types.h"

#include <vector>

namespace waft
{

/// Paths are planned apart and each brings the vortices of its own segments; all of them at once
/// would stir the air many times over. Kept are those that no track claims (the artist's own) and,
/// of the claimed ones, those that moved their tracks most: greedily by the sum of |f|^2 over the
/// claimed points, passing over any that stands near a kept one (MergeDistance of the width, in the
/// same time), at most `maximum`. Order: as given.
std::vector<Vortex> SelectVortices(const std::vector<Vortex>& vortices,
                                   const std::vector<Track>& tracks, const SceneInfo& scene,
                                   int maximum);

} // namespace waft
