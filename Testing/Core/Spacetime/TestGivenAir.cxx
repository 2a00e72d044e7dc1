// SPDX-License-Identifier: BSD-3-Clause
// E beside a sampled air: what the air does costs nothing, objects go with it, and the gradient is
// exact.
#include "Spacetime/Run/InitialObjects.h"
#include "Spacetime/Scene/InitialGas.h"
#include "Spacetime/Scene/Rollout.h"
#include "Spacetime/Scene/SpacetimeSetup.h"
#include "Spacetime/Solver/TimelinePreconditioner.h"
#include "SpacetimeRuns.h"
#include "SpacetimeScenes.h"
#include "TurningAir.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace waft;

namespace
{

struct AirProblem
{
  explicit AirProblem(int frames, int objects = 3, bool lands = false)
  {
    SceneOptions scene;
    scene.NumberOfFrames = frames;
    scene.NumberOfObjects = objects;
    this->Input = MakeScene(scene);
    if (lands)
    {
      this->Land();
    }
    this->Step = this->Input.Scene.Time.Step();
    this->Input.Air = TurningAir(this->Input.Scene.Bounds, frames, this->Step);
    if (!lands)
    {
      this->Input.Constraints.clear();
    }
    for (std::size_t o = 0; o < this->Input.Tracks.size() && !lands; ++o)
    {
      this->Drift(this->Input.Objects[o], this->Input.Tracks[o]);
    }
    SpacetimeOptions options;
    options.NumberOfGasParticles = 216;
    options.NumberOfObjectParticles = 12;
    const Result result = MakeSetup(this->Input, options, this->Setup);
    EXPECT_TRUE(result) << result.Message();
    this->Level = TimeLevel::Full(frames, 1);
  }

  // All are a few centimetres above the ground, where they lie from the last frame on.
  void Land()
  {
    const int last = this->Input.Scene.Time.NumberOfFrames - 1;
    for (std::size_t o = 0; o < this->Input.Tracks.size(); ++o)
    {
      const MotionObject& object = this->Input.Objects[o];
      std::vector<Vec3>& path = this->Input.Tracks[o].Positions;
      for (int k = 0; k <= last; ++k)
      {
        path[static_cast<std::size_t>(k)].z() = object.RestHeight + 0.005 * (last - k);
      }
      this->Input.Objects[o].Position = path.front();
      this->Input.Constraints[o].Kind = ConstraintKind::Rest;
      this->Input.Constraints[o].Value = path.back();
    }
  }

  /// Gives all objects a slip to the side besides.
  void Glide()
  {
    const SpacetimeSetup& setup = this->Setup;
    std::vector<BodyLaw> laws;
    std::vector<GroundEffect> ground;
    for (std::size_t o = 0; o < setup.Objects.size(); ++o)
    {
      BodyLaw law = LawOf(setup.Objects[o]);
      law.Slip += law.SettlingSpeed() * Vec3(0.5, -0.25, 0.0);
      laws.push_back(law.In(setup.Spacing, setup.FrameStep));
      ground.emplace_back(setup.Obstacles, setup.Landings[o], setup.Objects[o],
                          this->Input.Scene.Time.FramesPerSecond, nullptr);
    }
    SpacetimeModel& model = this->Setup.Model;
    model.Air = GivenAir(this->Input.Air, setup.Origin, setup.Spacing, setup.FrameStep,
                         model.NumberOfGas, std::move(laws), std::move(ground));
  }

  // Along the air less the settling speed, by the midpoint rule.
  void Drift(const MotionObject& object, Track& track) const
  {
    for (std::size_t k = 1; k < track.Positions.size(); ++k)
    {
      const Vec3& x = track.Positions[k - 1];
      Vec3 v = Vec3::Zero();
      for (int again = 0; again < 4; ++again)
      {
        const double between = (static_cast<double>(k) - 0.5) * this->Step;
        v = this->Input.Air.Sample(x + 0.5 * this->Step * v, between) -
            object.SettlingSpeed * Vec3::UnitZ();
      }
      track.Positions[k] = x + this->Step * v;
    }
  }

  double Step = 0.0;
  SpacetimeInput Input;
  SpacetimeSetup Setup;
  TimeLevel Level;
};

// move: of all differences, root mean square.
void CheckGradient(const AirProblem& problem, double move = 5e-4)
{
  const SpacetimeModel& model = problem.Setup.Model;
  SpacetimeObjective objective(model, model.Fields, problem.Level, SerialFor(),
                               FastestSphKernels());
  StateVector state = problem.Setup.Start;
  Random random(5);
  for (float& value : state)
  {
    value += static_cast<float>(0.05 * random.Normal());
  }
  StateVector gradient(state.size());
  SpacetimeTerms terms;
  ASSERT_TRUE(objective.Evaluate(state, &gradient, terms));
  for (int kind = 0; kind < 4; ++kind) // positions or velocities, of gas or of objects
  {
    StateVector plus = state, minus = state;
    double slope = 0.0, norm = 0.0;
    const auto isTaken = [&](std::size_t k)
    {
      const std::size_t index = k % model.FrameSize();
      const bool isGas = index % model.Stride() < model.NumberOfGas;
      return (index / model.Stride() < 3) == (kind % 2 == 0) && isGas == (kind < 2);
    };
    for (std::size_t k = 0; k < state.size(); ++k)
    {
      norm += isTaken(k) ? static_cast<double>(gradient[k]) * gradient[k] : 0.0;
    }
    const double scale = move / std::sqrt(norm / static_cast<double>(state.size()));
    for (std::size_t k = 0; k < state.size(); ++k)
    {
      const double part = isTaken(k) ? scale * gradient[k] : 0.0;
      plus[k] = static_cast<float>(state[k] + part);
      minus[k] = static_cast<float>(state[k] - part);
      slope += static_cast<double>(gradient[k]) * (double(plus[k]) - double(minus[k]));
    }
    SpacetimeTerms high, low;
    objective.Evaluate(plus, nullptr, high);
    objective.Evaluate(minus, nullptr, low);
    EXPECT_NEAR((high.E - low.E) / slope, 1.0, 3e-3) << "kind " << kind;
  }
}

} // namespace

TEST(GivenAir, ItsGradientEqualsCentralDifferences)
{
  CheckGradient(AirProblem(8));
}

TEST(GivenAir, ItsGradientEqualsCentralDifferencesAboveWhatIsLandedOn)
{
  CheckGradient(AirProblem(8, 3, true), 1e-5); // the cushion bends within a millimetre
}

TEST(GivenAir, ItsGradientEqualsCentralDifferencesOfWhatGlidesToALanding)
{
  AirProblem problem(8, 3, true);
  problem.Glide();
  CheckGradient(problem, 1e-5);
}

TEST(GivenAir, ItsGradientEqualsCentralDifferencesOfWhatSweepsFromSideToSide)
{
  AirProblem problem(8);
  std::vector<std::vector<Vec3>> slips(problem.Setup.Objects.size());
  for (std::size_t o = 0; o < slips.size(); ++o)
  {
    for (int frame = 0; frame < 8; ++frame)
    {
      const double phase = 1.3 * frame + static_cast<double>(o);
      slips[o].emplace_back(0.6 * std::sin(phase), 0.4 * std::cos(phase), -0.8);
    }
  }
  GivenAir& air = problem.Setup.Model.Air;
  const std::size_t body = problem.Setup.Model.NumberOfGas;
  const Vec3 x = Vec3::Constant(3.0), still = Vec3::Zero();
  const Vec3 sinking = air.Deviation(body, x, still, 2.0, 1.0);
  air.SetSlips(slips);
  const Vec3 sweeping = air.Deviation(body, x, still, 2.0, 1.0);
  const Vec3 slip = 0.5 * (slips[0][1] + slips[0][2]); // in the middle of the step
  const Vec3 law = problem.Setup.Objects[0].SettlingSpeed * Vec3::UnitZ();
  const double unit = problem.Setup.FrameStep / problem.Setup.Spacing;
  EXPECT_LT((sweeping - sinking + unit * (slip + law)).norm(), 1e-9);
  CheckGradient(problem);
}

TEST(GivenAir, AFrameAtOnceIsAsBodyByBody)
{
  const AirProblem problem(8);
  const SpacetimeModel& model = problem.Setup.Model;
  const std::size_t stride = model.Stride();
  const double unit = problem.Setup.FrameStep / problem.Setup.Spacing;
  std::vector<float> out(model.FrameSize()), jacobians(9 * stride);
  for (const double frame : { 0.0, 2.0, 3.3, 20.0 }) // on a time of the air, between, after all
  {
    const float* state = problem.Setup.Start.data();
    model.Air.Deviations(state, model.NumberOfBodies(), stride, frame, 1.0, out.data(),
                         jacobians.data());
    for (std::size_t i = 0; i < model.NumberOfBodies(); ++i)
    {
      const Vec3 x(state[i], state[stride + i], state[2 * stride + i]);
      const Vec3 v(state[3 * stride + i], state[4 * stride + i], state[5 * stride + i]);
      const Vec3 w = model.Air.Deviation(i, x, v, frame, 1.0);
      Mat3 jacobian;
      (void)problem.Input.Air.Sample(problem.Setup.ToWorld(x - 0.5 * v),
                                     (frame - 0.5) * problem.Setup.FrameStep, jacobian);
      for (int c = 0; c < 3; ++c)
      {
        EXPECT_NEAR(out[(3 + c) * stride + i], w[c], 1e-5 * unit) << i << ", frame " << frame;
        for (int k = 0; k < 3; ++k)
        {
          EXPECT_NEAR(jacobians[(3 * c + k) * stride + i], problem.Setup.FrameStep * jacobian(c, k),
                      1e-5 * problem.Setup.FrameStep)
            << i << ", frame " << frame;
        }
      }
    }
  }
}

TEST(GivenAir, AFrameAtOnceIsAsBodyByBodyInACushion)
{
  const AirProblem problem(8, 3, true);
  const SpacetimeModel& model = problem.Setup.Model;
  const std::size_t stride = model.Stride();
  std::vector<float> out(model.FrameSize());
  const float* state = problem.Setup.Start.data() + 5 * model.FrameSize();
  model.Air.Deviations(state, model.NumberOfBodies(), stride, 5.0, 1.0, out.data(), nullptr);
  for (std::size_t i = model.NumberOfGas; i < model.NumberOfBodies(); ++i)
  {
    const Vec3 x(state[i], state[stride + i], state[2 * stride + i]);
    const Vec3 v(state[3 * stride + i], state[4 * stride + i], state[5 * stride + i]);
    const Vec3 w = model.Air.Deviation(i, x, v, 5.0, 1.0);
    const double settling = problem.Input.Objects[i - model.NumberOfGas].SettlingSpeed *
                            problem.Setup.FrameStep / problem.Setup.Spacing;
    const Vec3 free = v - model.Air.Velocity(x - 0.5 * v, 4.5) + settling * Vec3::UnitZ();
    EXPECT_GT((free - w).z(), 0.1 * settling) << i; // the cushion acts
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(out[(3 + c) * stride + i], w[c], 1e-5 * settling) << i;
    }
    const Vec3 before = x - v;
    EXPECT_LT((model.Air.Carried(i, before, w, 5.0, 1.0) - v).norm(), 0.01 * v.norm()) << i;
  }
}

TEST(GivenAir, AFrameAtOnceIsAsBodyByBodyOfWhatGlides)
{
  AirProblem problem(8, 3, true);
  const SpacetimeModel& model = problem.Setup.Model;
  const GivenAir sinking = model.Air;
  problem.Glide();
  const std::size_t stride = model.Stride();
  std::vector<float> out(model.FrameSize());
  const float* state = problem.Setup.Start.data() + 5 * model.FrameSize();
  model.Air.Deviations(state, model.NumberOfBodies(), stride, 5.0, 1.0, out.data(), nullptr);
  for (std::size_t i = model.NumberOfGas; i < model.NumberOfBodies(); ++i)
  {
    const Vec3 x(state[i], state[stride + i], state[2 * stride + i]);
    const Vec3 v(state[3 * stride + i], state[4 * stride + i], state[5 * stride + i]);
    const Vec3 w = model.Air.Deviation(i, x, v, 5.0, 1.0);
    const double settling = problem.Input.Objects[i - model.NumberOfGas].SettlingSpeed *
                            problem.Setup.FrameStep / problem.Setup.Spacing;
    EXPECT_GT((w - sinking.Deviation(i, x, v, 5.0, 1.0)).x(), 0.05 * settling) << i;
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(out[(3 + c) * stride + i], w[c], 1e-5 * settling) << i;
    }
  }
}

TEST(GivenAir, WhatDriftsInItCostsNextToNothing)
{
  AirProblem problem(40);
  SpacetimeModel& model = problem.Setup.Model;
  model.Fluid.ObjectMass = 1e-9; // the gas does not know of the objects
  model.Fluid.SoundSpeed = 1e-3; // nor of its own disorder
  SpacetimeObjective objective(model, model.Fields, problem.Level, SerialFor(),
                               FastestSphKernels());
  StateVector state = problem.Setup.Start;
  SilentMonitor monitor;
  ASSERT_TRUE(MakeInitialGas(objective, SerialFor(), monitor, state));
  SpacetimeTerms drifting, hastened;
  objective.Evaluate(state, nullptr, drifting);
  StateVector faster = state;
  for (std::size_t k = 0; k < faster.size(); ++k)
  {
    const bool isVelocity = k % model.FrameSize() >= 3 * model.Stride();
    faster[k] *= isVelocity ? 1.1f : 1.0f;
  }
  objective.Evaluate(faster, nullptr, hastened);
  EXPECT_LT(drifting.Ev, 1e-3 * hastened.Ev);
  EXPECT_LT(drifting.Ex, 1e-6);
  const ReplayError replay = MeasureReplay(objective, state, 5, monitor);
  EXPECT_GE(replay.Objects, 0.0);
  EXPECT_LT(replay.Objects, 1e-3);
  EXPECT_LT(replay.Gas, 1e-3);
}

TEST(GivenAir, AMotionThatTheModelDoesNotGiveIsNotReplayed)
{
  AirProblem problem(40);
  SpacetimeModel& model = problem.Setup.Model;
  SpacetimeObjective objective(model, model.Fields, problem.Level, SerialFor(),
                               FastestSphKernels());
  StateVector state = problem.Setup.Start; // the gas stays where it is in an air that turns
  SilentMonitor monitor;
  const ReplayError replay = MeasureReplay(objective, state, 5, monitor);
  EXPECT_EQ(replay.Gas, -1.0); // it has no velocity
  for (int frame = 0; frame < model.NumberOfFrames; ++frame)
  {
    for (std::size_t o = 0; o < model.NumberOfObjects; ++o)
    {
      state[frame * model.FrameSize() + 5 * model.Stride() + model.NumberOfGas + o] *= 3.0f;
    }
  }
  EXPECT_GT(MeasureReplay(objective, state, 5, monitor).Objects, 0.3);
}

TEST(GivenAir, ARunInItKeepsTheMotionAndSaysHowFarItIsOne)
{
  AirProblem problem(50);
  SpacetimeOptions options;
  options.NumberOfGasParticles = 216;
  options.NumberOfObjectParticles = 12;
  options.MaximumNumberOfIterations = 30;
  SilentMonitor monitor;
  SpacetimeOutput output;
  const Result result = RunSpacetime(problem.Input, options, SerialFor(), monitor, output);
  ASSERT_TRUE(result) << result.Message();
  for (std::size_t o = 0; o < output.Tracks.size(); ++o)
  {
    for (std::size_t k = 0; k < 50; ++k)
    {
      const Vec3 moved = output.Tracks[o].Positions[k] - problem.Input.Tracks[o].Positions[k];
      EXPECT_LT(moved.norm(), 0.05) << o << ", frame " << k;
    }
    ASSERT_EQ(output.Tracks[o].Residuals.size(), 50u);
  }
  EXPECT_LT(output.GasModelResidual, 0.25);
  EXPECT_GE(output.GasModelResidual, 0.0);
  const std::vector<float>& residuals = output.Particles.Frames.back().Residuals;
  EXPECT_EQ(residuals.size(), output.Particles.Frames.back().Velocities.size());
}

TEST(GivenAir, OfFewBodiesValuesAreTakenOneByOneToTheSameBits)
{
  const AirProblem problem(8);
  const SpacetimeModel& model = problem.Setup.Model;
  const std::size_t stride = model.Stride();
  const float* state = problem.Setup.Start.data();
  std::vector<float> all(model.FrameSize()), few(model.FrameSize());
  std::vector<float> slopes(9 * stride), fewSlopes(9 * stride);
  model.Air.Deviations(state, 64, stride, 3.3, 1.0, all.data(), slopes.data()); // of 867 nodes
  model.Air.Deviations(state, 3, stride, 3.3, 1.0, few.data(), fewSlopes.data());
  for (std::size_t i = 0; i < 3; ++i)
  {
    for (std::size_t c = 0; c < 9; ++c)
    {
      EXPECT_EQ(slopes[c * stride + i], fewSlopes[c * stride + i]);
      EXPECT_EQ(c < 6 ? all[c * stride + i] : 0.0f, c < 6 ? few[c * stride + i] : 0.0f);
    }
  }
}

TEST(GivenAir, APathThatIsGivenHasNoLawAndNoSmoothness)
{
  AirProblem problem(9);
  SpacetimeModel& model = problem.Setup.Model;
  for (const int frame : { 3, 4 })
  {
    model.Flags[static_cast<std::size_t>(frame) * model.NumberOfObjects] |= FixedPosition;
  }
  for (std::size_t j = 1; j < 9; ++j)
  {
    EXPECT_EQ(StepHasLaw(model, problem.Level, j, 0), j != 4) << j;
    EXPECT_EQ(SmoothnessWeight(model, problem.Level, j, 0) > 0.0, j > 1 && (j < 3 || j > 5)) << j;
    EXPECT_EQ(SmoothnessWeight(model, problem.Level, j, 1) > 0.0, j > 1) << j;
  }
  model.Air = GivenAir();
  EXPECT_TRUE(StepHasLaw(model, problem.Level, 4, 0));
}

namespace
{

// All go through one place half-way, beside what the air asks of them.
StateVector Meeting(const AirProblem& problem)
{
  const SpacetimeModel& model = problem.Setup.Model;
  const std::size_t stride = model.Stride();
  const int half = model.NumberOfFrames / 2;
  StateVector state = problem.Setup.Start;
  const auto row = [&](int frame, std::size_t c, std::size_t o) -> float&
  {
    return state[static_cast<std::size_t>(frame) * model.FrameSize() + c * stride +
                 model.NumberOfGas + o];
  };
  for (std::size_t o = 1; o < model.NumberOfObjects; ++o)
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      const float apart = row(half, c, 0) - row(half, c, o) + 0.01f * static_cast<float>(o);
      for (int frame = 1; frame < model.NumberOfFrames; ++frame)
      {
        row(frame, c, o) += apart * static_cast<float>(std::min(frame, half)) / half;
        row(frame, 3 + c, o) += frame <= half ? apart / half : 0.0f;
      }
    }
  }
  return state;
}

} // namespace

TEST(InitialObjects, GiveWayToEachOtherAndLeaveTheGasAlone)
{
  const AirProblem problem(40);
  const SpacetimeModel& model = problem.Setup.Model;
  const StateVector before = Meeting(problem);
  StateVector state = before;
  SilentMonitor monitor;
  ASSERT_TRUE(
    MakeInitialObjects(model, problem.Setup.Table, problem.Level, SerialFor(), monitor, state));
  SpacetimeObjective objective(model, model.Fields, problem.Level, SerialFor(),
                               FastestSphKernels());
  SpacetimeTerms first, last;
  objective.Evaluate(before, nullptr, first);
  objective.Evaluate(state, nullptr, last);
  EXPECT_GT(first.Contact, 0.1);
  EXPECT_LT(last.Contact, 0.1 * first.Contact);
  EXPECT_LT(last.EvObjects, 0.5 * first.EvObjects);
  for (std::size_t k = 0; k < state.size(); ++k)
  {
    const std::size_t index = k % model.FrameSize();
    const bool isObject = index % model.Stride() >= model.NumberOfGas;
    const bool isHeld = !isObject || (k < 3 * model.Stride()); // gas, and where objects start
    EXPECT_TRUE(!isHeld || state[k] == before[k]) << k;
  }
}

TEST(InitialObjects, StayAsTheyWereWhenStopped)
{
  const AirProblem problem(40);
  const StateVector before = Meeting(problem);
  StateVector state = before;
  StopAt monitor(0.2);
  EXPECT_FALSE(MakeInitialObjects(problem.Setup.Model, problem.Setup.Table, problem.Level,
                                  SerialFor(), monitor, state));
  EXPECT_TRUE(state == before);
}

TEST(GivenAir, WideObjectsKeepTheirWholeWidthApart)
{
  AirProblem problem(8);
  const double width = 0.8 * problem.Setup.Spacing;
  for (MotionObject& object : problem.Input.Objects)
  {
    object.ClearanceRadius = 0.5 * width;
  }
  SpacetimeOptions options;
  options.NumberOfGasParticles = 216;
  SpacetimeSetup inAir, alone;
  ASSERT_TRUE(MakeSetup(problem.Input, options, inAir));
  EXPECT_NEAR(inAir.Model.Weights.ContactDistance * inAir.Spacing, 1.05 * width, 1e-9);
  problem.Input.Air = FieldSeries();
  ASSERT_TRUE(MakeSetup(problem.Input, options, alone));
  EXPECT_EQ(alone.Model.Weights.ContactDistance, 0.5);
}
