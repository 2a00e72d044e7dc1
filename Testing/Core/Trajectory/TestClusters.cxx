// SPDX-License-Identifier: BSD-3-Clause
#include "TracedDatabase.h"
#include "Trajectory/NearestSegment.h"
#include "Trajectory/SegmentFrame.h"

#include <gtest/gtest.h>

#include <functional>

using namespace waft;
using namespace waft::test;

namespace
{

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

/// Of squared distances of coefficients to their mean.
double SumOfSquaresOf(const MotionDatabase& database, const std::vector<int>& segments)
{
  const Eigen::Index rank = database.Segments[segments[0]].Coefficients.size();
  Eigen::MatrixXd points(rank, static_cast<Eigen::Index>(segments.size()));
  for (std::size_t i = 0; i < segments.size(); ++i)
  {
    points.col(static_cast<Eigen::Index>(i)) = database.Segments[segments[i]].Coefficients;
  }
  const Eigen::VectorXd mean = points.rowwise().mean();
  return (points.colwise() - mean).squaredNorm();
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
                     { after.begin(), after.begin() + database.Window }, options.RotationFreedom);
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
