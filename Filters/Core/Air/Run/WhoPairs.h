// SPDX-License-Identifier: BSD-3-Clause
// What it costs an object to go to a target in an air, and who goes where at the least of it.
#pragma once

#include "Air/Run/AirState.h"
#include "Constraints/Keyframes.h"

#include <cstddef>
#include <limits>
#include <map>
#include <vector>

namespace waft
{

inline constexpr std::size_t MostPaired = 100; // objects, of which all pairs are tried

/// A drift, and what it costs.
struct Way
{
  double Cost = std::numeric_limits<double>::infinity();
  bool Passes = false; // through an obstacle
  std::vector<Vec3> Path;
};

/// What obstacles are to a drift: in its way; likewise, but of a path that passes through one it is
/// not told; not there, which bounds what a way around them costs.
enum class Obstacles
{
  InTheWay,
  MayBePassed,
  NotThere
};

/// From the start that is the cheapest after half of the iterations; from one that passes through
/// an obstacle by then where none else does not. It ends there where it costs more than `most`.
Way LeastDrift(const AirContext& run, const AirSampler& air, BodyProblem& body, int iterations,
               std::vector<std::vector<Vec3>> starts, Obstacles obstacles = Obstacles::InTheWay,
               double most = std::numeric_limits<double>::infinity());
/// A body's starts but its plan, which leads elsewhere.
std::vector<std::vector<Vec3>> OtherStarts(const AirSampler& air, const BodyProblem& body);

/// An object that may have a target, by their indices.
struct WhoPair
{
  std::size_t Target = 0, Object = 0;
  double Cost = std::numeric_limits<double>::infinity(); // at least, where it
  bool Passes = false;                                   // through an obstacle
  bool IsSpare = false; // of the second half by chance: the choice without tells what more bring
};

/// What a choice goes by.
struct Choosing
{
  const AirContext& Run;
  const AirSampler& Air;
  std::vector<char> Counts; // by row
  std::vector<char> IsOpen; // whether its target is to be given out still
  Monitor& Caller;
};

/// The pairs that are tried: all, or of each target those objects with which an exchange makes the
/// legs of both least longer, and others by chance, whom a flow often brings there as well. With
/// their costs, unless the caller stopped it.
std::vector<WhoPair> JudgedPairs(const Choosing& choosing, const ChosenTargets& group);

/// A giving out of a group's targets: by target the object, and what it costs over what legs cost.
struct Giving
{
  std::vector<std::size_t> Objects; // of nobody where somebody would be left over
  double Share = 1.0;
};

/// By least cost of the pairs as they are known; all: the spare ones, too.
Giving GivingOf(const ChosenTargets& group, const std::vector<WhoPair>& pairs, std::size_t objects,
                bool all);
/// What a pair with an obstacle between costs is known by a plan alone, and but a bound before:
/// those that would be taken are planned, and it is given out anew.
Giving GiveOut(const Choosing& choosing, const ChosenTargets& group, std::vector<WhoPair>& pairs);

} // namespace waft
