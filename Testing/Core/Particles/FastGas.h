// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Particles/NeighbourList.h"
#include "RandomGas.h"

#include <vector>

namespace waft
{

/// What the fast sums over a gas read and write, in the places of its neighbour list.
struct FastGas
{
  explicit FastGas(const RandomGas& gas, const SphKernelTable& kernels) :
    Kernels(kernels), Constants(gas.Fluid.Constants()), N(gas.State.Positions.size())
  {
    std::vector<float> row[3];
    for (const Vec3& x : gas.State.Positions)
    {
      for (int c = 0; c < 3; ++c)
      {
        row[c].push_back(static_cast<float>(x[c]));
      }
    }
    NeighbourScratch scratch;
    this->List.Build(kernels, this->N, gas.State.NumberOfGas, row[0].data(), row[1].data(),
                     row[2].data(), 2.55f, scratch);
    for (const std::uint32_t i : this->List.Order())
    {
      const Vec3& v = gas.State.Velocities[i];
      const double mass = i < gas.State.NumberOfGas ? gas.Fluid.GasMass : gas.Fluid.ObjectMass;
      this->Records.push_back({ row[0][i], row[1][i], row[2][i], float(mass), float(v.x()),
                                float(v.y()), float(v.z()), 0.0f });
    }
    this->Records.insert(this->Records.end(), SphFarRecords,
                         { -1e4f, -1e4f, -1e4f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f });
    this->Starts.resize(this->N + 1);
    this->Groups.resize(this->List.NumberOfEntries() / 8 + 1);
    this->Nearest.resize(this->N);
  }
  SphPairs Pairs() { return { this->Starts.data(), this->Groups.data(), this->Nearest.data() }; }
  const SphKernelTable& Kernels;
  SphConstants Constants;
  std::size_t N;
  std::vector<SphRecord> Records; // by place, as all sums
  NeighbourList List;
  std::vector<std::uint32_t> Starts;
  std::vector<SphPairGroup> Groups;
  std::vector<float> Nearest;
};

} // namespace waft
