// SPDX-License-Identifier: BSD-3-Clause
#include "Base/LargePages.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace waft;

TEST(LargePages, VectorsAreAsAssigned)
{
  std::vector<float> v{ 1.0f, 2.0f };
  for (const std::size_t count : { std::size_t(1), std::size_t(3000000), std::size_t(10) })
  {
    AssignInLargePages(v, count);
    ASSERT_EQ(v.size(), count);
    EXPECT_TRUE(std::all_of(v.begin(), v.end(), [](float x) { return x == 0.0f; }));
    std::fill(v.begin(), v.end(), 3.0f);
  }
}
