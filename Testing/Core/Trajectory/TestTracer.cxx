// SPDX-License-Identifier: BSD-3-Clause
#include "AnalyticFlow.h"

#include <gtest/gtest.h>

#include <limits>

using namespace waft;
using namespace waft::test;

namespace
{

TraceOptions Options(int stride)
{
  TraceOptions options;
  options.SeedStride = stride;
  return options;
}

std::vector<Track> Trace(const FlowFunction& flow, const std::vector<double>& times,
                         const TraceOptions& options, int points = 16, int threads = 1,
                         std::vector<Vortex> vortices = {}, SolidTest solid = {})
{
  const PointLattice lattice = CubeLattice(options.Volume, points);
  TrajectoryTracer tracer;
  EXPECT_TRUE(tracer.Begin(lattice, options, std::move(vortices), std::move(solid)));
  for (const double time : times)
  {
    const Result result = tracer.Feed(FrameOfFlow(lattice, flow, time), ThreadedFor(threads));
    EXPECT_TRUE(result) << result.Message();
  }
  return tracer.Finish();
}

std::vector<double> Frames(int count, double rate = 30.0)
{
  std::vector<double> times;
  for (int i = 0; i < count; ++i)
  {
    times.push_back(i / rate);
  }
  return times;
}

} // namespace

TEST(Tracer, SeedsAreAUniformSubsetOfVoxelCentres)
{
  TraceOptions options = Options(4);
  const auto still = [](const Vec3&, double) { return Vec3(0, 0, 0); };
  const std::vector<Track> tracks = Trace(still, Frames(2), options);
  ASSERT_EQ(tracks.size(), 64u);
  Vec3 mean = Vec3::Zero();
  for (const Track& track : tracks)
  {
    const Vec3 place = (track.Positions[0] - options.Volume.Min) / 0.25 - Vec3::Constant(0.5);
    EXPECT_LT((place - place.array().round().matrix()).norm(), 1e-12);
    mean += track.Positions[0] / 64.0;
  }
  // A stride of four puts the subset half a voxel off the middle at most.
  EXPECT_LT((mean - options.Volume.Center()).lpNorm<Eigen::Infinity>(), 0.125 + 1e-12);
}

TEST(Tracer, ConstantFieldGivesStraightLinesExactly)
{
  TraceOptions options = Options(8);
  options.SettlingSpeed = 0.25;
  const Vec3 wind(0.25, -0.125, 0.5);
  const std::vector<Track> tracks =
    Trace([&](const Vec3&, double) { return wind; }, Frames(31), options);
  ASSERT_EQ(tracks.size(), 8u);
  for (const Track& track : tracks)
  {
    ASSERT_EQ(track.Positions.size(), 31u);
    for (std::size_t i = 0; i < track.Positions.size(); ++i)
    {
      const Vec3 expected = track.Positions[0] + (wind - Vec3(0, 0, 0.25)) * (i / 30.0);
      EXPECT_LT((track.Positions[i] - expected).norm(), 1e-12);
    }
  }
}

TEST(Tracer, SolidRotationKeepsItsRadius)
{
  const TraceOptions options = Options(5);
  const Vec3 center(0, 0, 2);
  const double turn = 2.0; // seconds
  const auto flow = [&](const Vec3& x, double)
  { return Vec3(Vec3(0, 0, 2.0 * M_PI / turn).cross(x - center)); };
  int whole = 0;
  for (const Track& track : Trace(flow, Frames(61), options))
  {
    if (std::hypot(track.Positions.front().x(), track.Positions.front().y()) > 1.8)
    {
      continue; // its circle leaves the lattice
    }
    ASSERT_EQ(track.Positions.size(), 61u);
    ++whole;
    const double before = std::hypot(track.Positions.front().x(), track.Positions.front().y());
    const double after = std::hypot(track.Positions.back().x(), track.Positions.back().y());
    EXPECT_NEAR(after, before, 1e-3 * before);
    EXPECT_LT((track.Positions.back() - track.Positions.front()).norm(), 1e-3 * before);
  }
  EXPECT_GE(whole, 12);
}

TEST(Tracer, VelocityIsLinearInTimeBetweenFramesAndSamplesAreEven)
{
  // u = a t is integrated exactly, and uneven flow frames do not show in the samples.
  const Vec3 a(0.3, -0.2, 0.1);
  const auto flow = [&](const Vec3&, double time) { return Vec3(a * time); };
  const std::vector<double> times{ 0.0, 0.11, 0.2, 0.5, 0.52, 1.0 };
  for (const Track& track : Trace(flow, times, Options(8)))
  {
    ASSERT_EQ(track.Positions.size(), 31u);
    for (int i = 0; i <= 30; ++i)
    {
      const double time = i / 30.0;
      EXPECT_LT((track.Positions[i] - track.Positions[0] - 0.5 * time * time * a).norm(), 1e-7);
    }
  }
}

TEST(Tracer, EndsAtTheVolumeAndAtWhatIsSolid)
{
  const auto flow = [](const Vec3&, double) { return Vec3(1, 0, 0); };
  const auto solid = [](const Vec3& x, double) { return x.x() > 0.9 && x.y() > 0.0; };
  const std::vector<Track> tracks = Trace(flow, Frames(121), Options(4), 16, 1, {}, solid);
  EXPECT_EQ(tracks.size(), 64u - 8u); // seeds in the solid are not sown
  for (const Track& track : tracks)
  {
    const double wall = track.Positions[0].y() > 0.0 ? 0.9 : 2.0;
    EXPECT_LE(track.Positions.back().x(), wall);
    EXPECT_GT(track.Positions.back().x(), wall - 1.0 / 30.0 - 1e-9);
    EXPECT_EQ(track.ForceTypes.size(), track.Positions.size());
  }
}

TEST(Tracer, AnnotationFollowsTheForces)
{
  TraceOptions options = Options(2);
  options.Annotation.ShortestRun = 0.0;
  Vortex left;
  left.VortexId = 7;
  left.P1 = Vec3(-1, 0, 0);
  left.P2 = Vec3(-1, 0, 4);
  left.Strength = 8.0;
  left.CenterTime = 0.5;
  left.CoreRadius = 0.3;
  Vortex other = left;
  other.VortexId = 3;
  other.P1.x() = other.P2.x() = 1.0;
  other.Strength = -4.0;
  const std::vector<Vortex> vortices{ left, other };
  const auto wind = [](const Vec3& x, double) { return Vec3(0.4 + 0.3 * x.y(), 0, 0); };
  const auto vortexForce = [&](const Vec3& x, double time)
  { return Vec3(left.Acceleration(x, time) + other.Acceleration(x, time)); };

  const PointLattice lattice = CubeLattice(options.Volume, 32);
  TrajectoryTracer tracer;
  ASSERT_TRUE(tracer.Begin(lattice, options, vortices));
  for (const double time : Frames(31))
  {
    FlowFrame frame = FrameOfFlow(
      lattice, [](const Vec3& x, double t) { return SwirlingFlow(x, t); }, time);
    frame.VortexForce = SampleFlow(lattice, vortexForce, time);
    frame.WindForce = SampleFlow(lattice, wind, time);
    ASSERT_TRUE(tracer.Feed(std::move(frame), SerialFor()));
  }
  int points = 0;
  int correct = 0;
  std::array<int, 3> seen{ 0, 0, 0 };
  for (const Track& track : tracer.Finish())
  {
    for (std::size_t i = 0; i < track.Positions.size(); ++i)
    {
      const Vec3& x = track.Positions[i];
      const double time = i / 30.0;
      // The rule itself: half of both together, above a floor.
      const double vortex = vortexForce(x, time).norm();
      const double air = wind(x, time).norm();
      const ForceType type = vortex > 0.5 * (vortex + air) && vortex > 0.05 ? ForceType::Vortex
                             : air > 0.05                                   ? ForceType::Wind
                                                                            : ForceType::None;
      const bool isLeft = left.Acceleration(x, time).norm() > other.Acceleration(x, time).norm();
      const int id = type == ForceType::Vortex ? (isLeft ? 7 : 3) : -1;
      ++points;
      correct += track.ForceTypes[i] == type && track.VortexIds[i] == id;
      ++seen[static_cast<int>(type)];
    }
  }
  EXPECT_GE(correct, 0.99 * points);
  EXPECT_GT(seen[1], 0.05 * points);
  EXPECT_GT(seen[2], 0.05 * points);
}

TEST(Tracer, ShortRunsAreIgnored)
{
  AnnotationOptions options; // 0.3 s: nine frames
  Track track;
  const auto add = [&](int count, const Vec3& vortex, const Vec3& wind)
  {
    for (int i = 0; i < count; ++i)
    {
      track.Positions.push_back(Vec3::Zero());
      track.VortexAccelerations.push_back(vortex);
      track.WindAccelerations.push_back(wind);
    }
  };
  add(4, Vec3(1, 0, 0), Vec3::Zero());         // short, at the start: takes what follows
  add(12, Vec3::Zero(), Vec3(1, 0, 0));        // wind
  add(5, Vec3(1, 0, 0), Vec3::Zero());         // short
  add(12, Vec3::Zero(), Vec3(1, 0, 0));        // wind
  add(10, Vec3(0.02, 0, 0), Vec3(0.01, 0, 0)); // under the floor: nothing
  AnnotateTrack({}, 0.0, 30.0, options, track);
  for (int i = 0; i < 33; ++i)
  {
    EXPECT_EQ(track.ForceTypes[i], ForceType::Wind) << i;
  }
  EXPECT_EQ(track.ForceTypes[40], ForceType::None);
}

TEST(Tracer, ThreadsDoNotChangeABit)
{
  const auto flow = [](const Vec3& x, double time) { return SwirlingFlow(x, time); };
  const std::vector<Track> one = Trace(flow, Frames(20), Options(3), 16, 1);
  const std::vector<Track> two = Trace(flow, Frames(20), Options(3), 16, 2);
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t t = 0; t < one.size(); ++t)
  {
    EXPECT_EQ(one[t].Positions, two[t].Positions);
  }
}

TEST(Tracer, RefusesWhatIsWrong)
{
  const PointLattice lattice = CubeLattice(Box(), 4);
  TrajectoryTracer tracer;
  TraceOptions options = Options(0);
  EXPECT_FALSE(tracer.Begin(lattice, options));
  options.SeedStride = 1;
  EXPECT_FALSE(tracer.Begin(PointLattice(), options));
  ASSERT_TRUE(tracer.Begin(lattice, options));
  FlowFrame frame;
  frame.Velocity.resize(3);
  EXPECT_NE(tracer.Feed(frame, SerialFor()).Message().find("64 values"), std::string::npos);
  frame.Velocity.assign(64, { 0.f, 0.f, 0.f });
  ASSERT_TRUE(tracer.Feed(frame, SerialFor()));
  EXPECT_NE(tracer.Feed(frame, SerialFor()).Message().find("after"), std::string::npos);
  frame.Time = 1.0;
  frame.Velocity[5][1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(tracer.Feed(frame, SerialFor()).Message().find("not finite"), std::string::npos);
}
