// SPDX-License-Identifier: BSD-3-Clause
// Hierarchical k-means as a textbook writes it, to measure the project's against.
#pragma once

#include <vector>

namespace waft
{

struct PlainTree
{
  long Nodes = 0;
  double SumOfSquares = 0.0; // of the top level
};

/// Uncompressed samples, seeds drawn evenly, every distance in full: `top` clusters, each split in
/// `branching` until a cluster holds one.
PlainTree PlainClusters(const std::vector<std::vector<double>>& samples, int top, int branching,
                        int iterations);

} // namespace waft
