// SPDX-License-Identifier: BSD-3-Clause
#include "Trajectory/KMeans.h"

#include <algorithm>
#include <limits>

namespace waft
{

namespace
{

/// Seeds at distances as great as chance allows (Arthur and Vassilvitskii 2007).
Eigen::MatrixXd SpreadSeeds(const Eigen::MatrixXd& points, const std::vector<int>& members,
                            int count, Random& random)
{
  Eigen::MatrixXd centers(points.rows(), count);
  std::vector<double> nearest(members.size(), std::numeric_limits<double>::infinity());
  int chosen = members[random.Index(static_cast<std::uint32_t>(members.size()))];
  int seeds = 0;
  while (true)
  {
    centers.col(seeds++) = points.col(chosen);
    if (seeds == count)
    {
      break;
    }
    double total = 0.0;
    for (std::size_t m = 0; m < members.size(); ++m)
    {
      const double squared = (points.col(members[m]) - points.col(chosen)).squaredNorm();
      nearest[m] = std::min(nearest[m], squared);
      total += nearest[m];
    }
    if (!(total > 0.0))
    {
      break;
    }
    double drawn = random.Uniform() * total;
    std::size_t m = 0;
    while (m + 1 < members.size() && (drawn >= nearest[m] || nearest[m] == 0.0))
    {
      drawn -= nearest[m++];
    }
    chosen = members[m];
  }
  return centers.leftCols(seeds);
}

} // namespace

Eigen::VectorXd MeanOf(const Eigen::MatrixXd& points, const std::vector<int>& members)
{
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(points.rows());
  for (const int member : members)
  {
    sum += points.col(member);
  }
  return sum / static_cast<double>(members.size());
}

std::vector<std::vector<int>> KMeans(const Eigen::MatrixXd& points, const std::vector<int>& members,
                                     int count, int iterations, Random& random)
{
  count = std::min(count, static_cast<int>(members.size()));
  Eigen::MatrixXd centers = SpreadSeeds(points, members, std::max(count, 1), random);
  std::vector<int> owner(members.size(), -1);
  for (int iteration = 0; iteration < iterations; ++iteration)
  {
    bool hasChanged = false;
    for (std::size_t m = 0; m < members.size(); ++m)
    {
      int best = 0;
      double least = std::numeric_limits<double>::infinity();
      for (Eigen::Index c = 0; c < centers.cols(); ++c)
      {
        const double squared = (points.col(members[m]) - centers.col(c)).squaredNorm();
        if (squared < least)
        {
          least = squared;
          best = static_cast<int>(c);
        }
      }
      hasChanged = hasChanged || owner[m] != best;
      owner[m] = best;
    }
    if (!hasChanged)
    {
      break;
    }
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(points.rows(), centers.cols());
    std::vector<int> sizes(centers.cols(), 0);
    for (std::size_t m = 0; m < members.size(); ++m)
    {
      sums.col(owner[m]) += points.col(members[m]);
      ++sizes[owner[m]];
    }
    for (Eigen::Index c = 0; c < centers.cols(); ++c)
    {
      if (sizes[c] > 0)
      {
        centers.col(c) = sums.col(c) / sizes[c];
      }
    }
  }

  std::vector<std::vector<int>> clusters(centers.cols());
  for (std::size_t m = 0; m < members.size(); ++m)
  {
    clusters[owner[m]].push_back(members[m]);
  }
  clusters.erase(std::remove_if(clusters.begin(), clusters.end(),
                                [](const std::vector<int>& cluster) { return cluster.empty(); }),
                 clusters.end());
  if (clusters.size() == 1 && count > 1)
  {
    const auto half = static_cast<std::ptrdiff_t>(members.size() / 2);
    clusters = { std::vector<int>(members.begin(), members.begin() + half),
                 std::vector<int>(members.begin() + half, members.end()) };
  }
  return clusters;
}

} // namespace waft
