// SPDX-License-Identifier: BSD-3-Clause
// What has been kept of the wishes about one object, and whether another one contradicts it.
#pragma once

#include "Base/Types.h"
#include "Constraints/Constraint.h"
#include "Constraints/LinearRows.h"

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace waft
{

/// One wish as a ball about a value of a linear form of positions.
struct Wish
{
  std::map<int, double> Stencil;
  Vec3 Value = Vec3::Zero();
  double Radius = 0.0;
  int Line = -1; // of the report; -1: the start
  ConstraintKind Kind = ConstraintKind::Position;
  int Frame = 0;
};

/// A contradiction that was found, or none.
struct Contradiction
{
  Wish Candidate;
  std::set<int> Lines; // of the report, -1: the start; none: the candidate's line with itself
  std::string How;     // by how much, and what was expected

  bool IsEmpty() const { return this->How.empty(); }
};

class ObjectWishes
{
public:
  /// tolerance: distance of positions that are taken as one [m].
  ObjectWishes(const Vec3& start, double tolerance);

  /// Keeps a wish unless it contradicts what is kept.
  Contradiction Add(const Wish& wish);
  Contradiction AddOrientation(const Constraint& row, int line);
  /// Forgets all of a line, which must be the last that was added.
  void Withdraw(int line);

private:
  void Keep(const Wish& wish);
  void Begin(int line);
  Contradiction CheckPosition(const Wish& wish) const;
  Contradiction CheckDerivative(const Wish& derivative, const Wish& candidate) const;
  Contradiction CheckSameDerivative(const Wish& wish) const;

  double Tolerance;
  LinearRows Exact;
  std::map<int, std::vector<Wish>> Positions; // by frame
  std::vector<Wish> Derivatives;              // velocities and accelerations
  std::vector<std::pair<Constraint, int>> Orientations;
  int NewestLine = -1;           // that was added last; -1: the start
  std::vector<int> NewestFrames; // of the positions that it added
};

} // namespace waft
