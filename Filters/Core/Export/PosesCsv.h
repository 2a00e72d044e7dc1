// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Base/Monitor.h"
#include "Base/Motion.h"
#include "Base/Pose.h"
#include "Base/Result.h"

#include <functional>
#include <string>
#include <vector>

namespace waft
{

constexpr const char* PosesCsvHeader = "object,frame,time,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz";
constexpr const char* PresentColumn = ",present";

/// The text of poses.csv: the header and one line per object and frame, in the order of tracks,
/// then of frames. Numbers have 17 significant digits, so that reading them gives the same bits.
/// Velocities are central differences of the positions, from where the object is in the shot. Where
/// any ever is not, the last column is 1 where one is and 0 where it is not. It is passed on piece
/// by piece, and no further once write returns false. Fails when poses do not fit the tracks.
Result PosesCsv(const std::vector<Track>& tracks, const std::vector<PoseTrack>& poses,
                const Timeline& time, const std::function<bool(const std::string& text)>& write);

/// The same as a file, whole or not at all.
Result WritePosesCsv(const std::string& path, const std::vector<Track>& tracks,
                     const std::vector<PoseTrack>& poses, const Timeline& time, Monitor& monitor);

} // namespace waft
