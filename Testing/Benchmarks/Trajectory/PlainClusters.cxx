// SPDX-License-Identifier: BSD-3-Clause
#include "PlainClusters.h"

#include "Base/Random.h"

#include <algorithm>

namespace waft
{

namespace
{

using Samples = std::vector<std::vector<double>>;
using Members = std::vector<int>;

double SquaredDistance(const std::vector<double>& a, const std::vector<double>& b)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    sum += (a[i] - b[i]) * (a[i] - b[i]);
  }
  return sum;
}

std::vector<Members> Part(const Samples& samples, const Members& members, int count, int iterations,
                          Random& random, double& squares)
{
  count = std::min(count, static_cast<int>(members.size()));
  Members order = members;
  Samples centers;
  for (int c = 0; c < count; ++c)
  {
    std::swap(order[c], order[c + random.Index(static_cast<std::uint32_t>(order.size() - c))]);
    centers.push_back(samples[order[c]]);
  }
  std::vector<Members> parts;
  for (int iteration = 0; iteration < iterations; ++iteration)
  {
    std::vector<Members> next(count);
    squares = 0.0;
    for (const int member : members)
    {
      int best = 0;
      double least = SquaredDistance(samples[member], centers[0]);
      for (int c = 1; c < count; ++c)
      {
        const double squared = SquaredDistance(samples[member], centers[c]);
        best = squared < least ? c : best;
        least = std::min(least, squared);
      }
      next[best].push_back(member);
      squares += least;
    }
    if (next == parts)
    {
      break;
    }
    parts = next;
    for (int c = 0; c < count; ++c)
    {
      std::vector<double> mean(samples[0].size(), 0.0);
      for (const int member : parts[c])
      {
        for (std::size_t i = 0; i < mean.size(); ++i)
        {
          mean[i] += samples[member][i] / static_cast<double>(parts[c].size());
        }
      }
      centers[c] = parts[c].empty() ? centers[c] : mean;
    }
  }
  parts.erase(
    std::remove_if(parts.begin(), parts.end(), [](const Members& m) { return m.empty(); }),
    parts.end());
  if (parts.size() == 1 && members.size() > 1)
  {
    const auto half = members.begin() + static_cast<std::ptrdiff_t>(members.size() / 2);
    parts = { Members(members.begin(), half), Members(half, members.end()) };
  }
  return parts;
}

} // namespace

PlainTree PlainClusters(const Samples& samples, int top, int branching, int iterations)
{
  Random random(1);
  PlainTree tree;
  Members all;
  for (std::size_t s = 0; s < samples.size(); ++s)
  {
    all.push_back(static_cast<int>(s));
  }
  std::vector<Members> pending = Part(samples, all, top, iterations, random, tree.SumOfSquares);
  while (!pending.empty())
  {
    const Members members = std::move(pending.back());
    pending.pop_back();
    ++tree.Nodes;
    if (members.size() > 1)
    {
      double squares = 0.0;
      for (Members& part : Part(samples, members, branching, iterations, random, squares))
      {
        pending.push_back(std::move(part));
      }
    }
  }
  return tree;
}

} // namespace waft
