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
                  [](const Vortex& item)
                  {
                    return std::tie(item.VortexId, item.P1, item.P2, item.Strength, item.CenterTime,
                                    item.Duration, item.CoreRadius, item.Confidence,
                                    item.ObjectCount);
                  });
}

} // namespace test
} // namespace waft
