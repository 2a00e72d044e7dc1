// SPDX-License-Identifier: BSD-3-Clause
// By how much a motion misses what is wanted of it.
#include "ConstraintFixture.h"

#include <cmath>

using namespace waft;
using namespace waft::testing;

TEST(ConstraintResiduals, AreDistancesBeyondTheRadius)
{
  Fixture f;
  Track track;
  for (int k = 0; k < 100; ++k)
  {
    const double t = 0.1 * k;
    track.Positions.emplace_back(std::sin(t), 0.2 * t, 2.0 + 0.1 * t * t);
  }
  for (int k = 60; k <= 70; ++k)
  {
    track.Positions[k] = Vec3(-0.5, 1, 0.01);
  }
  track.Positions[64].x() += 0.02;
  const auto v = CentralDifferences(track.Positions, 0.1);
  const auto a = CentralDifferences(v, 0.1);
  f.Add(Kind::Position, 10, track.Positions[10]);
  f.Add(Kind::Position, 11, track.Positions[11] + Vec3(0, 0.3, 0), 0.1);
  f.Add(Kind::Position, 12, track.Positions[12] + Vec3(0, 0.3, 0), 0.31);
  f.Add(Kind::Velocity, 13, v[13]);
  f.Add(Kind::Velocity, 14, v[14] + Vec3(0.5, 0, 0));
  f.Add(Kind::Acceleration, 15, a[15]);
  f.Add(Kind::Acceleration, 16, a[16] + Vec3(0, 0, 0.25));
  f.Add(Kind::Rest, 60, Vec3(-0.5, 1, 1)).Until = 70;
  f.Add(Kind::Rest, 65, Vec3(-0.5, 1, 1)).Until = 70;
  f.Add(Kind::Position, 20, Vec3(0, 0, 9)); // infeasible: keeps its status and sentence
  auto report = f.Judged();
  for (ReportRow& line : report)
  {
    line.Status = line.Row == 9 ? Infeasible : Met;
    line.Message = line.Row == 9 ? "too high" : "";
  }
  MeasureResiduals(f.Rows, { track }, f.Objects, f.Obstacles, f.Scene, report);
  const std::vector<double> residuals{
    0, 0.2, 0, 0, 0.5, 0, 0.25, 0.02, 0, (track.Positions[20] - Vec3(0, 0, 9)).norm()
  };
  const Statuses statuses{ Met, Unreachable, Met,         Met, Unreachable,
                           Met, Unreachable, Unreachable, Met, Infeasible };
  for (std::size_t n = 0; n < report.size(); ++n)
  {
    EXPECT_NEAR(report[n].Residual, residuals[n], 1e-12) << n;
    EXPECT_EQ(report[n].Status, statuses[n]) << n;
  }
  EXPECT_NE(report[4].Message.find("velocity at frame 14: missed by 0.5 m/s, expected at most"),
            std::string::npos)
    << report[4].Message;
  EXPECT_EQ(report[9].Message, "too high");
}

TEST(ConstraintResiduals, OrientationsAndRowsWithoutAnObject)
{
  Fixture f;
  PoseTrack pose;
  pose.Orientations.assign(100, Quat(Eigen::AngleAxisd(0.5, Vec3::UnitZ())));
  f.Add(Kind::Orientation, 10, Vec3::Zero()).Orientation = Quat(-pose.Orientations[0].coeffs());
  f.Add(Kind::Orientation, 11, Vec3::Zero(), 0.1);
  f.Add(Kind::Position, 12, Vec3(0, 0, 1)).ObjectId = -1;
  auto report = f.Judged();
  MeasureOrientationResiduals(f.Rows, { pose }, report);
  MeasureResiduals(f.Rows, {}, f.Objects, f.Obstacles, f.Scene, report);
  EXPECT_NEAR(report[0].Residual, 0.0, 1e-12);
  EXPECT_EQ(report[0].Status, Met);
  EXPECT_NEAR(report[1].Residual, 0.4, 1e-12);
  EXPECT_EQ(report[1].Status, Unreachable);
  EXPECT_EQ(report[2].Status, Unreachable);
  EXPECT_EQ(report[2].Message, "no object was assigned to it");
}

TEST(ConstraintResiduals, SayHowNearAnUnmetPlaceIsComeTo)
{
  Fixture f;
  std::vector<Track> tracks(2);
  tracks[0].Positions.assign(100, Vec3(0, 0, 2));
  tracks[1].ObjectId = 1;
  tracks[1].Positions.assign(100, Vec3(0, 1, 2));
  f.Add(Kind::Position, 10, Vec3(0, 0.25, 2), 0.05).Status = Unreachable;
  f.Add(Kind::Position, 10, Vec3(0, 1.5, 2)).ObjectId = -1;
  auto report = f.Judged();
  MeasureResiduals(f.Rows, tracks, f.Objects, f.Obstacles, f.Scene, report);
  EXPECT_NEAR(report[0].Residual, 0.2, 1e-12);
  EXPECT_NE(report[0].Message.find("; it comes within 0.2 m"), std::string::npos)
    << report[0].Message;
  EXPECT_EQ(report[1].Status, Unreachable);
  EXPECT_NEAR(report[1].Residual, 0.5, 1e-12);
  EXPECT_EQ(report[1].Message, "no object was assigned to it, the nearest comes within 0.5 m");
}
