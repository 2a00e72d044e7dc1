// SPDX-License-Identifier: BSD-3-Clause
// Which keys of an animation can be left out, since those beside them give them back.
#pragma once

#include "Base/Types.h"

#include <limits>
#include <vector>

namespace waft
{

/// An animation of more poses than these is thinned.
constexpr std::size_t MostWholeKeys = 100000;
/// Of one that never is.
constexpr std::size_t AnyNumberOfKeys = std::numeric_limits<std::size_t>::max();

/// How far a pose that is left out may be from what its neighbours give back: too little to be
/// seen.
constexpr double KeyPlaceTolerance = 0.005; // of the body's largest extent
constexpr double KeyTurnTolerance = 0.5;    // degrees

/// Keys of one body as an animation holds them.
struct BodyKeys
{
  std::vector<float> Times;  // s
  std::vector<float> Places; // three a key
  std::vector<float> Turns;  // four a key, a unit quaternion

  static constexpr std::size_t PlaceWidth = 3, TurnWidth = 4;
  std::size_t Count() const { return this->Times.size(); }
};

/// The numbers of the keys that are kept, ascending: the first, the last, all of `marks` (those
/// that are no key are passed over), and of the others as few as a greedy choice leaves: from a key
/// to the next kept one are as many as can be left out, up to 63, or any number where the body lies
/// still. Each that is left out is within `placeTolerance` [m] and `turnTolerance` [rad] of what a
/// reader makes of the two kept beside it: a place on the straight line, a turn by glTF's slerp,
/// and as well by the mean of components, made a unit again, that some readers take for it.
std::vector<std::size_t> KeysToKeep(const BodyKeys& keys, const std::vector<int>& marks,
                                    double placeTolerance, double turnTolerance);

/// These alone.
void KeepKeys(const std::vector<std::size_t>& kept, BodyKeys& keys);

} // namespace waft
