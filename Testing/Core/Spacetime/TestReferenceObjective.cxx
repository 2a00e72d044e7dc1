// SPDX-License-Identifier: BSD-3-Clause
// The fast objective and the solver against double precision and against Ceres.
#include "Base/Random.h"
#include "CeresRun.h"
#include "ReferenceObjective.h"
#include "Spacetime/Energy/SpacetimeObjective.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace waft;
using test::ReferenceObjective;

namespace
{

StandardProblem SmallProblem(int frames, int objects, const std::array<int, 3>& gas)
{
  StandardProblem problem;
  problem.NumberOfFrames = frames;
  problem.NumberOfObjects = objects;
  problem.ParticlesPerObject = 2;
  problem.Gas = gas;
  problem.Build();
  return problem;
}

std::vector<double> Disturbed(const StandardProblem& problem, double size)
{
  std::vector<double> z = ReferenceObjective(problem.Setup.Model).From(problem.Setup.Start);
  Random random(4);
  for (double& value : z)
  {
    value += size * random.Normal();
  }
  return z;
}

} // namespace

TEST(SpacetimeObjective, EqualsTheReference)
{
  const StandardProblem problem = SmallProblem(6, 4, { 5, 5, 5 });
  const ReferenceObjective reference(problem.Setup.Model);
  std::vector<double> z = Disturbed(problem, 0.06);
  const StateVector state = reference.To(z);
  z = reference.From(state);
  std::vector<double> expected(z.size());
  const double e = reference.Evaluate(z.data(), expected.data());
  const TimeLevel level = TimeLevel::Full(problem.Setup.Model.NumberOfFrames, 1);
  for (const SphKernelTable* table : { &PortableSphKernels(), &FastestSphKernels() })
  {
    SpacetimeObjective objective(problem.Setup.Model, problem.Setup.Model.Fields, level,
                                 SerialFor(), *table);
    SpacetimeTerms terms;
    StateVector gradient(state.size());
    ASSERT_TRUE(objective.Evaluate(state, &gradient, terms));
    EXPECT_NEAR(terms.E / e, 1.0, 1e-5);
    const std::vector<double> found = reference.From(gradient);
    double error = 0.0, scale = 0.0;
    for (std::size_t k = 0; k < found.size(); ++k)
    {
      error += (found[k] - expected[k]) * (found[k] - expected[k]);
      scale += expected[k] * expected[k];
    }
    EXPECT_LT(std::sqrt(error / scale), 2e-5) << table->Name;
  }
}

TEST(SpacetimeObjective, PushesGasThatIsTooNearApart)
{
  StandardProblem problem = SmallProblem(2, 1, { 4, 4, 4 });
  problem.Setup.Model.Weights.Separation = 0.0;
  StateVector state = problem.Setup.Start;
  for (int c = 0; c < 3; ++c)
  {
    float* row = state.data() + c * problem.Setup.Model.Stride();
    row[20] = row[21] + (c == 0 ? 0.2f : 0.05f);
  }
  const TimeLevel level = TimeLevel::Full(2, 1);
  const auto evaluate = [&](double weight, const StateVector& x, StateVector& gradient)
  {
    problem.Setup.Model.Weights.Separation = weight;
    SpacetimeObjective objective(problem.Setup.Model, problem.Setup.Model.Fields, level,
                                 SerialFor(), FastestSphKernels());
    SpacetimeTerms terms;
    objective.Evaluate(x, &gradient, terms);
    return terms;
  };
  StateVector without(state.size()), with(state.size());
  EXPECT_EQ(evaluate(0.0, state, without).Penalties, 0.0);
  const double r = std::sqrt(0.2 * 0.2 + 2.0 * 0.05 * 0.05);
  const double depth = problem.Setup.Model.Weights.GasDistance - r;
  ASSERT_GT(depth, 0.1);
  EXPECT_NEAR(evaluate(50.0, state, with).Penalties, 25.0 * depth * depth, 1e-4);
  const std::size_t x = 20;
  EXPECT_NEAR(with[x] - without[x], -50.0 * depth * 0.2 / r, 1e-3);
  EXPECT_NEAR(with[21] - without[21], 50.0 * depth * 0.2 / r, 1e-3);
  EXPECT_EQ(evaluate(50.0, problem.Setup.Start, with).Penalties, 0.0);
}

TEST(SpacetimeObjective, VanishesOnARollout)
{
  StandardProblem problem = SmallProblem(20, 3, { 6, 6, 6 });
  SpacetimeModel& model = problem.Setup.Model;
  model.Weights.CoherenceWeight = 0.0;
  const TimeLevel level = TimeLevel::Full(model.NumberOfFrames, 1);
  SpacetimeObjective objective(model, model.Fields, level, SerialFor(), FastestSphKernels());
  StateVector state = problem.Setup.Start;
  SpacetimeTerms terms;
  objective.Evaluate(state, nullptr, terms);
  const double start = terms.E;
  const std::size_t s = model.Stride();
  for (int j = 0; j + 1 < model.NumberOfFrames; ++j)
  {
    FrameTerms& frame = objective.ForwardFrame(state, j);
    const float* here = state.data() + j * model.FrameSize();
    float* next = state.data() + (j + 1) * model.FrameSize();
    for (int c = 0; c < 3; ++c)
    {
      for (std::size_t i = 0; i < model.NumberOfBodies(); ++i)
      {
        const float v = here[(3 + c) * s + i] + frame.Acceleration(c)[i];
        next[(3 + c) * s + i] = v;
        next[c * s + i] =
          here[c * s + i] + v + static_cast<float>(model.Weights.XsphFactor) * frame.Average(c)[i];
      }
    }
  }
  objective.Evaluate(state, nullptr, terms);
  EXPECT_GT(start, 1e-2);
  EXPECT_LT(terms.E, 1e-9 * start); // rounding of single precision
}

TEST(Lbfgs, ReachesTheCostOfCeresOrLower)
{
  for (const std::uint64_t seed : { 1, 2 })
  {
    StandardProblem problem;
    problem.Seed = seed;
    problem.NumberOfFrames = 11;
    problem.NumberOfObjects = 3;
    problem.ParticlesPerObject = 2;
    problem.Gas = { 3, 3, 3 };
    problem.Build();
    const CeresComparison result = CompareWithCeres(problem, 400, 400, SerialFor());
    EXPECT_LE(result.Waft.Cost, result.Ceres.Cost) << "seed " << seed;
    EXPECT_LT(result.Ceres.Cost, 0.5 * result.Start);
  }
}
