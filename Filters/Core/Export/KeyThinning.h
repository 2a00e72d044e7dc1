// SPDX-License-Identifier: BSD-3-Clause
// Which keys of an animation can be left out, since those beside them give them back.
#pragma once

#include "Base/Types.h"

#include <limits>
#include <map>
#include <vector>

namespace waft
{

/// An animation of more poses than these is thinned.
constexpr std::size_t MostWholeKeys = 100000;
/// Of one that never is.
constexpr std::size_t AnyNumberOfKeys = std::numeric_limits<std::size_t>::max();

/// How far a pose that is left out may be from what its neighbours give back: too little to be
/// seen.
constexpr double KeyPlaceTolerance = 0.05; // of the body's largest extent
constexpr double KeyTurnTolerance = 2.0;   // degrees

/// Keys of one body as an animation holds them.
struct BodyKeys
{
  std::vector<float> Times;  // s
  std::vector<float> Places; // three a key
  std::vector<float> Turns;  // four a key, a unit quaternion

  static constexpr std::size_t PlaceWidth = 3, TurnWidth = 4;
  std::size_t Count() const { return this->Times.size(); }
};

/// Chooses the keys of bodies that are kept, and which bodies have one list of times together.
///
/// Kept are the first, the last, and all of `marks` (those that are no key are passed over). Of the
/// others either those alone are left out at which a body lies still, which bodies that come to lie
/// at the same frame share the times of; or a greedy choice leaves few, and the body has times of
/// its own: from a key to the next kept one are as many as can be left out, up to 63, or any number
/// where it lies still. What takes the fewest numbers is taken, all keys where
/// that is no more. Each that is left out is within
/// `placeTolerance` [m] and `turnTolerance` [rad] of what a reader makes of the two kept beside it:
/// a place on the straight line, a turn by glTF's slerp, and as well by the mean of components,
/// made a unit again, that some readers take for it.
class KeyThinning
{
public:
  /// To be told of each body before the first is thinned.
  void Add(const BodyKeys& keys, const std::vector<int>& marks);
  /// Takes those away that are left out. Returns the number of its list of times: one that was
  /// given before, or the next; they begin at 0.
  std::size_t Thin(const std::vector<int>& marks, double placeTolerance, double turnTolerance,
                   BodyKeys& keys);

private:
  struct List
  {
    std::size_t Bodies = 0;
    std::size_t Number = AnyNumberOfKeys; // not given yet
  };
  std::map<std::vector<std::size_t>, List> Shared; // by the ends of gaps between keys
  std::size_t Numbers = 0;
};

} // namespace waft
