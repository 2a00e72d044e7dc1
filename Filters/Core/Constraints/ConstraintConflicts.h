// SPDX-License-Identifier: BSD-3-Clause
// What has been kept of the constraints on one object, and whether another one contradicts it.
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

/// One constraint as a ball about a value of a linear form of positions.
struct ConstraintBall
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
  ConstraintBall Candidate;
  std::set<int> Lines; // of the report, -1: the start; none: the candidate's line with itself
  std::string How;     // by how much, and what was expected

  bool IsEmpty() const { return this->How.empty(); }
};

class KeptConstraints
{
public:
  /// tolerance: distance of positions that are taken as one [m].
  KeptConstraints(const Vec3& start, double tolerance);

  /// Keeps a constraint unless it contradicts what is kept.
  Contradiction Add(const ConstraintBall& ball);
  Contradiction AddOrientation(const Constraint& row, int line);
  /// Forgets all of a line, which must be the last that was added.
  void Withdraw(int line);

private:
  void Keep(const ConstraintBall& ball);
  void Begin(int line);
  Contradiction CheckPosition(const ConstraintBall& ball) const;
  Contradiction CheckDerivative(const ConstraintBall& derivative,
                                const ConstraintBall& candidate) const;
  Contradiction CheckSameDerivative(const ConstraintBall& ball) const;

  double Tolerance;
  LinearRows Exact;
  std::map<int, std::vector<ConstraintBall>> Positions; // by frame
  std::vector<ConstraintBall> Derivatives;              // velocities and accelerations
  std::vector<std::pair<Constraint, int>> Orientations;
  int NewestLine = -1;           // that was added last; -1: the start
  std::vector<int> NewestFrames; // of the positions that it added
};

} // namespace waft
