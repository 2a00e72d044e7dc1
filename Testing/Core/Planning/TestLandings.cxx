// SPDX-License-Identifier: BSD-3-Clause
// How objects come down: as light things do, and exactly where they are told.
#include "PlanScenes.h"
#include "Trajectory/Style.h"

#include <gtest/gtest.h>

#include <ctime>

using namespace waft;
using namespace waft::test;

namespace
{

/// Largest downward speed in the second before a frame [m/s].
double FastestFall(const std::vector<Vec3>& p, int frame)
{
  double fastest = 0.0;
  for (int k = frame - 29; k <= frame; ++k)
  {
    fastest = std::max(fastest, (p[k - 1].z() - p[k].z()) * 30.0);
  }
  return fastest;
}

} // namespace

TEST(Landings, SinkNoFasterThanSuchThingsFallAndSlowDownAtTheGround)
{
  PlanScene scene;
  AddLetters(scene, 48);
  const PlanOutput output = scene.Run(1);
  const StyleSamples reference = StyleOf(SwirlDatabase());
  StyleSamples style;
  std::vector<double> along;
  std::vector<double> sinking;
  for (const Constraint& row : output.Constraints)
  {
    EXPECT_EQ(row.Status, ConstraintStatus::Met) << row.Target;
    const std::vector<Vec3>& p = output.Tracks[row.ObjectId].Positions;
    EXPECT_LT((p[250] - Vec3(row.Value.x(), row.Value.y(), 0.002)).norm(), 1e-12);
    EXPECT_LE(FastestFall(p, 250), 1.3 * scene.Objects[row.ObjectId].SettlingSpeed) << row.Target;
    EXPECT_LT((p[249] - p[250]).norm() * 30.0, 0.05) << row.Target;
    for (int k = 220; k < 250; ++k)
    {
      EXPECT_GE(p[k].z(), p[250].z() - 1e-9) << row.Target << ' ' << k;
    }
    for (int k = 40; k < 234; ++k)
    {
      const double change = p[k + 2].z() - 3.0 * p[k + 1].z() + 3.0 * p[k].z() - p[k - 1].z();
      if (k < 180 || k > 195)
      {
        (k < 180 ? along : sinking).push_back(std::abs(change));
      }
    }
    AppendStyle({ p.begin(), p.begin() + 221 }, 1.0 / 30.0, style);
  }
  // No jerk where the even sinking begins: the bend changes no more than it does along the way.
  EXPECT_LE(Quantile(sinking, 0.98), Quantile(along, 0.98));
  EXPECT_LE(KolmogorovSmirnov(reference.LogCurvature, style.LogCurvature), 0.20);
  EXPECT_LE(KolmogorovSmirnov(reference.Acceleration, style.Acceleration), 0.35);
}

TEST(Landings, FollowTheSettlingSpeedOfEachObject)
{
  // Down, feathers and leaves; on the ground and on a table, after another mark and without.
  PlanScene scene;
  scene.AddBox(Vec3(0.6, 0.6, 0.0), Vec3(1.6, 1.6, 0.8));
  const double speeds[] = { 0.15, 0.4, 0.8 };
  for (int i = 0; i < 9; ++i)
  {
    scene.AddObject(Vec3(-1.2 + 0.3 * i, -1.0, 2.2));
    scene.Objects.back().SettlingSpeed = speeds[i % 3];
    if (i % 2 == 1)
    {
      scene.AddRow(ConstraintKind::Position, i, 100, Vec3(-0.5, 0.1 * i, 1.6));
    }
    scene
      .AddRow(ConstraintKind::Rest, i, 240,
              i < 3 ? Vec3(0.9, 0.8 + 0.2 * i, 1.2) : Vec3(-1.0 + 0.2 * i, 0.2, 1.0))
      .Until = 299;
  }
  const PlanOutput output = scene.Run(4);
  for (const Constraint& row : output.Constraints)
  {
    EXPECT_EQ(row.Status, ConstraintStatus::Met) << row.Row;
    if (row.Kind == ConstraintKind::Rest)
    {
      EXPECT_LE(FastestFall(output.Tracks[row.ObjectId].Positions, 240),
                1.3 * scene.Objects[row.ObjectId].SettlingSpeed)
        << row.Row;
    }
  }
}

TEST(Landings, ThatMustBeQuickComeBeforeTheirManner)
{
  // 2.4 m down in 55 frames and 2.6 m in 80: faster than such things sink, not than the air is.
  PlanScene scene;
  const int frames[] = { 55, 80 };
  for (int i = 0; i < 8; ++i)
  {
    scene.AddObject(Vec3(-0.5 + 0.15 * i, -0.4, 2.4 + 0.2 * (i % 2)));
    scene.AddRow(ConstraintKind::Rest, i, frames[i % 2], Vec3(0.2, 0.3 - 0.1 * i, 1.0)).Until = 299;
  }
  const PlanOutput output = scene.Run(1);
  for (const Constraint& row : output.Constraints)
  {
    EXPECT_EQ(row.Status, ConstraintStatus::Met) << row.Row;
    const std::vector<Vec3>& p = output.Tracks[row.ObjectId].Positions;
    EXPECT_LT((p[row.Frame] - Vec3(row.Value.x(), row.Value.y(), 0.002)).norm(), 1e-12);
    EXPECT_LT((p[row.Frame] - p[row.Frame - 1]).norm() * 30.0, 0.1) << row.Row;
    EXPECT_LE(FastestStep(output.Tracks[row.ObjectId]), 1.5 * SwirlDatabase().TopSpeed);
  }
}

// Of a long flight more paths fail, and each takes longer to fit: there are fewer to choose from.
TEST(Landings, TakeAFrameOfALongFlightNoLongerThanOfAShortOne)
{
  const auto secondsOfAFrame = [](int frames)
  {
    PlanScene scene;
    AddLetters(scene, 12, frames);
    EXPECT_TRUE(scene.Obstacles.Build(scene.Meshes));
    SwirlDatabase();
    const std::clock_t begin = std::clock();
    const PlanOutput output = scene.Run(1);
    for (const Constraint& row : output.Constraints)
    {
      EXPECT_EQ(row.Status, ConstraintStatus::Met) << row.Target;
    }
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / (frames - 50.0);
  };
  EXPECT_LT(secondsOfAFrame(3000), 2.0 * secondsOfAFrame(300));
}
