// SPDX-License-Identifier: BSD-3-Clause
// The SPH block of one frame: accelerations, velocity averages and external forces of all bodies,
// and the adjoint of these.
#pragma once

#include "Particles/NeighbourList.h"
#include "Spacetime/Energy/LandingDamping.h"
#include "Spacetime/Model/SpacetimeModel.h"

#include <vector>

namespace waft
{

/// Work space for one frame at a time, one a thread. Rows of bodies have the model's stride, rows
/// of particles a stride of their own. Particles stand in the order of the frame's neighbour list;
/// objects' particles in their own.
class FrameTerms
{
public:
  /// The fields may change between two calls of Forward.
  FrameTerms(const SpacetimeModel& model, const AirFields& fields, const SphFluid& fluid,
             const SphKernelTable& kernels);

  /// state: the frame's six rows, in a sampled air with the deviations as velocities; step: frames
  /// to the next one. Brings `list` up to date. Then Acceleration (all of it, external fields
  /// included) and Average hold.
  void Forward(const float* state, int frame, double step, NeighbourList& list);
  /// Of the frame of the last Forward: AccelerationBar and AverageBar in; adds their pull-back to
  /// the six rows of `gradient`.
  void Adjoint(float* gradient);

  /// Of the frame of the last Forward: half the sum of squares of how much gas is nearer to gas
  /// than GasDistance; adds `factor` times its gradient to the six rows of `gradient`, unless null.
  double Crowding(float factor, float* gradient) const;

  float* Acceleration(int c) { return this->Rates.data() + c * this->BodyStride; }
  float* Average(int c) { return this->Rates.data() + (3 + c) * this->BodyStride; }
  float* AccelerationBar(int c) { return this->Bars.data() + c * this->BodyStride; }
  float* AverageBar(int c) { return this->Bars.data() + (3 + c) * this->BodyStride; }
  /// Acceleration by vortices and winds.
  const float* External(int c) const { return this->Force.data() + c * this->BodyStride; }
  /// Acceleration by vortices alone.
  const float* ByVortices(int c) const
  {
    return (this->HasWinds ? this->VortexForce : this->Force).data() + c * this->BodyStride;
  }
  /// Acceleration of an object by the damping of its landing.
  const Vec3& ByLanding(std::size_t object) const { return this->Damping[object].Acceleration; }
  /// Of a particle, by its number: density, P (in rho0 dx^2 / frame^2), and the fraction of the
  /// density that is not gas.
  struct AirAt
  {
    double Density, Pressure, WallFraction;
  };
  std::vector<AirAt> Air() const;

private:
  /// Rows go through several terms in one sweep, so many entries at a time.
  static constexpr std::size_t Block = 256;

  /// Objects in a sampled air without any gas.
  bool IsAlone() const { return this->Model.NumberOfGas == 0 && !this->Model.Air.IsEmpty(); }
  void ForwardAlone(const float* state);
  void FillPositions(const float* state);
  void PositionParticles(const float* state);
  void MakeRoom(std::size_t entries);
  void GatherRates(const float* state);
  void AddWalls(int frame);
  void AddSprings(std::size_t begin, std::size_t end, const SphBox& box);
  void AddObstacle(std::size_t i, int frame);
  void AddFields(const float* state, int frame);
  void ActivateVortices(int frame);
  void AddWinds(const float* state, std::size_t begin, std::size_t end);
  void AddLandingDamping(const float* state, int frame, double step);
  SphRows ParticleRows(std::vector<float>& v, std::size_t begin) const
  {
    return { v.data() + begin, this->ParticleStride };
  }
  SphRows BodyRows(std::vector<float>& v, std::size_t begin) const
  {
    return { v.data() + begin, this->BodyStride };
  }

  const SpacetimeModel& Model;
  const AirFields& Fields;
  SphFluid Fluid;
  const SphKernelTable& Kernels;
  SphConstants Constants;
  std::size_t BodyStride, ParticleStride;

  const std::uint32_t* Order = nullptr; // the particle at each index
  std::vector<float> X;                 // 3 rows of particles
  std::vector<SphRecord> Records;       // particles and the far ones
  std::vector<SphAdjointRecord> Adjoints;
  std::vector<float> Density, PressureSlope, Psi, Bar; // particles
  std::vector<float> PsiGradient, PsiHessian;          // 3 and 6 rows
  std::vector<float> Raise, RaiseSlope;            // of D of the objects' particles; WallCorrection
  std::vector<float> SpringForce, SpringSlope;     // gas: 3 rows and 6 of the Jacobian
  std::vector<float> Force, Jacobian, VortexForce; // bodies: 3, 9 and 3 rows
  std::vector<float> Rates, Bars;                  // bodies: 6 rows
  std::vector<float> WindCoefficients, BackgroundCoefficients;
  float BackgroundDrag = 0.0f;
  bool HasWinds = false;
  std::vector<DampingForce> Damping; // one an object
  std::vector<SphVortex> Active;
  NeighbourScratch Scratch;
  /// The pairs of the frame that Forward was last called for, and sums over them.
  std::vector<std::uint32_t> PairStarts;
  std::vector<SphPairGroup> PairGroups;
  std::vector<float> Nearest;
  std::vector<SphPairSum> PairSums;
  SphPairs Pairs{};
};

} // namespace waft
