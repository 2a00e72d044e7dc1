// SPDX-License-Identifier: BSD-3-Clause
// Flows in closed form, sampled as a simulation would give them.
#pragma once

#include "Trajectory/TrajectoryTracer.h"

#include <cmath>
#include <functional>

namespace waft
{
namespace test
{

using FlowFunction = std::function<Vec3(const Vec3& x, double time)>;

inline PointLattice CubeLattice(const Box& box, int points)
{
  PointLattice lattice;
  lattice.Dimensions = { points, points, points };
  lattice.Spacing = box.Size() / points;
  lattice.Origin = box.Min + 0.5 * lattice.Spacing;
  return lattice;
}

inline std::vector<std::array<float, 3>> SampleFlow(const PointLattice& lattice,
                                                    const FlowFunction& flow, double time)
{
  std::vector<std::array<float, 3>> values;
  values.reserve(lattice.NumberOfPoints());
  for (int k = 0; k < lattice.Dimensions[2]; ++k)
  {
    for (int j = 0; j < lattice.Dimensions[1]; ++j)
    {
      for (int i = 0; i < lattice.Dimensions[0]; ++i)
      {
        const Vec3 v = flow(lattice.Origin + Vec3(i, j, k).cwiseProduct(lattice.Spacing), time);
        values.push_back({ float(v.x()), float(v.y()), float(v.z()) });
      }
    }
  }
  return values;
}

inline FlowFrame FrameOfFlow(const PointLattice& lattice, const FlowFunction& flow, double time)
{
  FlowFrame frame;
  frame.Time = time;
  frame.Velocity = SampleFlow(lattice, flow, time);
  return frame;
}

/// A swirling, divergence-free flow that changes in time (Arnold, Beltrami, Childress).
inline Vec3 SwirlingFlow(const Vec3& x, double time, double phase = 0.0)
{
  const double w = 1.7;
  const double p = phase + 0.9 * time;
  return 0.35 * Vec3(std::sin(w * x.z() + p) + std::cos(w * x.y()),
                     std::sin(w * x.x()) + std::cos(w * x.z() + p),
                     std::sin(w * x.y()) + std::cos(w * x.x()));
}

} // namespace test
} // namespace waft
