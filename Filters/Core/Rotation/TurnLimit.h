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
/// again, slower about there, a few times, as long as that helps.
AttitudeOutcome TurnObjectWithin(double most, const AttitudePlan& plan, const FlightBody& body,
                                 FlightPath path);

/// Counts what the limit does to all objects of a scene.
class TurnCount
{
public:
  explicit TurnCount(double most) : Most(most) {}
  void Add(const AttitudeOutcome& outcome);
  /// How many objects and frames were slowed; how many turn by more all the same, and by how much.
  std::vector<std::string> Warnings() const;

private:
  double Most; // rad
  int SlowedObjects = 0;
  int SlowedFrames = 0;
  int FastObjects = 0;
  int FastFrames = 0;
  double Greatest = 0.0; // rad
};

} // namespace waft
