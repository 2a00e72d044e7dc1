// SPDX-License-Identifier: BSD-3-Clause
// Whole plans, judged on the tracks that come out.
#include "Base/ThreadRanks.h"
#include "PlanScenes.h"
#include "Planning/ScenePlans.h"
#include "Trajectory/Style.h"

#include <gtest/gtest.h>

#include <cstring>
#include <map>

using namespace waft;
using namespace waft::test;

namespace
{

void AddFeatherRows(PlanScene& scene)
{
  scene.AddObject(Vec3(-1.5, -0.8, 3.4));
  scene.AddBox(Vec3(-0.2, -2.0, 0.0), Vec3(0.2, 0.4, 1.6));
  scene.AddRow(ConstraintKind::Position, 0, 110, Vec3(-0.6, 0.7, 2.6));
  scene.AddRow(ConstraintKind::Position, 0, 200, Vec3(0.6, -0.5, 2.2)).Radius = 0.05;
  scene.AddRow(ConstraintKind::Position, 0, 299, Vec3(1.5, 0.6, 1.0));
}

} // namespace

TEST(Planner, MeetsMarksExactlyClearOfEverythingInStyle)
{
  PlanScene scene;
  AddFeatherRows(scene);
  const StyleSamples reference = StyleOf(test::SwirlDatabase());
  StyleSamples style;
  double jump = 0.0;
  double speed = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    const PlanOutput output = scene.Run(seed);
    ASSERT_EQ(output.Tracks.size(), 1u);
    const Track& track = output.Tracks[0];
    ASSERT_EQ(track.Positions.size(), 300u);
    EXPECT_EQ(track.Positions[0], Vec3(-1.5, -0.8, 3.4));
    EXPECT_EQ(track.Positions[110], Vec3(-0.6, 0.7, 2.6));
    EXPECT_LE((track.Positions[200] - Vec3(0.6, -0.5, 2.2)).norm(), 0.05);
    EXPECT_EQ(track.Positions[299], Vec3(1.5, 0.6, 1.0));
    EXPECT_GE(LeastSlack(scene, track, 0, 299), -0.004);
    EXPECT_LE(FastestStep(track), 1.5 * test::SwirlDatabase().TopSpeed);
    for (const ReportRow& line : output.Report)
    {
      EXPECT_EQ(line.Status, ConstraintStatus::Met) << line.Message;
    }
    AppendStyle(track.Positions, 1.0 / 30.0, style);
    // Velocity extrapolated from both sides of a waypoint.
    for (int k : { 110, 200 })
    {
      const auto& p = track.Positions;
      const Vec3 left = 1.5 * p[k] - 2.0 * p[k - 1] + 0.5 * p[k - 2];
      const Vec3 right = -1.5 * p[k] + 2.0 * p[k + 1] - 0.5 * p[k + 2];
      jump = std::max(jump, (left - right).norm());
    }
    for (std::size_t k = 1; k < 300; ++k)
    {
      speed += (track.Positions[k] - track.Positions[k - 1]).norm() / (299.0 * 20.0);
    }
  }
  EXPECT_LE(jump, 0.05 * speed);
  EXPECT_LE(KolmogorovSmirnov(reference.LogCurvature, style.LogCurvature), 0.20);
  EXPECT_LE(KolmogorovSmirnov(reference.Acceleration, style.Acceleration), 0.35);
}

TEST(Planner, GivesTheSameBytesForAnyNumberOfThreads)
{
  PlanScene scene;
  AddFeatherRows(scene);
  for (int i = 0; i < 9; ++i)
  {
    scene.AddObject(Vec3(-1.0 + 0.2 * i, 1.0, 2.5));
  }
  const PlanOutput one = scene.Run(3);
  const PlanOutput two = scene.Run(3, ThreadedFor(2));
  ASSERT_EQ(one.Tracks.size(), two.Tracks.size());
  for (std::size_t i = 0; i < one.Tracks.size(); ++i)
  {
    const Track& a = one.Tracks[i];
    const Track& b = two.Tracks[i];
    ASSERT_EQ(a.Positions.size(), b.Positions.size());
    EXPECT_EQ(
      std::memcmp(a.Positions.data(), b.Positions.data(), a.Positions.size() * sizeof(Vec3)), 0);
    EXPECT_EQ(a.VortexIds, b.VortexIds);
  }
  EXPECT_EQ(one.Vortices.size(), two.Vortices.size());
  EXPECT_EQ(one.Trees.size(), two.Trees.size());
  const PlanOutput other = scene.Run(4);
  EXPECT_NE(other.Tracks[0].Positions[50], one.Tracks[0].Positions[50]);
}

namespace
{

/// By several ranks, of two threads each.
PlanOutput RunOnRanks(PlanScene& scene, const PlanOptions& options, int size, Monitor& monitor)
{
  PlanScene::Check(scene.Obstacles.Build(scene.Meshes));
  const auto serve = [](ReadingStream& inputs, SharedItems& items)
  { return ServePlans(inputs, items, 2, ThreadedFor(2)); };
  PlanOutput output;
  Result outcome = Result::Ok();
  EXPECT_TRUE(RunRanks(size,
                       [&](Communicator& ranks)
                       {
                         if (!ranks.IsFirst())
                         {
                           Serve(ranks, { { PlanKind, serve } });
                           return;
                         }
                         const PlanInput input{ SwirlDatabase(), scene.Objects, scene.Constraints,
                                                scene.Obstacles, scene.Scene,   scene.Guides,
                                                &ranks };
                         outcome = PlanMotion(input, options, ThreadedFor(2), monitor, output);
                         Release(ranks);
                       }));
  PlanScene::Check(outcome);
  return output;
}

} // namespace

TEST(Planner, GivesTheSameBytesForAnyNumberOfRanks)
{
  PlanScene scene;
  AddFeatherRows(scene);
  scene.AddBox(Vec3(-0.2, 0.4, 0.5), Vec3(0.2, 0.8, 2.8));
  for (int i = 0; i < 9; ++i)
  {
    scene.AddObject(Vec3(-1.0 + 0.2 * i, 1.0, 2.5));
  }
  scene.Guides.push_back({ 1, { Vec3(-1.0, 1.0, 2.5), Vec3(0.5, 0.0, 1.0) } });
  PlanOptions options;
  options.Seed = 3;
  const PlanOutput one = scene.Run(options);
  SilentMonitor silent;
  for (const int size : { 2, 3, 5 })
  {
    const PlanOutput other = RunOnRanks(scene, options, size, silent);
    EXPECT_EQ(DigestOf(one.Tracks), DigestOf(other.Tracks)) << size;
    EXPECT_EQ(DigestOf(one.Vortices), DigestOf(other.Vortices)) << size;
    ASSERT_EQ(one.Trees.size(), other.Trees.size());
    for (std::size_t k = 0; k < one.Trees.size(); ++k)
    {
      EXPECT_EQ(one.Trees[k].Points, other.Trees[k].Points);
      EXPECT_EQ(one.Trees[k].Cost, other.Trees[k].Cost);
    }
  }
}

TEST(Planner, ObjectsDoNotDependOnEachOther)
{
  PlanScene alone;
  AddFeatherRows(alone);
  PlanScene together;
  AddFeatherRows(together);
  together.AddObject(Vec3(1, 1, 3));
  EXPECT_EQ(alone.Run(1).Tracks[0].Positions, together.Run(1).Tracks[0].Positions);
}

TEST(Planner, FliesFreeWithoutRowsAndAfterTheLastOne)
{
  PlanScene scene;
  scene.AddBox(Vec3(-0.5, -0.5, 0.0), Vec3(0.5, 0.5, 2.0));
  for (int i = 0; i < 6; ++i)
  {
    scene.AddObject(Vec3(-1.2 + 0.4 * i, -1.0, 2.5));
  }
  scene.AddRow(ConstraintKind::Position, 2, 60, Vec3(0.5, -0.9, 2.6));
  scene.Objects[1].Velocity = Vec3(0.3, 0.4, -0.1);
  const PlanOutput output = scene.Run(1);
  StyleSamples style;
  for (const Track& track : output.Tracks)
  {
    EXPECT_EQ(track.Positions[0], scene.Objects[track.ObjectId].Position);
    EXPECT_GE(LeastSlack(scene, track, 0, 299), -0.004);
    EXPECT_LE(FastestStep(track), 1.5 * test::SwirlDatabase().TopSpeed);
    AppendStyle(track.Positions, 1.0 / 30.0, style);
  }
  EXPECT_EQ(output.Tracks[2].Positions[60], Vec3(0.5, -0.9, 2.6));
  const Vec3 velocity = CentralDifferences(output.Tracks[1].Positions, 1.0 / 30.0)[0];
  EXPECT_LT((velocity - Vec3(0.3, 0.4, -0.1)).norm(), 1e-9);
  const StyleSamples reference = StyleOf(test::SwirlDatabase());
  EXPECT_LE(KolmogorovSmirnov(reference.LogCurvature, style.LogCurvature), 0.20);
  EXPECT_LE(KolmogorovSmirnov(reference.Acceleration, style.Acceleration), 0.35);
}

TEST(Planner, LandsSoftlyLiesStillAndLiftsOff)
{
  PlanScene scene;
  scene.AddBox(Vec3(0.5, 0.5, 0.0), Vec3(1.5, 1.5, 0.8));
  scene.AddObject(Vec3(-1.0, -0.5, 3.0));
  scene.AddObject(Vec3(0.5, 0.0, 3.0));
  scene.AddRow(ConstraintKind::Rest, 0, 150, Vec3(0.3, -0.4, 1.0)).Until = 200;
  scene.AddRow(ConstraintKind::Rest, 1, 180, Vec3(1.0, 1.0, 2.0)).Until = 299;
  const PlanOutput output = scene.Run(2);
  for (const ReportRow& line : output.Report)
  {
    EXPECT_EQ(line.Status, ConstraintStatus::Met) << line.Message;
  }
  const Vec3 places[2] = { Vec3(0.3, -0.4, 0.002), Vec3(1.0, 1.0, 0.802) };
  const int rests[2] = { 150, 180 };
  const int untils[2] = { 200, 299 };
  for (int i = 0; i < 2; ++i)
  {
    const std::vector<Vec3>& p = output.Tracks[i].Positions;
    for (int k = rests[i]; k <= untils[i]; ++k)
    {
      EXPECT_EQ(p[k], p[rests[i]]);
    }
    EXPECT_LT((p[rests[i]] - places[i]).norm(), 1e-12);
    for (int k = rests[i] - 30; k < rests[i]; ++k)
    {
      EXPECT_GE(p[k].z(), places[i].z() - 0.001);
    }
    // Soft: the last steps fade out.
    EXPECT_LT((p[rests[i]] - p[rests[i] - 1]).norm(), 0.05 / 30.0);
    EXPECT_GE(LeastSlack(scene, output.Tracks[i], 0, rests[i] - 30), -0.004);
  }
  EXPECT_LT((output.Tracks[0].Positions[201] - output.Tracks[0].Positions[200]).norm(),
            0.05 / 30.0);
  EXPECT_GE(LeastSlack(scene, output.Tracks[0], 230, 299), -0.004);
  EXPECT_GT((output.Tracks[0].Positions[260] - places[0]).norm(), 0.1);
}

TEST(Planner, MeetsVelocitiesAccelerationsAndAGivenPath)
{
  PlanScene scene;
  scene.AddObject(Vec3(-1.0, 0.0, 2.5));
  scene.AddRow(ConstraintKind::Velocity, 0, 40, Vec3(0.3, -0.2, 0.1));
  scene.AddRow(ConstraintKind::Position, 0, 100, Vec3(0.0, 0.5, 2.0));
  scene.AddRow(ConstraintKind::Velocity, 0, 100, Vec3(0.5, 0.0, 0.0)).Radius = 0.01;
  scene.AddRow(ConstraintKind::Acceleration, 0, 130, Vec3(0.0, 0.4, -0.3));
  for (int k = 180; k <= 220; ++k)
  {
    const double u = (k - 180) / 40.0;
    scene.AddRow(ConstraintKind::Position, 0, k,
                 Vec3(1.0 - 0.5 * u, std::sin(2.0 * u), 2.0 + 0.3 * u * u));
  }
  const PlanOutput output = scene.Run(5);
  const std::vector<Vec3>& p = output.Tracks[0].Positions;
  const std::vector<Vec3> velocities = CentralDifferences(p, 1.0 / 30.0);
  const std::vector<Vec3> accelerations = CentralDifferences(velocities, 1.0 / 30.0);
  EXPECT_LT((velocities[40] - Vec3(0.3, -0.2, 0.1)).norm(), 1e-9);
  EXPECT_LE((velocities[100] - Vec3(0.5, 0.0, 0.0)).norm(), 0.01);
  EXPECT_LT((accelerations[130] - Vec3(0.0, 0.4, -0.3)).norm(), 1e-8);
  for (const Constraint& row : scene.Constraints)
  {
    if (row.Kind == ConstraintKind::Position)
    {
      EXPECT_EQ(p[row.Frame], row.Value);
    }
  }
  for (const ReportRow& line : output.Report)
  {
    EXPECT_EQ(line.Status, ConstraintStatus::Met) << line.Row << ' ' << line.Message;
  }
  for (int k : { 180, 220 })
  {
    const Vec3 left = 1.5 * p[k] - 2.0 * p[k - 1] + 0.5 * p[k - 2];
    const Vec3 right = -1.5 * p[k] + 2.0 * p[k + 1] - 0.5 * p[k + 2];
    EXPECT_LE((left - right).norm(), 0.05 * (p[k + 1] - p[k]).norm()) << k;
  }
}

TEST(Planner, WorksAtOtherFrameRatesAndWithHardlyAnyFrames)
{
  for (double rate : { 24.0, 60.0 })
  {
    PlanScene scene;
    scene.Scene.Time.FramesPerSecond = rate;
    scene.AddObject(Vec3(-1.0, 0.0, 2.0));
    const int frame = static_cast<int>(5.0 * rate);
    scene.AddRow(ConstraintKind::Position, 0, std::min(frame, 250), Vec3(0.8, 0.4, 2.2));
    const PlanOutput output = scene.Run(1);
    EXPECT_EQ(output.Report[0].Status, ConstraintStatus::Met) << rate;
    EXPECT_LE(FastestStep(output.Tracks[0]) / 30.0 * rate, 1.5 * test::SwirlDatabase().TopSpeed);
  }
  for (int frames : { 1, 2, 3, 9 })
  {
    PlanScene scene;
    scene.Scene.Time.NumberOfFrames = frames;
    scene.AddObject(Vec3(-1.0, 0.0, 2.0));
    scene.Objects[0].Velocity = Vec3(0.2, 0.0, 0.0);
    scene.AddRow(ConstraintKind::Velocity, 0, 0, Vec3(0.3, 0.0, 0.0));
    scene.AddRow(ConstraintKind::Acceleration, 0, frames - 1, Vec3(0.0, 0.1, 0.0));
    const PlanOutput output = scene.Run(1);
    ASSERT_EQ(output.Tracks[0].Positions.size(), static_cast<std::size_t>(frames));
    for (const Vec3& x : output.Tracks[0].Positions)
    {
      EXPECT_TRUE(x.allFinite());
    }
  }
}

TEST(Planner, CarriesAnnotationAndVorticesWithTheSegments)
{
  PlanScene scene;
  AddFeatherRows(scene);
  const PlanOutput output = scene.Run(1);
  const Track& track = output.Tracks[0];
  ASSERT_EQ(track.VortexIds.size(), 300u);
  ASSERT_FALSE(output.Vortices.empty());
  int driven = 0;
  for (std::size_t k = 0; k < 300; ++k)
  {
    if (track.VortexIds[k] < 0)
    {
      continue;
    }
    ++driven;
    ASSERT_LT(track.VortexIds[k], static_cast<int>(output.Vortices.size()));
    const Vortex& vortex = output.Vortices[track.VortexIds[k]];
    EXPECT_EQ(vortex.VortexId, track.VortexIds[k]);
    EXPECT_LT(
      (vortex.Acceleration(track.Positions[k], k / 30.0) - track.VortexAccelerations[k]).norm(),
      1e-12);
    EXPECT_NEAR((vortex.P2 - vortex.P1).norm(), 2.0, 1e-9);
  }
  EXPECT_GT(driven, 20);
}

TEST(Planner, ShowsItsTrees)
{
  PlanScene scene;
  AddFeatherRows(scene);
  const PlanOutput output = scene.Run(1);
  int trees[2] = { 0, 0 };
  for (std::size_t i = 0; i < output.Trees.size(); ++i)
  {
    const TreeBranch& branch = output.Trees[i];
    ++trees[branch.Tree];
    EXPECT_GE(branch.Points.size(), 2u);
    if (branch.Parent >= 0)
    {
      EXPECT_LT(branch.Parent, static_cast<int>(i));
      EXPECT_EQ(output.Trees[branch.Parent].Span, branch.Span);
    }
  }
  EXPECT_GT(trees[0], 5);
  EXPECT_GT(trees[1], 5);
}
