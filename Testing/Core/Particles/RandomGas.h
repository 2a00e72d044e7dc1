// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Base/Random.h"
#include "Particles/GasLattice.h"
#include "Particles/RestDensity.h"
#include "Particles/SphReference.h"

namespace waft
{

/// A disturbed lattice of n^3 gas particles, or of given cells, with a few object particles in it.
struct RandomGas
{
  SphFluid Fluid;
  Vec3 Size = Vec3::Ones();
  RestDensity Rest;
  SphState State;

  explicit RandomGas(int n, int objects, double disturbance, std::uint64_t seed = 1) :
    RandomGas(std::array<int, 3>{ n, n, n }, objects, disturbance, seed)
  {
  }
  RandomGas(const std::array<int, 3>& cells, int objects, double disturbance,
            std::uint64_t seed = 1)
  {
    this->Fluid.ObjectViscosity = 0.4;
    const GasLattice lattice = GasLattice::Make(Box{ Vec3::Zero(), Vec3::Ones() }, cells);
    this->Fluid.GasMass = lattice.ParticleMass(this->Fluid);
    this->Fluid.ObjectMass = 0.1 * this->Fluid.GasMass;
    this->Size = lattice.SizeInSpacings();
    this->Rest.Build(lattice, this->Fluid);
    this->State.Positions = lattice.Points();
    this->State.NumberOfGas = this->State.Positions.size();
    Random random(seed);
    for (int k = 0; k < objects; ++k)
    {
      this->State.Positions.push_back(
        random.InBox({ Vec3::Constant(0.2), this->Size - Vec3::Constant(0.2) }));
    }
    for (Vec3& x : this->State.Positions)
    {
      x += disturbance * Vec3(random.Normal(), random.Normal(), random.Normal());
      x = x.cwiseMax(Vec3::Constant(0.05)).cwiseMin(this->Size - Vec3::Constant(0.05));
      this->State.Velocities.push_back(0.1 *
                                       Vec3(random.Normal(), random.Normal(), random.Normal()));
    }
  }

  /// The box with what the lattice lacks beside its walls.
  SphVolume Volume() const
  {
    SphVolume volume(this->Size);
    volume.Rest = &this->Rest;
    return volume;
  }

  SphVolume Volume(const ObstacleField& obstacles) const
  {
    SphVolume volume = this->Volume();
    volume.Obstacles = &obstacles;
    return volume;
  }

  SphState RandomChange(std::uint64_t seed) const
  {
    Random random(seed);
    SphState change = this->State;
    for (auto* v : { &change.Positions, &change.Velocities })
    {
      for (Vec3& x : *v)
      {
        x = Vec3(random.Normal(), random.Normal(), random.Normal());
      }
    }
    return change;
  }
};

} // namespace waft
