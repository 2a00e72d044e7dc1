// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Parallel.h"
#include "Base/Random.h"

#include <gtest/gtest.h>

#include <vector>

using namespace waft;

TEST(Random, KeepsItsSequence)
{
  Random a(42, 7);
  Random b(42, 7);
  Random other(42, 8);
  int equal = 0;
  for (int i = 0; i < 1000; ++i)
  {
    const std::uint32_t bits = a.Bits();
    EXPECT_EQ(bits, b.Bits());
    equal += bits == other.Bits();
  }
  EXPECT_LE(equal, 1);
}

TEST(Random, MatchesTheReferenceOfItsAuthors)
{
  // pcg32-demo of O'Neill: seed 42, stream 54.
  Random random(42, 54);
  EXPECT_EQ(random.Bits(), 0xa15c02b7u);
  EXPECT_EQ(random.Bits(), 0x7b47f409u);
  EXPECT_EQ(random.Bits(), 0xba1d3330u);
}

TEST(Random, HasTheMomentsOfItsDistributions)
{
  Random random(1);
  const int n = 200000;
  double uniform = 0.0;
  double normal = 0.0;
  double square = 0.0;
  Vec3 direction = Vec3::Zero();
  for (int i = 0; i < n; ++i)
  {
    uniform += random.Uniform();
    const double x = random.Normal();
    normal += x;
    square += x * x;
    direction += random.Direction();
  }
  EXPECT_NEAR(uniform / n, 0.5, 0.003);
  EXPECT_NEAR(normal / n, 0.0, 0.01);
  EXPECT_NEAR(square / n, 1.0, 0.02);
  EXPECT_LT(direction.norm() / n, 0.01);
}

TEST(ThreadedFor, CoversEachIndexOnce)
{
  for (const int threads : { 1, 2, 3 })
  {
    std::vector<int> seen(101, 0);
    ThreadedFor(threads)(seen.size(),
                         [&](std::size_t begin, std::size_t end)
                         {
                           for (std::size_t i = begin; i < end; ++i)
                           {
                             ++seen[i];
                           }
                         });
    EXPECT_EQ(seen, std::vector<int>(101, 1));
  }
}
