// SPDX-License-Identifier: BSD-3-Clause
// How far apart two bodies keep, which is never farther than their marks leave them.
#pragma once

#include "Base/Types.h"

#include <array>
#include <cstddef>
#include <vector>

namespace waft
{

/// A frame at which a body is held to a place: exactly, or within a ball about it. Lengths are in
/// any one unit.
struct HeldMark
{
  int Frame = 0;
  Vec3 Place = Vec3::Zero();
  double Radius = 0.0;
};

/// What bodies need between them, and what their marks take from that. At a mark of both their
/// distance is that of the marks, or the smaller radius of their balls where that is more: in a
/// ball twelve have room that far from each other. With the time from its mark either body comes
/// to leave as much room as it needs, as if it were pushed off evenly, in a second or in so long
/// that it is pushed no faster than it settles in calm air.
class KeptDistances
{
public:
  explicit KeptDistances(double framesPerSecond) : Rate(framesPerSecond) {}

  /// radius: half of what two like it need between their centres; settlingSpeed: a second. Of
  /// several marks at a frame the narrowest counts.
  /// first: frame from which it is in the shot.
  void AddBody(double radius, double settlingSpeed, int frames, std::vector<HeldMark> marks,
               int first = 0);

  std::size_t NumberOfBodies() const { return this->Bodies.size(); }
  bool IsPresent(int frame, std::size_t body) const { return frame >= this->Bodies[body].First; }
  /// What two bodies need, without a look at marks.
  double Needed(std::size_t a, std::size_t b) const
  {
    return this->Bodies[a].Radius + this->Bodies[b].Radius;
  }
  /// The frames of the marks that tell at a frame: the last one before it and the first that is
  /// not; -1 where there is none that near.
  std::array<int, 2> MarkFrames(int frame, std::size_t body) const;
  /// What they keep at a frame.
  double At(int frame, std::size_t a, std::size_t b) const;

private:
  struct Body
  {
    double Radius;
    double Parting; // frames in which it comes to leave the whole of its radius
    int First;      // frame from which it is in the shot
    std::vector<HeldMark> Marks;
    std::vector<int> Next; // by frame: the first mark that is not before it
  };
  struct Nearby
  {
    const HeldMark* Mark;
    double Growth;
  };
  /// The last mark before a frame and the first that is not, where they still matter.
  static int MarksAbout(const Body& body, int frame, Nearby (&found)[2]);

  double Rate;
  std::vector<Body> Bodies;
};

} // namespace waft
