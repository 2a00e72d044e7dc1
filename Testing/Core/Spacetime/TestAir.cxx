// SPDX-License-Identifier: BSD-3-Clause
// What the air does to light things: terminal fall, the damping above a surface, the moving start.
#include "Spacetime/Energy/LandingDamping.h"
#include "Spacetime/Scene/InitialGas.h"
#include "Spacetime/Scene/SpacetimeSetup.h"
#include "SpacetimeScenes.h"
#include "StandardProblem.h"

#include <gtest/gtest.h>

using namespace waft;

namespace
{

SpacetimeSetup MakeProblem(const SpacetimeInput& input)
{
  SpacetimeOptions options;
  options.NumberOfGasParticles = 343;
  options.NumberOfObjectParticles = 25;
  SpacetimeSetup setup;
  const Result result = MakeSetup(input, options, setup);
  EXPECT_TRUE(result) << result.Message();
  return setup;
}

/// How far gas goes from its first places in so many frames of plain simulation [dx], and its
/// largest acceleration on the way [dx / frame^2].
struct Drift
{
  double Moved = 0.0, Accelerated = 0.0;

  Drift(const SpacetimeModel& model, const StateVector& start, int frames)
  {
    const TimeLevel level = TimeLevel::Full(model.NumberOfFrames, 1);
    SpacetimeObjective objective(model, model.Fields, level, SerialFor(), FastestSphKernels());
    StateVector state(start.begin(), start.begin() + model.FrameSize());
    state.resize(start.size());
    for (int j = 0; j < frames; ++j)
    {
      FrameTerms& terms = objective.ForwardFrame(state, 0);
      for (int c = 0; c < 3; ++c)
      {
        float* x = state.data() + c * model.Stride();
        float* v = x + 3 * model.Stride();
        for (std::size_t i = 0; i < model.NumberOfGas; ++i)
        {
          const float a = terms.Acceleration(c)[i];
          v[i] += a;
          x[i] += v[i];
          this->Accelerated = std::max<double>(this->Accelerated, std::abs(a));
          this->Moved =
            std::max<double>(this->Moved, std::abs(x[i] - start[c * model.Stride() + i]));
        }
      }
    }
  }
};

/// The derivative of a function of a vector by its component c, from five points that are near
/// enough to be on one piece of what is pieced together of splines.
template <class Function>
Vec3 FivePointDifference(const Function& f, const Vec3& x, int c)
{
  constexpr double h = 1e-4;
  const Vec3 one = h * Vec3::Unit(c);
  const Vec3 two = 2.0 * one;
  const Vec3 near = f(x + one) - f(x - one);
  const Vec3 far = f(x + two) - f(x - two);
  return (8.0 * near - far) / (12.0 * h);
}

} // namespace

TEST(SettlingSlip, AThingThatFallsAtItsSettlingSpeedThroughStillAirIsAtOneWithIt)
{
  SceneOptions scene;
  scene.NumberOfObjects = 1;
  scene.NumberOfFrames = 3;
  SpacetimeInput input = MakeScene(scene);
  input.Vortices.clear();
  MotionObject& object = input.Objects[0];
  object.Position = Vec3(0.0, 0.0, 2.0);
  const double fall = object.SettlingSpeed * input.Scene.Time.Step();
  input.Tracks[0].Positions = { object.Position, object.Position - fall * Vec3::UnitZ(),
                                object.Position - 2.0 * fall * Vec3::UnitZ() };
  input.Constraints.clear();
  const auto coherence = [&](double factor)
  {
    SpacetimeSetup setup = MakeProblem(input);
    const SpacetimeModel& model = setup.Model;
    for (int j = 0; j < 3; ++j)
    {
      setup.Start[j * model.FrameSize() + 5 * model.Stride() + model.NumberOfGas] *=
        static_cast<float>(factor);
    }
    const TimeLevel level = TimeLevel::Full(3, 1);
    SpacetimeObjective objective(model, model.Fields, level, SerialFor(), FastestSphKernels());
    SpacetimeTerms terms;
    objective.Evaluate(setup.Start, nullptr, terms);
    return terms.Ec;
  };
  EXPECT_LT(coherence(1.0), 0.01 * coherence(0.0));
  EXPECT_LT(coherence(1.0), 0.01 * coherence(2.0));
}

TEST(LandingDamping, HasExactDerivativesAboveTheFloorAndAnObstacle)
{
  SceneOptions scene;
  scene.NumberOfFrames = 20;
  scene.Land = true;
  SpacetimeInput input = MakeScene(scene);
  ObstacleMesh table;
  table.ObstacleId = 1;
  table.Mesh = MakeBox({ Vec3(-0.6, -0.6, 0.2), Vec3(0.6, 0.6, 0.6) });
  input.Obstacles.push_back(table);
  SpacetimeSetup setup = MakeProblem(input);
  SpacetimeModel& model = setup.Model;
  for (const std::uint8_t flag : { LandsOnFloor, LandsOnObstacle })
  {
    model.Flags.assign(model.Flags.size(), flag);
    // Beside an edge of the table the distance is curved.
    const Vec3 place = flag == LandsOnFloor ? setup.FromWorld(Vec3(1.0, 1.0, 0.06))
                                            : setup.FromWorld(Vec3(0.68, 0.1, 0.67));
    const Vec3 velocity(0.02, -0.03, -0.08);
    const DampingForce force = LandingDamping(model, 3, 1.0, 1, place, velocity);
    EXPECT_GT(force.Acceleration.norm(), 1e-5);
    EXPECT_LT(force.Acceleration.dot(velocity), 0.0);
    const auto at = [&](const Vec3& x) -> Vec3
    { return LandingDamping(model, 3, 1.0, 1, x, velocity).Acceleration; };
    const auto with = [&](const Vec3& v) -> Vec3
    { return LandingDamping(model, 3, 1.0, 1, place, v).Acceleration; };
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_LT((FivePointDifference(at, place, c) - force.ByPosition.col(c)).norm(),
                1e-6 * force.ByPosition.norm())
        << int(flag) << c;
      EXPECT_LT((FivePointDifference(with, velocity, c) - force.ByVelocity.col(c)).norm(),
                1e-6 * force.ByVelocity.norm())
        << int(flag) << c;
    }
  }
  model.Flags.assign(model.Flags.size(), 0);
  EXPECT_EQ(LandingDamping(model, 3, 1.0, 1, Vec3(1.0, 1.0, 0.1), -Vec3::UnitZ()).Acceleration,
            Vec3(Vec3::Zero()));
}

TEST(LandingDamping, StopsASettlingLeafSoftlyAboveTheFloor)
{
  SceneOptions scene;
  scene.NumberOfFrames = 20;
  scene.Land = true;
  SpacetimeSetup setup = MakeProblem(MakeScene(scene));
  SpacetimeModel& model = setup.Model;
  model.Flags.assign(model.Flags.size(), LandsOnFloor);
  const Vec3 x0 = setup.FromWorld(Vec3(0.0, 0.0, 0.4));
  Vec3 x = x0;
  Vec3 v = -model.SettlingSlip(0) * Vec3::UnitZ();
  double hardest = 0.0;
  int frames = 0;
  for (; x.z() > model.Clearances[0].RestHeight + 0.2 * model.BrakeHeights[0] && frames < 300;
       ++frames)
  {
    const Vec3 force = LandingDamping(model, 3, 1.0, 0, x, v).Acceleration -
                       (model.Gravities[0] + model.DragRates[0] * v.z()) * Vec3::UnitZ();
    hardest = std::max(hardest, force.norm());
    v += force;
    x += v;
  }
  EXPECT_GT(frames, (x0 - x).z() / model.SettlingSlip(0)); // longer than free fall
  EXPECT_LT(frames, 60);
  EXPECT_LT(v.norm(), 0.5 * model.SettlingSlip(0));
  EXPECT_LT(hardest, 15.0 * model.Gravities[0]);
}

TEST(GasAtRest, StaysWhereItIsBesideWallsAndAPillar)
{
  SceneOptions scene;
  scene.NumberOfFrames = 6;
  SpacetimeInput input = MakeScene(scene);
  input.Vortices.clear();
  AddPillar(input);
  SpacetimeSetup setup = MakeProblem(input);
  SpacetimeModel& model = setup.Model;
  model.Fluid.ObjectMass = 1e-9; // the gas does not know of the objects
  ASSERT_FALSE(model.Obstacles.IsEmpty());
  const Drift drift(model, setup.Start, 300);
  EXPECT_LT(drift.Accelerated, 2e-6); // rounding of single precision
  EXPECT_LT(drift.Moved, 2e-3);
  EXPECT_LT(Drift(model, setup.Start, 1000).Accelerated, 2e-6); // nor does rounding grow
  // It is the rest density that does it.
  model.Rest = RestDensity();
  EXPECT_GT(Drift(model, setup.Start, 1).Accelerated, 1e-2);
}

TEST(GasAtRest, StaysWhereItIsInTheStandardProblem)
{
  StandardProblem problem; // 13 x 14 x 14 particles
  problem.NumberOfFrames = 4;
  problem.NumberOfObjects = 1;
  problem.Build();
  problem.Setup.Model.Fields.Vortices.clear();
  problem.Setup.Model.Fluid.ObjectMass = 1e-9;
  const Drift drift(problem.Setup.Model, problem.Setup.Start, 300);
  EXPECT_LT(drift.Accelerated, 2e-6);
  EXPECT_LT(drift.Moved, 2e-3);
}

TEST(MakeInitialGas, MovesTheAirWithTheObjectsAndKeepsItsDynamics)
{
  // Everything is carried along by one stream.
  SceneOptions scene;
  scene.NumberOfObjects = 20;
  scene.NumberOfFrames = 60;
  SpacetimeInput input = MakeScene(scene);
  input.Vortices.clear();
  const double step = input.Scene.Time.Step();
  for (Track& track : input.Tracks)
  {
    for (int k = 1; k < scene.NumberOfFrames; ++k)
    {
      const Vec3 x = track.Positions[k - 1] - Vec3(0.0, 0.0, 2.0);
      const Vec3 u = 0.5 * Vec3(-x.y(), x.x(), 0.0); // a slow turn about the middle
      track.Positions[k] = track.Positions[k - 1] + step * u;
    }
  }
  SpacetimeSetup setup = MakeProblem(input);
  const SpacetimeModel& model = setup.Model;
  const TimeLevel level = TimeLevel::Full(scene.NumberOfFrames, 1);
  SpacetimeObjective objective(model, model.Fields, level, SerialFor(), FastestSphKernels());
  SpacetimeTerms still, moved;
  objective.Evaluate(setup.Start, nullptr, still);
  StateVector state = setup.Start;
  SilentMonitor monitor;
  ASSERT_TRUE(MakeInitialGas(objective, SerialFor(), monitor, state));
  objective.Evaluate(state, nullptr, moved);
  EXPECT_LT(moved.Ev, still.Ev);
  // They stir it, and not faintly.
  double along = 0.0, square = 0.0;
  for (int j = scene.NumberOfFrames / 2; j < scene.NumberOfFrames; ++j)
  {
    const Vec3 x = setup.FromWorld(input.Tracks[3].Positions[j]);
    const Vec3 v = setup.FromWorld(input.Tracks[3].Positions[j]) -
                   setup.FromWorld(input.Tracks[3].Positions[j - 1]);
    const float* p = state.data() + j * model.FrameSize();
    for (std::size_t i = 0; i < model.NumberOfGas; ++i)
    {
      const Vec3 y(p[i], p[model.Stride() + i], p[2 * model.Stride() + i]);
      if ((x - y).norm() < 1.0)
      {
        const float* u = p + 3 * model.Stride() + i;
        along += v.dot(Vec3(u[0], u[model.Stride()], u[2 * model.Stride()]));
        square += v.squaredNorm();
      }
    }
  }
  EXPECT_GT(along, 0.3 * square);
  for (int j = 0; j < scene.NumberOfFrames; ++j)
  {
    for (int c = 0; c < 3; ++c)
    {
      const float* before = setup.Start.data() + j * model.FrameSize() + c * model.Stride();
      const float* after = state.data() + j * model.FrameSize() + c * model.Stride();
      for (std::size_t i = 0; i < model.NumberOfBodies(); ++i)
      {
        if (i >= model.NumberOfGas)
        {
          EXPECT_EQ(after[i], before[i]);
        }
        else
        {
          EXPECT_GE(after[i], 0.0f);
          EXPECT_LE(after[i], model.Size[c]);
        }
      }
    }
  }
}
