// SPDX-License-Identifier: BSD-3-Clause
// What is found out about shapes before bodies of them turn.
#pragma once

#include "Rotation/PanelBody.h"
#include "Rotation/RigidBody.h"

#include <vector>

namespace waft
{

struct PreparedShape
{
  ShellProperties Properties;
  PanelBody Panels;
  bool IsPrepared = false;
  double Draw = 0.0; // over the settling speed, of bodies that glide (StillAir.h); 0: not yet known
};

/// By ShapeId; who turns bodies of the same shapes by the same options several times keeps it.
using PreparedShapes = std::vector<PreparedShape>;

} // namespace waft
