// SPDX-License-Identifier: BSD-3-Clause
// Takes to choose from, and guides that a path follows loosely.
#include "Planning/Takes.h"

#include "PlanScenes.h"
#include "Trajectory/Style.h"

#include <gtest/gtest.h>

using namespace waft;
using namespace waft::test;

namespace
{

struct TakesRun
{
  Result Outcome;
  PlanOutput Output;
  std::vector<TakeScore> Scores;
};

TakesRun PlanAll(PlanScene& scene, const TakeOptions& takes, std::uint64_t seed = 3)
{
  PlanScene::Check(scene.Obstacles.Build(scene.Meshes));
  const PlanInput input{ SwirlDatabase(), scene.Objects, scene.Constraints, scene.Obstacles,
                         scene.Scene };
  PlanOptions options;
  options.Seed = seed;
  SilentMonitor monitor;
  TakesRun run;
  run.Outcome = PlanTakes(input, options, takes, SerialFor(), monitor, run.Output, run.Scores);
  return run;
}

PlanScene OneFlight()
{
  PlanScene scene;
  scene.AddObject(Vec3(-1.4, 0.0, 2.0));
  scene.AddRow(ConstraintKind::Position, 0, 299, Vec3(1.4, 0.0, 2.0));
  return scene;
}

/// A bow over the straight way, 1.2 m high.
Guide Bow()
{
  Guide guide;
  for (int k = 0; k <= 24; ++k)
  {
    const double u = k / 24.0;
    guide.Points.emplace_back(-1.4 + 2.8 * u, 1.2 * std::sin(M_PI * u), 2.0);
  }
  return guide;
}

/// Root mean square distance of the positions from where the guide has them.
double DistanceFrom(const Guide& guide, const std::vector<Vec3>& p)
{
  double sum = 0.0;
  for (const Vec3& x : p)
  {
    double least = 1e300;
    for (std::size_t k = 1; k < guide.Points.size(); ++k)
    {
      const Vec3 side = guide.Points[k] - guide.Points[k - 1];
      const double u =
        std::clamp((x - guide.Points[k - 1]).dot(side) / side.squaredNorm(), 0.0, 1.0);
      least = std::min(least, (guide.Points[k - 1] + u * side - x).squaredNorm());
    }
    sum += least;
  }
  return std::sqrt(sum / static_cast<double>(p.size()));
}

} // namespace

TEST(Takes, AreThePlansOfConsecutiveSeedsAndTheBestCanBeChosen)
{
  PlanScene scene = OneFlight();
  TakeOptions takes;
  takes.NumberOfTakes = 4;
  std::vector<std::vector<Vec3>> paths;
  std::vector<TakeScore> scores;
  for (int take = 0; take < 4; ++take)
  {
    takes.Take = take;
    const TakesRun run = PlanAll(scene, takes);
    ASSERT_TRUE(bool(run.Outcome)) << run.Outcome.Message();
    ASSERT_EQ(run.Scores.size(), 4u);
    EXPECT_EQ(run.Scores[take].Seed, 3u + take);
    paths.push_back(run.Output.Tracks[0].Positions);
    EXPECT_EQ(paths.back(), scene.Run(3 + take).Tracks[0].Positions);
    scores = run.Scores;
  }
  int best = 0;
  const StyleSamples reference = StyleOf(SwirlDatabase());
  for (int take = 0; take < 4; ++take)
  {
    EXPECT_EQ(scores[take].NumberOfMet, 1);
    StyleSamples style;
    AppendStyle(paths[take], 1.0 / 30.0, style);
    const double curvature = KolmogorovSmirnov(reference.LogCurvature, style.LogCurvature);
    const double acceleration = KolmogorovSmirnov(reference.Acceleration, style.Acceleration);
    EXPECT_DOUBLE_EQ(scores[take].Score, curvature + acceleration);
    best = scores[take].Score < scores[best].Score ? take : best;
    EXPECT_TRUE(take == 0 || paths[take] != paths[0]);
  }
  takes.Take = -1;
  EXPECT_EQ(PlanAll(scene, takes).Output.Tracks[0].Positions, paths[best]);
}

TEST(Takes, RefuseAChoiceThatIsNotThere)
{
  PlanScene scene = OneFlight();
  TakeOptions takes;
  takes.NumberOfTakes = 2;
  takes.Take = 2;
  EXPECT_NE(PlanAll(scene, takes).Outcome.Message().find("Take is 2"), std::string::npos);
  takes.NumberOfTakes = 0;
  EXPECT_NE(PlanAll(scene, takes).Outcome.Message().find("NumberOfTakes"), std::string::npos);
}

TEST(Takes, StoppedHalfWayGiveTheBestThatIsWhole)
{
  PlanScene scene = OneFlight();
  PlanScene::Check(scene.Obstacles.Build(scene.Meshes));
  struct StopsInThirdTake : Monitor
  {
    bool Tick(double fraction, const std::string&) override { return fraction < 0.5; }
  } monitor;
  const PlanInput input{ SwirlDatabase(), scene.Objects, scene.Constraints, scene.Obstacles,
                         scene.Scene };
  TakeOptions takes;
  takes.NumberOfTakes = 4;
  takes.Take = 3;
  PlanOutput output;
  std::vector<TakeScore> scores;
  const Result result =
    PlanTakes(input, PlanOptions(), takes, SerialFor(), monitor, output, scores);
  EXPECT_TRUE(result.IsStopped());
  ASSERT_EQ(scores.size(), 2u);
  const int best = scores[1].Score < scores[0].Score ? 1 : 0;
  EXPECT_EQ(output.Tracks[0].Positions, scene.Run(PlanOptions().Seed + best).Tracks[0].Positions);
}

TEST(Guides, AreFollowedTheMoreTheyWeighAndLeaveTheStyle)
{
  PlanScene scene = OneFlight();
  scene.Guides = { Bow() };
  const StyleSamples reference = StyleOf(SwirlDatabase());
  double distance[3] = { 0.0, 0.0, 0.0 };
  const double weights[3] = { 0.0, 0.5, 1.0 };
  for (int i = 0; i < 3; ++i)
  {
    StyleSamples style;
    for (std::uint64_t seed = 1; seed <= 10; ++seed)
    {
      PlanOptions options;
      options.Seed = seed;
      options.GuideWeight = weights[i];
      const PlanOutput output = scene.Run(options);
      EXPECT_EQ(output.Report[0].Status, ConstraintStatus::Met);
      EXPECT_EQ(output.Tracks[0].Positions.back(), Vec3(1.4, 0.0, 2.0));
      EXPECT_LE(FastestStep(output.Tracks[0]), 1.5 * SwirlDatabase().TopSpeed);
      distance[i] += 0.1 * DistanceFrom(scene.Guides[0], output.Tracks[0].Positions);
      AppendStyle(output.Tracks[0].Positions, 1.0 / 30.0, style);
    }
    EXPECT_LE(KolmogorovSmirnov(reference.LogCurvature, style.LogCurvature), 0.20) << weights[i];
    EXPECT_LE(KolmogorovSmirnov(reference.Acceleration, style.Acceleration), 0.35) << weights[i];
  }
  EXPECT_LT(distance[1], 0.6 * distance[0]);
  EXPECT_LT(distance[2], distance[1]);
  EXPECT_LT(distance[2], 0.25);
}

TEST(Guides, LeadAnObjectWithoutRowsToTheirEnd)
{
  PlanScene scene;
  scene.AddObject(Vec3(-1.4, 0.0, 2.0));
  scene.AddObject(Vec3(-1.0, 1.0, 2.0));
  const std::vector<Vec3> alone = scene.Run(1).Tracks[1].Positions;
  scene.Guides = { Bow() };
  const PlanOutput output = scene.Run(1);
  EXPECT_LE((output.Tracks[0].Positions.back() - scene.Guides[0].Points.back()).norm(), 0.0801);
  EXPECT_LT(DistanceFrom(scene.Guides[0], output.Tracks[0].Positions), 0.5);
  EXPECT_EQ(output.Tracks[1].Positions, alone);
  EXPECT_TRUE(output.Report.empty());
}

TEST(Guides, ThroughAWallAreNotFollowedIntoIt)
{
  PlanScene scene = OneFlight();
  scene.Guides = { Bow() };
  scene.AddBox(Vec3(-0.1, 0.3, 0.0), Vec3(0.1, 2.0, 4.0));
  const PlanOutput output = scene.Run(2);
  EXPECT_EQ(output.Report[0].Status, ConstraintStatus::Met);
  EXPECT_GE(LeastSlack(scene, output.Tracks[0], 0, 299), -0.004);
}

TEST(Guides, AreRefusedByName)
{
  PlanScene scene = OneFlight();
  const auto message = [&](const std::vector<Guide>& guides)
  {
    scene.Guides = guides;
    try
    {
      scene.Run(1);
    }
    catch (const std::runtime_error& error)
    {
      return std::string(error.what());
    }
    return std::string();
  };
  Guide other = Bow();
  other.ObjectId = 5;
  EXPECT_NE(message({ other }).find("object 5: there is no such"), std::string::npos);
  EXPECT_NE(message({ Bow(), Bow() }).find("object 0: there is another"), std::string::npos);
  Guide point;
  point.Points = { Vec3::Zero() };
  EXPECT_NE(message({ point }).find("at least 2 points"), std::string::npos);
}
