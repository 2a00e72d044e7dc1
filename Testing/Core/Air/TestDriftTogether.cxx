// SPDX-License-Identifier: BSD-3-Clause
// Bodies that touch, solved as one problem: against a plain sum of costs, and on two threads.
#include "Air/Drift/DriftTogether.h"
#include "Air/Drift/FourDrifts.h"
#include "Air/PlainDrift.h"
#include "Base/Random.h"
#include "Base/ThreadRanks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

using namespace waft;

namespace
{

constexpr int Frames = 46;
constexpr int Count = 4;
constexpr int Mark = 30;
constexpr double Radius = 0.1; // m, of each body
constexpr double Apart = 0.08; // m, of neighbouring marks

/// Bodies in a row that drift to marks nearer to each other than they are wide, in a slow swirl.
struct Crowd
{
  HalfSeries Air;
  std::vector<TogetherBody> Bodies;
  KeptDistances Kept{ 30.0 };
  std::vector<std::vector<Vec3>> Paths;

  explicit Crowd(bool lastStays = false, int count = Count) :
    Bodies(static_cast<std::size_t>(count))
  {
    FieldSeries air;
    air.Meaning = FieldMeaning::Velocity;
    air.Dimensions = { 9, 9, 9 };
    air.Origin = Vec3(-2.0, -2.0, 0.0);
    air.Spacing = Vec3::Constant(0.5);
    for (int f = 0; f < Frames; ++f)
    {
      air.Times.push_back(f / 30.0);
      air.Values.emplace_back();
      for (int p = 0; p < 729; ++p)
      {
        const float x = -2.0f + 0.5f * float(p % 9), y = -2.0f + 0.5f * float(p / 9 % 9);
        air.Values.back().push_back({ -0.3f * y, 0.3f * x, 0.1f * std::sin(x + 0.1f * float(f)) });
      }
    }
    this->Air = HalfSeries(air);
    for (int o = 0; o < count; ++o)
    {
      DriftProblem problem;
      problem.Time = { Frames, 30.0 };
      problem.Law = BodyLaw::Sinking(0.5);
      problem.IsFixed.assign(Frames, 0);
      problem.Fixed.assign(Frames, Vec3::Zero());
      problem.Flight.assign(Frames - 1, 1.0);
      problem.IsFixed[0] = problem.IsFixed[Mark] = 1;
      problem.Fixed[0] = Vec3(0.12 * o - 0.2, 0.02 * o, 2.5);
      problem.Fixed[Mark] = Vec3(Apart * o - 0.1, 0.0, 2.0);
      this->Kept.AddBody(Radius, 0.5, Frames,
                         { { 0, problem.Fixed[0] }, { Mark, problem.Fixed[Mark] } });
      this->Paths.emplace_back();
      for (int f = 0; f < Frames; ++f)
      {
        const double s = f / double(Mark);
        this->Paths.back().push_back((1.0 - s) * problem.Fixed[0] + s * problem.Fixed[Mark]);
      }
      if (!lastStays || o + 1 < count)
      {
        this->Bodies[std::size_t(o)].Problem = std::make_unique<DriftProblem>(problem);
      }
    }
  }

  std::vector<DriftContact> Contacts(const ParallelFor& parallel = SerialFor()) const
  {
    return FindContacts(this->Kept, this->Paths, 1.0, parallel);
  }

  double PlainCost(const std::vector<DriftContact>& contacts,
                   const std::vector<std::vector<Vec3>>& paths) const
  {
    double cost = 0.0;
    for (std::size_t o = 0; o < this->Bodies.size(); ++o)
    {
      cost += this->Bodies[o].Problem
                ? PlainDriftCost(*this->Bodies[o].Problem, Unpacked(this->Air),
                                 this->Bodies[o].Weights, paths[o])
                : 0.0;
    }
    for (const DriftContact& contact : contacts)
    {
      const auto f = std::size_t(contact.Frame);
      const double depth =
        std::max(0.0, contact.Kept - (paths[contact.A][f] - paths[contact.B][f]).norm());
      cost += 0.5 * DriftWeights().Contact * depth * depth;
    }
    return cost;
  }

  void Solve(const std::vector<DriftContact>& contacts, const ParallelFor& parallel = SerialFor())
  {
    SingleRank alone;
    this->Solve(contacts, parallel, alone);
  }

  void Solve(const std::vector<DriftContact>& contacts, const ParallelFor& parallel,
             Communicator& ranks)
  {
    SilentMonitor monitor;
    EXPECT_TRUE(SolveTogether(this->Bodies, contacts, AirSampler(this->Air), DriftWeights().Contact,
                              100, parallel, ranks, monitor, this->Paths));
  }
};

double Most(const std::vector<std::vector<double>>& residue)
{
  double most = 0.0;
  for (const std::vector<double>& of : residue)
  {
    most = std::max(most, *std::max_element(of.begin(), of.end()));
  }
  return most;
}

} // namespace

TEST(DriftTogether, ContactsAreThoseOfAllPairs)
{
  constexpr double Margin = 0.5;
  constexpr std::size_t Many = 400;
  Random random(8);
  KeptDistances kept(30.0);
  std::vector<std::vector<Vec3>> paths;
  for (std::size_t o = 0; o < Many; ++o)
  {
    kept.AddBody(0.02 + 0.03 * (random.Uniform() < 0.2), 0.5, 2, {});
    paths.emplace_back();
    for (int f = 0; f < 2; ++f)
    {
      Vec3 x = random.InBox({ Vec3(-1.0, -0.4, -0.1), Vec3(1.0, 0.4, 0.1) });
      x.x() = o % 3 == 0 ? 0.15 * std::round(x.x() / 0.15) : x.x(); // on a border of two strips
      paths.back().push_back(x);
    }
  }
  std::vector<std::tuple<int, std::size_t, std::size_t>> expected, found;
  for (int f = 0; f < 2; ++f)
  {
    for (std::size_t a = 0; a < Many; ++a)
    {
      for (std::size_t b = a + 1; b < Many; ++b)
      {
        const double apart = (paths[a][std::size_t(f)] - paths[b][std::size_t(f)]).norm();
        if (apart < (1.0 + Margin) * kept.Needed(a, b))
        {
          expected.emplace_back(f, a, b);
        }
      }
    }
  }
  for (const DriftContact& contact : FindContacts(kept, paths, Margin, SerialFor()))
  {
    found.emplace_back(contact.Frame, contact.A, contact.B);
  }
  EXPECT_GT(expected.size(), 200u);
  EXPECT_EQ(found, expected);
}

TEST(DriftTogether, EndsWhereNoChangeOfAnyBodyCostsLess)
{
  Crowd crowd;
  const std::vector<DriftContact> contacts = crowd.Contacts();
  const double before = crowd.PlainCost(contacts, crowd.Paths);
  crowd.Solve(contacts);
  const double found = crowd.PlainCost(contacts, crowd.Paths);
  EXPECT_LT(found, 0.9 * before);
  Random random(5);
  for (int i = 0; i < 40; ++i)
  {
    std::vector<std::vector<Vec3>> moved = crowd.Paths;
    const int middle = 3 + int(random.Uniform(0.0, Frames - 6.0));
    const double size = i % 2 == 0 ? 1e-3 : 1e-2;
    for (std::vector<Vec3>& path : moved)
    {
      const Vec3 way = size * random.Direction();
      for (int f = 1; f < Frames; ++f)
      {
        path[std::size_t(f)] +=
          f == Mark ? Vec3(Vec3::Zero()) : Vec3(std::exp(-0.1 * std::pow(f - middle, 2)) * way);
      }
    }
    EXPECT_GT(crowd.PlainCost(contacts, moved), found * (1.0 - 1e-3)) << i;
  }
}

TEST(DriftTogether, LeavesLittleOfWhatBodiesAreTooNearAndNothingAtTheMarks)
{
  Crowd crowd;
  const double before = Most(ContactResidue(crowd.Contacts(), crowd.Paths));
  crowd.Solve(crowd.Contacts());
  const std::vector<std::vector<double>> residue = ContactResidue(crowd.Contacts(), crowd.Paths);
  EXPECT_GT(before, 0.02);
  EXPECT_LT(Most(residue), 0.5 * before);
  for (const std::vector<double>& of : residue)
  {
    EXPECT_LT(of[Mark], 1e-12);
    EXPECT_LT(of[0], 1e-12);
  }
}

TEST(DriftTogether, WhatMayNotMoveStaysAndTheOthersGiveWay)
{
  Crowd crowd(true);
  const std::vector<Vec3> stays = crowd.Paths.back();
  const std::vector<DriftContact> contacts = crowd.Contacts();
  const double before = crowd.PlainCost(contacts, crowd.Paths);
  crowd.Solve(contacts);
  EXPECT_EQ(crowd.Paths.back(), stays);
  EXPECT_LT(crowd.PlainCost(contacts, crowd.Paths), before);
}

TEST(DriftTogether, TheProductOfADirectionIsThatOfItsMatrix)
{
  const Crowd crowd;
  const AirSampler air(crowd.Air);
  constexpr double damping = 0.7;
  constexpr std::size_t bodies = 3; // the fourth place stays empty
  FourDrifts four(Frames, 8);
  std::vector<BandedMatrix> matrices;
  for (std::size_t o = 0; o < bodies; ++o)
  {
    DriftEquations equations(*crowd.Bodies[o].Problem, air, crowd.Bodies[o].Weights);
    equations.LookAt(crowd.Paths[o]);
    equations.Linearise();
    four.Set(o, equations);
    matrices.push_back(equations.Lower());
  }
  ASSERT_TRUE(four.Factor(damping));
  four.Begin();
  for (int k = 0; k < 4; ++k)
  {
    const FourDrifts::Sums solved = four.Solve();
    EXPECT_GT(solved[0], 0.0);
    EXPECT_EQ(solved[3], 0.0);
    four.Turn(0.3 * k);
    four.Multiply();
    four.Subtract(1, 5, Vec3::UnitX(), 2.0); // so that a next direction is another one
    const FourDrifts::Sums found = four.Bend();
    for (std::size_t o = 0; o < bodies; ++o)
    {
      const auto along = [&](std::size_t i) { return four.Direction(o, i / 3)[int(i % 3)]; };
      double bend = o == 1 ? -2.0 * along(15) : 0.0;
      for (std::size_t i = 0; i < matrices[o].Size(); ++i)
      {
        bend += (matrices[o].At(i, i) + damping) * along(i) * along(i);
        for (std::size_t j = i > 8 ? i - 8 : 0; j < i; ++j)
        {
          bend += 2.0 * matrices[o].At(i, j) * along(i) * along(j);
        }
      }
      EXPECT_NEAR(found[o], bend, 1e-9 * std::abs(bend)) << o << " " << k;
    }
    EXPECT_EQ(found[3], 0.0);
    four.Go(0.5);
  }
}

TEST(DriftTogether, IsTheSameOnAnyNumberOfThreads)
{
  Crowd one, two;
  one.Solve(one.Contacts());
  const ParallelFor threads = ThreadedFor(2);
  two.Solve(two.Contacts(threads), threads);
  EXPECT_EQ(one.Paths, two.Paths);
}

TEST(DriftTogether, IsTheSameOnAnyNumberOfRanks)
{
  constexpr int many = 22; // the last ones alone in their four, one of them may not move
  Crowd one(true, many);
  const std::vector<DriftContact> contacts = one.Contacts();
  const std::vector<std::vector<Vec3>> begun = one.Paths;
  one.Solve(contacts);
  EXPECT_NE(begun, one.Paths);
  for (const int size : { 2, 3, 8 }) // of eight ranks two have nobody
  {
    EXPECT_TRUE(RunRanks(size,
                         [&](Communicator& ranks)
                         {
                           Crowd other(true, many);
                           other.Solve(contacts, ThreadedFor(2), ranks);
                           EXPECT_EQ(one.Paths, other.Paths) << ranks.Rank() << " of " << size;
                         }));
  }
}
