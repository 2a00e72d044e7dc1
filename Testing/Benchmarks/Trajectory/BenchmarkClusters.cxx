// SPDX-License-Identifier: BSD-3-Clause
// WaftBenchmarkClusters [segments] [threads]: cutting, compressing and clustering of random
// swirling tracks, beside the trees as a textbook makes them, and nearest segments through the
// trees beside the full comparison.
#include "Base/Random.h"
#include "PlainClusters.h"
#include "Trajectory/NearestSegment.h"
#include "Trajectory/TrajectoryClusters.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

using namespace waft;

namespace
{

double Wall()
{
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

/// 300 frames of a path whose turning and climbing wander.
Track Wander(int id)
{
  Random random(7, static_cast<std::uint64_t>(id));
  Track track;
  track.ObjectId = id;
  Vec3 x = Vec3::Zero();
  double heading = random.Uniform(0.0, 6.28);
  double turn = 0.0;
  double climb = 0.0;
  double speed = 0.6;
  for (int frame = 0; frame < 300; ++frame)
  {
    track.Positions.push_back(x);
    turn += 0.01 * random.Normal() - 0.06 * turn;
    climb += 0.01 * random.Normal() - 0.05 * climb;
    speed += 0.01 * random.Normal() - 0.02 * (speed - 0.6);
    heading += turn;
    x += speed / 30.0 * Vec3(std::cos(heading), std::sin(heading), std::sin(4.0 * climb));
  }
  return track;
}

std::vector<std::size_t> GroupSizes(const MotionDatabase& database)
{
  std::vector<std::size_t> sizes(database.Groups.size(), 0);
  for (const Segment& segment : database.Segments)
  {
    ++sizes[segment.Group];
  }
  return sizes;
}

std::vector<std::vector<double>> SamplesOf(const MotionDatabase& database, int group)
{
  std::vector<std::vector<double>> samples;
  for (std::size_t s = 0; s < database.Segments.size(); ++s)
  {
    if (database.Segments[s].Group != group)
    {
      continue;
    }
    samples.emplace_back();
    for (const Vec3& x : database.Reconstruct(static_cast<int>(s)))
    {
      samples.back().insert(samples.back().end(), x.data(), x.data() + 3);
    }
  }
  return samples;
}

/// Of the segments to the means of their top nodes.
double SquaresOfTopLevel(const MotionDatabase& database)
{
  std::vector<int> top(database.Nodes.size());
  std::vector<std::vector<int>> members(database.Nodes.size());
  for (std::size_t n = 0; n < database.Nodes.size(); ++n)
  {
    const ClusterNode& node = database.Nodes[n];
    top[n] = node.Parent < 0 ? static_cast<int>(n) : top[node.Parent];
    if (node.FirstChild < 0)
    {
      members[top[n]].push_back(node.Medoid);
    }
  }
  double squares = 0.0;
  for (const std::vector<int>& segments : members)
  {
    if (segments.empty())
    {
      continue;
    }
    Eigen::VectorXd mean = 0.0 * database.Segments[segments[0]].Coefficients;
    for (const int segment : segments)
    {
      mean += database.Segments[segment].Coefficients / static_cast<double>(segments.size());
    }
    for (const int segment : segments)
    {
      squares += (database.Segments[segment].Coefficients - mean).squaredNorm();
    }
  }
  return squares;
}

class Stages : public Monitor
{
public:
  bool Tick(double, const std::string& text) override
  {
    if (text != this->Last)
    {
      std::printf("  %7.2f s: %s\n", Wall() - this->Start, text.c_str());
      this->Last = text;
    }
    return true;
  }

private:
  double Start = Wall();
  std::string Last;
};

} // namespace

int main(int argc, char** argv)
{
  const int segments = argc > 1 ? std::atoi(argv[1]) : 200000;
  const int threads = argc > 2 ? std::atoi(argv[2]) : 1;
  ClusterInput input;
  input.Simulations.resize(1);
  for (int t = 0; t < segments / 9 + 1; ++t)
  {
    input.Simulations[0].Tracks.push_back(Wander(t));
  }
  ClusterOptions options;
  options.MaximumSegments = segments;
  MotionDatabase database;
  Stages monitor;
  const double start = Wall();
  const Result result =
    ClusterTrajectories(input, options, ThreadedFor(threads), monitor, database);
  if (!result)
  {
    std::fprintf(stderr, "%s\n", result.Message().c_str());
    return 1;
  }
  std::printf("%zu segments in %zu groups, %zu nodes, relative error %g, %d threads: %.2f s\n",
              database.Segments.size(), database.Groups.size(), database.Nodes.size(),
              options.RelativeError, threads, Wall() - start);

  const double plainStart = Wall();
  const std::vector<int> topNodes = TopNodesOfGroups(GroupSizes(database), 100);
  long plainNodes = 0;
  double plainSquares = 0.0;
  for (std::size_t g = 0; g < database.Groups.size(); ++g)
  {
    const PlainTree tree = PlainClusters(SamplesOf(database, static_cast<int>(g)), topNodes[g],
                                         options.Trees.Branching, options.Trees.Iterations);
    plainNodes += tree.Nodes;
    plainSquares += tree.SumOfSquares;
  }
  std::printf("plain trees of the same segments, uncompressed, 1 thread: %ld nodes, %.2f s; sum of "
              "squares of the top level %.4g, of the above %.4g\n",
              plainNodes, Wall() - plainStart, plainSquares, SquaresOfTopLevel(database));

  // Queries half way between two segments.
  Random random(3);
  long evaluations[2] = { 0, 0 };
  double seconds[2] = { 0.0, 0.0 };
  int found = 0;
  const int queries = 300;
  for (int q = 0; q < queries; ++q)
  {
    const Segment& a =
      database.Segments[random.Index(static_cast<std::uint32_t>(database.Segments.size()))];
    const Segment* b = &a;
    do
    {
      b = &database.Segments[random.Index(static_cast<std::uint32_t>(database.Segments.size()))];
    } while (b->Group != a.Group);
    const Eigen::VectorXd query = 0.8 * a.Coefficients + 0.2 * b->Coefficients;
    double before = Wall();
    const NearestResult all = FindNearestByAll(database, a.Group, query);
    seconds[0] += Wall() - before;
    before = Wall();
    const NearestResult tree = FindNearest(database, a.Group, query, all.Evaluations / 10);
    seconds[1] += Wall() - before;
    evaluations[0] += all.Evaluations;
    evaluations[1] += tree.Evaluations;
    found += tree.Segment == all.Segment;
  }
  std::printf(
    "nearest: %ld distances and %.3f ms by the trees, %ld and %.3f ms by all, the same in "
    "%.1f %%\n",
    evaluations[1] / queries, 1e3 * seconds[1] / queries, evaluations[0] / queries,
    1e3 * seconds[0] / queries, 100.0 * found / queries);
  return 0;
}
