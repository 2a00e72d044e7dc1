// SPDX-License-Identifier: BSD-3-Clause
#include "AnalyticFlow.h"
#include "Trajectory/KMeans.h"
#include "Trajectory/NearestSegment.h"
#include "Trajectory/SegmentFrame.h"
#include "Trajectory/TrajectoryClusters.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

using namespace waft;
using namespace waft::test;

namespace
{

Vortex Upright(int id)
{
  Vortex vortex;
  vortex.VortexId = id;
  vortex.P1 = Vec3(0.3, 0.2, 0);
  vortex.P2 = Vec3(0.1, -0.3, 4);
  vortex.Strength = 6.0;
  vortex.CenterTime = 1.5;
  vortex.CoreRadius = 0.3;
  return vortex;
}

ClusterInput Traced(int simulations, int stride)
{
  ClusterInput input;
  for (int s = 0; s < simulations; ++s)
  {
    TraceOptions options;
    options.SeedStride = stride;
    const FlowLattice lattice = CubeLattice(options.Volume, 24);
    TrajectoryTracer tracer;
    const std::vector<Vortex> vortices{ Upright(4 + s) };
    EXPECT_TRUE(tracer.Begin(lattice, options, vortices));
    for (int frame = 0; frame < 100; ++frame)
    {
      EXPECT_TRUE(
        tracer.Feed(FrameOfFlow(
                      lattice, [s](const Vec3& x, double t) { return SwirlingFlow(x, t, 0.6 * s); },
                      frame / 30.0),
                    SerialFor()));
    }
    input.Simulations.push_back({ tracer.Finish(), vortices });
  }
  return input;
}

MotionDatabase Build(const ClusterInput& input, const ClusterOptions& options, int threads = 1)
{
  MotionDatabase database;
  SilentMonitor monitor;
  const Result result =
    ClusterTrajectories(input, options, ThreadedFor(threads), monitor, database);
  EXPECT_TRUE(result) << result.Message();
  return database;
}

const MotionDatabase& Large()
{
  static const MotionDatabase database = []
  {
    ClusterOptions options;
    options.MaximumSegments = 0;
    return Build(Traced(4, 2), options);
  }();
  return database;
}

std::vector<int> SegmentsBelow(const MotionDatabase& database, int node)
{
  const ClusterNode& n = database.Nodes[node];
  if (n.FirstChild < 0)
  {
    return { n.Medoid };
  }
  std::vector<int> all;
  for (int c = 0; c < n.NumberOfChildren; ++c)
  {
    const std::vector<int> below = SegmentsBelow(database, n.FirstChild + c);
    all.insert(all.end(), below.begin(), below.end());
  }
  return all;
}

double SumOfSquaresOf(const MotionDatabase& database, const std::vector<int>& segments)
{
  const Eigen::Index rank = database.Segments[segments[0]].Coefficients.size();
  Eigen::MatrixXd points(rank, static_cast<Eigen::Index>(segments.size()));
  std::vector<int> members;
  for (std::size_t i = 0; i < segments.size(); ++i)
  {
    points.col(static_cast<Eigen::Index>(i)) = database.Segments[segments[i]].Coefficients;
    members.push_back(static_cast<int>(i));
  }
  return SumOfSquares(points, members);
}

} // namespace

TEST(Clusters, DatabaseIsWhole)
{
  const MotionDatabase& database = Large();
  const Result result = database.Validate();
  EXPECT_TRUE(result) << result.Message();
  EXPECT_GE(database.Segments.size(), 5000u);
  EXPECT_GE(database.Groups.size(), 4u);
  EXPECT_GE(database.TopNodes.size(), 60u);
  EXPECT_LE(database.TopNodes.size(), 150u);
  EXPECT_GT(database.TopSpeed, 0.5);
}

TEST(Clusters, SegmentsStartAtTheOriginAndHeadAlongX)
{
  const MotionDatabase& database = Large();
  for (std::size_t s = 0; s < database.Segments.size(); s += 37)
  {
    const std::vector<Vec3> positions = database.Reconstruct(static_cast<int>(s));
    EXPECT_LT(positions[0].norm(), 1e-9);
    const Vec3 velocity = -1.5 * positions[0] + 2.0 * positions[1] - 0.5 * positions[2];
    // Horizontal motion across x is what compression leaves of zero.
    EXPECT_LT(std::abs(velocity.y()), 0.004);
    EXPECT_GT(velocity.x(), -0.004);
  }
}

TEST(Clusters, CompressionKeepsTheStatedError)
{
  ClusterOptions options;
  const ClusterInput input = Traced(1, 4);
  for (const double error : { 0.1, 0.01, 0.001 })
  {
    options.RelativeError = error;
    std::size_t rank = 0;
    for (const SegmentGroup& group : Build(input, options).Groups)
    {
      EXPECT_LE(group.RelativeError, error * (1.0 + 1e-9));
      EXPECT_GT(group.RelativeError, 0.0);
      const Eigen::MatrixXd product = group.Basis.transpose() * group.Basis;
      EXPECT_LT((product - Eigen::MatrixXd::Identity(product.rows(), product.cols())).norm(),
                1e-10);
      rank += group.Basis.cols();
    }
    RecordProperty("Rank" + std::to_string(error), static_cast<int>(rank));
  }
}

TEST(Clusters, SquaresNeverGrowDownTheTree)
{
  const MotionDatabase& database = Large();
  for (std::size_t n = 0; n < database.Nodes.size(); ++n)
  {
    const ClusterNode& node = database.Nodes[n];
    const std::vector<int> segments = SegmentsBelow(database, static_cast<int>(n));
    ASSERT_EQ(segments.size(), static_cast<std::size_t>(node.NumberOfSegments));
    for (const int segment : segments)
    {
      ASSERT_LE(
        (database.Segments[segment].Coefficients - database.Segments[node.Medoid].Coefficients)
          .norm(),
        node.Radius + 1e-12);
    }
    if (node.FirstChild < 0)
    {
      continue;
    }
    double children = 0.0;
    for (int c = 0; c < node.NumberOfChildren; ++c)
    {
      children += SumOfSquaresOf(database, SegmentsBelow(database, node.FirstChild + c));
    }
    const double whole = SumOfSquaresOf(database, segments);
    ASSERT_LE(children, whole * (1.0 + 1e-12) + 1e-15);
  }
}

TEST(Clusters, TopLevelBeatsAnArbitraryPartition)
{
  // Clusters of the top level against as many made of consecutive segments: k-means must be better.
  const MotionDatabase& database = Large();
  double clustered = 0.0;
  double arbitrary = 0.0;
  std::size_t next = 0;
  for (std::size_t g = 0; g < database.Groups.size(); ++g)
  {
    for (const int top : database.TopNodes)
    {
      if (database.Nodes[top].Group != static_cast<int>(g))
      {
        continue;
      }
      clustered += SumOfSquaresOf(database, SegmentsBelow(database, top));
      std::vector<int> part;
      for (int i = 0; i < database.Nodes[top].NumberOfSegments; ++i)
      {
        part.push_back(static_cast<int>(next++));
      }
      arbitrary += SumOfSquaresOf(database, part);
    }
  }
  EXPECT_LT(clustered, 0.35 * arbitrary);
}

TEST(Clusters, TableEqualsDirectAlignment)
{
  const MotionDatabase& database = Large();
  const ConnectionOptions options;
  std::size_t connectible = 0;
  for (std::size_t a = 0; a < database.TopNodes.size(); ++a)
  {
    for (std::size_t b = 0; b < database.TopNodes.size(); ++b)
    {
      const Connection& entry = database.At(a, b);
      connectible += entry.IsConnectible;
      EXPECT_EQ(entry.IsConnectible, entry.Cost <= options.NotConnectible);
      if ((a * 31 + b) % 97 != 0)
      {
        continue;
      }
      const std::vector<Vec3> before =
        database.Reconstruct(database.Nodes[database.TopNodes[a]].Medoid);
      const std::vector<Vec3> after =
        database.Reconstruct(database.Nodes[database.TopNodes[b]].Medoid);
      const Connection direct =
        AlignWindows({ before.end() - database.Window, before.end() },
                     { after.begin(), after.begin() + database.Window }, options.Freedom);
      EXPECT_EQ(direct.Cost, entry.Cost);
      EXPECT_EQ(direct.Rotation.coeffs(), entry.Rotation.coeffs());
      EXPECT_EQ(direct.Translation, entry.Translation);
      EXPECT_LE(TiltOf(entry.Rotation), options.MaxTilt + 1e-9);
    }
  }
  const std::size_t all = database.Connections.size();
  EXPECT_GT(connectible, all / 50);
  EXPECT_LT(connectible, all * 9 / 10);
}

TEST(Clusters, NearestSegmentThroughTheTree)
{
  // Queries are segments of an unseen run; its own are left out of the database.
  const MotionDatabase& database = Large();
  ClusterOptions options;
  options.MaximumSegments = 0;
  ClusterInput other = Traced(6, 6);
  other.Simulations.erase(other.Simulations.begin(), other.Simulations.begin() + 5);
  const MotionDatabase queries = Build(other, options);
  int asked = 0;
  int found = 0;
  long evaluations = 0;
  long reference = 0;
  for (std::size_t q = 0; q < queries.Segments.size(); ++q)
  {
    const SegmentGroup& from = queries.Groups[queries.Segments[q].Group];
    for (std::size_t g = 0; g < database.Groups.size(); ++g)
    {
      if (database.Groups[g].NumberOfSamples != from.NumberOfSamples)
      {
        continue;
      }
      const Eigen::VectorXd coefficients =
        CoefficientsOf(database.Groups[g], queries.Reconstruct(static_cast<int>(q)));
      const NearestResult all = FindNearestByAll(database, static_cast<int>(g), coefficients);
      const NearestResult tree =
        FindNearest(database, static_cast<int>(g), coefficients, all.Evaluations / 10);
      const NearestResult exact = FindNearest(database, static_cast<int>(g), coefficients, 0);
      EXPECT_EQ(exact.Distance, all.Distance);
      ++asked;
      found += tree.Segment == all.Segment;
      evaluations += tree.Evaluations;
      reference += all.Evaluations;
    }
  }
  ASSERT_GE(asked, 100);
  EXPECT_GE(found, 0.9 * asked) << found << " of " << asked;
  EXPECT_LE(evaluations, reference / 10);
}

TEST(Clusters, VorticesTravelWithTheirSegments)
{
  ClusterOptions options;
  options.MaximumSegments = 0;
  options.RelativeError = 1e-5;
  const ClusterInput input = Traced(1, 6);
  const MotionDatabase database = Build(input, options);
  const Vortex& world = input.Simulations[0].Vortices[0];
  int checked = 0;
  for (std::size_t s = 0; s < database.Segments.size(); ++s)
  {
    const Segment& segment = database.Segments[s];
    const std::vector<Vec3> local = database.Reconstruct(static_cast<int>(s));
    for (std::size_t i = 0; i < local.size(); ++i)
    {
      ASSERT_EQ(segment.VortexIds[i] >= 0, segment.ForceTypes[i] == ForceType::Vortex);
    }
    const int id = segment.VortexIds[0];
    if (id < 0)
    {
      continue;
    }
    // |f| does not depend on the frame: find the sample of a track that has it.
    const Vortex& vortex = database.Vortices[id];
    const double strength = vortex.Acceleration(local[0], 0.0).norm();
    double best = 1.0;
    for (const Track& track : input.Simulations[0].Tracks)
    {
      for (std::size_t i = 0; i < track.Positions.size(); ++i)
      {
        const double time = world.CenterTime - vortex.CenterTime;
        if (std::abs(i / 30.0 - time) < 1e-9)
        {
          const double here = world.Acceleration(track.Positions[i], time).norm();
          best = std::min(best, std::abs(here - strength));
        }
      }
    }
    EXPECT_LT(best, 2e-3 * (1.0 + strength));
    ++checked;
  }
  EXPECT_GT(checked, 20);

  const SegmentFrame frame = FrameOf({ Vec3(1, 2, 3), Vec3(1, 2.1, 3.1), Vec3(1, 2.2, 3.2) });
  EXPECT_LT((frame.ToLocal(Vec3(1, 2.1, 3.1)) - Vec3(0.1, 0, 0.1)).norm(), 1e-12);
  const Vec3 x(0.4, 0.9, 1.3);
  const Vec3 expected = frame.Rotation.conjugate() * world.Acceleration(x, 2.0);
  EXPECT_LT((LocalVortex(world, frame, 0.7).Acceleration(frame.ToLocal(x), 1.3) - expected).norm(),
            1e-12);
}

TEST(Clusters, ThreadsDoNotChangeABit)
{
  ClusterOptions options;
  options.MaximumSegments = 400;
  const ClusterInput input = Traced(1, 4);
  const MotionDatabase one = Build(input, options, 1);
  const MotionDatabase two = Build(input, options, 2);
  ASSERT_EQ(one.Segments.size(), 400u);
  ASSERT_EQ(two.Segments.size(), 400u);
  ASSERT_EQ(one.Nodes.size(), two.Nodes.size());
  for (std::size_t s = 0; s < one.Segments.size(); ++s)
  {
    EXPECT_EQ(one.Segments[s].Coefficients, two.Segments[s].Coefficients);
  }
  for (std::size_t n = 0; n < one.Nodes.size(); ++n)
  {
    EXPECT_EQ(one.Nodes[n].Medoid, two.Nodes[n].Medoid);
    EXPECT_EQ(one.Nodes[n].FirstChild, two.Nodes[n].FirstChild);
    EXPECT_EQ(one.Nodes[n].Radius, two.Nodes[n].Radius);
  }
  for (std::size_t c = 0; c < one.Connections.size(); ++c)
  {
    EXPECT_EQ(one.Connections[c].Cost, two.Connections[c].Cost);
  }
}

TEST(Clusters, CachesOfTheProcessorDoNotChangeABit)
{
  ClusterOptions options;
  options.MaximumSegments = 0;
  const ClusterInput input = Traced(2, 2); // thousands of segments in a group
  std::ptrdiff_t l1, l2, l3;
  Eigen::internal::manage_caching_sizes(Eigen::GetAction, &l1, &l2, &l3);
  std::vector<MotionDatabase> databases;
  for (const int size : { 16, 32, 48, 128 })
  {
    Eigen::setCpuCacheSizes(size << 10, size << 13, size << 16);
    databases.push_back(Build(input, options));
  }
  Eigen::setCpuCacheSizes(l1, l2, l3);
  const MotionDatabase& first = databases.front();
  ASSERT_GT(first.Segments.size(), 2500u);
  for (const MotionDatabase& other : databases)
  {
    ASSERT_EQ(other.Groups.size(), first.Groups.size());
    for (std::size_t g = 0; g < first.Groups.size(); ++g)
    {
      EXPECT_EQ(other.Groups[g].Basis, first.Groups[g].Basis);
      EXPECT_EQ(other.Groups[g].RelativeError, first.Groups[g].RelativeError);
    }
    for (std::size_t s = 0; s < first.Segments.size(); ++s)
    {
      ASSERT_EQ(other.Segments[s].Coefficients, first.Segments[s].Coefficients);
    }
    for (std::size_t n = 0; n < first.Nodes.size(); ++n)
    {
      ASSERT_EQ(other.Nodes[n].Medoid, first.Nodes[n].Medoid);
      ASSERT_EQ(other.Nodes[n].Radius, first.Nodes[n].Radius);
    }
    for (std::size_t c = 0; c < first.Connections.size(); ++c)
    {
      ASSERT_EQ(other.Connections[c].Cost, first.Connections[c].Cost);
    }
  }
}

TEST(Clusters, CoincidingSegmentsStillEndInLeavesOfTheirOwn)
{
  ClusterInput input;
  Track track;
  for (int i = 0; i < 14; ++i)
  {
    track.Positions.emplace_back(0.05 * i, 0.002 * i * i, 0.0);
  }
  input.Simulations.push_back({ std::vector<Track>(9, track), {} });
  const MotionDatabase database = Build(input, ClusterOptions());
  EXPECT_EQ(database.Segments.size(), 9u);
  EXPECT_TRUE(database.Validate());
}

TEST(Clusters, RefusesWhatIsWrong)
{
  MotionDatabase database;
  SilentMonitor monitor;
  ClusterInput input;
  const auto message = [&](const ClusterOptions& options)
  { return ClusterTrajectories(input, options, SerialFor(), monitor, database).Message(); };
  EXPECT_NE(message({}).find("none has 12 samples"), std::string::npos);
  Track track;
  track.ObjectId = 5;
  track.Positions.assign(20, Vec3::Zero());
  track.Positions[3].y() = std::numeric_limits<double>::quiet_NaN();
  input.Simulations.push_back({ { track }, {} });
  EXPECT_NE(message({}).find("object 5"), std::string::npos);
  ClusterOptions options;
  options.Window = 40;
  EXPECT_NE(message(options).find("Window"), std::string::npos);
  EXPECT_TRUE(database.Segments.empty());

  MotionDatabase broken = Large();
  broken.Segments[3].Group = 99;
  EXPECT_NE(broken.Validate().Message().find("segment 3"), std::string::npos);
  broken = Large();
  broken.Nodes.back().Medoid = broken.Nodes[broken.Nodes.size() - 2].Medoid;
  EXPECT_FALSE(broken.Validate());
  EXPECT_NE(MotionDatabase().Validate().Message().find("no segment"), std::string::npos);
}

namespace
{

class StopAfter : public Monitor
{
public:
  explicit StopAfter(int ticks) : Left(ticks) {}
  bool Tick(double fraction, const std::string&) override
  {
    EXPECT_GE(fraction, this->Last);
    EXPECT_LE(fraction, 1.0);
    this->Last = fraction;
    return --this->Left >= 0;
  }

private:
  int Left;
  double Last = 0.0;
};

} // namespace

TEST(Clusters, StopsWhenAsked)
{
  const ClusterInput input = Traced(1, 6);
  int stopped = 0;
  for (int ticks = 0; ticks < 40; ++ticks)
  {
    MotionDatabase database;
    StopAfter monitor(ticks);
    const Result result =
      ClusterTrajectories(input, ClusterOptions(), SerialFor(), monitor, database);
    ASSERT_TRUE(result);
    stopped += result.IsStopped();
    EXPECT_EQ(result.IsStopped(), database.Segments.empty());
  }
  EXPECT_GT(stopped, 5);
  EXPECT_LT(stopped, 40);
}
