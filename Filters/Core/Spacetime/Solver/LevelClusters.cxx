// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Solver/LevelClusters.h"

#include <algorithm>
#include <utility>

namespace waft
{
namespace
{

/// Those that touch nothing held; what the others bind is held from now on.
std::vector<LinearCluster> PartFromHeld(std::vector<LinearCluster> clusters,
                                        const std::vector<int>& levelOfFrame, std::size_t objects,
                                        std::vector<char>& held)
{
  std::vector<LinearCluster> movable;
  for (LinearCluster& cluster : clusters)
  {
    const auto isHeld = [&](int frame)
    {
      const int j = levelOfFrame[frame];
      return j < 0 || held[j * objects + cluster.Object()];
    };
    if (std::none_of(cluster.Frames().begin(), cluster.Frames().end(), isHeld))
    {
      movable.push_back(std::move(cluster));
      continue;
    }
    for (const int frame : cluster.Frames())
    {
      if (levelOfFrame[frame] >= 0)
      {
        held[levelOfFrame[frame] * objects + cluster.Object()] = 1;
      }
    }
  }
  return movable;
}

} // namespace

LevelClusters::LevelClusters(const SpacetimeModel& model, const ConstraintTable& table,
                             std::vector<int> levelOfFrame, HeldUnknowns& held) :
  Model(model),
  LevelOfFrame(std::move(levelOfFrame))
{
  std::vector<bool> hasFrame;
  for (const int j : this->LevelOfFrame)
  {
    hasFrame.push_back(held.IsPart || j >= 0);
  }
  this->Clusters = MakeClusters(model, table, hasFrame);
  if (held.IsPart)
  {
    this->Clusters = PartFromHeld(std::move(this->Clusters), this->LevelOfFrame,
                                  model.NumberOfObjects, held.Objects);
  }
}

void LevelClusters::Visit(const std::function<void(std::size_t j, std::size_t object)>& visit) const
{
  for (const LinearCluster& cluster : this->Clusters)
  {
    for (const int frame : cluster.Frames())
    {
      visit(static_cast<std::size_t>(this->LevelOfFrame[frame]), cluster.Object());
    }
  }
}

void LevelClusters::Project(StateVector& state) const
{
  for (const LinearCluster& cluster : this->Clusters)
  {
    Eigen::MatrixX3d points = this->Points(cluster, state);
    cluster.Project(points);
    this->SetPoints(cluster, points, state);
  }
}

void LevelClusters::ProjectTangent(StateVector& direction) const
{
  for (const LinearCluster& cluster : this->Clusters)
  {
    Eigen::MatrixX3d change = this->Points(cluster, direction);
    cluster.ProjectTangent(change);
    this->SetPoints(cluster, change, direction);
  }
}

double LevelClusters::Violation(const StateVector& state) const
{
  double largest = 0.0;
  for (const LinearCluster& cluster : this->Clusters)
  {
    largest = std::max(largest, cluster.Violation(this->Points(cluster, state)));
  }
  return largest;
}

std::size_t LevelClusters::Offset(const LinearCluster& cluster, Eigen::Index k) const
{
  const auto j = static_cast<std::size_t>(this->LevelOfFrame[cluster.Frames()[k]]);
  return j * this->Model.FrameSize() + this->Model.NumberOfGas + cluster.Object();
}

Eigen::MatrixX3d LevelClusters::Points(const LinearCluster& cluster,
                                       const StateVector& vector) const
{
  Eigen::MatrixX3d points(cluster.Frames().size(), 3);
  for (Eigen::Index k = 0; k < points.rows(); ++k)
  {
    points.row(k) =
      VectorAt(vector.data() + this->Offset(cluster, k), this->Model.Stride()).transpose();
  }
  return points;
}

void LevelClusters::SetPoints(const LinearCluster& cluster, const Eigen::MatrixX3d& points,
                              StateVector& vector) const
{
  for (Eigen::Index k = 0; k < points.rows(); ++k)
  {
    SetVector(vector.data() + this->Offset(cluster, k), this->Model.Stride(),
              points.row(k).transpose());
  }
}

} // namespace waft
