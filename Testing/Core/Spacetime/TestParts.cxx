// SPDX-License-Identifier: BSD-3-Clause
// Levels of time, distances of pairs, the way out of obstacles, the preconditioner, clusters of
// linear rows, the wind's least squares.
#include "Spacetime/Energy/ObjectTerms.h"
#include "Spacetime/Fields/VortexSelection.h"
#include "Spacetime/Model/LevelTransfer.h"
#include "Spacetime/Run/Schedule.h"
#include "Spacetime/Scene/SpacetimeExport.h"
#include "Spacetime/Scene/SpacetimeSetup.h"
#include "Spacetime/Solver/HardConstraints.h"
#include "Spacetime/Solver/TimelinePreconditioner.h"
#include "SpacetimeScenes.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

using namespace waft;

namespace
{

SpacetimeSetup MakeProblem(const SpacetimeInput& input)
{
  SpacetimeOptions options;
  options.NumberOfGasParticles = 125;
  options.NumberOfObjectParticles = 3;
  SpacetimeSetup setup;
  const Result result = MakeSetup(input, options, setup);
  EXPECT_TRUE(result) << result.Message();
  return setup;
}

/// What the optimiser found for the only object.
StateVector StateOf(const SpacetimeSetup& setup, const std::vector<Vec3>& found)
{
  const SpacetimeModel& model = setup.Model;
  StateVector state(found.size() * model.FrameSize(), 0.0f);
  for (std::size_t k = 0; k < found.size(); ++k)
  {
    const Vec3 local = setup.FromWorld(found[k]);
    for (int c = 0; c < 3; ++c)
    {
      state[k * model.FrameSize() + c * model.Stride() + model.NumberOfGas] =
        static_cast<float>(local[c]);
    }
  }
  return state;
}

} // namespace

TEST(TimeLevels, HoldEveryFrameOfARequirement)
{
  SceneOptions scene;
  scene.NumberOfFrames = 40;
  SpacetimeInput input = MakeScene(scene);
  Constraint row = input.Constraints[0];
  row.Row = 9;
  row.Frame = 13;
  row.Radius = 0.2;
  row.Value = input.Tracks[0].Positions[13];
  input.Constraints.push_back(row);
  row.Row = 10;
  row.Frame = 21;
  row.Radius = 0.0;
  row.Kind = ConstraintKind::Velocity;
  row.Value = Vec3(0.1, 0.0, 0.0);
  input.Constraints.push_back(row);
  const SpacetimeSetup setup = MakeProblem(input);
  const std::vector<int> frames = CoarseFrames(setup.Model, setup.Table, 2);
  for (const int frame : { 0, 13, 20, 22, 39 })
  {
    EXPECT_TRUE(std::binary_search(frames.begin(), frames.end(), frame)) << frame;
  }
  EXPECT_LT(frames.size(), 26u);
  for (std::size_t k = 1; k < frames.size(); ++k)
  {
    EXPECT_LE(frames[k] - frames[k - 1], 2);
    EXPECT_GE(frames[k] - frames[k - 1], 1);
  }
  // Uniform motion passes from level to level unchanged.
  StateVector full(40 * setup.Model.FrameSize());
  for (std::size_t k = 0; k < full.size(); ++k)
  {
    const std::size_t frame = k / setup.Model.FrameSize();
    const bool position = k % setup.Model.FrameSize() < 3 * setup.Model.Stride();
    full[k] = position ? 1.0f + 0.25f * static_cast<float>(frame) : 0.25f;
  }
  const TimeLevel level = TimeLevel::Make(frames, 1);
  StateVector back(full.size(), 0.0f);
  Prolong(setup.Model, level, Restrict(setup.Model, level, full), back);
  for (std::size_t k = 0; k < full.size(); ++k)
  {
    ASSERT_NEAR(back[k], full[k], 1e-5);
  }
}

TEST(Schedule, GoesFromTheCoarsestLevelToAllFrames)
{
  SceneOptions scene;
  scene.NumberOfFrames = 200;
  SpacetimeInput input = MakeScene(scene);
  const SpacetimeOptions options;
  const auto plan = [&]()
  { return PlanSchedule(MakeProblem(input), options, input.Scene.Bounds.Width()); };
  const Schedule schedule = plan();
  ASSERT_EQ(schedule.Coarsest(), 2);
  EXPECT_LE(schedule.CoarseFrames[1].size(), 60u);
  EXPECT_LE(schedule.CoarseFrames[0].size(), 110u);
  EXPECT_EQ(schedule.LevelOf(0, 200, 1).NumberOfFrames(), 200u);
  EXPECT_EQ(schedule.Stages.front().Coarseness, 2);
  EXPECT_GT(schedule.Stages.front().Leash, 0.0);
  EXPECT_EQ(schedule.Stages.back().Coarseness, 0);
  for (std::size_t k = 1; k < schedule.Stages.size(); ++k)
  {
    EXPECT_LE(schedule.Stages[k].Coarseness, schedule.Stages[k - 1].Coarseness);
  }
  // Marks at every second frame leave nothing to a level of every fourth.
  for (int frame = 2; frame < 198; frame += 2)
  {
    Constraint row = input.Constraints.front();
    row.Row = 100 + frame;
    row.Frame = frame;
    row.Radius = 0.0;
    row.Value = input.Tracks[0].Positions[frame];
    input.Constraints.push_back(row);
  }
  const Schedule bound = plan();
  EXPECT_EQ(bound.Coarsest(), 1);
  EXPECT_EQ(bound.Stages.front().Coarseness, 1);
}

TEST(PairDistance, IsNoMoreAtMarksThanTheyAreApart)
{
  SceneOptions scene;
  scene.NumberOfObjects = 2;
  scene.NumberOfFrames = 80;
  scene.Land = true;
  SpacetimeInput input = MakeScene(scene);
  for (std::size_t o = 0; o < 2; ++o)
  {
    input.Constraints[o].Value.head<2>() = Eigen::Vector2d(0.02 * o, 0.0);
    for (int k = input.Constraints[o].Frame; k < scene.NumberOfFrames; ++k)
    {
      input.Tracks[o].Positions[k].head<2>() = Eigen::Vector2d(0.02 * o, 0.0);
    }
  }
  const SpacetimeSetup setup = MakeProblem(input);
  const SpacetimeModel& model = setup.Model;
  const int rest = input.Constraints[0].Frame;
  EXPECT_NEAR(PairDistance(model, rest, 0, 1), 0.02 / setup.Spacing, 1e-9);
  EXPECT_NEAR(PairDistance(model, rest - 9, 0, 1), // by the square of 0.3 s
              0.02 / setup.Spacing + 0.09 * model.Weights.ContactDistance, 1e-9);
  EXPECT_EQ(PairDistance(model, rest / 2, 0, 1), model.Weights.ContactDistance);
  EXPECT_GT(model.Weights.ContactDistance, 2.0 * input.Objects[0].ClearanceRadius / setup.Spacing);
}

TEST(ExportPositions, MovesAMotionOutOfTheWayInsteadOfGoingBackToThePlan)
{
  // Found beside a box 3 cm nearer than the clearance allows, planned far from it.
  SceneOptions scene;
  scene.NumberOfObjects = 1;
  scene.NumberOfFrames = 90;
  SpacetimeInput input = MakeScene(scene);
  ObstacleMesh box;
  box.ObstacleId = 1;
  box.Mesh = MakeBox({ Vec3(-0.3, -0.6, 1.0), Vec3(0.3, 0.2, 3.0) });
  input.Obstacles.push_back(box);
  std::vector<Vec3> found;
  for (int k = 0; k < scene.NumberOfFrames; ++k)
  {
    const double s = k / double(scene.NumberOfFrames - 1);
    const double bow = std::sin(M_PI * s) * std::sin(M_PI * s);
    input.Tracks[0].Positions[k] = Vec3(-1.0 + 2.0 * s, 0.6, 2.0);
    found.emplace_back(-1.0 + 2.0 * s, 0.6 - 0.38 * bow, 2.0);
  }
  input.Objects[0].Position = found.front();
  input.Constraints[0].Value = found.back();
  const SpacetimeSetup setup = MakeProblem(input);
  StateVector state = StateOf(setup, found);
  std::vector<std::string> warnings;
  const std::vector<Vec3> x = ExportPositions(input, setup, state, warnings)[0];
  EXPECT_TRUE(warnings.empty());
  for (std::size_t k = 0; k < x.size(); ++k)
  {
    EXPECT_GE(setup.Obstacles.SignedDistance(x[k], double(k)),
              input.Objects[0].ClearanceRadius - 1e-3 * 4.0)
      << k;
    EXPECT_LT((x[k] - found[k]).norm(), 0.035) << k; // the plan is 0.38 m away
    if (k > 0 && k + 1 < x.size())
    {
      const Vec3 was = found[k + 1] - 2.0 * found[k] + found[k - 1];
      EXPECT_LT(900.0 * (x[k + 1] - 2.0 * x[k] + x[k - 1] - was).norm(), 2.0) << k; // m/s^2
    }
  }
}

TEST(ExportPositions, LetsWhatHangsAtAnObstacleLeaveIt)
{
  SceneOptions scene;
  scene.NumberOfObjects = 1;
  scene.NumberOfFrames = 90;
  SpacetimeInput input = MakeScene(scene);
  const double radius = input.Objects[0].ClearanceRadius;
  ObstacleMesh branch;
  branch.ObstacleId = 1;
  branch.Mesh = MakeBox({ Vec3(-1.0, -0.1, 2.0), Vec3(1.0, 0.0, 2.1) });
  input.Obstacles.push_back(branch);
  input.Objects[0].Release = 20;
  std::vector<Vec3> found;
  for (int k = 0; k < scene.NumberOfFrames; ++k)
  {
    found.emplace_back(0.0, 0.4 * radius + 0.1 * radius * std::max(0, k - 20), 2.05);
  }
  input.Tracks[0].Positions = found;
  input.Objects[0].Position = found.front();
  input.Constraints[0].Value = found.back();
  const SpacetimeSetup setup = MakeProblem(input);
  EXPECT_TRUE(setup.Model.Flag(30, 0) & LandsOnObstacle);
  EXPECT_FALSE(setup.Model.Flag(60, 0) & LandsOnObstacle); // a second after
  StateVector state = StateOf(setup, found);
  std::vector<std::string> warnings;
  const std::vector<Vec3> x = ExportPositions(input, setup, state, warnings)[0];
  EXPECT_TRUE(warnings.empty());
  for (std::size_t k = 0; k < x.size(); ++k)
  {
    EXPECT_LT((x[k] - found[k]).norm(), 1e-5) << k;
  }
}

TEST(TimelinePreconditioner, InvertsTheTimeCoupling)
{
  SceneOptions scene;
  scene.NumberOfFrames = 12;
  scene.NumberOfObjects = 2;
  const SpacetimeInput input = MakeScene(scene);
  const SpacetimeSetup setup = MakeProblem(input);
  const SpacetimeModel& model = setup.Model;
  const TimeLevel level = TimeLevel::Full(12, 1);
  const double damping = 1e-3;
  const TimelinePreconditioner preconditioner(model, level, SerialFor(), damping);
  // The same matrix, dense, from the rows' definition.
  const SpacetimeWeights& w = model.Weights;
  for (const std::size_t body : { std::size_t(4), model.NumberOfGas + 1 })
  {
    const bool object = body >= model.NumberOfGas;
    const double fraction = object ? 0.3 : 1.0; // of the diagonal
    Eigen::MatrixXd m = Eigen::MatrixXd::Identity(24, 24) * (fraction * damping);
    const auto add = [&](const std::vector<std::pair<int, double>>& row, double weight)
    {
      Eigen::VectorXd v = Eigen::VectorXd::Zero(24);
      for (const auto& [place, value] : row)
      {
        v[place] += value;
      }
      m += weight * v * v.transpose();
    };
    for (int j = 0; j < 12; ++j)
    {
      const double air = object ? w.ObjectCoherence : 1.0;
      add({ { 2 * j + 1, 1.0 } }, fraction * air * w.CoherenceWeight * w.SpatialShare);
      std::vector<std::pair<int, double>> row{ { 2 * j + 1, 1.0 } };
      const int count = (j > 0) + (j < 11);
      for (const int k : { j - 1, j + 1 })
      {
        if (k >= 0 && k < 12)
        {
          row.push_back({ 2 * k + 1, -1.0 / count });
        }
      }
      add(row, w.CoherenceWeight * (1.0 - w.SpatialShare));
      if (j > 0)
      {
        add({ { 2 * j, 1.0 }, { 2 * j - 2, -1.0 }, { 2 * j + 1, -1.0 } },
            (object ? w.ObjectPosition : 1.0) * w.PositionWeight);
        add({ { 2 * j + 1, 1.0 }, { 2 * j - 1, -1.0 } }, w.VelocityWeight);
      }
    }
    m *= object ? static_cast<double>(model.Offsets.size()) : 1.0;
    std::vector<int> free;
    for (int k = 0; k < 24; ++k)
    {
      const bool fixed = object && k % 2 == 0 && (k == 0 || k == 22);
      if (!fixed)
      {
        free.push_back(k);
      }
    }
    StateVector in(12 * model.FrameSize(), 0.0f), out(in.size(), 0.0f);
    Random random(2);
    Eigen::VectorXd right(free.size());
    const auto place = [&](int k)
    { return (k / 2) * model.FrameSize() + (k % 2 ? 4 : 1) * model.Stride() + body; };
    for (std::size_t k = 0; k < free.size(); ++k)
    {
      right[k] = random.Normal();
      in[place(free[k])] = static_cast<float>(right[k]);
    }
    Eigen::MatrixXd reduced(free.size(), free.size());
    for (std::size_t r = 0; r < free.size(); ++r)
    {
      for (std::size_t c = 0; c < free.size(); ++c)
      {
        reduced(r, c) = m(free[r], free[c]);
      }
    }
    const Eigen::VectorXd expected = reduced.ldlt().solve(right);
    preconditioner.Solve(in, out);
    for (std::size_t k = 0; k < free.size(); ++k)
    {
      EXPECT_NEAR(out[place(free[k])], expected[k], 2e-3 * expected.lpNorm<Eigen::Infinity>());
    }
    if (object)
    {
      EXPECT_EQ(out[place(0)], 0.0f);
      EXPECT_EQ(out[place(22)], 0.0f);
    }
  }
}

TEST(LinearCluster, ProjectsOntoRowsAndBallsTogether)
{
  SceneOptions scene;
  scene.NumberOfFrames = 20;
  scene.NumberOfObjects = 1;
  const SpacetimeInput input = MakeScene(scene);
  const SpacetimeSetup setup = MakeProblem(input);
  ConstraintTable table = setup.Table;
  DifferenceRow exact;
  exact.Terms = { { 4, -0.5 }, { 6, 0.5 } };
  exact.Value = Vec3(0.2, 0.1, -0.3);
  DifferenceRow ball;
  ball.Terms = { { 5, -0.5 }, { 6, 0.5 } };
  ball.Value = Vec3(0.0, 0.4, 0.0);
  ball.Radius = 0.05;
  table.Rows = { exact, ball };
  table.Balls = { { 5, 0, Vec3(3.0, 3.0, 3.0), 0.5 } };
  const auto clusters = MakeClusters(setup.Model, table, std::vector<bool>(20, true));
  ASSERT_EQ(clusters.size(), 1u);
  EXPECT_EQ(clusters[0].Frames(), (std::vector<int>{ 4, 5, 6 }));
  Eigen::MatrixX3d x(3, 3);
  x << 2.0, 3.0, 3.5, 4.0, 3.0, 3.0, 3.0, 2.0, 3.0;
  EXPECT_GT(clusters[0].Violation(x), 0.1);
  clusters[0].Project(x);
  EXPECT_LT(clusters[0].Violation(x), 1e-9);
  Eigen::MatrixX3d once = x;
  clusters[0].Project(once);
  EXPECT_LT((once - x).norm(), 1e-9);
  // A tangent step keeps the exact row.
  Eigen::MatrixX3d step = Eigen::MatrixX3d::Random(3, 3);
  clusters[0].ProjectTangent(step);
  EXPECT_LT((0.5 * (step.row(2) - step.row(0))).norm(), 1e-12);
  EXPECT_GT(step.norm(), 1e-3);
}

TEST(SelectVortices, KeepsTheArtistsAndTheStrongestOfEachPlaceAndTime)
{
  SceneOptions scene;
  scene.NumberOfFrames = 60;
  scene.NumberOfObjects = 2;
  SpacetimeInput input = MakeScene(scene);
  Vortex base = input.Vortices[0];
  std::vector<Vortex> vortices;
  const auto add = [&](int id, double x, double strength)
  {
    base.VortexId = id;
    base.Strength = strength;
    base.P1 = Vec3(x, 0.0, 0.5);
    base.P2 = Vec3(x, 0.0, 2.5);
    vortices.push_back(base);
  };
  add(0, 0.0, 1.0);
  add(1, 0.1, 2.0);  // beside the first and stronger
  add(2, 1.5, 1.5);  // elsewhere
  add(3, -1.5, 0.1); // weak
  add(7, 0.0, 0.1);  // the artist's: nobody claims it
  for (Track& track : input.Tracks)
  {
    for (int frame = 0; frame < 60; ++frame)
    {
      track.VortexIds.push_back(frame % 4);
    }
  }
  std::vector<int> ids;
  for (const Vortex& vortex : SelectVortices(vortices, input.Tracks, input.Scene, 2))
  {
    ids.push_back(vortex.VortexId);
  }
  EXPECT_EQ(ids, (std::vector<int>{ 1, 2, 7 }));
  EXPECT_EQ(SelectVortices(vortices, input.Tracks, input.Scene, 0).size(), 1u);
}
