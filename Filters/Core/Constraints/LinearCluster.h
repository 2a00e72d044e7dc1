// SPDX-License-Identifier: BSD-3-Clause
// Velocities and accelerations as linear rows on positions, and the nearest positions that meet
// them. The unit of length is the caller's.
#pragma once

#include "Base/Types.h"

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <vector>

namespace waft
{

/// |x - Center| <= Radius for an object's position at a frame.
struct PositionBall
{
  int Frame = 0;
  std::size_t Object = 0;
  Vec3 Center = Vec3::Zero();
  double Radius = 0.0;
};

/// |sum of Coefficient x(Frame) - Value| <= Radius: a velocity or an acceleration as a finite
/// difference of positions.
struct DifferenceRow
{
  struct Term
  {
    int Frame;
    double Coefficient;
  };
  std::size_t Object = 0;
  std::vector<Term> Terms;
  Vec3 Value = Vec3::Zero();
  double Radius = 0.0;
};

/// Where an object is fixed at a frame; null: it is free.
using FixedAt = std::function<const Vec3*(int frame, std::size_t object)>;

/// Rows of one object that have frames in common, with the positions that they bind.
class LinearCluster
{
public:
  LinearCluster(std::size_t object, const std::vector<const DifferenceRow*>& rows,
                const std::vector<PositionBall>& balls, const FixedAt& fixedAt);

  std::size_t Object() const { return this->Owner; }
  const std::vector<int>& Frames() const { return this->FreeFrames; } // free ones
  /// positions: one row a free frame; moved to the nearest that meets the rows and balls.
  void Project(Eigen::MatrixX3d& positions) const;
  /// Removes what would leave the exact rows.
  void ProjectTangent(Eigen::MatrixX3d& change) const;
  /// Largest violation of a row, by its own radius, in the row's unit.
  double Violation(const Eigen::MatrixX3d& positions) const;

private:
  void ProjectExact(Eigen::MatrixX3d& positions) const;

  std::size_t Owner;
  std::vector<int> FreeFrames;
  Eigen::MatrixXd Exact, Inverse; // rows of radius 0; pseudo-inverse A^T (A A^T)^-1
  Eigen::MatrixX3d ExactValues;
  struct BallRow
  {
    Eigen::RowVectorXd Coefficients;
    Eigen::RowVector3d Value;
    double Radius;
  };
  std::vector<BallRow> BallRows;
  struct BallPoint
  {
    int Index;
    Eigen::RowVector3d Center;
    double Radius;
  };
  std::vector<BallPoint> BallPoints;
};

/// Groups the rows of each object that have free frames in common, of those whose frames are all
/// there.
std::vector<LinearCluster> MakeClusters(const std::vector<DifferenceRow>& rows,
                                        const std::vector<PositionBall>& balls,
                                        const FixedAt& fixedAt, const std::vector<bool>& hasFrame);

} // namespace waft
