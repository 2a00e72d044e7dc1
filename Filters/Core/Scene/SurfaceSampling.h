// SPDX-License-Identifier: BSD-3-Clause
// Few points that draw a surface.
#pragma once

#include "Base/Mesh.h"
#include "Base/Result.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace waft
{

/// `count` points evenly spread over a surface by area. Fails when it has no area.
Result SampleSurface(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed,
                     std::uint64_t stream, std::vector<Vec3>& points);

} // namespace waft
