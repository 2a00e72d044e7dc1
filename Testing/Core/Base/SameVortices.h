// SPDX-License-Identifier: BSD-3-Clause
// Two lists of vortices that must be the same to the bit.
#pragma once

#include "Base/ForceFields.h"
#include "Base/SameLists.h"

namespace waft
{
namespace test
{

inline void ExpectSame(const std::vector<Vortex>& a, const std::vector<Vortex>& b)
{
  ExpectSameItems("vortex", a, b,
                  [](const Vortex& x, const Vortex& y)
                  {
                    EXPECT_EQ(x.VortexId, y.VortexId);
                    EXPECT_EQ(x.P1, y.P1);
                    EXPECT_EQ(x.P2, y.P2);
                    EXPECT_EQ(x.Strength, y.Strength);
                    EXPECT_EQ(x.CenterTime, y.CenterTime);
                    EXPECT_EQ(x.Duration, y.Duration);
                    EXPECT_EQ(x.CoreRadius, y.CoreRadius);
                    EXPECT_EQ(x.Confidence, y.Confidence);
                    EXPECT_EQ(x.ObjectCount, y.ObjectCount);
                  });
}

} // namespace test
} // namespace waft
