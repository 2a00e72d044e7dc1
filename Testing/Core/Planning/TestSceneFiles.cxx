// SPDX-License-Identifier: BSD-3-Clause
// The scenes of a single object, each planned from 20 seeds: how like the air the paths are.
#include "Constraints/Warp.h"
#include "SceneFiles.h"
#include "Trajectory/Style.h"

#include <gtest/gtest.h>

#include <cstdio>

using namespace waft;
using namespace waft::test;

namespace
{

constexpr int Seeds = 20;
constexpr double RetimingLimit = 0.15;

struct Plans
{
  PlanScene Scene;
  std::vector<PlanOutput> Outputs; // one a seed
};

/// Made once a scene, for all tests.
const Plans& PlansOf(const std::string& name)
{
  static std::map<std::string, Plans> all;
  const auto [entry, isNew] = all.emplace(name, Plans());
  Plans& plans = entry->second;
  if (isNew)
  {
    plans.Scene = LoadPlanScene(name);
    for (std::uint64_t seed = 1; seed <= Seeds; ++seed)
    {
      plans.Outputs.push_back(plans.Scene.Run(seed));
    }
  }
  return plans;
}

/// The natural cubic spline through the start and the marks, one position a frame.
std::vector<Vec3> Spline(const PlanScene& scene)
{
  const auto count = static_cast<std::size_t>(scene.Scene.Time.NumberOfFrames);
  WarpProblem problem;
  problem.SecondDifferences.assign(count, Vec3::Zero());
  problem.IsFixed.assign(count, 0);
  problem.Fixed.assign(count, Vec3::Zero());
  problem.IsFixed[0] = 1;
  problem.Fixed[0] = scene.Objects[0].Position;
  for (const Constraint& row : scene.Constraints)
  {
    problem.IsFixed[row.Frame] = 1;
    problem.Fixed[row.Frame] = row.Value;
  }
  return SolveWarp(problem);
}

/// Between the velocities extrapolated from both sides [m per frame].
double VelocityJump(const std::vector<Vec3>& p, int k)
{
  const Vec3 left = 1.5 * p[k] - 2.0 * p[k - 1] + 0.5 * p[k - 2];
  const Vec3 right = -1.5 * p[k] + 2.0 * p[k + 1] - 0.5 * p[k + 2];
  return (right - left).norm();
}

/// By which the acceleration changes from frame k to the next [m per frame^2].
double AccelerationChange(const std::vector<Vec3>& p, int k)
{
  return (p[k + 2] - 3.0 * p[k + 1] + 3.0 * p[k] - p[k - 1]).norm();
}

} // namespace

class SceneFiles : public testing::TestWithParam<const char*>
{
};

TEST_P(SceneFiles, AreFlownInStyleAndTwiceAsCloseAsASpline)
{
  const std::string name = GetParam();
  const Plans& plans = PlansOf(name);
  const auto frames = static_cast<std::size_t>(FreeFrames(plans.Scene));
  const double step = plans.Scene.Scene.Time.Step();
  StyleSamples style;
  for (const PlanOutput& output : plans.Outputs)
  {
    for (const ReportRow& line : output.Report)
    {
      EXPECT_EQ(line.Status, ConstraintStatus::Met) << line.Message;
    }
    AppendStyle(output.Tracks[0].Positions, step, 0, frames, style);
  }
  StyleSamples spline;
  AppendStyle(Spline(plans.Scene), step, 0, frames, spline);
  const StyleSamples air = StyleOf(SwirlDatabase());
  const double curvature = KolmogorovSmirnov(air.LogCurvature, style.LogCurvature);
  const double acceleration = KolmogorovSmirnov(air.Acceleration, style.Acceleration);
  const double splineCurvature = KolmogorovSmirnov(air.LogCurvature, spline.LogCurvature);
  const double splineAcceleration = KolmogorovSmirnov(air.Acceleration, spline.Acceleration);
  std::printf("%s: distance of log-curvature %.2f (spline %.2f), of acceleration %.2f (%.2f)\n",
              GetParam(), curvature, splineCurvature, acceleration, splineAcceleration);
  EXPECT_LE(curvature, 0.20);
  EXPECT_LE(acceleration, 0.35);
  EXPECT_LE(curvature, 0.5 * splineCurvature);
  EXPECT_LE(acceleration, 0.5 * splineAcceleration);
  // No bends that air does not make: those of the database, flown as fast as retiming allows.
  EXPECT_LE(Quantile(style.Acceleration, 0.99), 1.3225 * Quantile(air.Acceleration, 0.99));
  EXPECT_LE(Quantile(style.Acceleration, 1.0), 1.3225 * Quantile(air.Acceleration, 1.0));
}

TEST_P(SceneFiles, HaveNoJumpsOfVelocityOrAccelerationAtAnySeam)
{
  const std::string name = GetParam();
  const Plans& plans = PlansOf(name);
  const int frames = FreeFrames(plans.Scene);
  double most = 0.0; // of the database, from frame to frame
  for (std::size_t i = 0; i < SwirlDatabase().Segments.size(); ++i)
  {
    const std::vector<Vec3> p = SwirlDatabase().Reconstruct(static_cast<int>(i));
    for (int k = 1; k + 2 < static_cast<int>(p.size()); ++k)
    {
      most = std::max(most, AccelerationChange(p, k));
    }
  }
  most *= std::pow(1.0 + RetimingLimit, 3);
  double jump = 0.0; // anywhere, so at every blend
  double jumpAtMarks = 0.0;
  double change = 0.0;
  double changeAtMarks = 0.0;
  for (const PlanOutput& output : plans.Outputs)
  {
    const std::vector<Vec3>& p = output.Tracks[0].Positions;
    double way = 0.0;
    for (int k = 1; k < frames; ++k)
    {
      way += (p[k] - p[k - 1]).norm();
    }
    const double mean = way / (frames - 1);
    for (int k = 2; k + 2 < frames; ++k)
    {
      jump = std::max(jump, VelocityJump(p, k) / mean);
      change = std::max(change, AccelerationChange(p, k) / most);
    }
    for (const Constraint& row : output.Constraints)
    {
      if (row.Frame + 3 < frames)
      {
        jumpAtMarks = std::max(jumpAtMarks, VelocityJump(p, row.Frame) / mean);
        for (int k : { row.Frame - 2, row.Frame - 1, row.Frame, row.Frame + 1 })
        {
          changeAtMarks = std::max(changeAtMarks, AccelerationChange(p, k) / most);
        }
      }
    }
  }
  std::printf(
    "%s: velocity jumps by %.1f %% of its mean (at marks %.1f %%), acceleration from frame "
    "to frame by %.2f (%.2f) of the most in the database\n",
    GetParam(), 100.0 * jump, 100.0 * jumpAtMarks, change, changeAtMarks);
  EXPECT_LE(jump, 0.02);
  EXPECT_LE(jumpAtMarks, 0.05);
  EXPECT_LE(change, 1.0);
  EXPECT_LE(changeAtMarks, 1.0);
}

INSTANTIATE_TEST_SUITE_P(All, SceneFiles,
                         testing::Values("feather-waypoints", "feather-spiral", "feather-maze"),
                         [](const auto& info)
                         {
                           const std::string name = info.param;
                           return name.substr(name.find('-') + 1);
                         });
