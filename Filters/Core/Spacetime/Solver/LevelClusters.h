// SPDX-License-Identifier: BSD-3-Clause
// Velocities and accelerations asked for, as rows on the positions at the frames of a level.
#pragma once

#include "Spacetime/Model/ConstraintTable.h"
#include "Spacetime/Solver/HeldUnknowns.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace waft
{

class LevelClusters
{
public:
  /// levelOfFrame: -1 where a frame is not on the level. Where something is held, rows that bind
  /// both what may move and what may not are no clusters: all that they bind is held as well.
  LevelClusters(const SpacetimeModel& model, const ConstraintTable& table,
                std::vector<int> levelOfFrame, HeldUnknowns& held);

  /// Moves positions to the nearest that meet the rows.
  void Project(StateVector& state) const;
  /// Takes out of a direction what would leave the exact rows.
  void ProjectTangent(StateVector& direction) const;
  /// Largest violation of a row, by its own radius; at least 0.
  double Violation(const StateVector& state) const;
  /// Each position that rows bind.
  void Visit(const std::function<void(std::size_t j, std::size_t object)>& visit) const;

private:
  std::size_t Offset(const LinearCluster& cluster, Eigen::Index k) const;
  /// One point a free frame of a cluster, and back.
  Eigen::MatrixX3d Points(const LinearCluster& cluster, const StateVector& vector) const;
  void SetPoints(const LinearCluster& cluster, const Eigen::MatrixX3d& points,
                 StateVector& vector) const;

  const SpacetimeModel& Model;
  std::vector<int> LevelOfFrame;
  std::vector<LinearCluster> Clusters; // no two of them bind the same position
};

} // namespace waft
