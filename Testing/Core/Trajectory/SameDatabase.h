// SPDX-License-Identifier: BSD-3-Clause
// Two motion databases that must be the same to the bit.
#pragma once

#include "Base/SameLists.h"
#include "Base/SameVortices.h"
#include "Trajectory/MotionDatabase.h"

namespace waft
{
namespace test
{

/// Provenance included.
inline void ExpectSame(const MotionDatabase& a, const MotionDatabase& b)
{
  EXPECT_EQ(a.FramesPerSecond, b.FramesPerSecond);
  EXPECT_EQ(a.Volume.Min, b.Volume.Min);
  EXPECT_EQ(a.Volume.Max, b.Volume.Max);
  EXPECT_EQ(a.Window, b.Window);
  EXPECT_EQ(a.SettlingSpeed, b.SettlingSpeed);
  EXPECT_EQ(a.TopSpeed, b.TopSpeed);
  EXPECT_EQ(a.TopNodes, b.TopNodes);
  EXPECT_EQ(a.Provenance, b.Provenance);
  ExpectSameItems(
    "group", a.Groups, b.Groups,
    [](const SegmentGroup& item)
    { return std::tie(item.NumberOfSamples, item.Mean, item.Basis, item.RelativeError); });
  ExpectSameItems("segment", a.Segments, b.Segments,
                  [](const Segment& item)
                  {
                    return std::tie(item.Group, item.Simulation, item.Coefficients, item.ForceTypes,
                                    item.VortexIds, item.MeanWind);
                  });
  ASSERT_EQ(a.Segments.size(), b.Segments.size());
  for (std::size_t s = 0; s < a.Segments.size(); ++s)
  {
    EXPECT_EQ(a.Reconstruct(static_cast<int>(s)), b.Reconstruct(static_cast<int>(s)));
  }
  ExpectSameItems("node", a.Nodes, b.Nodes,
                  [](const ClusterNode& item)
                  {
                    return std::tie(item.Parent, item.Group, item.Medoid, item.FirstChild,
                                    item.NumberOfChildren, item.NumberOfSegments, item.Radius);
                  });
  ExpectSameItems(
    "connection", a.Connections, b.Connections,
    [](const Connection& item)
    { return std::tie(item.Cost, item.Rotation.coeffs(), item.Translation, item.IsConnectible); });
  ExpectSame(a.Vortices, b.Vortices);
}

} // namespace test
} // namespace waft
