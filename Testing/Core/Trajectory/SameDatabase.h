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
  ExpectSameItems("group", a.Groups, b.Groups,
                  [](const SegmentGroup& x, const SegmentGroup& y)
                  {
                    EXPECT_EQ(x.NumberOfSamples, y.NumberOfSamples);
                    EXPECT_EQ(x.Mean, y.Mean);
                    EXPECT_EQ(x.Basis, y.Basis);
                    EXPECT_EQ(x.RelativeError, y.RelativeError);
                  });
  ExpectSameItems("segment", a.Segments, b.Segments,
                  [](const Segment& x, const Segment& y)
                  {
                    EXPECT_EQ(x.Group, y.Group);
                    EXPECT_EQ(x.Simulation, y.Simulation);
                    EXPECT_EQ(x.Coefficients, y.Coefficients);
                    EXPECT_EQ(x.ForceTypes, y.ForceTypes);
                    EXPECT_EQ(x.VortexIds, y.VortexIds);
                    EXPECT_EQ(x.MeanWind, y.MeanWind);
                  });
  ASSERT_EQ(a.Segments.size(), b.Segments.size());
  for (std::size_t s = 0; s < a.Segments.size(); ++s)
  {
    EXPECT_EQ(a.Reconstruct(static_cast<int>(s)), b.Reconstruct(static_cast<int>(s)));
  }
  ExpectSameItems("node", a.Nodes, b.Nodes,
                  [](const ClusterNode& x, const ClusterNode& y)
                  {
                    EXPECT_EQ(x.Parent, y.Parent);
                    EXPECT_EQ(x.Group, y.Group);
                    EXPECT_EQ(x.Medoid, y.Medoid);
                    EXPECT_EQ(x.FirstChild, y.FirstChild);
                    EXPECT_EQ(x.NumberOfChildren, y.NumberOfChildren);
                    EXPECT_EQ(x.NumberOfSegments, y.NumberOfSegments);
                    EXPECT_EQ(x.Radius, y.Radius);
                  });
  ExpectSameItems("connection", a.Connections, b.Connections,
                  [](const Connection& x, const Connection& y)
                  {
                    EXPECT_EQ(x.Cost, y.Cost);
                    EXPECT_EQ(x.Rotation.coeffs(), y.Rotation.coeffs());
                    EXPECT_EQ(x.Translation, y.Translation);
                    EXPECT_EQ(x.IsConnectible, y.IsConnectible);
                  });
  ExpectSame(a.Vortices, b.Vortices);
}

} // namespace test
} // namespace waft
