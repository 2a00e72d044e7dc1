// SPDX-License-Identifier: BSD-3-Clause
#include "AnalyticFlow.h"
#include "Trajectory/Coverage.h"
#include "Trajectory/SegmentFrame.h"
#include "Trajectory/TrackPieces.h"

#include <gtest/gtest.h>

#include <map>

using namespace waft;
using namespace waft::test;

namespace
{

constexpr double Rate = 30.0;
constexpr double Width = 4.0;

std::vector<Track> Traced(double phase)
{
  TraceOptions options;
  options.SeedStride = 5;
  const PointLattice lattice = CubeLattice(options.Volume, 24);
  TrajectoryTracer tracer;
  EXPECT_TRUE(tracer.Begin(lattice, options));
  for (int frame = 0; frame < 90; ++frame)
  {
    const auto flow = [phase](const Vec3& x, double t) { return SwirlingFlow(x, t, phase); };
    EXPECT_TRUE(tracer.Feed(FrameOfFlow(lattice, flow, frame / Rate), SerialFor()));
  }
  return tracer.Finish();
}

// By the definition, every pair in full.
class PlainCoverage
{
public:
  explicit PlainCoverage(double tolerance) : Tolerance(tolerance) {}
  CoveragePoint Add(const std::vector<Track>& tracks)
  {
    const std::vector<int> lengths = GroupLengths(SegmentationOptions());
    std::map<int, std::vector<Eigen::VectorXd>> added;
    for (const TrackPiece& piece : CutTracks(tracks, Rate, Width, SegmentationOptions(), lengths))
    {
      const std::vector<Vec3> part = PositionsOf(tracks, piece);
      this->Chords[piece.Length].push_back((part.back() - part.front()).squaredNorm());
      added[piece.Length].push_back(LocalSamples(part, FrameOf(part)));
    }
    CoveragePoint point;
    int isNew = 0;
    for (const auto& [length, segments] : added)
    {
      double chord = 0.0;
      for (const double squared : this->Chords[length])
      {
        chord += squared / this->Chords[length].size();
      }
      for (const Eigen::VectorXd& segment : segments)
      {
        ++point.NewSegments;
        bool isKnown = false;
        for (const Eigen::VectorXd& other : this->Known[length])
        {
          const double squared = (segment - other).squaredNorm() / lengths[length];
          isKnown = isKnown || squared <= this->Tolerance * this->Tolerance * chord;
        }
        isNew += isKnown ? 0 : 1;
      }
    }
    for (const auto& [length, segments] : added)
    {
      std::vector<Eigen::VectorXd>& known = this->Known[length];
      known.insert(known.end(), segments.begin(), segments.end());
    }
    point.NewShare = double(isNew) / point.NewSegments;
    return point;
  }

private:
  double Tolerance;
  std::map<int, std::vector<Eigen::VectorXd>> Known;
  std::map<int, std::vector<double>> Chords;
};

} // namespace

TEST(Coverage, IsThatOfItsDefinition)
{
  for (const double tolerance : { Coverage::DefaultTolerance, 0.12 })
  {
    Coverage coverage(SegmentationOptions(), Rate, Width, tolerance);
    PlainCoverage plain(tolerance);
    std::vector<CoveragePoint> expected;
    for (int simulation = 0; simulation < 5; ++simulation)
    {
      const std::vector<Track> tracks = Traced(0.3 * simulation);
      coverage.Add(tracks, SerialFor());
      expected.push_back(plain.Add(tracks));
    }
    ASSERT_EQ(coverage.Curve().size(), 4u); // none for the first
    for (int i = 0; i < 4; ++i)
    {
      EXPECT_EQ(coverage.Curve()[i].Simulations, i + 1);
      EXPECT_EQ(coverage.Curve()[i].NewSegments, expected[i + 1].NewSegments);
      EXPECT_NEAR(coverage.Curve()[i].NewShare, expected[i + 1].NewShare, 1e-12);
      EXPECT_GT(coverage.Curve()[i].NewShare, 0.01);
      EXPECT_LT(coverage.Curve()[i].NewShare, 0.98);
    }
  }
}

TEST(Coverage, NothingIsNewInWhatWasSeen)
{
  Coverage coverage(SegmentationOptions(), Rate, Width);
  coverage.Add(Traced(0.0), SerialFor());
  coverage.Add(Traced(1.1), SerialFor());
  coverage.Add(Traced(0.0), SerialFor());
  ASSERT_EQ(coverage.Curve().size(), 2u);
  EXPECT_GT(coverage.Curve()[0].NewShare, 0.1);
  EXPECT_EQ(coverage.Curve()[1].NewShare, 0.0);
  EXPECT_GT(coverage.Curve()[1].NewSegments, 50);
}

TEST(Coverage, FramesOfSegmentsDoNotCount)
{
  // The same paths elsewhere and turned about the vertical.
  std::vector<Track> tracks = Traced(0.4);
  Coverage coverage(SegmentationOptions(), Rate, Width);
  coverage.Add(tracks, SerialFor());
  const Quat turn(Eigen::AngleAxisd(2.1, Vec3::UnitZ()));
  for (Track& track : tracks)
  {
    for (Vec3& x : track.Positions)
    {
      x = turn * x + Vec3(0.3, -0.2, 0.7);
    }
  }
  coverage.Add(tracks, SerialFor());
  EXPECT_LT(coverage.Curve()[0].NewShare, 0.01);
}

TEST(Coverage, ThreadsDoNotChangeIt)
{
  Coverage one(SegmentationOptions(), Rate, Width);
  Coverage two(SegmentationOptions(), Rate, Width);
  for (const double phase : { 0.0, 0.7, 1.9 })
  {
    const std::vector<Track> tracks = Traced(phase);
    one.Add(tracks, SerialFor());
    two.Add(tracks, ThreadedFor(2));
  }
  EXPECT_EQ(one.Curve()[0].NewShare, two.Curve()[0].NewShare);
  EXPECT_EQ(one.Curve()[1].NewShare, two.Curve()[1].NewShare);
}
