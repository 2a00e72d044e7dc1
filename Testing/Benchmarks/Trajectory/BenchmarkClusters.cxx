// SPDX-License-Identifier: BSD-3-Clause
// WaftBenchmarkClusters [segments] [threads]: cutting, compressing and clustering of random
// swirling tracks, and nearest segments through the trees beside the full comparison.
#include "Base/Random.h"
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
