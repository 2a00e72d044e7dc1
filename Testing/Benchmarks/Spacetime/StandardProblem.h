// SPDX-License-Identifier: BSD-3-Clause
// The standard problem: independent paths with random phases through three marks each, in a unit
// box of gas with three vortices.
#pragma once

#include "Spacetime/Scene/SpacetimeSetup.h"

#include <array>
#include <cstdint>

namespace waft
{

struct StandardProblem
{
  std::array<int, 3> Gas{ 13, 14, 14 };
  int NumberOfObjects = 25;
  int ParticlesPerObject = 5;
  int NumberOfFrames = 301;
  std::uint64_t Seed = 1;

  SpacetimeSetup Setup; // Model, Table and Start, at all frames

  void Build();
};

} // namespace waft
