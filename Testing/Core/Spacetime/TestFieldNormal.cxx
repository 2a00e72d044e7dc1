// SPDX-License-Identifier: BSD-3-Clause
// The fields for a motion as it is: held against a dense solve, and against fields that are known.
#include "Spacetime/Fields/WindEstimate.h"
#include "Spacetime/Paper/BlockTridiagonal.h"
#include "Spacetime/Paper/ClosedCurl.h"
#include "Spacetime/Paper/FieldNormal.h"
#include "Spacetime/Paper/FieldUpdates.h"
#include "Spacetime/Paper/FieldsPart.h"
#include "Spacetime/Run/Spacetime.h"
#include "SpacetimeScenes.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace waft;

namespace
{

SpacetimeSetup GasInNoise(const SpacetimeInput& input, int gas)
{
  SpacetimeOptions options;
  options.NumberOfGasParticles = gas;
  options.NumberOfObjectParticles = 3;
  SpacetimeSetup setup;
  const Result result = MakeSetup(input, options, setup);
  EXPECT_TRUE(result) << result.Message();
  SpacetimeModel& model = setup.Model;
  std::mt19937 random(3);
  std::normal_distribution<float> noise(0.0f, 0.02f);
  for (int frame = 1; frame < model.NumberOfFrames; ++frame)
  {
    float* v = setup.Start.data() + frame * model.FrameSize() + 3 * model.Stride();
    for (std::size_t i = 0; i < 3 * model.Stride(); ++i)
    {
      v[i] += noise(random);
    }
  }
  model.Fields.Cost = FieldCost(model, model.Fields);
  return setup;
}

struct FieldProblem
{
  explicit FieldProblem(const SceneOptions& scene, int gas = 1000) :
    Input(MakeScene(scene)), Setup(GasInNoise(Input, gas)), Fields(Setup.Model.Fields),
    Level(TimeLevel::Full(Setup.Model.NumberOfFrames, 1)),
    Objective(Setup.Model, Fields, Level, ThreadedFor(2), FastestSphKernels())
  {
  }
  SpacetimeInput Input;
  SpacetimeSetup Setup;
  AirFields Fields;
  TimeLevel Level;
  SpacetimeObjective Objective;
};

SceneOptions FieldScene()
{
  SceneOptions scene;
  scene.NumberOfFrames = 40;
  return scene;
}

} // namespace

TEST(FieldNormal, BlocksAreSolvedAsADenseMatrixIs)
{
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(12, 12);
  for (int k = 0; k < 12; k += 3)
  {
    const Eigen::MatrixXd a = Eigen::MatrixXd::Random(3, 3);
    dense.block<3, 3>(k, k) = a * a.transpose() + 4.0 * Eigen::MatrixXd::Identity(3, 3);
    if (k < 9)
    {
      dense.block<3, 3>(k, k + 3).setRandom();
      dense.block<3, 3>(k + 3, k) = dense.block<3, 3>(k, k + 3).transpose().eval();
    }
  }
  const auto block = [&](std::size_t row, std::size_t column)
  {
    return Eigen::MatrixXd(
      dense.block<3, 3>(static_cast<Eigen::Index>(3 * row), static_cast<Eigen::Index>(3 * column)));
  };
  BlockTridiagonal blocks;
  blocks.NumberOfBlocks = 4;
  blocks.Diagonal = [&](std::size_t k) { return block(k, k); };
  blocks.Upper = [&](std::size_t k) { return block(k, k + 1); };
  const Eigen::MatrixXd right = Eigen::MatrixXd::Random(12, 2);
  Eigen::MatrixXd solved = right;
  blocks.Solve(solved);
  EXPECT_LT((dense * solved - right).norm(), 1e-12);
}

TEST(FieldNormal, AClosedWindHasNoDivergenceAndNothingThroughTheWalls)
{
  const Vec3 size(9.0, 12.0, 15.0);
  SplineWind wind = MakeLattice(size, LatticeDimensions(Vec3(3.0, 4.0, 5.0)), 15.0);
  const Eigen::SparseMatrix<double, Eigen::RowMajor> curl = ClosedCurl(wind);
  const Eigen::VectorXd c = curl * Eigen::VectorXd::Random(curl.cols());
  std::vector<float> knot(4 * wind.NumberOfNodes());
  for (std::size_t i = 0; i < 3 * wind.NumberOfNodes(); ++i)
  {
    knot[i / 3 * 4 + i % 3] = static_cast<float>(c[static_cast<Eigen::Index>(i)]);
  }
  wind.Knots = { knot, knot };
  const double scale = c.lpNorm<Eigen::Infinity>();
  Vec3 mean = Vec3::Zero();
  for (int i = 0; i <= 10; ++i)
  {
    for (int j = 0; j <= 10; ++j)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        Vec3 x = size.cwiseProduct(Vec3(0.1 * i, 0.1 * j, 0.05 * (i + j)));
        for (const double wall : { 0.0, size[axis] })
        {
          x[axis] = wall;
          EXPECT_NEAR(SampleField(wind, x, 3.0)[axis], 0.0, 1e-5 * scale);
        }
      }
    }
  }
  constexpr int Points = 24;
  for (int n = 0; n < Points * Points * Points; ++n)
  {
    const Vec3 s(n % Points + 0.5, n / Points % Points + 0.5, n / Points / Points + 0.5);
    mean += SampleField(wind, size.cwiseProduct(s / Points), 3.0);
  }
  EXPECT_LT(mean.norm() / (Points * Points * Points), 1e-2 * scale);
  const auto& n = wind.Dimensions;
  for (int k = 1; k + 1 < n[2]; ++k)
  {
    for (int j = 1; j + 1 < n[1]; ++j)
    {
      for (int i = 1; i + 1 < n[0]; ++i)
      {
        double divergence = 0.0;
        const int here[3] = { i, j, k };
        for (int a = 0; a < 3; ++a)
        {
          int up[3] = { here[0], here[1], here[2] };
          int down[3] = { here[0], here[1], here[2] };
          ++up[a];
          --down[a];
          divergence +=
            0.5 / wind.Spacing[a] *
            (c[static_cast<Eigen::Index>(3 * wind.Node(up[0], up[1], up[2]) + a)] -
             c[static_cast<Eigen::Index>(3 * wind.Node(down[0], down[1], down[2]) + a)]);
        }
        EXPECT_NEAR(divergence, 0.0, 1e-12);
      }
    }
  }
}

// The matrix and the right side made by trying one unknown after the other in E itself.
TEST(FieldNormal, CostsWhatEDoes)
{
  FieldProblem problem(FieldScene());
  ASSERT_FALSE(problem.Fields.Vortices.empty());
  SpacetimeTerms terms;
  problem.Objective.Evaluate(problem.Setup.Start, nullptr, terms);
  FieldNormal normal(problem.Setup.Model, problem.Fields, FieldChoice());
  ASSERT_TRUE(normal.Gather(problem.Objective, problem.Setup.Start, SerialFor()));
  const double before = terms.E - normal.Cost(problem.Fields);
  AirFields solved = problem.Fields;
  normal.Solve(solved);
  for (const double fraction : { 1.0, 0.5, -0.3 })
  {
    AirFields& fields = problem.Fields;
    fields = solved;
    for (std::size_t k = 0; k < fields.Vortices.size(); ++k)
    {
      fields.Vortices[k].Strength *= fraction;
    }
    for (std::vector<float>& knot : fields.Wind.Knots)
    {
      for (float& value : knot)
      {
        value *= static_cast<float>(fraction);
      }
    }
    fields.Cost = FieldCost(problem.Setup.Model, fields);
    problem.Objective.Evaluate(problem.Setup.Start, nullptr, terms);
    EXPECT_NEAR(terms.E - normal.Cost(fields), before, 2e-6 * before);
  }
}

TEST(FieldNormal, AgreesWithADenseSolve)
{
  SceneOptions scene;
  scene.NumberOfFrames = 20;
  FieldProblem problem(scene, 150);
  SpacetimeTerms terms;
  problem.Objective.Evaluate(problem.Setup.Start, nullptr, terms);
  FieldNormal normal(problem.Setup.Model, problem.Fields, FieldChoice());
  ASSERT_TRUE(normal.Gather(problem.Objective, problem.Setup.Start, ThreadedFor(2)));
  AirFields solved = problem.Fields;
  normal.Solve(solved);
  EXPECT_LT(normal.ScaledGradient(solved, terms.E), 1e-5);
  EXPECT_GT(normal.ScaledGradient(problem.Fields, terms.E), 1e-3);
  // Samples as rows of one dense matrix, its unknowns potential by knot, then strengths.
  const SpacetimeModel& model = problem.Setup.Model;
  const Eigen::MatrixXd curl = Eigen::MatrixXd(ClosedCurl(solved.Wind));
  const auto knots = static_cast<Eigen::Index>(solved.Wind.Knots.size());
  const Eigen::Index winds = knots * curl.cols();
  const Eigen::Index unknowns = winds + static_cast<Eigen::Index>(solved.Vortices.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(unknowns, unknowns);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns);
  for (std::size_t j = 0; j + 1 < problem.Level.NumberOfFrames(); ++j)
  {
    const double s = problem.Level.Frames[j] / solved.Wind.FramesPerKnot;
    const auto knot = std::min<Eigen::Index>(static_cast<Eigen::Index>(s), knots - 2);
    const double t = s - static_cast<double>(knot);
    for (std::size_t i = 0; i < model.NumberOfBodies(); ++i)
    {
      if (i >= model.NumberOfGas && !StepHasLaw(model, problem.Level, j + 1, i - model.NumberOfGas))
      {
        continue;
      }
      const Vec3 x =
        VectorAt(problem.Setup.Start.data() + j * model.FrameSize() + i, model.Stride());
      Vec3 target;
      problem.Objective.VelocityResidual(j + 1, i, target.data());
      Eigen::MatrixXd row = Eigen::MatrixXd::Zero(3, unknowns);
      const SplineStencil stencil = solved.Wind.Stencil(x);
      for (int n = 0; n < 27; ++n)
      {
        const double w = static_cast<double>(stencil.Weights[0][n % 3]) *
                         stencil.Weights[1][n / 3 % 3] * stencil.Weights[2][n / 9];
        const auto node = static_cast<Eigen::Index>(
          3 * solved.Wind.Node(stencil.First[0] + n % 3, stencil.First[1] + n / 3 % 3,
                               stencil.First[2] + n / 9));
        row.middleCols(knot * curl.cols(), curl.cols()) += (1.0 - t) * w * curl.middleRows(node, 3);
        row.middleCols((knot + 1) * curl.cols(), curl.cols()) += t * w * curl.middleRows(node, 3);
      }
      for (std::size_t n = 0; n < solved.Vortices.size(); ++n)
      {
        Vortex unit = problem.Fields.Vortices[n];
        target += unit.Acceleration(x, problem.Level.Frames[j]);
        unit.Strength = 1.0;
        row.col(winds + static_cast<Eigen::Index>(n)) =
          unit.Acceleration(x, problem.Level.Frames[j]);
      }
      const double weight = model.VelocityWeight(i);
      matrix.selfadjointView<Eigen::Lower>().rankUpdate(row.transpose(), weight);
      right += weight * row.transpose() * target;
    }
  }
  matrix = Eigen::MatrixXd(matrix.selfadjointView<Eigen::Lower>());
  const FieldPenalty penalty(model);
  const double mean = MeanNodeWeight(model, solved.Wind, static_cast<int>(knots));
  const Eigen::MatrixXd inSpace =
    curl.transpose() * (PenaltyInSpace(solved.Wind, penalty).OfVectors() * curl);
  const Eigen::MatrixXd square = curl.transpose() * curl;
  for (Eigen::Index k = 0; k < knots; ++k)
  {
    const auto block = [&](Eigen::Index a, Eigen::Index b)
    { return matrix.block(a * curl.cols(), b * curl.cols(), curl.cols(), curl.cols()); };
    block(k, k) += mean * inSpace;
    if (k + 1 < knots)
    {
      block(k, k) += mean * penalty.TimeSmoothing * square;
      block(k + 1, k + 1) += mean * penalty.TimeSmoothing * square;
      block(k, k + 1) -= mean * penalty.TimeSmoothing * square;
      block(k + 1, k) -= mean * penalty.TimeSmoothing * square;
    }
  }
  for (std::size_t n = 0; n < solved.Vortices.size(); ++n)
  {
    const auto at = winds + static_cast<Eigen::Index>(n);
    matrix(at, at) +=
      mean * penalty.Ridge * VortexNorm(model, solved.Wind, problem.Fields.Vortices[n]);
  }
  const Eigen::VectorXd dense = matrix.completeOrthogonalDecomposition().solve(right);
  const double cost = 0.5 * dense.dot(matrix * dense) - right.dot(dense);
  EXPECT_NEAR(normal.Cost(solved), cost, 1e-6 * std::abs(cost));
}

TEST(FieldNormal, RecoversASwirlThatTheMotionFollows)
{
  FieldProblem problem(FieldScene());
  SpacetimeModel& model = problem.Setup.Model;
  problem.Fields = AirFields();
  model.Gravities.assign(model.NumberOfObjects, 0.0f);
  model.Fluid.Viscosity = 0.0;
  const auto truth = [&](const Vec3& x)
  {
    const Vec3 s = M_PI * x.cwiseQuotient(model.Size);
    return Vec3(1e-2 *
                Vec3(std::sin(s.x()) * std::cos(s.y()) * model.Size.x(),
                     -std::cos(s.x()) * std::sin(s.y()) * model.Size.y(), 0.0) /
                model.Size.x());
  };
  StateVector& state = problem.Setup.Start;
  for (int frame = 0; frame < model.NumberOfFrames; ++frame)
  {
    for (std::size_t i = 0; i < model.NumberOfBodies(); ++i)
    {
      float* p = state.data() + frame * model.FrameSize() + i;
      const Vec3 v = frame * truth(VectorAt(p, model.Stride()));
      SetVector(p + 3 * model.Stride(), model.Stride(), v);
    }
  }
  FieldChoice choice;
  choice.Vortices = false;
  SpacetimeTerms before, terms;
  std::vector<int> dropped;
  problem.Objective.Evaluate(state, nullptr, before);
  ASSERT_TRUE(SolveFields(problem.Fields, problem.Objective, state, choice, SerialFor(), nullptr,
                          terms, dropped));
  EXPECT_LT(terms.E, before.E);
  EXPECT_LT(terms.Ev, 0.1 * before.Ev);
  double error = 0.0;
  for (const Vec3& s : { Vec3(0.3, 0.4, 0.5), Vec3(0.6, 0.7, 0.3), Vec3(0.5, 0.2, 0.8) })
  {
    const Vec3 x = s.cwiseProduct(model.Size);
    error = std::max(error, (SampleField(problem.Fields.Wind, x, 20.0) - truth(x)).norm());
  }
  EXPECT_LT(error, 0.25 * 1e-2);
}

TEST(Convergence, TellsEq2AndWhatMovesTheObjects)
{
  FieldProblem problem(FieldScene(), 300);
  SpacetimeModel& model = problem.Setup.Model;
  SpacetimeTerms terms;
  problem.Objective.Evaluate(problem.Setup.Start, nullptr, terms);
  const double weighted = terms.E2;
  model.Weights.ObjectPosition = 1.0;
  model.Weights.ObjectCoherence = 1.0;
  problem.Objective.Evaluate(problem.Setup.Start, nullptr, terms);
  const SpacetimeWeights& w = model.Weights;
  const double eq2 =
    w.PositionWeight * terms.Ex + w.VelocityWeight * terms.Ev + w.CoherenceWeight * terms.Ec;
  EXPECT_NEAR(terms.E2, eq2, 1e-9 * eq2);
  EXPECT_NEAR(weighted, eq2, 1e-9 * eq2);
  ConvergenceRow row;
  static_cast<SpacetimeTerms&>(row) = terms;
  row.SetShares(false);
  // What nothing of the model gives, from the residuals.
  double none = 0.0, noneSquared = 0.0, vorticesSquared = 0.0;
  for (std::size_t j = 0; j + 1 < problem.Level.NumberOfFrames(); ++j)
  {
    for (std::size_t o = 0; o < model.NumberOfObjects; ++o)
    {
      const std::size_t i = model.NumberOfGas + o;
      const float* v = problem.Setup.Start.data() + j * model.FrameSize() + 3 * model.Stride() + i;
      Vec3 rv;
      problem.Objective.VelocityResidual(j + 1, i, rv.data());
      if (StepHasLaw(model, problem.Level, j + 1, o))
      {
        none +=
          rv.dot(VectorAt(v + model.FrameSize(), model.Stride()) - VectorAt(v, model.Stride()));
        noneSquared += rv.squaredNorm();
        Vec3 swirl = Vec3::Zero();
        for (const Vortex& vortex : problem.Fields.Vortices)
        {
          swirl += vortex.Acceleration(VectorAt(v - 3 * model.Stride(), model.Stride()),
                                       problem.Level.Frames[j]);
        }
        vorticesSquared += swirl.squaredNorm();
      }
    }
  }
  EXPECT_GT(terms.Motion, 0.0);
  EXPECT_NEAR(row.ShareNone, none / terms.Motion, 1e-4);
  EXPECT_NEAR(row.NoneSquared, noneSquared, 1e-4 * noneSquared);
  EXPECT_NEAR(row.VorticesSquared, vorticesSquared, 1e-4 * vorticesSquared);
  EXPECT_NE(row.ShareVortices, 0.0);
  row.SetShares(true);
  EXPECT_TRUE(std::isnan(row.ShareNone) && std::isnan(row.E2));
}

TEST(VorticesPart, IsWhatEvOfTheObjectsRisesByWithoutThem)
{
  FieldProblem problem(FieldScene(), 300);
  const StateVector& state = problem.Setup.Start;
  SpacetimeTerms terms;
  problem.Objective.Evaluate(state, nullptr, terms);
  FieldNormal both(problem.Setup.Model, problem.Fields, FieldChoice());
  ASSERT_TRUE(both.Gather(problem.Objective, state, SerialFor()));
  ASSERT_TRUE(both.Solve(problem.Fields));
  problem.Objective.Evaluate(state, nullptr, terms);
  const double with = terms.EvObjects;
  const double part = PartOfVortices(problem.Objective, state, true, SerialFor());
  const double partOfAll = PartOfVortices(problem.Objective, state, false, SerialFor());
  // The same by E itself, of each air one after the other.
  problem.Fields.Vortices.clear();
  problem.Objective.Evaluate(state, nullptr, terms);
  const double sameWind = terms.EvObjects;
  FieldChoice wind;
  wind.Vortices = false;
  FieldNormal alone(problem.Setup.Model, problem.Fields, wind);
  ASSERT_TRUE(alone.Gather(problem.Objective, state, SerialFor()));
  ASSERT_TRUE(alone.Solve(problem.Fields));
  problem.Objective.Evaluate(state, nullptr, terms);
  const double otherWind = terms.EvObjects;
  problem.Fields.Wind = SplineWind();
  problem.Objective.Evaluate(state, nullptr, terms);
  EXPECT_NEAR(part, (otherWind - with) / terms.EvObjects, 1e-4);
  EXPECT_NEAR(partOfAll, (sameWind - with) / terms.EvObjects, 1e-4);
  EXPECT_NE(otherWind, sameWind);
  EXPECT_EQ(PartOfVortices(problem.Objective, state, true, SerialFor()), 0.0); // there are none
}

// Fields that say something of the air say it of bodies, too, that they were not solved for.
TEST(FieldNormal, ExplainsBodiesThatAreLeftOut)
{
  SceneOptions scene;
  scene.NumberOfFrames = 90;
  const SpacetimeInput input = MakeScene(scene);
  SpacetimeOptions options;
  options.NumberOfGasParticles = 1000;
  options.NumberOfObjectParticles = 3;
  options.MaximumNumberOfIterations = 30;
  options.LeashIterations = 5;
  SpacetimeOutput output;
  const SolverState last = LastState(input, options, output);
  SpacetimeSetup setup;
  ASSERT_TRUE(MakeSetup(input, options, setup));
  const SpacetimeModel& model = setup.Model;
  const TimeLevel level = TimeLevel::Full(model.NumberOfFrames, 1);
  AirFields fields = last.Fields;
  const StateVector& state = last.Motion;
  SpacetimeObjective objective(model, fields, level, ThreadedFor(2), FastestSphKernels());
  SpacetimeTerms terms;
  objective.Evaluate(state, nullptr, terms);
  const auto isLeftOut = [&](std::size_t body)
  { return (body < model.NumberOfGas ? body : body - model.NumberOfGas) % 5 == 2; };
  FieldChoice choice;
  choice.Counts = [&](std::size_t body) { return !isLeftOut(body); };
  FieldNormal normal(model, fields, choice);
  ASSERT_TRUE(normal.Gather(objective, state, ThreadedFor(2)));
  AirFields solved = fields;
  ASSERT_TRUE(normal.Solve(solved));
  // Of what is asked of the fields, by those that counted and those that did not.
  double asked[2] = { 0.0, 0.0 }, left[2] = { 0.0, 0.0 };
  const auto field = [](const AirFields& of, const Vec3& x, int frame)
  {
    Vec3 sum = SampleField(of.Wind, x, frame);
    for (const Vortex& vortex : of.Vortices)
    {
      sum += vortex.Acceleration(x, frame);
    }
    return sum;
  };
  for (std::size_t j = 0; j + 1 < level.NumberOfFrames(); ++j)
  {
    for (std::size_t i = 0; i < model.NumberOfBodies(); ++i)
    {
      if (i >= model.NumberOfGas && !StepHasLaw(model, level, j + 1, i - model.NumberOfGas))
      {
        continue;
      }
      const Vec3 x = VectorAt(state.data() + j * model.FrameSize() + i, model.Stride());
      Vec3 target;
      objective.VelocityResidual(j + 1, i, target.data());
      target += field(fields, x, level.Frames[j]);
      const int group = isLeftOut(i) ? 1 : 0;
      asked[group] += model.BodyWeight(i) * target.squaredNorm();
      left[group] +=
        model.BodyWeight(i) * (target - field(solved, x, level.Frames[j])).squaredNorm();
    }
  }
  const double counted = 1.0 - left[0] / asked[0];
  const double others = 1.0 - left[1] / asked[1];
  std::printf("[ figure ] explained of those that count %.3f, of those left out %.3f\n", counted,
              others);
  EXPECT_GT(others, 0.68 * counted); // 0.70, and 0.697 where sums go in another order
  const FieldsPart part = PartOfFields(objective, state, FieldChoice(), ThreadedFor(2));
  EXPECT_NEAR(part.All[0], counted, 1e-9);
  EXPECT_NEAR(part.All[1], others, 1e-9);
  EXPECT_EQ(PartOfFields(objective, state, FieldChoice(), SerialFor()).All, part.All);
  EXPECT_LT(part.All[0], std::max(part.Objects[0], part.Gas[0]));
}

// More coefficients, and such as cost less, explain more of what they are solved for.
TEST(FieldNormal, FinerLatticesAndSmallerRidgesExplainMore)
{
  FieldProblem problem(FieldScene(), 300);
  const StateVector& state = problem.Setup.Start;
  SpacetimeModel& model = problem.Setup.Model;
  SpacetimeTerms terms;
  problem.Objective.Evaluate(state, nullptr, terms);
  const auto explained = [&](int cells, double ridge)
  {
    model.WindNodes = WindLatticeOf(problem.Input.Scene.Bounds.Size(), cells);
    model.FieldRidge = ridge;
    return PartOfFields(problem.Objective, state, FieldChoice(), SerialFor()).All[0];
  };
  const double usual = explained(5, 0.05);
  EXPECT_GT(usual, 0.0);
  EXPECT_GT(explained(5, 0.005), usual);
  EXPECT_GT(explained(8, 0.05), usual);
  EXPECT_LT(explained(5, 5.0), usual);
}
