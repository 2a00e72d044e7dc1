// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Random.h"
#include "Particles/NeighbourList.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

using namespace waft;

namespace
{

void CheckAgainstBruteForce(const SphKernelTable& kernels, std::size_t n, std::size_t gas,
                            const Vec3& size, float reach)
{
  Random random(7);
  std::vector<float> x[3];
  for (std::size_t i = 0; i < n; ++i)
  {
    const Vec3 p = random.InBox({ -size, size });
    for (int c = 0; c < 3; ++c)
    {
      x[c].push_back(static_cast<float>(p[c]));
    }
  }
  NeighbourScratch scratch;
  NeighbourList list;
  list.Build(kernels, n, gas, x[0].data(), x[1].data(), x[2].data(), reach, scratch);
  const SphNeighbours view = list.View();
  std::vector<std::size_t> particles(list.Order().begin(), list.Order().end());
  particles.push_back(n); // the far one
  for (std::size_t i = gas; i < n; ++i)
  {
    EXPECT_EQ(particles[i], i);
  }
  // Each pair once: (i, j) with i < j here.
  std::set<std::pair<std::size_t, std::size_t>> listed, expected;
  for (std::size_t i = 0; i < n; ++i)
  {
    for (std::size_t k = 8 * view.Starts[i]; k < 8 * view.Starts[i + 1]; ++k)
    {
      const std::size_t place = view.Narrow ? view.Narrow[k] : view.Wide[k];
      ASSERT_LE(place, n);
      if (place < n)
      {
        ASSERT_LT(place, gas); // the pair of gas and object stands at the object
        EXPECT_TRUE(listed.insert(std::minmax(particles[i], particles[place])).second);
      }
    }
  }
  // Of many particles only the pairs of some.
  const std::size_t every = n > 1000 ? 501 : 1;
  for (auto pair = listed.begin(); pair != listed.end();)
  {
    pair = pair->first % every == 0 ? std::next(pair) : listed.erase(pair);
  }
  for (std::size_t i = 0; i < n; i += every)
  {
    for (std::size_t j = i + 1; j < n; ++j)
    {
      float r2 = 0.0f;
      for (int c = 0; c < 3; ++c)
      {
        r2 += (x[c][i] - x[c][j]) * (x[c][i] - x[c][j]);
      }
      if (i < gas && r2 < reach * reach)
      {
        expected.insert({ i, j });
      }
    }
  }
  EXPECT_EQ(listed, expected);
  EXPECT_FALSE(expected.empty());
}

} // namespace

TEST(NeighbourList, EqualsBruteForce)
{
  for (const SphKernelTable* table :
       { &PortableSphKernels(), Avx2SphKernels(), Avx512SphKernels() })
  {
    if (table != nullptr)
    {
      SCOPED_TRACE(table->Name);
      CheckAgainstBruteForce(*table, 700, 650, Vec3(4.0, 3.0, 5.0), 2.55f);
      CheckAgainstBruteForce(*table, 300, 300, Vec3(9.0, 0.5, 0.5), 1.0f);
      CheckAgainstBruteForce(*table, 40, 20, Vec3(0.2, 0.2, 0.2), 2.0f);
    }
  }
}

TEST(NeighbourList, UsesWideIndicesForManyParticles)
{
  CheckAgainstBruteForce(FastestSphKernels(), 66000, 65900, Vec3(20.0, 20.0, 20.0), 1.0f);
}

TEST(NeighbourList, LaysWhatIsNearInSpaceSideBySide)
{
  // Gas in a row, numbered at random.
  constexpr std::size_t n = 500;
  std::vector<float> x(n), y(n, 0.0f), z(n, 0.0f);
  Random random(5);
  for (float& p : x)
  {
    p = static_cast<float>(random.Uniform(0.0, 100.0));
  }
  NeighbourScratch scratch;
  NeighbourList list;
  constexpr float Reach = 1.0f;
  list.Build(FastestSphKernels(), n, n, x.data(), y.data(), z.data(), Reach, scratch);
  float last = 0.0f;
  for (const std::uint32_t i : list.Order())
  {
    EXPECT_GT(x[i], last - Reach); // of its cell or of the next
    last = std::max(last, x[i]);
  }
}

TEST(NeighbourList, IsStaleOnlyAfterALongMove)
{
  std::vector<float> x{ 0.0f, 1.0f, 2.0f }, y(3, 0.0f), z(3, 0.0f);
  NeighbourScratch scratch;
  NeighbourList list;
  EXPECT_TRUE(list.IsStale(x.data(), y.data(), z.data(), 0.1f));
  list.Build(FastestSphKernels(), 3, 3, x.data(), y.data(), z.data(), 2.5f, scratch);
  y[1] = 0.09f;
  EXPECT_FALSE(list.IsStale(x.data(), y.data(), z.data(), 0.1f));
  y[1] = 0.11f;
  EXPECT_TRUE(list.IsStale(x.data(), y.data(), z.data(), 0.1f));
}
