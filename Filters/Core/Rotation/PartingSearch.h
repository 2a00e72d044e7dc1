// SPDX-License-Identifier: BSD-3-Clause
// Which turns and shifts part the bodies of a motion that are in each other.
#pragma once

#include "Rotation/PartingAttempt.h"

#include <array>
#include <map>
#include <utility>
#include <vector>

namespace waft
{

/// What is changed; by track.
struct PartedMotion
{
  std::vector<std::vector<unsigned char>> Turned; // which frames; empty: none
  std::vector<std::vector<Vec3>> Shifts;          // m; empty: it stays
  std::vector<MeshCut> Left;                      // deeper than TouchedDepth all the same
};

/// Changes a motion meeting by meeting, each time by the least of a ladder that helps most.
/// Meetings out of each other's reach are searched at once, by threads; what comes is as if they
/// had been searched one after another.
class PartingSearch
{
public:
  /// most: rad from a frame to the next, that turns keep to. rows: rests with their first
  /// contacts. motion: of tracks and poses, which change. All that is given stays where it is for
  /// as long as this.
  PartingSearch(const RotationInput& input, const std::vector<Constraint>& rows, double most,
                const PosedMotion& motion, Monitor& monitor, std::vector<Track>& tracks,
                std::vector<PoseTrack>& poses);

  /// In which a change comes and goes.
  int EaseFrames() const;
  /// Whether a body of a pair may be changed where the two are in each other.
  bool IsFree(const MeshCut& cut);
  /// Parts them in their order; whether anything could be done. Bodies that fly in each other for
  /// longer than three seconds are left to it.
  bool Part(std::vector<Meeting> meetings, const ParallelFor& parallel);
  bool IsStopped() const { return this->Stopped; } // by the monitor
  PartedMotion Take() { return std::move(this->Result); }

private:
  using MeetingKey = std::array<std::size_t, 3>;

  const PartingFreedom& TakeFreedom(std::size_t track);
  std::pair<int, int> VersionsOf(const Meeting& meeting) const;
  bool IsInVain(const Meeting& meeting) const;
  std::vector<std::size_t> ApartFrom(const std::vector<Meeting>& meetings) const;
  bool AreApart(const Meeting& earlier, const Meeting& later,
                const std::vector<int>& changes) const;
  void Make(const PartingAttempt& attempt);

  const std::vector<Constraint>& Rows;
  RowsOfObjects Places;
  const PosedMotion& Motion;
  Monitor& Caller;
  std::vector<Track>& Tracks;
  std::vector<PoseTrack>& Poses;
  PathBoxes Boxes;
  std::vector<PartingFreedom> Freedoms; // by track, once it is asked for
  PartedScene Scene;
  bool Stopped = false;
  std::vector<int> Versions;                        // changes so far, by track
  std::map<MeetingKey, std::pair<int, int>> InVain; // with the versions then
  PartedMotion Result;
};

} // namespace waft
