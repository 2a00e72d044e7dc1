// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Energy/SpacetimeObjective.h"
#include "Spacetime/Scene/SpacetimeSetup.h"
#include "Spacetime/Solver/TimelinePreconditioner.h"
#include "SpacetimeScenes.h"

#include <gtest/gtest.h>

using namespace waft;

namespace
{

SpacetimeOptions SmallOptions()
{
  SpacetimeOptions options;
  options.NumberOfGasParticles = 216;
  options.NumberOfObjectParticles = 12;
  return options;
}

// A disturbed state: gas off its lattice and moving.
StateVector Disturbed(const SpacetimeSetup& setup, double size)
{
  StateVector state = setup.Start;
  const SpacetimeModel& model = setup.Model;
  Random random(5);
  for (int j = 0; j < model.NumberOfFrames; ++j)
  {
    for (int c = 0; c < 6; ++c)
    {
      float* row = state.data() + j * model.FrameSize() + c * model.Stride();
      for (std::size_t i = 0; i < model.NumberOfBodies(); ++i)
      {
        row[i] += static_cast<float>(size * random.Normal());
      }
    }
  }
  return state;
}

struct Problem
{
  explicit Problem(SpacetimeInput scene, const SpacetimeOptions& options = SmallOptions()) :
    Input(std::move(scene))
  {
    const Result result = MakeSetup(this->Input, options, this->Setup);
    EXPECT_TRUE(result) << result.Message();
  }
  SpacetimeInput Input;
  SpacetimeSetup Setup;
};

// Largest relative error of the gradient along some directions against central differences.
double GradientError(const SpacetimeSetup& setup, const TimeLevel& level, double step)
{
  const SpacetimeModel& model = setup.Model;
  SpacetimeObjective objective(model, model.Fields, level, SerialFor(), FastestSphKernels());
  const StateVector full = Disturbed(setup, 0.05);
  StateVector state(level.NumberOfFrames() * model.FrameSize());
  for (std::size_t j = 0; j < level.NumberOfFrames(); ++j)
  {
    std::copy_n(full.data() + level.Frames[j] * model.FrameSize(), model.FrameSize(),
                state.data() + j * model.FrameSize());
  }
  StateVector gradient(state.size());
  SpacetimeTerms terms;
  objective.Evaluate(state, &gradient, terms);
  double worst = 0.0;
  for (int direction = 0; direction < 6; ++direction)
  {
    // Along the gradient of some kinds of unknowns: all, gas or objects, positions or velocities.
    StateVector d(state.size(), 0.0f);
    double slope = 0.0, norm = 0.0;
    for (std::size_t k = 0; k < state.size(); ++k)
    {
      const std::size_t place = k % model.FrameSize();
      const bool position = place / model.Stride() < 3;
      const bool gas = place % model.Stride() < model.NumberOfGas;
      const bool taken = direction == 0 || (direction == 1 && gas && position) ||
                         (direction == 2 && gas && !position) ||
                         (direction == 3 && !gas && position) ||
                         (direction == 4 && !gas && !position) || (direction == 5 && position);
      d[k] = taken ? gradient[k] : 0.0f;
      norm += static_cast<double>(d[k]) * d[k];
    }
    const double scale = step / std::sqrt(norm / static_cast<double>(state.size()));
    StateVector plus = state, minus = state;
    for (std::size_t k = 0; k < state.size(); ++k)
    {
      plus[k] = state[k] + static_cast<float>(scale * d[k]);
      minus[k] = state[k] - static_cast<float>(scale * d[k]);
      // The step that was really taken, after rounding.
      slope += static_cast<double>(gradient[k]) * (double(plus[k]) - double(minus[k]));
    }
    SpacetimeTerms high, low;
    objective.Evaluate(plus, nullptr, high);
    objective.Evaluate(minus, nullptr, low);
    worst = std::max(worst, std::abs((high.E - low.E) / slope - 1.0));
  }
  return worst;
}

} // namespace

TEST(SpacetimeObjective, GradientEqualsCentralDifferencesTermByTerm)
{
  SceneOptions scene;
  scene.NumberOfFrames = 8;
  for (int term = 0; term < 7; ++term)
  {
    SpacetimeOptions options = SmallOptions();
    options.PositionWeight = term == 0 || term >= 4 ? 10.0 : 1e-6;
    options.VelocityWeight = term == 1 || term >= 4 ? 1.0 : 1e-6;
    options.CoherenceWeight = term >= 2 ? 0.5 : 0.0;
    options.SpatialShare = term == 2 ? 1.0 : (term == 3 ? 0.0 : 0.5);
    options.TemporalWindow = term == 5 ? 3 : 1;
    options.XsphFactor = term == 6 ? 0.3 : 0.0;
    options.PressureExponent = term == 6 ? 7.0 : 1.0;
    Problem problem(MakeScene(scene), options);
    const double error = GradientError(
      problem.Setup, TimeLevel::Full(scene.NumberOfFrames, options.TemporalWindow), 5e-4);
    EXPECT_LT(error, 2e-3) << "term " << term;
  }
}

TEST(SpacetimeObjective, GradientHoldsOnUnevenLevelsWithObstaclesRestAndWinds)
{
  SceneOptions scene;
  scene.NumberOfFrames = 20;
  scene.Land = true;
  SpacetimeInput input = MakeScene(scene);
  AddPillar(input);
  input.Wind.Meaning = FieldMeaning::Velocity;
  input.Wind.Dimensions = { 2, 2, 2 };
  input.Wind.Origin = Vec3(-2.0, -2.0, 0.0);
  input.Wind.Spacing = Vec3::Constant(4.0);
  input.Wind.Times = { 0.0 };
  input.Wind.Values.emplace_back();
  for (int k = 0; k < 8; ++k)
  {
    input.Wind.Values[0].push_back({ 0.3f * (k & 1), 0.5f, k & 4 ? 0.4f : -0.2f });
  }
  Problem problem(std::move(input));
  problem.Setup.Model.Weights.ContactDistance = 2.0;
  const TimeLevel level = TimeLevel::Make({ 0, 2, 4, 5, 7, 9, 11, 12, 14, 16, 18, 19 }, 1);
  EXPECT_LT(GradientError(problem.Setup, level, 1e-3), 4e-3);
}
