// SPDX-License-Identifier: BSD-3-Clause
// From a chain of pieces to a path: blended, its gap shared out, braked and retimed.
#include "PlainBlending.h"
#include "Planning/SpanFit.h"
#include "RandomChains.h"

#include <gtest/gtest.h>

using namespace waft;
using namespace waft::test;

TEST(Blending, UndoneGivesBackTheDatabaseOutsideTheOverlaps)
{
  // Turn, handovers and rigid motion taken off again, the steps are those of the segments.
  const SegmentLibrary& library = Library();
  PieceChain chain = RandomChain(4);
  chain.JoinIndex = 2;
  chain.JoinAngle = 0.3;
  const std::vector<Vec3> path = BlendChain(library, chain);
  ASSERT_EQ(static_cast<int>(path.size()), chain.NumberOfSamples(library.Window()));
  const std::vector<Handover> handovers = HandOver(library, chain);
  ASSERT_EQ(handovers.size() + 1, chain.Pieces.size());
  const std::vector<int> beginnings = chain.Beginnings(library.Window());
  const double steps = static_cast<double>(path.size()) - 1.0;
  int compared = 0;
  for (std::size_t i = 0; i < chain.Pieces.size(); ++i)
  {
    const Piece& piece = chain.Pieces[i];
    const std::vector<Vec3>& samples = library.Samples(piece.Segment);
    const int length = piece.Last - piece.First;
    for (int k = library.Window() - 1; k < length - (library.Window() - 1); ++k)
    {
      const int at = beginnings[i] + k;
      Vec3 step =
        Eigen::AngleAxisd(-0.3 * (at + 0.5) / steps, Vec3::UnitZ()) * Vec3(path[at + 1] - path[at]);
      for (std::size_t j = 0; j < handovers.size(); ++j)
      {
        step -= handovers[j].Correction(at + 0.5, i > j);
      }
      if (static_cast<int>(i) >= chain.JoinIndex)
      {
        step = Eigen::AngleAxisd(0.3, Vec3::UnitZ()) * step;
      }
      const Vec3 own = samples[piece.First + k + 1] - samples[piece.First + k];
      EXPECT_LT((piece.Transform.Rotation.transpose() * step - own).norm(), 1e-12);
      ++compared;
    }
  }
  EXPECT_GT(compared, 60);
}

TEST(Blending, LeavesOutOnlyHandoversThatAddNothing)
{
  for (const std::uint64_t seed : { 4, 5, 6 })
  {
    PieceChain chain = RandomChain(seed, 900);
    ASSERT_GT(chain.Pieces.size(), 20U);
    chain.JoinIndex = static_cast<int>(chain.Pieces.size()) / 2;
    chain.JoinAngle = 0.2;
    EXPECT_EQ(BlendChain(Library(), chain), PlainBlend(Library(), chain));
  }
}

TEST(Handover, IsSmoothAndEndsAtItsReach)
{
  Handover handover;
  handover.Centre = 40.0;
  handover.Reach = 30.0;
  handover.Offset = Vec3(0.02, -0.01, 0.005);
  handover.Slope = Vec3(0.001, 0.002, -0.001);
  const auto before = [&](double sample) { return handover.Correction(sample, false); };
  const auto after = [&](double sample) { return handover.Correction(sample, true); };
  EXPECT_EQ(before(9.9), Vec3(Vec3::Zero()));
  EXPECT_EQ(after(70.1), Vec3(Vec3::Zero()));
  const double h = 0.01;
  for (double sample = -5.0; sample < 85.0; sample += h)
  {
    // Together with what the pieces differ by, both sides are one motion.
    const Vec3 difference = handover.Offset + (sample - 40.0) * handover.Slope;
    EXPECT_LT((before(sample) - after(sample) - difference).norm(), 1e-12) << sample;
    // Twice differentiable: no jump in the second derivative.
    const auto bend = [&](double x) -> Vec3
    { return (before(x - h) - 2.0 * before(x) + before(x + h)) / (h * h); };
    EXPECT_LT((bend(sample + h) - bend(sample)).norm(), 2e-6) << sample;
  }
  // Handed over, the offset leaves no shift in place.
  Handover flat = handover;
  flat.Slope = Vec3::Zero();
  Vec3 shift = Vec3::Zero();
  for (double sample = 0.5; sample < 80.0; sample += 1.0)
  {
    shift += flat.Correction(sample, sample > 40.0);
  }
  EXPECT_LT(shift.norm(), 1e-12);
}

TEST(Blending, LeavesAccelerationsAsTheyAreInTheAir)
{
  const SegmentLibrary& library = Library();
  double most = 0.0;
  for (std::size_t s = 0; s < library.Database().Segments.size(); ++s)
  {
    for (const Vec3& bend : SecondDifferences(library.Samples(static_cast<int>(s))))
    {
      most = std::max(most, bend.norm());
    }
  }
  double blended = 0.0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed)
  {
    for (const Vec3& bend : SecondDifferences(BlendChain(library, RandomChain(seed))))
    {
      blended = std::max(blended, bend.norm());
    }
  }
  EXPECT_LE(blended, most);
}

TEST(Redistribution, SharesTheGapOutEvenlyAndKeepsTheEnds)
{
  // The goal stands where no chain leads; each piece is to take the same part of the gap in each
  // frame, so that no connection gets a jump of velocity and none is preferred.
  const SegmentLibrary& library = Library();
  ClearanceField field;
  field.Bounds = Box{ Vec3(-9, -9, -9), Vec3(9, 9, 9) };
  const double width = field.Bounds.Width();
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    const PieceChain chain = RandomChain(seed);
    const std::vector<Vec3> chained = BlendChain(library, chain);
    SpanRequest request;
    request.Start.Position = chained.front() + Vec3(0.1, -0.2, 0.1);
    request.Goal.Position = chained.back() + Vec3(0.9, 0.5, -0.6);
    request.Clock.Frames = 240;
    const std::vector<Vec3> own = RetimePath(chained, request.Clock);
    SpanResult result;
    const SpanFitter fitter(library, field, field, request, 0.001);
    ASSERT_TRUE(fitter.Fit(chain, true, result)) << seed;
    EXPECT_LE((result.Positions.front() - request.Start.Position).norm(), 1e-9 * width);
    EXPECT_LE((result.Positions.back() - request.Goal.Position).norm(), 1e-9 * width);
    // What each connection takes, a frame: from the middle of its overlap to the next.
    const std::vector<int> beginnings = chain.Beginnings(library.Window());
    const double scale = 240.0 / (static_cast<double>(chained.size()) - 1.0);
    std::vector<Vec3> changes;
    int from = 0;
    for (std::size_t i = 1; i <= beginnings.size(); ++i)
    {
      const int to = i < beginnings.size() ? static_cast<int>(beginnings[i] * scale) : 240;
      changes.push_back(((result.Positions[to] - own[to]) - (result.Positions[from] - own[from])) /
                        (to - from));
      from = to;
    }
    const Vec3 mean = (request.Goal.Position - own[240] - request.Start.Position + own[0]) / 240.0;
    ASSERT_GT(mean.norm(), 1e-3);
    for (const Vec3& change : changes)
    {
      EXPECT_LE((change - mean).norm(), 0.1 * mean.norm()) << seed;
    }
  }
}

TEST(Blending, SpreadsTheTurnOfTheJoinEvenly)
{
  const SegmentLibrary& library = Library();
  PieceChain straight = RandomChain(5);
  PieceChain turned = straight;
  turned.JoinIndex = 2;
  turned.JoinAngle = 0.4;
  const Mat3 turn = Eigen::AngleAxisd(0.4, Vec3::UnitZ()).toRotationMatrix();
  for (std::size_t i = 2; i < turned.Pieces.size(); ++i)
  {
    turned.Pieces[i].Transform.Rotation = turn * turned.Pieces[i].Transform.Rotation;
  }
  // With the later pieces turned by the join's angle, each step is turned by its part of it.
  const std::vector<Vec3> a = BlendChain(library, straight);
  const std::vector<Vec3> b = BlendChain(library, turned);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k + 1 < a.size(); ++k)
  {
    const double angle = 0.4 * (k + 0.5) / (a.size() - 1.0);
    const Vec3 wanted = Eigen::AngleAxisd(angle, Vec3::UnitZ()) * (a[k + 1] - a[k]);
    EXPECT_LT((b[k + 1] - b[k] - wanted).norm(), 1e-12);
  }
}

TEST(SpanClock, BrakesAndLaunchesSmoothly)
{
  SpanClock clock;
  clock.Frames = 100;
  clock.BrakeFrames = 30;
  clock.LaunchFrames = 20;
  EXPECT_DOUBLE_EQ(clock.FlightFrames(), 75.0);
  EXPECT_DOUBLE_EQ(clock.Flown(0.0), 0.0);
  EXPECT_NEAR(clock.Flown(100.0), 75.0, 1e-12);
  EXPECT_NEAR(clock.Flown(60.0) - clock.Flown(59.0), 1.0, 1e-12);
  for (int k = 1; k <= 100; ++k)
  {
    const double rate = clock.Flown(k) - clock.Flown(k - 1);
    EXPECT_GE(rate, -1e-12);
    EXPECT_LE(rate, 1.0 + 1e-12);
  }
  EXPECT_LT(clock.Flown(1.0), 0.01);
  EXPECT_LT(75.0 - clock.Flown(99.0), 0.01);
}

TEST(RetimePath, KeepsSamplesAtTheSamePaceAndShapesAtAnother)
{
  std::vector<Vec3> circle;
  for (int k = 0; k <= 90; ++k)
  {
    circle.emplace_back(std::cos(0.05 * k), std::sin(0.05 * k), 0.01 * k);
  }
  SpanClock clock;
  clock.Frames = 90;
  const std::vector<Vec3> same = RetimePath(circle, clock);
  for (int k = 0; k <= 90; ++k)
  {
    EXPECT_LT((same[k] - circle[k]).norm(), 1e-12);
  }
  clock.Frames = 100;
  const std::vector<Vec3> slower = RetimePath(circle, clock);
  for (int k = 8; k <= 92; ++k)
  {
    const double u = 0.05 * 0.9 * k;
    EXPECT_LT((slower[k] - Vec3(std::cos(u), std::sin(u), 0.2 * u)).norm(), 1e-6);
  }
}
