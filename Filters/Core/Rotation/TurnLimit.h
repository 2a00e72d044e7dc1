// SPDX-License-Identifier: BSD-3-Clause
// No more turning from a frame to the next than frames can show.
#pragma once

#include "Rotation/Attitude.h"

#include <string>
#include <vector>

namespace waft
{

/// TurnObject with at most `most` [rad] from a frame to the next. A body that keeps to it by itself
/// flies as it does without a limit, bit by bit. Any other one flies anew from a little before it
/// turns by more for the first time, with an angular velocity that never is above it and that
/// torques change by at most half of it in a frame, so that it does not jump back and forth between
/// two limits. Where a row, a rest or a surface turns the flown poses beyond it, the body flies
/// again, slower about there, a few times, as long as that helps; poses that came with its path are
/// not kept from there on.
AttitudeOutcome TurnObjectWithin(double most, const AttitudePlan& plan, const FlightBody& body,
                                 FlightPath path);

/// Sets that limit for all of a flight, whether or not it would turn by more.
void SetLimit(double most, FlightPath& path);

/// Counts what the limit does to all objects of a scene.
class TurnCount
{
public:
  /// most: the limit [rad a frame]. tolerated: of an object's frames, of which nothing is said: a
  /// limit that nobody set.
  explicit TurnCount(double most, double tolerated = 0.0) : Most(most), Tolerated(tolerated) {}
  void Add(const AttitudeOutcome& outcome);
  /// How many objects and frames were slowed, and which; how many turn by more all the same, and by
  /// how much.
  std::vector<std::string> Warnings() const;

private:
  /// Objects of which the same is to be said.
  struct Tally
  {
    void Add(int objectId, int frames, int first, int last);
    /// "2 objects, 5 frames (object 3 at frames 7 to 10, object 4 at frame 2)": the first few.
    std::string Text() const;

    int Objects = 0;
    int Frames = 0;
    std::string Named;
  };

  double Most; // rad
  double Tolerated;
  Tally Slowed;
  Tally Fast;
  double Greatest = 0.0; // rad
};

} // namespace waft
