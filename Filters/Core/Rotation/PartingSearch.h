// SPDX-License-Identifier: BSD-3-Clause
// Which turns and shifts part two bodies that are in each other.
#pragma once

#include "Rotation/MeshCuts.h"
#include "Rotation/RotationRefine.h"

#include <memory>
#include <vector>

namespace waft
{

/// That pairs are parted to, in lengths of the shorter body.
inline constexpr double PartedDepth = 0.5 * TouchedDepth;

/// Two bodies over the frames at which they are in each other, with few frames between.
struct Meeting
{
  std::size_t A = 0, B = 0;
  int First = 0, Last = 0;
};

/// What is changed; by track.
struct PartedMotion
{
  std::vector<std::vector<unsigned char>> Turned; // which frames; empty: none
  std::vector<std::vector<Vec3>> Shifts;          // m; empty: it stays
  std::vector<MeshCut> Left;                      // deeper than TouchedDepth all the same
};

/// Changes a motion pair by pair, each time by the least of a ladder that helps most.
class PartingSearch
{
public:
  /// most: rad from a frame to the next, that turns keep to. motion: of tracks and poses, which
  /// change. All that is given stays where it is for as long as this.
  PartingSearch(const RotationInput& input, const std::vector<Constraint>& rows, double most,
                const PosedMotion& motion, Monitor& monitor, std::vector<Track>& tracks,
                std::vector<PoseTrack>& poses);
  ~PartingSearch();

  /// In which a change comes and goes.
  int EaseFrames() const;
  /// Whether a body of a pair may be changed where the two are in each other.
  bool IsFree(const MeshCut& cut);
  /// Whether anything could be done. Bodies that fly in each other for longer than three seconds
  /// are left to it.
  bool Part(const Meeting& meeting);
  bool IsStopped() const; // by the monitor
  PartedMotion Take();

private:
  class Internals;
  std::unique_ptr<Internals> Impl;
};

} // namespace waft
