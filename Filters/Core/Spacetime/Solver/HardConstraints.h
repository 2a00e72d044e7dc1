// SPDX-License-Identifier: BSD-3-Clause
// The user's requirements and the leash as sets that every accepted iterate lies in.
#pragma once

#include "Base/Parallel.h"
#include "Spacetime/Model/ConstraintTable.h"
#include "Spacetime/Model/StateVector.h"
#include "Spacetime/Model/TimeLevel.h"
#include "Spacetime/Solver/ActiveConstraints.h"
#include "Spacetime/Solver/HeldUnknowns.h"
#include "Spacetime/Solver/LevelClusters.h"

#include <functional>
#include <vector>

namespace waft
{

class HardConstraints
{
public:
  /// All at the level's frames that are not free keep their values; rows that bind both what may
  /// move and what may not are held as they are.
  HardConstraints(const SpacetimeModel& model, const TimeLevel& level, const ConstraintTable& table,
                  const ParallelFor& parallel);

  /// Radius about the planned positions [dx]; zero: none. The user's own requirements win.
  void SetLeash(double radius) { this->Leash = radius; }

  /// The nearest state that meets everything (gas is held in its box).
  void Project(StateVector& state) const;
  /// The same for a trial point, whose time lines first come along to the user's balls that they
  /// miss (once there is no leash).
  void Project(const TimelinePreconditioner& preconditioner, StateVector& state) const;
  /// Balls, and walls of the gas' box, that the descent direction -gradient would leave.
  void FindActive(const StateVector& state, const StateVector& gradient);
  /// Removes from a direction what leaves fixed values, active balls and walls and exact rows.
  void ProjectTangent(StateVector& direction) const;
  /// The same for a direction out of the preconditioner, whose time lines go along with what the
  /// touched balls of the user take away (once there is no leash).
  void ProjectTangent(const TimelinePreconditioner& preconditioner, StateVector& direction) const;
  /// Largest violation of a position [dx], in single precision.
  double MaxViolation(const StateVector& state) const;

private:
  void EnterBalls(const TimelinePreconditioner& preconditioner, StateVector& state) const;
  std::size_t Offset(std::size_t j, std::size_t object) const;
  void TakeBalls(const std::vector<int>& levelOfFrame);
  void ProjectFrame(std::size_t j, StateVector& state) const;
  void FindWalls(std::size_t j, const StateVector& state, const StateVector& gradient);

  const SpacetimeModel& Model;
  const TimeLevel& Level;
  const ConstraintTable& Table;
  ParallelFor Parallel;
  HeldUnknowns Held;
  LevelClusters Clusters;
  double Leash = 0.0;
  struct LevelBall
  {
    std::size_t Frame, Object;
    Vec3 Center;
    double Radius;
  };
  void ForBalls(const std::function<void(const LevelBall&)>& visit) const;
  /// The direction out of a ball where the state touches it and a descent would leave it, or zero.
  Vec3 TouchNormal(const LevelBall& ball, const StateVector& state,
                   const StateVector& gradient) const;
  std::vector<LevelBall> Balls;      // the user's
  ActiveConstraints Touched;         // likewise
  std::vector<LevelBall> LeashBalls; // radius as set
  struct Active
  {
    std::size_t Offset;
    float Normal[3];
  };
  std::vector<Active> ActiveBalls;
  std::vector<std::vector<std::size_t>> ActiveWalls; // by level frame: coordinates held at a wall
};

} // namespace waft
