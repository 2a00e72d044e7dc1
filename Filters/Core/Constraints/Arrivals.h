// SPDX-License-Identifier: BSD-3-Clause
// A time of its own for each of several: who comes when in a window of frames.
#pragma once

#include "Base/Types.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace waft
{

/// How ranks spread over a window: s of [0, 1] to [0, 1].
enum class TimeSpread
{
  Even,   // s(x) = x
  EaseIn, // x^2: the first come close upon each other, the last one by one
  EaseOut // 1 - (1 - x)^2
};
inline constexpr int NumberOfTimeSpreads = 3;

/// "even", "ease-in", "ease-out".
const char* ToString(TimeSpread spread);
/// The spread of this name, or null.
const TimeSpread* FindTimeSpread(const std::string& name);

double SpreadOf(TimeSpread spread, double part);

/// Frames, both included; From is at most To.
struct FrameWindow
{
  int From = 0;
  int To = 0;
};

/// The frame of the one at `part` [0, 1] of the way: From + round(s(part) (To - From)).
int FrameAt(const FrameWindow& window, TimeSpread spread, double part);

/// Of the k-th of N: k / (N - 1), of one alone 0.
double PartOfRank(std::size_t rank, std::size_t count);

/// Who comes when: the part of the way of each, in [0, 1]. Equal keys follow each other as they are
/// listed.
std::vector<double> PartsByKey(const std::vector<double>& keys);
/// Of given ranks, 0 to N - 1; equal ones share their part.
std::vector<double> PartsByRank(const std::vector<int>& ranks);
/// The streams of releases and of leavings that have no order.
inline constexpr std::uint64_t ReleaseStream = 0x72656c65617365;
inline constexpr std::uint64_t LeaveStream = 0x6c65617665;
/// By chance, a permutation by the seed.
std::vector<double> PartsByChance(std::size_t count, std::uint64_t seed, std::uint64_t stream);
/// Where one of several is: along the width and the height of what they draw, and in space [m].
struct OrderedPlace
{
  double Across = 0.0, Up = 0.0;
  Vec3 Position = Vec3::Zero();
};
/// Who comes when by where they are.
enum class PlaceOrder
{
  LeftToRight,
  RightToLeft,
  TopDown,
  BottomUp,
  Outward, // from the middle of all
  Inward,
  Random
};
inline constexpr int NumberOfPlaceOrders = 7;
/// "left-to-right", ..., "random".
const char* ToString(PlaceOrder order);
/// The order of this name, or null.
const PlaceOrder* FindPlaceOrder(const std::string& name);
std::vector<double> PartsByPlace(PlaceOrder order, const std::vector<OrderedPlace>& places,
                                 std::uint64_t seed, std::uint64_t stream);
/// Group after group in the order of their numbers, each in an equal part of the way, in which its
/// own are spread as they are listed. groups: of each its group.
std::vector<double> PartsByGroup(const std::vector<int>& groups, TimeSpread within);

} // namespace waft
