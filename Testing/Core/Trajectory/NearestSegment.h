// SPDX-License-Identifier: BSD-3-Clause
// The segment nearest to given samples, found through the cluster trees.
#pragma once

#include "Trajectory/MotionDatabase.h"

#include <vector>

namespace waft
{

struct NearestResult
{
  int Segment = -1;      // -1: no group has segments of that length
  double Distance = 0.0; // in coefficients [m]: root of the sum of squares over all samples
  int Evaluations = 0;   // distances computed
};

/// Coefficients of samples in the basis of a group [m]. The samples are in the frame of a segment
/// (see SegmentFrame.h) and as many as the group's.
Eigen::VectorXd CoefficientsOf(const SegmentGroup& group, const std::vector<Vec3>& positions);

/// Best-first descent: the node whose medoid is nearest, less a fraction of its radius, is opened
/// next; nodes that cannot hold anything nearer (triangle inequality) are dropped. It ends when
/// nothing is left (then the result is exact) or after `budget` distances, 0: no limit.
NearestResult FindNearest(const MotionDatabase& database, int group,
                          const Eigen::VectorXd& coefficients, int budget);

/// Every segment of the group compared: the reference.
NearestResult FindNearestByAll(const MotionDatabase& database, int group,
                               const Eigen::VectorXd& coefficients);

} // namespace waft
