// SPDX-License-Identifier: BSD-3-Clause
// Two lists of vortices that must be the same to the bit.
#pragma once

#include "Base/ForceFields.h"

#include <gtest/gtest.h>

#include <vector>

namespace waft
{
namespace test
{

inline void ExpectSame(const std::vector<Vortex>& a, const std::vector<Vortex>& b)
{
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    SCOPED_TRACE("vortex " + std::to_string(i));
    EXPECT_EQ(a[i].VortexId, b[i].VortexId);
    EXPECT_EQ(a[i].P1, b[i].P1);
    EXPECT_EQ(a[i].P2, b[i].P2);
    EXPECT_EQ(a[i].Strength, b[i].Strength);
    EXPECT_EQ(a[i].CenterTime, b[i].CenterTime);
    EXPECT_EQ(a[i].Duration, b[i].Duration);
    EXPECT_EQ(a[i].CoreRadius, b[i].CoreRadius);
    EXPECT_EQ(a[i].Confidence, b[i].Confidence);
    EXPECT_EQ(a[i].ObjectCount, b[i].ObjectCount);
  }
}

} // namespace test
} // namespace waft
