// SPDX-License-Identifier: BSD-3-Clause
#include "Trajectory/NearestSegment.h"

#include <limits>
#include <queue>

namespace waft
{

namespace
{

struct Candidate
{
  double Promise; // the lower the sooner [m]
  double Distance;
  int Node;

  bool operator<(const Candidate& other) const
  {
    return this->Promise != other.Promise ? this->Promise > other.Promise : this->Node > other.Node;
  }
};

constexpr double RadiusFraction = 0.5;

} // namespace

Eigen::VectorXd CoefficientsOf(const SegmentGroup& group, const std::vector<Vec3>& positions)
{
  Eigen::VectorXd samples(group.Mean.size());
  for (Eigen::Index i = 0; i < group.NumberOfSamples; ++i)
  {
    samples.segment<3>(3 * i) = positions[i];
  }
  return group.Basis.transpose() * (samples - group.Mean);
}

NearestResult FindNearest(const MotionDatabase& database, int group,
                          const Eigen::VectorXd& coefficients, int budget)
{
  NearestResult best;
  best.Distance = std::numeric_limits<double>::infinity();
  std::priority_queue<Candidate> open;
  const auto consider = [&](int index)
  {
    const ClusterNode& node = database.Nodes[index];
    const double distance = (database.Segments[node.Medoid].Coefficients - coefficients).norm();
    ++best.Evaluations;
    if (distance < best.Distance || (distance == best.Distance && node.Medoid < best.Segment))
    {
      best.Distance = distance;
      best.Segment = node.Medoid;
    }
    if (node.FirstChild >= 0)
    {
      open.push({ distance - RadiusFraction * node.Radius, distance, index });
    }
  };
  for (const int top : database.TopNodes)
  {
    if (database.Nodes[top].Group == group)
    {
      consider(top);
    }
  }
  while (!open.empty() && (budget <= 0 || best.Evaluations < budget))
  {
    const Candidate candidate = open.top();
    open.pop();
    const ClusterNode& node = database.Nodes[candidate.Node];
    if (candidate.Distance - node.Radius > best.Distance)
    {
      continue;
    }
    for (int c = 0; c < node.NumberOfChildren; ++c)
    {
      consider(node.FirstChild + c);
    }
  }
  return best;
}

NearestResult FindNearestByAll(const MotionDatabase& database, int group,
                               const Eigen::VectorXd& coefficients)
{
  NearestResult best;
  best.Distance = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < database.Segments.size(); ++s)
  {
    if (database.Segments[s].Group != group)
    {
      continue;
    }
    const double distance = (database.Segments[s].Coefficients - coefficients).norm();
    ++best.Evaluations;
    if (distance < best.Distance)
    {
      best.Distance = distance;
      best.Segment = static_cast<int>(s);
    }
  }
  return best;
}

} // namespace waft
