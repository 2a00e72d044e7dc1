// SPDX-License-Identifier: BSD-3-Clause
// Two motion databases that must be the same to the bit.
#pragma once

#include "Base/SameVortices.h"
#include "Trajectory/MotionDatabase.h"

#include <gtest/gtest.h>

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
  ASSERT_EQ(a.Groups.size(), b.Groups.size());
  for (std::size_t g = 0; g < a.Groups.size(); ++g)
  {
    EXPECT_EQ(a.Groups[g].NumberOfSamples, b.Groups[g].NumberOfSamples);
    EXPECT_EQ(a.Groups[g].Mean, b.Groups[g].Mean);
    EXPECT_EQ(a.Groups[g].Basis, b.Groups[g].Basis);
    EXPECT_EQ(a.Groups[g].RelativeError, b.Groups[g].RelativeError);
  }
  ASSERT_EQ(a.Segments.size(), b.Segments.size());
  for (std::size_t s = 0; s < a.Segments.size(); ++s)
  {
    EXPECT_EQ(a.Segments[s].Group, b.Segments[s].Group);
    EXPECT_EQ(a.Segments[s].Simulation, b.Segments[s].Simulation);
    EXPECT_EQ(a.Segments[s].Coefficients, b.Segments[s].Coefficients);
    EXPECT_EQ(a.Segments[s].ForceTypes, b.Segments[s].ForceTypes);
    EXPECT_EQ(a.Segments[s].VortexIds, b.Segments[s].VortexIds);
    EXPECT_EQ(a.Segments[s].MeanWind, b.Segments[s].MeanWind);
    EXPECT_EQ(a.Reconstruct(static_cast<int>(s)), b.Reconstruct(static_cast<int>(s)));
  }
  ASSERT_EQ(a.Nodes.size(), b.Nodes.size());
  for (std::size_t n = 0; n < a.Nodes.size(); ++n)
  {
    EXPECT_EQ(a.Nodes[n].Parent, b.Nodes[n].Parent);
    EXPECT_EQ(a.Nodes[n].Group, b.Nodes[n].Group);
    EXPECT_EQ(a.Nodes[n].Medoid, b.Nodes[n].Medoid);
    EXPECT_EQ(a.Nodes[n].FirstChild, b.Nodes[n].FirstChild);
    EXPECT_EQ(a.Nodes[n].NumberOfChildren, b.Nodes[n].NumberOfChildren);
    EXPECT_EQ(a.Nodes[n].NumberOfSegments, b.Nodes[n].NumberOfSegments);
    EXPECT_EQ(a.Nodes[n].Radius, b.Nodes[n].Radius);
  }
  ASSERT_EQ(a.Connections.size(), b.Connections.size());
  for (std::size_t c = 0; c < a.Connections.size(); ++c)
  {
    EXPECT_EQ(a.Connections[c].Cost, b.Connections[c].Cost);
    EXPECT_EQ(a.Connections[c].Rotation.coeffs(), b.Connections[c].Rotation.coeffs());
    EXPECT_EQ(a.Connections[c].Translation, b.Connections[c].Translation);
    EXPECT_EQ(a.Connections[c].IsConnectible, b.Connections[c].IsConnectible);
  }
  ExpectSame(a.Vortices, b.Vortices);
}

} // namespace test
} // namespace waft
