// SPDX-License-Identifier: BSD-3-Clause
#include "Trajectory/ClusterTree.h"

#include "Base/FractionDone.h"
#include "Trajectory/KMeans.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace waft
{

namespace
{

using Members = std::vector<int>; // columns of the coefficients of a group

/// The tree below one initial cluster, breadth first: children are consecutive.
struct Subtree
{
  int Group = 0;
  Members Root;
  std::vector<ClusterNode> Nodes;
};

ClusterNode NodeOf(const TreeInput& input, int group, const Members& members)
{
  ClusterNode node;
  node.Group = group;
  node.NumberOfSegments = static_cast<int>(members.size());
  const Eigen::VectorXd mean = MeanOf(input.Coefficients, members);
  int medoid = members.front();
  double least = std::numeric_limits<double>::infinity();
  for (const int member : members)
  {
    const double squared = (input.Coefficients.col(member) - mean).squaredNorm();
    if (squared < least)
    {
      least = squared;
      medoid = member;
    }
  }
  node.Medoid = input.Segments[medoid];
  for (const int member : members)
  {
    const auto offset = input.Coefficients.col(member) - input.Coefficients.col(medoid);
    node.Radius = std::max(node.Radius, offset.norm());
  }
  return node;
}

void Grow(const TreeInput& input, const ClusterTreeOptions& options, Random random,
          Subtree& subtree)
{
  std::vector<Members> pending{ subtree.Root };
  subtree.Nodes = { NodeOf(input, subtree.Group, subtree.Root) };
  for (std::size_t n = 0; n < subtree.Nodes.size(); ++n)
  {
    const Members members = std::move(pending[n]);
    if (members.size() == 1)
    {
      continue;
    }
    std::vector<Members> parts =
      KMeans(input.Coefficients, members, options.Branching, options.Iterations, random);
    subtree.Nodes[n].FirstChild = static_cast<int>(subtree.Nodes.size());
    subtree.Nodes[n].NumberOfChildren = static_cast<int>(parts.size());
    for (Members& part : parts)
    {
      subtree.Nodes.push_back(NodeOf(input, subtree.Group, part));
      subtree.Nodes.back().Parent = static_cast<int>(n);
      pending.push_back(std::move(part));
    }
  }
}

/// Roots first, then the rest of each subtree in turn.
void Join(std::vector<Subtree>& subtrees, std::vector<ClusterNode>& nodes,
          std::vector<int>& topNodes)
{
  int next = static_cast<int>(subtrees.size());
  std::vector<int> offsets; // added to an index within the subtree, other than its root's 0
  for (const Subtree& subtree : subtrees)
  {
    offsets.push_back(next - 1);
    next += static_cast<int>(subtree.Nodes.size()) - 1;
  }
  nodes.assign(next, ClusterNode());
  topNodes.clear();
  for (std::size_t t = 0; t < subtrees.size(); ++t)
  {
    const int root = static_cast<int>(t);
    topNodes.push_back(root);
    for (std::size_t n = 0; n < subtrees[t].Nodes.size(); ++n)
    {
      ClusterNode node = subtrees[t].Nodes[n];
      if (node.Parent >= 0)
      {
        node.Parent = node.Parent == 0 ? root : node.Parent + offsets[t];
      }
      if (node.FirstChild >= 0)
      {
        node.FirstChild += offsets[t];
      }
      nodes[n == 0 ? root : static_cast<int>(n) + offsets[t]] = node;
    }
  }
}

} // namespace

Result ClusterTreeOptions::Validate() const
{
  WAFT_RETURN_IF_FAILED(ValidateFields<ClusterTreeOptions>(*this));
  if (this->Iterations < 1)
  {
    return Result::Error("Iterations: expected at least 1");
  }
  return Result::Ok();
}

std::vector<int> TopNodesOfGroups(const std::vector<std::size_t>& groupSizes, int numberOfTopNodes)
{
  double roots = 0.0;
  for (const std::size_t size : groupSizes)
  {
    roots += std::sqrt(static_cast<double>(size));
  }
  std::vector<int> topNodes;
  for (const std::size_t size : groupSizes)
  {
    const double wanted =
      numberOfTopNodes * std::sqrt(static_cast<double>(size)) / std::max(roots, 1e-300);
    const int most = static_cast<int>(std::min<std::size_t>(size, 1u << 30));
    topNodes.push_back(std::min(most, std::max(1, static_cast<int>(std::lround(wanted)))));
  }
  return topNodes;
}

Result BuildClusterTrees(const std::vector<TreeInput>& groups, const ClusterTreeOptions& options,
                         const ParallelFor& parallelFor, Monitor& monitor,
                         std::vector<ClusterNode>& nodes, std::vector<int>& topNodes)
{
  if (Result result = options.Validate(); !result)
  {
    return result;
  }
  std::vector<std::size_t> sizes;
  for (const TreeInput& group : groups)
  {
    sizes.push_back(group.Segments.size());
  }
  const std::vector<int> counts = TopNodesOfGroups(sizes, options.NumberOfTopNodes);

  std::vector<Subtree> subtrees;
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    if (groups[g].Segments.empty())
    {
      continue;
    }
    if (!monitor.Tick(0.3 * FractionDone(g, groups.size()), "Clustering segments"))
    {
      return Result::Stopped();
    }
    Members all(groups[g].Segments.size());
    for (std::size_t s = 0; s < all.size(); ++s)
    {
      all[s] = static_cast<int>(s);
    }
    Random random(options.Seed, 2 * g);
    std::vector<Members> parts = { all };
    if (counts[g] > 1)
    {
      parts = KMeans(groups[g].Coefficients, all, counts[g], options.Iterations, random);
    }
    for (Members& part : parts)
    {
      subtrees.push_back({ static_cast<int>(g), std::move(part), {} });
    }
  }

  constexpr std::size_t batch = 8;
  for (std::size_t first = 0; first < subtrees.size(); first += batch)
  {
    if (!monitor.Tick(0.3 + 0.7 * FractionDone(first, subtrees.size()), "Splitting clusters"))
    {
      return Result::Stopped();
    }
    parallelFor(std::min(batch, subtrees.size() - first),
                [&](std::size_t begin, std::size_t end)
                {
                  for (std::size_t t = first + begin; t < first + end; ++t)
                  {
                    Grow(groups[subtrees[t].Group], options, Random(options.Seed, 2 * t + 1),
                         subtrees[t]);
                  }
                });
  }
  Join(subtrees, nodes, topNodes);
  return Result::Ok();
}

} // namespace waft
