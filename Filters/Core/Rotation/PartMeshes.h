// SPDX-License-Identifier: BSD-3-Clause
// Bodies whose meshes are in each other in a finished flight are turned a little, and where that
// does not do shifted a little, so that they pass each other.
#pragma once

#include "Rotation/PartingSearch.h"

#include <string>
#include <vector>

namespace waft
{

/// Each pair is parted by the least of a ladder of turns, about axes that bring the bodies flat
/// against the line between their centres first, and then of shifts: eased in and out over frames,
/// to nothing where poses and places are given, by no more than `most` [rad] from a frame to the
/// next, so that balls, clearances and surfaces are kept and no other pair is worse for it. Done
/// pair by pair in the order of frames, again for those whom others got in the way of, pairs out of
/// each other's reach at once: the same on any number of threads. Bodies whose marks leave no room
/// for more than eight others stay in them as they are.
/// tracks: as bodies fly, moved by shifts so far; rows: rests with their first contacts. Changes
/// the orientations of poses and the positions of tracks. False: stopped; then they are of no use.
bool PartMeshes(const RotationInput& input, const std::vector<Constraint>& rows, double most,
                const ParallelFor& parallel, Monitor& monitor, std::vector<Track>& tracks,
                std::vector<PoseTrack>& poses, PartedMotion& parted);

/// Which are left in flight, the first few by name; empty where none is.
std::vector<std::string> WarningsOfCuts(const std::vector<MeshCut>& left,
                                        const std::vector<Track>& tracks);

} // namespace waft
