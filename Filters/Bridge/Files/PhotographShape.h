// SPDX-License-Identifier: BSD-3-Clause
// A body from a photograph's file: for the source and for scenes that name a picture as a shape.
#pragma once

#include "Base/Result.h"
#include "Base/Shape.h"
#include "Shapes/Photograph.h"

#include <string>

namespace waft
{

/// Mesh, texture coordinates and texture of `shape` from a picture: see MakePhotographSheet. A
/// picture without transparency is cut from the commonest colour of its border. The shape's other
/// members are left alone, and all of it on failure.
Result LoadPhotographShape(const std::string& path, const PhotographOptions& options, Shape& shape);

} // namespace waft
