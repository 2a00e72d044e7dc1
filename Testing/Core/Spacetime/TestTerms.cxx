// SPDX-License-Identifier: BSD-3-Clause
// Each term of E apart: its rows' tangent and adjoint and its gradient in double precision, and the
// fast objective in single precision held against them.
#include "Base/Random.h"
#include "ReferenceObjective.h"
#include "Spacetime/Energy/SpacetimeObjective.h"
#include "TermCases.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

using namespace waft;
using test::Problem;
using test::ReferenceObjective;
using test::Term;
using test::Terms;

namespace
{

using Numbers = ReferenceObjective::Numbers;

double Dot(const Numbers& a, const Numbers& b)
{
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k)
  {
    sum += a[k] * b[k];
  }
  return sum;
}

double Norm(const Numbers& a)
{
  return std::sqrt(Dot(a, a));
}

/// a + factor b.
Numbers Sum(Numbers a, double factor, const Numbers& b)
{
  for (std::size_t k = 0; k < a.size(); ++k)
  {
    a[k] += factor * b[k];
  }
  return a;
}

Numbers RandomNumbers(std::size_t size, std::uint64_t seed)
{
  Random random(seed);
  Numbers numbers(size);
  for (double& value : numbers)
  {
    value = random.Normal();
  }
  return numbers;
}

/// Of the unknowns: all, or gas or objects, places or velocities.
enum class Kind
{
  All,
  GasPlaces,
  GasVelocities,
  ObjectPlaces,
  ObjectVelocities
};
constexpr Kind Kinds[] = { Kind::All, Kind::GasPlaces, Kind::GasVelocities, Kind::ObjectPlaces,
                           Kind::ObjectVelocities };

Numbers Only(Kind kind, const SpacetimeModel& model, Numbers numbers)
{
  for (std::size_t k = 0; k < numbers.size(); ++k)
  {
    const bool isGas = k / 6 % model.NumberOfBodies() < model.NumberOfGas;
    const bool isPlace = k % 6 < 3;
    const Kind own = isGas ? (isPlace ? Kind::GasPlaces : Kind::GasVelocities)
                           : (isPlace ? Kind::ObjectPlaces : Kind::ObjectVelocities);
    numbers[k] = kind == Kind::All || kind == own ? numbers[k] : 0.0;
  }
  return numbers;
}

} // namespace

TEST(Terms, TheAdjointIsTheTransposeOfTheTangent)
{
  Problem problem;
  for (const Term& term : Terms())
  {
    term.Add(problem.Empty(), problem);
    const ReferenceObjective reference(problem.Setup.Model, problem.Level());
    const Numbers z = problem.Disturbed(reference);
    const Numbers p = RandomNumbers(z.size(), 1);
    const Numbers jp = reference.Tangent(z.data(), p);
    const Numbers u = RandomNumbers(jp.size(), 2);
    const Numbers ju = reference.Adjoint(z.data(), u);
    ASSERT_GT(Norm(jp), 1e-3) << term.Name;
    EXPECT_NEAR(Dot(jp, u), Dot(p, ju), 1e-12 * Norm(jp) * Norm(u)) << term.Name;
  }
}

TEST(Terms, TheTangentAndTheGradientEqualCentralDifferences)
{
  Problem problem;
  for (const Term& term : Terms())
  {
    term.Add(problem.Empty(), problem);
    const ReferenceObjective reference(problem.Setup.Model, problem.Level());
    const Numbers z = problem.Disturbed(reference);
    Numbers gradient(z.size());
    ASSERT_GT(reference.Evaluate(z.data(), gradient.data()), 1e-6) << term.Name;
    ASSERT_GT(Norm(gradient), 1e-4) << term.Name;
    for (const Kind kind : Kinds)
    {
      const Numbers part = Only(kind, problem.Setup.Model, gradient);
      if (Norm(part) == 0.0)
      {
        continue; // they have nothing to do with the term
      }
      // Along the gradient, so that the slope is not a small difference, and all else besides.
      const Numbers random = Only(kind, problem.Setup.Model, RandomNumbers(z.size(), 3));
      const Numbers d = Sum(part, 0.3 * Norm(part) / Norm(random), random);
      const double h = 1e-6 * std::sqrt(double(z.size())) / Norm(d);
      const Numbers high = Sum(z, h, d), low = Sum(z, -h, d);
      const double slope = Dot(gradient, d);
      const double difference =
        (reference.Evaluate(high.data(), nullptr) - reference.Evaluate(low.data(), nullptr)) /
        (2.0 * h);
      EXPECT_NEAR(difference / slope, 1.0, 1e-6) << term.Name << " " << int(kind);
      const Numbers jd = reference.Tangent(z.data(), d);
      const Numbers rows = Sum(reference.Rows(high.data()), -1.0, reference.Rows(low.data()));
      ASSERT_EQ(rows.size(), jd.size()) << term.Name;
      EXPECT_LT(Norm(Sum(jd, -0.5 / h, rows)), 1e-6 * Norm(jd)) << term.Name << " " << int(kind);
    }
  }
}

TEST(Terms, TheFastObjectiveHasTheSameCostAndGradient)
{
  Problem problem;
  for (const Term& term : Terms())
  {
    term.Add(problem.Empty(), problem);
    const SpacetimeModel& model = problem.Setup.Model;
    const TimeLevel level = problem.Level();
    const ReferenceObjective reference(model, level);
    const Numbers z = problem.Disturbed(reference);
    Numbers expected(z.size());
    const double e = reference.Evaluate(z.data(), expected.data());
    const StateVector state = reference.To(z);
    for (const SphKernelTable* table : { &PortableSphKernels(), &FastestSphKernels() })
    {
      SpacetimeObjective objective(model, model.Fields, level, SerialFor(), *table);
      SpacetimeTerms terms;
      StateVector gradient(state.size());
      ASSERT_TRUE(objective.Evaluate(state, &gradient, terms));
      EXPECT_NEAR(terms.E / e, 1.0, 2e-6) << term.Name;
      const Numbers error = Sum(reference.From(gradient), -1.0, expected);
      for (const Kind kind : Kinds)
      {
        EXPECT_LE(Norm(Only(kind, model, error)), 2e-5 * Norm(Only(kind, model, expected)))
          << term.Name << " " << table->Name << " " << int(kind);
      }
    }
  }
}

// So that what a column of the convergence falls by is what that term falls by.
TEST(Terms, EachPenaltyHasAColumnOfItsOwn)
{
  const std::vector<std::pair<std::string, double SpacetimeTerms::*>> penalties = {
    { "clearance", &SpacetimeTerms::Clearance },
    { "approach", &SpacetimeTerms::Approach },
    { "contact", &SpacetimeTerms::Contact },
    { "separation", &SpacetimeTerms::Separation },
  };
  Problem problem;
  for (const Term& term : Terms())
  {
    term.Add(problem.Empty(), problem);
    const SpacetimeModel& model = problem.Setup.Model;
    const TimeLevel level = problem.Level();
    const ReferenceObjective reference(model, level);
    SpacetimeObjective objective(model, model.Fields, level, SerialFor(), FastestSphKernels());
    SpacetimeTerms terms;
    ASSERT_TRUE(objective.Evaluate(reference.To(problem.Disturbed(reference)), nullptr, terms));
    double sum = 0.0;
    for (const auto& [name, member] : penalties)
    {
      const bool isIts = std::string(term.Name).rfind(name, 0) == 0;
      EXPECT_TRUE(isIts ? terms.*member > 0.0 : terms.*member >= 0.0) << term.Name << " " << name;
      sum += terms.*member;
    }
    EXPECT_NEAR(terms.Penalties, sum, 1e-12 * sum) << term.Name;
    const SpacetimeWeights& w = model.Weights;
    EXPECT_NEAR(terms.E,
                w.PositionWeight * terms.Ex + w.VelocityWeight * terms.Ev +
                  w.CoherenceWeight * terms.Ec + sum,
                1e-12 * terms.E)
      << term.Name;
  }
}
