// SPDX-License-Identifier: BSD-3-Clause
// Runs of the clustering: the same on any machine, stopped, refused.
#include "SameDatabase.h"
#include "TracedDatabase.h"

#include <limits>

using namespace waft;
using namespace waft::test;

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

TEST(ClusterRuns, ThreadsDoNotChangeABit)
{
  ClusterOptions options;
  options.MaximumSegments = 400;
  const ClusterInput input = Traced(1, 4);
  const MotionDatabase one = Build(input, options, 1);
  const MotionDatabase two = Build(input, options, 2);
  ASSERT_EQ(one.Segments.size(), 400u);
  ExpectSame(one, two);
}

TEST(ClusterRuns, CachesOfTheProcessorDoNotChangeABit)
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
    ExpectSame(other, first);
  }
}

TEST(ClusterRuns, RefusesWhatIsWrong)
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

TEST(ClusterRuns, StopsWhenAsked)
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
