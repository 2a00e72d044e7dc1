// SPDX-License-Identifier: BSD-3-Clause
// Descent along the user's balls that an object's path touches.
#pragma once

#include "Spacetime/Model/StateVector.h"
#include "Spacetime/Solver/TimelinePreconditioner.h"

#include <Eigen/Core>

#include <utility>
#include <vector>

namespace waft
{

/// A direction M^-1 g that would leave a touched ball is not to lose its part across the ball at
/// that one frame alone: the frames about it would stay where they are, and the path would come to
/// the ball with a jerk. It is projected in the metric of M, so that the object's whole time line
/// goes along: d - M^-1 A^T (A M^-1 A^T)^-1 A d, a row of A for each touched ball. A path that is
/// outside balls is brought to them likewise.
class ActiveConstraints
{
public:
  using Vectors = std::vector<Eigen::Vector3f>; // one a ball

  explicit ActiveConstraints(const SpacetimeModel& model) : Model(model) {}

  /// A ball about an object's place at a level frame.
  void Add(std::size_t frame, std::size_t object);
  std::size_t Size() const { return this->Frames.size(); }

  /// Unit normals, zero where a ball is not touched.
  void Touch(Vectors normals) { this->Normals = std::move(normals); }
  void Project(const TimelinePreconditioner& preconditioner, StateVector& direction) const;
  /// overshoots: from each ball's surface to the place outside it, zero inside.
  void Enter(const TimelinePreconditioner& preconditioner, const Vectors& overshoots,
             StateVector& state) const;

private:
  /// Takes away what each ball has beyond it along its normal; where that is zero, nothing.
  void TakeAway(const TimelinePreconditioner& preconditioner, const std::vector<Vec3>& normals,
                const std::vector<double>& beyond, StateVector& vector) const;

  const SpacetimeModel& Model;
  std::vector<std::size_t> Frames, Objects;
  Vectors Normals;
};

} // namespace waft
