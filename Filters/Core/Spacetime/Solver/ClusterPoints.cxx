// SPDX-License-Identifier: BSD-3-Clause
// Positions that linear rows bind, out of a vector and back into it: the frames may be those of
// several ranks.
#include "Spacetime/Solver/HardConstraints.h"

namespace waft
{

std::vector<Eigen::MatrixX3d> HardConstraints::ClusterPoints(const StateVector& vector) const
{
  std::vector<std::size_t> frames;
  std::vector<float> values;
  for (const LinearCluster& cluster : this->Clusters)
  {
    for (const int frame : cluster.Frames())
    {
      const auto j = static_cast<std::size_t>(this->LevelOfFrame[frame]);
      const bool isOwn = this->Partition.Own().Contains(j);
      for (std::size_t c = 0; c < 3; ++c)
      {
        values.push_back(
          isOwn ? vector[this->Offset(j, cluster.Object()) + c * this->Model.Stride()] : 0.0f);
      }
      frames.push_back(j);
    }
  }
  this->Partition.GatherPoints(frames, values);
  std::vector<Eigen::MatrixX3d> points;
  const float* value = values.data();
  for (const LinearCluster& cluster : this->Clusters)
  {
    points.emplace_back(cluster.Frames().size(), 3);
    for (Eigen::Index k = 0; k < points.back().rows(); ++k, value += 3)
    {
      points.back().row(k) = Eigen::RowVector3f(value[0], value[1], value[2]).cast<double>();
    }
  }
  return points;
}

void HardConstraints::SetClusterPoints(const std::vector<Eigen::MatrixX3d>& points,
                                       StateVector& vector) const
{
  for (std::size_t m = 0; m < points.size(); ++m)
  {
    const LinearCluster& cluster = this->Clusters[m];
    for (std::size_t k = 0; k < cluster.Frames().size(); ++k)
    {
      const auto j = static_cast<std::size_t>(this->LevelOfFrame[cluster.Frames()[k]]);
      if (this->Partition.Own().Contains(j))
      {
        float* x = vector.data() + this->Offset(j, cluster.Object());
        for (int c = 0; c < 3; ++c)
        {
          x[c * this->Model.Stride()] =
            static_cast<float>(points[m](static_cast<Eigen::Index>(k), c));
        }
      }
    }
  }
}

} // namespace waft
