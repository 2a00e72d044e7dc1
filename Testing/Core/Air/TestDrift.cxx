// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Drift/BandedMatrix.h"
#include "Air/Drift/Drift.h"
#include "Air/PlainDrift.h"
#include "Base/Random.h"
#include "Obstacles/Shapes.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>

using namespace waft;

namespace
{

constexpr int Frames = 61;

Timeline Line()
{
  return { Frames, 30.0 };
}

/// A flow of the given velocity on a lattice of 4 m.
HalfSeries Flow(const std::function<Vec3(const Vec3&, double)>& velocity, int points = 33)
{
  FieldSeries air;
  air.Meaning = FieldMeaning::Velocity;
  air.Dimensions = { points, points, points };
  air.Origin = Vec3(-2.0, -2.0, 0.0);
  air.Spacing = Vec3::Constant(4.0 / (points - 1));
  for (int f = 0; f < Frames; ++f)
  {
    air.Times.push_back(Line().Time(f));
    std::vector<std::array<float, 3>> values;
    for (int k = 0; k < points; ++k)
    {
      for (int j = 0; j < points; ++j)
      {
        for (int i = 0; i < points; ++i)
        {
          const Vec3 u =
            velocity(air.Origin + Vec3(i, j, k).cwiseProduct(air.Spacing), Line().Time(f));
          values.push_back({ float(u.x()), float(u.y()), float(u.z()) });
        }
      }
    }
    air.Values.push_back(std::move(values));
  }
  return HalfSeries(air);
}

Vec3 Swirl(const Vec3& x, double t)
{
  return { -0.8 * x.y() + 0.2 * std::sin(3.0 * t), 0.8 * x.x(), 0.3 * std::sin(2.0 * x.x() + t) };
}

DriftProblem Free(const Vec3& start)
{
  DriftProblem problem;
  problem.Time = Line();
  problem.Law = BodyLaw::Sinking(0.5);
  problem.IsFixed.assign(Frames, 0);
  problem.Fixed.assign(Frames, Vec3::Zero());
  problem.Flight.assign(Frames - 1, 1.0);
  problem.IsFixed[0] = 1;
  problem.Fixed[0] = start;
  return problem;
}

DriftProblem ToAMark()
{
  DriftProblem problem = Free(Vec3(0.5, 0.0, 3.0));
  problem.IsFixed[Frames - 1] = 1;
  problem.Fixed[Frames - 1] = Vec3(-0.6, 0.4, 1.5);
  return problem;
}

/// A mark on a floor, that the body comes to rest on at a frame and lies on from then on.
struct ToAFloor
{
  static constexpr int TouchDown = Frames - 7;

  explicit ToAFloor(double response)
  {
    ObstacleMesh floor;
    floor.Mesh = MakeBox({ Vec3(-2.0, -2.0, 0.0), Vec3(2.0, 2.0, 1.5) });
    EXPECT_TRUE(this->Obstacles.Build({ floor }));
    LandingWindow landing;
    landing.ObstacleId = floor.ObstacleId;
    landing.Frame = TouchDown;
    landing.First = landing.Frame - 30.0;
    this->Problem = ToAMark();
    this->Problem.Fixed.front().z() = 2.4;
    this->Problem.Fixed.back().z() = 1.51;
    this->Problem.ResponseTime = response;
    for (std::size_t f = TouchDown; f < Frames; ++f)
    {
      this->Problem.IsFixed[f] = 1;
      this->Problem.Fixed[f] = this->Problem.Fixed.back();
    }
    std::fill(this->Problem.Flight.begin() + TouchDown, this->Problem.Flight.end(), 0.0);
    MotionObject body;
    body.RestHeight = 0.01;
    body.SettlingSpeed = this->Problem.Law.SettlingSpeed();
    this->Problem.Ground = GroundEffect(this->Obstacles, { landing }, body, 30.0, nullptr);
  }
  ObstacleSet Obstacles;
  DriftProblem Problem;
};

std::vector<Vec3> StraightIn(const DriftProblem& problem)
{
  std::vector<Vec3> path;
  for (int f = 0; f < Frames; ++f)
  {
    const double s = f / (Frames - 1.0);
    path.push_back((1.0 - s) * problem.Fixed.front() + s * problem.Fixed.back());
  }
  return path;
}

class BandedMatrixOf : public ::testing::TestWithParam<std::size_t>
{
};

TEST_P(BandedMatrixOf, FourSideBySideAreTheSameBitsAsEachAlone)
{
  constexpr std::size_t n = 45;
  const std::size_t band = this->GetParam();
  Random random(5);
  Banded<FourDoubles> four(n, band);
  std::vector<BandedMatrix> alone(4, BandedMatrix(n, band));
  std::vector<FourDoubles> x(n);
  std::vector<std::vector<double>> own(4, std::vector<double>(n));
  for (std::size_t i = 0; i < n; ++i)
  {
    for (std::size_t b = 0; b < 4; ++b)
    {
      for (std::size_t j = i > band ? i - band : 0; j <= i; ++j)
      {
        const double entry =
          i == j ? 2.0 * double(band) + random.Uniform() : random.Uniform(-1.0, 1.0);
        four.At(i, j).Of[b] = alone[b].At(i, j) = entry;
      }
      x[i].Of[b] = own[b][i] = random.Normal();
    }
  }
  ASSERT_TRUE(four.Factor());
  four.Solve(x);
  for (std::size_t b = 0; b < 4; ++b)
  {
    ASSERT_TRUE(alone[b].Factor());
    alone[b].Solve(own[b]);
    for (std::size_t i = 0; i < n; ++i)
    {
      EXPECT_EQ(x[i].Of[b], own[b][i]) << b << " " << i;
    }
  }
}

TEST_P(BandedMatrixOf, SolvesAsADenseOneDoes)
{
  constexpr std::size_t n = 40;
  const std::size_t band = this->GetParam();
  Random random(3);
  Eigen::MatrixXd root = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t i = 0; i < n; ++i)
  {
    for (std::size_t j = i > band ? i - band : 0; j <= i; ++j)
    {
      root(i, j) = i == j ? 3.0 + random.Uniform() : random.Uniform(-0.5, 0.5);
    }
  }
  const Eigen::MatrixXd dense = root * root.transpose();
  BandedMatrix banded(n, band);
  std::vector<double> b;
  for (std::size_t i = 0; i < n; ++i)
  {
    for (std::size_t j = i > band ? i - band : 0; j <= i; ++j)
    {
      banded.At(i, j) = dense(i, j);
    }
    b.push_back(random.Normal());
  }
  const Eigen::VectorXd expected =
    dense.ldlt().solve(Eigen::Map<const Eigen::VectorXd>(b.data(), n));
  ASSERT_TRUE(banded.Factor());
  banded.Solve(b);
  for (std::size_t i = 0; i < n; ++i)
  {
    EXPECT_NEAR(b[i], expected[i], 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Bands, BandedMatrixOf, ::testing::Values(1, 2, 8, 11, 39));

TEST(BandedMatrix, SaysWhatIsNotPositive)
{
  BandedMatrix indefinite(2, 1);
  indefinite.At(0, 0) = -1.0;
  indefinite.At(1, 1) = 1.0;
  EXPECT_FALSE(indefinite.Factor());
  for (const std::size_t at : { 3U, 25U, 39U }) // by the usual band's own way, and in its last rows
  {
    BandedMatrix large(40, 8);
    for (std::size_t i = 0; i < 40; ++i)
    {
      large.At(i, i) = i == at ? -1.0 : 1.0;
    }
    EXPECT_FALSE(large.Factor()) << at;
  }
  Banded<FourDoubles> four(40, 8);
  for (std::size_t i = 0; i < 40; ++i)
  {
    four.At(i, i).Of = { 1.0, 1.0, i == 25 ? 0.0 : 1.0, 1.0 };
  }
  EXPECT_FALSE(four.Factor()) << "one of them is enough";
}

TEST(AirSampler, IsTrilinearBetweenFramesWithItsGradient)
{
  const auto linear = [](const Vec3& x, double t)
  { return Vec3(0.25 * x.x() - x.z() + t, 2.0 * x.y(), x.x() + 0.5 * x.z() - 2.0 * t); };
  const HalfSeries air = Flow(linear, 9);
  const FieldSeries floats = Unpacked(air);
  const AirSampler sampler(air);
  const Vec3 x(0.37, -1.21, 2.9);
  Mat3 gradient;
  const Vec3 between = sampler.Between(10, x, &gradient);
  EXPECT_LT((between - floats.Sample(x, 10.5 / 30.0)).norm(), 1e-6);
  EXPECT_LT((between - linear(x, 10.5 / 30.0)).norm(), 3e-3); // as half floats go
  Mat3 expected;
  expected << 0.25, 0.0, -1.0, 0.0, 2.0, 0.0, 1.0, 0.0, 0.5;
  EXPECT_LT((gradient - expected).norm(), 1e-2);
  EXPECT_LT((sampler.At(7, x) - floats.Sample(x, 7.0 / 30.0)).norm(), 1e-6);
  // Beyond the lattice the value at its end, which does not change across it.
  const Vec3 outside = sampler.Between(10, Vec3(5.0, 0.0, 1.0), &gradient);
  EXPECT_LT((outside - floats.Sample(Vec3(2.0, 0.0, 1.0), 10.5 / 30.0)).norm(), 1e-6);
  EXPECT_EQ(gradient.col(0).norm(), 0.0);
}

TEST(Drift, NeedsNoControlWhereNothingIsWanted)
{
  const HalfSeries air = Flow(Swirl);
  const FieldSeries floats = Unpacked(air);
  for (const Vec3& slip : { Vec3(0.0, 0.0, 0.5), Vec3(0.2, -0.1, 0.5) }) // straight down, gliding
  {
    DriftProblem problem = Free(Vec3(0.5, 0.2, 3.0));
    problem.Law.Slip = slip;
    std::vector<Vec3> path(Frames, Vec3(0.5, 0.2, 3.0));
    (void)SolveDrift(problem, AirSampler(air), {}, 100, path);
    EXPECT_LT(ControlInFlight(problem, AirSampler(air), path), 1e-6);
    // As a Runge-Kutta tracer goes.
    Vec3 x = path[0];
    const double dt = Line().Step();
    const auto velocity = [&](const Vec3& at, double t)
    { return Vec3(floats.Sample(at, t) - slip); };
    for (int f = 0; f + 1 < Frames; ++f)
    {
      const double t = Line().Time(f);
      const Vec3 k1 = velocity(x, t);
      const Vec3 k2 = velocity(x + 0.5 * dt * k1, t + 0.5 * dt);
      const Vec3 k3 = velocity(x + 0.5 * dt * k2, t + 0.5 * dt);
      x += dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + velocity(x + dt * k3, t + dt));
    }
    EXPECT_LT((path.back() - x).norm(), 2e-3);
  }
}

// As a fine integration of T v' = w - v goes, and where the control is given as a wind forward in
// time to the mark that it was found for.
TEST(Drift, OfABodyWithInertiaIsReplayedForward)
{
  const HalfSeries air = Flow(Swirl);
  const FieldSeries floats = Unpacked(air);
  const double dt = Line().Step();
  for (const double response : { 0.005, 0.05, 0.2 })
  {
    DriftProblem problem = Free(Vec3(0.5, 0.2, 3.0));
    problem.ResponseTime = response;
    std::vector<Vec3> path(Frames, Vec3(0.5, 0.2, 3.0));
    (void)SolveDrift(problem, AirSampler(air), {}, 100, path);
    EXPECT_LT(ControlInFlight(problem, AirSampler(air), path), 1e-6);
    const Vec3 slip = problem.Law.Slip;
    const auto given = [&](const Vec3& at, double t) { return Vec3(floats.Sample(at, t) - slip); };
    constexpr int Fine = 100;
    const double h = dt / Fine;
    Vec3 x = path[0], v = (path[1] - path[0]) / dt;
    for (int k = 0; k + 1 < Frames; ++k)
    {
      for (int s = 0; s < Fine; ++s)
      {
        const double t = Line().Time(k) + (s + 0.5) * h;
        const double kept = std::exp(-h / response);
        const Vec3 w = given(x + 0.5 * h * v, t);
        const Vec3 next = kept * v + (1.0 - kept) * w;
        x += 0.5 * h * (v + next);
        v = next;
      }
    }
    EXPECT_LT((path.back() - x).norm(), 5e-3) << response;

    DriftProblem asked = ToAMark();
    asked.ResponseTime = response;
    std::vector<Vec3> flown = StraightIn(asked);
    (void)SolveDrift(asked, AirSampler(air), {}, 100, flown);
    const std::vector<Vec3> controls = DriftControls(asked, AirSampler(air), flown);
    const double e = std::exp(-dt / response);
    const double now = 1.0 - response / dt * (1.0 - e);
    Vec3 at = flown[1], velocity = (flown[1] - flown[0]) / dt;
    Vec3 before = given(0.5 * (flown[0] + flown[1]), 0.5 * dt);
    for (int k = 1; k + 1 < Frames; ++k)
    {
      Vec3 next = velocity, there;
      for (int i = 0; i < 20; ++i)
      {
        there = given(at + 0.5 * dt * next, (k + 0.5) * dt);
        next = e * velocity + (1.0 - e - now) * before + now * there + (1.0 - e) * controls[k];
      }
      velocity = next;
      before = there;
      at += dt * velocity;
    }
    EXPECT_LT((at - asked.Fixed.back()).norm(), 1e-4) << response;
  }
}

TEST(Drift, EndsWhereNoChangeCostsLess)
{
  const HalfSeries air = Flow(Swirl);
  const DriftWeights weights;
  for (const double response : { 0.0, 0.05 })
  {
    DriftProblem problem = ToAMark();
    problem.ResponseTime = response;
    std::vector<Vec3> path = StraightIn(problem);
    const DriftOutcome outcome = SolveDrift(problem, AirSampler(air), weights, 200, path);
    EXPECT_EQ(path.front(), problem.Fixed.front());
    EXPECT_EQ(path.back(), problem.Fixed.back());
    EXPECT_GT(ControlInFlight(problem, AirSampler(air), path), 0.05);
    const double least = PlainDriftCost(problem, Unpacked(air), weights, path);
    EXPECT_NEAR(outcome.Cost, least, 1e-9);
    Random random(5);
    for (int trial = 0; trial < 50; ++trial)
    {
      std::vector<Vec3> other = path;
      const Vec3 way = 0.01 * random.Direction();
      const int waves = 1 + static_cast<int>(random.Index(8));
      for (int f = 1; f + 1 < Frames; ++f)
      {
        other[f] += std::sin(M_PI * waves * f / (Frames - 1.0)) * way;
      }
      EXPECT_GT(PlainDriftCost(problem, Unpacked(air), weights, other), least - 1e-9);
    }
  }
}

TEST(Drift, ComesToWhatTheDenseMethodComesTo)
{
  const HalfSeries air = Flow(Swirl);
  for (const double response : { 0.0, 0.05 })
  {
    DriftProblem problem = ToAMark();
    problem.ResponseTime = response;
    std::vector<Vec3> path = StraightIn(problem);
    std::vector<Vec3> plain = path;
    const double cost = SolveDrift(problem, AirSampler(air), {}, 60, path).Cost;
    EXPECT_NEAR(PlainSolveDrift(problem, Unpacked(air), {}, 25, plain) / cost, 1.0, 1e-3);
    double apart = 0.0;
    for (int f = 0; f < Frames; ++f)
    {
      apart = std::max(apart, (path[f] - plain[f]).norm());
    }
    EXPECT_LT(apart, 0.01);
  }
}

// The last frames are the ground's, not a hand's.
TEST(Drift, ComesToRestByTheGroundEffect)
{
  const HalfSeries air = Flow(Swirl);
  for (const double response : { 0.0, 0.05 })
  {
    const ToAFloor scene(response);
    const DriftProblem& problem = scene.Problem;
    std::vector<Vec3> path = StraightIn(problem);
    const DriftOutcome outcome = SolveDrift(problem, AirSampler(air), {}, 200, path);
    EXPECT_NEAR(outcome.Cost, PlainDriftCost(problem, Unpacked(air), {}, path), 1e-9);
    std::vector<Vec3> plain = StraightIn(problem);
    EXPECT_NEAR(PlainSolveDrift(problem, Unpacked(air), {}, 60, plain) / outcome.Cost, 1.0, 1e-2);
    constexpr int down = ToAFloor::TouchDown;
    const double last = 30.0 * (path[down - 1] - path[down]).z();
    EXPECT_LT(last, 0.7 * problem.Law.SettlingSpeed());
    EXPECT_FALSE(IsFreeStep(problem, path, down - 1));
    EXPECT_TRUE(IsFreeStep(problem, path, Frames / 2));
    EXPECT_FALSE(IsFreeOfGround(problem, path, down - 1));
    EXPECT_TRUE(IsFreeOfGround(problem, path, Frames / 2));
    const std::vector<Vec3> controls = DriftControls(problem, AirSampler(air), path);
    double largest = 0.0;
    for (std::size_t k = down - 4; k < down; ++k)
    {
      largest = std::max(largest, controls[k].norm());
    }
    EXPECT_LT(largest, 2.0 * ControlInFlight(problem, AirSampler(air), path));
  }
}

TEST(Drift, KeepsToBallsVelocitiesAndBarriers)
{
  const HalfSeries air = Flow(Swirl);
  DriftProblem problem = ToAMark();
  problem.Rows.push_back({ { { 30, 1.0 } }, Vec3(1.0, 1.0, 2.0), 0.1 });
  problem.Rows.push_back({ { { 44, -15.0 }, { 46, 15.0 } }, Vec3(0.4, 0.0, -0.2), 0.0 });
  problem.TooNear = [](int, const Vec3& x, std::vector<DriftDepth>& depths)
  {
    if (x.z() < 1.4)
    {
      depths.push_back({ Vec3::UnitZ(), 1.4 - x.z() });
    }
  };
  std::vector<Vec3> path(Frames, Vec3(0.0, 0.0, 2.0));
  SolveDrift(problem, AirSampler(air), {}, 200, path);
  EXPECT_LT((path[30] - Vec3(1.0, 1.0, 2.0)).norm(), 0.1005);
  EXPECT_LT((15.0 * (path[46] - path[44]) - Vec3(0.4, 0.0, -0.2)).norm(), 0.002);
  for (const Vec3& x : path)
  {
    EXPECT_GT(x.z(), 1.4 - 0.01);
  }
}

} // namespace
