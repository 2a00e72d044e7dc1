// SPDX-License-Identifier: BSD-3-Clause
// The level sets of OpenVDB.
#pragma once

#include "Obstacles/DistanceLattice.h"

namespace waft
{

/// Distances [m] of the lattice's points to a surface displaced by offset, without sign, at most
/// lattice.Band plus one spacing (openvdb::tools::meshToVolume). They are upper bounds of the true
/// distances, some tenths of a spacing too large where they are too large. Throws what OpenVDB
/// throws.
void UnsignedNarrowBand(const TriangleMesh& mesh, const Vec3& offset,
                        const DistanceLattice& lattice, std::vector<float>& distance);

} // namespace waft
