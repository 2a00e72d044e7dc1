// SPDX-License-Identifier: BSD-3-Clause
// Tree-structured vector quantisation: k-means clusters, each split again down to single segments
// (Shi et al. 2005, section 3.2 and Fig. 2).
#pragma once

#include "Base/Monitor.h"
#include "Base/Parallel.h"
#include "Base/Result.h"
#include "Base/SceneFrame.h"
#include "Trajectory/MotionDatabase.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace waft
{

struct ClusterTreeOptions
{
  /// Initial clusters of all groups together; each group gets a fraction by the root of its size,
  /// at least one.
  int NumberOfTopNodes = 100;
  /// Children of an inner node, at most.
  int Branching = 4;
  /// Lloyd iterations of one split, at most.
  int Iterations = 40;
  std::uint64_t Seed = 1;

  Result Validate() const;

  template <class Visitor, class... Holder>
  static void VisitSize(Visitor&& visit, Holder&... of)
  {
    visit(OptionField{ "NumberOfTopNodes",
                       { 1, 1e6 },
                       "",
                       "Initial clusters of all lengths together: the representatives that paths "
                       "are planned with." },
          of.NumberOfTopNodes...);
  }

  /// What a user sets.
  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    VisitSize(visit, of...);
    visit(
      OptionField{
        "Branching", { 2, 1e6 }, "", "Children of an inner node of a cluster tree, at most." },
      of.Branching...);
    visit(SeedField(), of.Seed...);
  }
};

/// The segments of one group.
struct TreeInput
{
  Eigen::MatrixXd Coefficients; // [rank x segments]
  std::vector<int> Segments;    // their indices in the database
};

/// nodes: as MotionDatabase::Nodes, the top nodes of all groups first, in the order of the groups;
/// topNodes: their indices. A group without segments has no nodes.
Result BuildClusterTrees(const std::vector<TreeInput>& groups, const ClusterTreeOptions& options,
                         const ParallelFor& parallelFor, Monitor& monitor,
                         std::vector<ClusterNode>& nodes, std::vector<int>& topNodes);

/// Initial clusters of each group by sizes of groups, summing to about numberOfTopNodes.
std::vector<int> TopNodesOfGroups(const std::vector<std::size_t>& groupSizes, int numberOfTopNodes);

} // namespace waft
