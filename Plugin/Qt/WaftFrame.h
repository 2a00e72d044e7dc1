// SPDX-License-Identifier: BSD-3-Clause
// Where a first camera stands. Plugin/Python/waft/showing.py says the same for scripts.
#pragma once

#include <vector>

class pqDataRepresentation;
class pqRenderView;

namespace waft
{

/// Whether it is a look that Waft's outputs have by themselves.
bool IsMotion(pqDataRepresentation* shown);

/// Turns a view's camera to the boxes of what is shown in it, z up, from the front and above, and
/// as near as they fit; of obstacles, a wide ground say, what is near the rest. False, and nothing
/// done, where nothing has points.
bool Frame(pqRenderView* view, const std::vector<pqDataRepresentation*>& shown);

/// The same box, looked at as the camera looks now.
bool Reset(pqRenderView* view, const std::vector<pqDataRepresentation*>& shown);

/// A soft background in place of the palette's; nothing where a user has chosen one.
void SetBackdrop(pqRenderView* view);

} // namespace waft
