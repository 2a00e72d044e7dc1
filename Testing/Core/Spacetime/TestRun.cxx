// SPDX-License-Identifier: BSD-3-Clause
// The whole optimisation on small scenes.
#include "Spacetime/Run/Spacetime.h"
#include "SpacetimeRuns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>

using namespace waft;

namespace
{

void ExpectMonotone(const SpacetimeOutput& output)
{
  double seconds = 0.0;
  for (std::size_t k = 0; k < output.Convergence.size(); ++k)
  {
    const ConvergenceRow& row = output.Convergence[k];
    EXPECT_TRUE(std::isfinite(row.E));
    EXPECT_GE(row.Seconds, seconds);
    seconds = row.Seconds;
    if (k > 0 && output.Convergence[k - 1].Stage == row.Stage)
    {
      EXPECT_LE(row.E, output.Convergence[k - 1].E) << row.Stage << " " << row.Iteration;
    }
  }
  EXPECT_EQ(output.Convergence.front().Stage, "initial");
  EXPECT_EQ(output.Convergence.back().Stage, "final");
}

void ExpectAllMet(const SpacetimeOutput& output)
{
  for (const ReportRow& row : output.Report)
  {
    EXPECT_EQ(row.Status, ConstraintStatus::Met) << row.Row << ": " << row.Message;
  }
}

Constraint Row(int object, int frame, ConstraintKind kind, const Vec3& value, double radius,
               int row)
{
  Constraint c;
  c.ObjectId = object;
  c.Frame = frame;
  c.Kind = kind;
  c.Value = value;
  c.Radius = radius;
  c.Row = row;
  return c;
}

/// <|v_i - v_j|^2> of pairs nearer than r over twice the variance of v.
double Incoherence(const std::vector<Track>& tracks, double r, double step)
{
  double pairs = 0.0, square = 0.0;
  Vec3 mean = Vec3::Zero();
  long pairCount = 0, count = 0;
  std::vector<std::vector<Vec3>> v;
  for (const Track& track : tracks)
  {
    v.push_back(CentralDifferences(track.Positions, step));
  }
  for (std::size_t k = 0; k < tracks[0].Positions.size(); ++k)
  {
    for (std::size_t i = 0; i < tracks.size(); ++i)
    {
      mean += v[i][k];
      square += v[i][k].squaredNorm();
      ++count;
      for (std::size_t j = 0; j < i; ++j)
      {
        if ((tracks[i].Positions[k] - tracks[j].Positions[k]).norm() < r)
        {
          pairs += (v[i][k] - v[j][k]).squaredNorm();
          ++pairCount;
        }
      }
    }
  }
  mean /= double(count);
  return pairs / double(pairCount) / (2.0 * (square / double(count) - mean.squaredNorm()));
}

} // namespace

namespace
{

void ExpectCoherent(int objects, int frames, int iterations)
{
  SceneOptions scene;
  scene.NumberOfObjects = objects;
  scene.NumberOfFrames = frames;
  const SpacetimeInput input = MakeScene(scene);
  SpacetimeOptions options = QuickOptions();
  options.MaximumNumberOfIterations = iterations;
  const SpacetimeOutput output = RunScene(input, options);
  ExpectMonotone(output);
  ExpectAllMet(output);
  EXPECT_LT(output.Convergence.back().E, 0.1 * output.Convergence.front().E);
  for (std::size_t o = 0; o < input.Tracks.size(); ++o)
  {
    EXPECT_LT(output.PositionResiduals[o], 4e-3);
    EXPECT_LT(output.VelocityResiduals[o], 4e-3);
    const std::vector<Vec3>& x = output.Tracks[o].Positions;
    EXPECT_EQ(std::memcmp(x.front().data(), input.Objects[o].Position.data(), sizeof(Vec3)), 0);
    EXPECT_EQ(std::memcmp(x.back().data(), input.Constraints[o].Value.data(), sizeof(Vec3)), 0);
    for (const Vec3& p : x)
    {
      EXPECT_GE(input.Scene.Bounds.InnerDistance(p), input.Objects[o].ClearanceRadius - 4e-3);
    }
  }
  const double step = input.Scene.Time.Step();
  const double planned = Incoherence(input.Tracks, 0.8, step);
  const double found = Incoherence(output.Tracks, 0.8, step);
  EXPECT_LT(found, 0.7 * planned);
}

} // namespace

// Air takes a few seconds to be set in motion.
TEST(RunSpacetime, MakesPlannedPathsCoherentAndKeepsExactRowsToTheBit)
{
  ExpectCoherent(10, 100, 150);
}

TEST(RunSpacetimeByNight, MakesPlannedPathsCoherentAndKeepsExactRowsToTheBit)
{
  ExpectCoherent(20, 150, 400); // to the end of it
}

TEST(RunSpacetime, MeetsBallsVelocitiesAndAccelerations)
{
  SceneOptions scene;
  scene.NumberOfFrames = 60;
  SpacetimeInput input = MakeScene(scene);
  const int a = input.Objects[0].ObjectId;
  const int b = input.Objects[1].ObjectId;
  const Vec3 near = input.Tracks[0].Positions[20] + Vec3(0.1, 0.05, 0.0);
  input.Constraints.push_back(Row(a, 20, ConstraintKind::Position, near, 0.03, 10));
  input.Constraints.push_back(Row(a, 40, ConstraintKind::Velocity, Vec3(0.4, -0.2, 0.1), 0.0, 11));
  input.Constraints.push_back(Row(a, 59, ConstraintKind::Velocity, Vec3(0.0, 0.3, -0.2), 0.0, 12));
  input.Constraints.push_back(
    Row(b, 25, ConstraintKind::Acceleration, Vec3(0.0, 1.0, 0.5), 0.0, 13));
  input.Constraints.push_back(Row(b, 26, ConstraintKind::Velocity, Vec3(0.1, 0.2, 0.3), 0.05, 14));
  input.Constraints.push_back(Row(b, 45, ConstraintKind::Position,
                                  input.Tracks[1].Positions[45] + Vec3(0.05, 0, 0), 0.0, 15));
  input.Constraints.push_back(Row(b, 46, ConstraintKind::Velocity, Vec3(0.2, 0.0, -0.3), 0.0, 16));
  const SpacetimeOutput output = RunScene(input, QuickOptions());
  ExpectMonotone(output);
  ExpectAllMet(output);
  const double step = input.Scene.Time.Step();
  const auto x = [&](int o, int k) { return output.Tracks[o].Positions[k]; };
  const auto velocity = [&](int o, int k)
  { return CentralDifferences(output.Tracks[o].Positions, step)[k]; };
  EXPECT_LE((x(0, 20) - near).norm(), 0.03 + 4e-9);
  EXPECT_LT((velocity(0, 40) - Vec3(0.4, -0.2, 0.1)).norm(), 1e-9);
  EXPECT_LT((velocity(0, 59) - Vec3(0.0, 0.3, -0.2)).norm(), 1e-9);
  EXPECT_LE((velocity(1, 26) - Vec3(0.1, 0.2, 0.3)).norm(), 0.05 + 1e-9);
  const Vec3 acceleration = (velocity(1, 26) - velocity(1, 24)) / (2.0 * step);
  EXPECT_LT((acceleration - Vec3(0.0, 1.0, 0.5)).norm(), 1e-7);
  EXPECT_LT((velocity(1, 46) - Vec3(0.2, 0.0, -0.3)).norm(), 1e-9);
  EXPECT_EQ(x(1, 45), input.Constraints[8].Value);
}

TEST(RunSpacetime, ComesAsNearAsThePlanToWhatCannotBeMet)
{
  SceneOptions scene;
  scene.NumberOfFrames = 60;
  SpacetimeInput input = MakeScene(scene);
  const int a = input.Objects[0].ObjectId;
  const Vec3 planned = input.Tracks[0].Positions[20];
  // A detour that the optimiser would leave out.
  for (int k = 10; k <= 30; ++k)
  {
    const double s = std::sin(0.05 * 3.14159265358979 * (k - 10));
    input.Tracks[0].Positions[k] += 0.3 * s * s * Vec3::UnitZ();
  }
  const Vec3 far = planned + Vec3(0.0, 0.0, 0.7);
  input.Constraints.push_back(Row(a, 20, ConstraintKind::Position, far, 0.05, 10));
  input.Constraints.back().Status = ConstraintStatus::Unreachable;
  const SpacetimeOutput output = RunScene(input, QuickOptions());
  const double flown = (output.Tracks[0].Positions[20] - far).norm();
  EXPECT_LE(flown, (input.Tracks[0].Positions[20] - far).norm() + 1e-9);
  const ReportRow& line = output.Report.back();
  EXPECT_EQ(line.Status, ConstraintStatus::Unreachable);
  EXPECT_NEAR(line.Residual, flown - 0.05, 1e-12);
  char text[64];
  std::snprintf(text, sizeof text, "; it comes within %.3g m", line.Residual);
  EXPECT_NE(line.Message.find(text), std::string::npos) << line.Message;
}

TEST(RunSpacetime, LandsAtTheRestingPlaceAndKeepsClearOfAPillar)
{
  SceneOptions scene;
  scene.NumberOfFrames = 80;
  scene.Land = true;
  scene.NumberOfObjects = 6;
  SpacetimeInput input = MakeScene(scene);
  AddPillar(input, Vec3(1.35, -0.6, -0.1), Vec3(1.8, 0.6, 2.2));
  const SpacetimeOutput output = RunScene(input, QuickOptions());
  ExpectMonotone(output);
  ExpectAllMet(output);
  EXPECT_TRUE(output.Warnings.empty());
  ObstacleSet obstacles;
  ASSERT_TRUE(obstacles.Build(input.Obstacles));
  for (std::size_t o = 0; o < input.Tracks.size(); ++o)
  {
    MotionObject object = input.Objects[o];
    object.ClearanceRadius -= 1e-3 * input.Scene.Bounds.Width();
    const auto windows = LandingWindows(object, input.Constraints, obstacles, 30.0);
    ASSERT_EQ(windows.size(), 1u);
    const std::vector<Vec3>& x = output.Tracks[o].Positions;
    for (int k = windows[0].Frame; k <= windows[0].Until; ++k)
    {
      EXPECT_EQ(x[k], windows[0].Centre.Place);
    }
    for (std::size_t k = 0; k + 1 < x.size(); ++k)
    {
      EXPECT_TRUE(IsMotionClear(obstacles, object, windows, x[k], double(k), x[k + 1], k + 1.0))
        << o << " at " << k;
    }
  }
}

TEST(RunSpacetime, GivesTheSameBitsOnAnyNumberOfThreads)
{
  SceneOptions scene;
  scene.NumberOfFrames = 40;
  const SpacetimeInput input = MakeScene(scene);
  SpacetimeOptions options = QuickOptions();
  options.MaximumNumberOfIterations = 15;
  const SpacetimeOutput one = RunScene(input, options, 1);
  const SpacetimeOutput two = RunScene(input, options, 2);
  ASSERT_EQ(one.Convergence.size(), two.Convergence.size());
  for (std::size_t k = 0; k < one.Convergence.size(); ++k)
  {
    EXPECT_EQ(one.Convergence[k].E, two.Convergence[k].E);
  }
  for (std::size_t o = 0; o < one.Tracks.size(); ++o)
  {
    EXPECT_EQ(one.Tracks[o].Positions, two.Tracks[o].Positions);
    EXPECT_EQ(one.Tracks[o].AirVelocities, two.Tracks[o].AirVelocities);
  }
  EXPECT_EQ(one.Wind.Values, two.Wind.Values);
  EXPECT_EQ(one.Particles.Frames[20].Positions, two.Particles.Frames[20].Positions);
}

TEST(RunSpacetime, FillsItsOutputs)
{
  SceneOptions scene;
  scene.NumberOfObjects = 1;
  scene.NumberOfFrames = 50;
  SpacetimeInput input = MakeScene(scene);
  input.Scene.Bounds.Max = Vec3(2.0, 2.0, 3.3); // not a cube
  SpacetimeOptions options = QuickOptions();
  options.MaximumNumberOfIterations = 20;
  const SpacetimeOutput output = RunScene(input, options);
  const Track& track = output.Tracks[0];
  ASSERT_EQ(track.Forces.size(), 50u);
  ASSERT_EQ(track.AirVelocities.size(), 50u);
  ASSERT_EQ(track.SphVelocities.size(), 50u);
  double vortex = 0.0, wind = 0.0;
  for (std::size_t k = 0; k < 50; ++k)
  {
    EXPECT_LT((track.Forces[k] - track.VortexAccelerations[k] - track.WindAccelerations[k]).norm(),
              1e-12);
    Vec3 expected = Vec3::Zero();
    for (const Vortex& v : output.Vortices)
    {
      expected += v.Acceleration(track.Positions[k], input.Scene.Time.Time(double(k)));
    }
    EXPECT_LT((expected - track.VortexAccelerations[k]).norm(), 1e-4);
    vortex += track.VortexAccelerations[k].squaredNorm();
    wind += track.WindAccelerations[k].squaredNorm();
  }
  EXPECT_GT(wind, 0.0);
  EXPECT_LE(std::sqrt(wind), 2.0 * std::sqrt(vortex));
  EXPECT_EQ(output.Wind.Dimensions, WindLatticeDimensions(input.Scene.Bounds, options));
  ASSERT_TRUE(output.Wind.Validate("wind"));
  ASSERT_EQ(output.Particles.Frames.size(), 50u);
  for (const auto& frame : output.Particles.Frames)
  {
    ASSERT_EQ(frame.Positions.size(), 3 * output.Particles.ObjectIds.size());
    for (std::size_t i = 0; i < output.Particles.ObjectIds.size(); ++i)
    {
      const Vec3 x(frame.Positions[3 * i], frame.Positions[3 * i + 1], frame.Positions[3 * i + 2]);
      EXPECT_GE(input.Scene.Bounds.InnerDistance(x), -1e-5);
    }
  }
}

TEST(RunSpacetime, BeginsWithGasAtRestWhereThatIsAskedFor)
{
  SceneOptions scene;
  scene.NumberOfFrames = 30;
  SpacetimeOptions options = QuickOptions();
  options.NumberOfGasParticles = 125;
  const SpacetimeOutput moving = RunScene(MakeScene(scene), options);
  options.MoveGas = false;
  const SpacetimeOutput still = RunScene(MakeScene(scene), options);
  EXPECT_EQ(moving.Convergence[1].Stage, "gas moved");
  EXPECT_EQ(still.Convergence[0].E, moving.Convergence[0].E);
  for (const ConvergenceRow& row : still.Convergence)
  {
    EXPECT_NE(row.Stage, "gas moved");
  }
  EXPECT_LT(still.Convergence.back().E, still.Convergence.front().E);
  EXPECT_NE(still.Tracks[0].Positions, moving.Tracks[0].Positions);
}

TEST(RunSpacetime, KeepsTheBestSoFarWhenStopped)
{
  SceneOptions scene;
  scene.NumberOfFrames = 40;
  const SpacetimeInput input = MakeScene(scene);
  double before = std::numeric_limits<double>::infinity();
  // In the leash, at its end, on each level.
  for (const double fraction : { 0.02, 0.06, 0.1, 0.15, 0.25, 0.4, 0.8 })
  {
    StopAt monitor(fraction);
    SpacetimeOutput output;
    const Result result = RunSpacetime(input, QuickOptions(), SerialFor(), monitor, output);
    ASSERT_TRUE(result) << result.Message();
    EXPECT_TRUE(result.IsStopped());
    ASSERT_EQ(output.Tracks.size(), input.Tracks.size());
    ExpectAllMet(output);
    ASSERT_EQ(output.Convergence[1].Stage, "gas moved");
    const double began = output.Convergence[1].E;
    EXPECT_LT(began, output.Convergence[0].E);
    // Later is better. A few iterations under a tight leash may not make up for what it costs to
    // carry them to all frames.
    const double energy = output.Convergence.back().E;
    EXPECT_LE(energy, fraction < 0.12 ? began : 0.9 * began) << fraction;
    EXPECT_LE(energy, before) << fraction;
    before = energy;
  }
}

TEST(RunSpacetime, NamesBadInputAndLeavesTheOutputEmpty)
{
  SceneOptions scene;
  scene.NumberOfFrames = 20;
  const SpacetimeInput good = MakeScene(scene);
  const auto message = [](const SpacetimeInput& input, const SpacetimeOptions& options)
  {
    SilentMonitor monitor;
    SpacetimeOutput output;
    const Result result = RunSpacetime(input, options, SerialFor(), monitor, output);
    EXPECT_FALSE(result);
    EXPECT_TRUE(output.Tracks.empty());
    EXPECT_TRUE(output.Convergence.empty());
    return result.Message();
  };
  SpacetimeInput bad = good;
  bad.Tracks[1].Positions[7].y() = std::nan("");
  EXPECT_NE(message(bad, {}).find("object 11: not a finite position at frame 7"),
            std::string::npos);
  bad = good;
  bad.Tracks[2].Positions.pop_back();
  EXPECT_NE(message(bad, {}).find("object 12: 19 points"), std::string::npos);
  bad = good;
  bad.Tracks.clear();
  EXPECT_NE(message(bad, {}).find("Tracks"), std::string::npos);
  bad = good;
  bad.Constraints[0].ObjectId = 99;
  EXPECT_NE(message(bad, {}).find("object 99"), std::string::npos);
  bad = good;
  bad.Vortices[0].P2 = bad.Vortices[0].P1;
  EXPECT_NE(message(bad, {}).find("VortexId 0"), std::string::npos);
  bad = good;
  bad.Scene.Bounds.Max.z() = 0.05;
  EXPECT_NE(message(bad, {}).find("too flat"), std::string::npos);
  SpacetimeOptions options;
  options.CourantNumber = 5.0;
  EXPECT_NE(message(good, options).find("CourantNumber"), std::string::npos);
}

TEST(RunSpacetime, GivesTheBestSoFarAtItsTimeLimit)
{
  SpacetimeOptions options = QuickOptions();
  options.TimeLimit = 1e-6; // s: up at the first look
  const SpacetimeInput input = MakeScene(SceneOptions());
  const SpacetimeOutput output = RunScene(input, options);
  ASSERT_EQ(output.Warnings.size(), 1u);
  EXPECT_NE(output.Warnings[0].find("TimeLimit"), std::string::npos) << output.Warnings[0];
  EXPECT_LE(output.Convergence.back().E, 1.01 * output.Convergence.front().E);
  EXPECT_EQ(output.Tracks.size(), input.Tracks.size());
}
