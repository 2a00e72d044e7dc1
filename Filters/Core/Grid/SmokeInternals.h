// SPDX-License-Identifier: BSD-3-Clause
// The state of a smoke solver and the parts of its step.
#pragma once

#include "Grid/AirKernels.h"
#include "Grid/PressureSolver.h"
#include "Grid/SmokeSolver.h"
#include "Grid/SolidFaces.h"

namespace waft
{

using FloatArray = std::vector<float>;

inline VectorArrays Pointers(std::array<FloatArray, 3>& arrays)
{
  return { arrays[0].data(), arrays[1].data(), arrays[2].data() };
}
inline ConstVectorArrays ConstPointers(const std::array<FloatArray, 3>& arrays)
{
  return { arrays[0].data(), arrays[1].data(), arrays[2].data() };
}

template <typename Body>
void ForPlanes(const ParallelFor& parallelFor, int count, const Body& body)
{
  parallelFor(static_cast<std::size_t>(count),
              [&](std::size_t begin, std::size_t end)
              {
                for (std::size_t k = begin; k < end; ++k)
                {
                  body(static_cast<int>(k));
                }
              });
}

struct SmokeSolver::Internals
{
  SmokeOptions Options;
  SmokeForces Forces;
  FieldSeries Steering;
  StaggeredLayout Layout;
  AxisEnds Ends{};        // of what the air carries
  AxisEnds DerivedEnds{}; // of what is derived from it: no jump at an open end
  std::array<float, 3> Spacing{ 1.0f, 1.0f, 1.0f };
  std::array<float, 3> FirstCenter{ 0.0f, 0.0f, 0.0f };
  /// Of the voxels of this index along an axis.
  float VoxelCenter(int axis, int index) const
  {
    return this->FirstCenter[axis] + static_cast<float>(index) * this->Spacing[axis];
  }

  SolidFaces Solids;
  PressureSolver Pressure;

  // The state.
  int Frame = -1;
  double Time = 0.0;
  std::array<FloatArray, 3> Velocity;
  FloatArray Density;
  FloatArray Temperature;
  FloatArray Potential;       // phi = dt p / rho [m^2/s], the pressure's layout
  double PotentialStep = 0.0; // the dt in it [s]
  bool HasSmoke = false;
  bool HasWarmth = false;

  // Work space.
  std::array<FloatArray, 3> NewVelocity, Center, Vorticity, Acceleration;
  std::array<FloatArray, 3> Backwards, Forwards; // displacements of the cells' air [voxels]
  FloatArray VorticitySize, NewScalar, Returned, RightHandSide;
  SmokeStatistics Statistics;
  SmokeState Before; // the step, for a stop within it

  void Prepare();
  void BuildSolids(const FloatArray& distances,
                   const std::vector<std::array<float, 3>>& velocities);

  /// One frame's time in substeps; false when stopped.
  bool Advance(double start, double duration, const ParallelFor& parallelFor,
               const std::function<bool()>& goOn);
  bool Substep(double start, double dt, const ParallelFor& parallelFor,
               const std::function<bool()>& goOn);
  double LargestSpeed() const; // in voxels per second
  /// The centre of a face [m].
  Vec3 FaceAt(int axis, int i, int j, int k) const;

  // SmokeForcing.cxx
  void AddVortices(double time, const ParallelFor& parallelFor, const VectorArrays& sum) const;
  /// Winds in closed form and the sampled one; center: the air's velocity, for a wind that drags.
  void AddWinds(double time, double dt, const ParallelFor& parallelFor,
                const ConstVectorArrays& center, const VectorArrays& sum) const;
  /// A sampled field at all cells: its acceleration, or what draws the air towards its velocity.
  void AddBreeze(const ParallelFor& parallelFor, const ConstVectorArrays& center,
                 const VectorArrays& sum) const;
  void AddField(const FieldSeries& field, double time, double dt, const ParallelFor& parallelFor,
                const ConstVectorArrays& center, const VectorArrays& sum) const;
  void AddSteering(const ParallelFor& parallelFor, const VectorArrays& sum) const;
  void AddConfinementAndBuoyancy(const ParallelFor& parallelFor);
  void ComputeCenters(const ParallelFor& parallelFor, std::array<FloatArray, 3>& center) const;
  void ComputeVorticity(const ParallelFor& parallelFor, const std::array<FloatArray, 3>& center,
                        std::array<FloatArray, 3>& vorticity, FloatArray& size) const;
  void Emit(double time);

  // SmokeTransport.cxx
  double Energy(const std::array<FloatArray, 3>& faces, const ParallelFor& parallelFor) const;
  /// Traces the air, too: before AdvectScalars.
  void AdvectVelocity(double dt, const ParallelFor& parallelFor);
  /// time: after the step.
  void AdvectScalars(double time, double dt, const ParallelFor& parallelFor);
  void Trace(double dt, const ParallelFor& parallelFor,
             std::array<FloatArray, 3>& displacement) const;
  void Advect(int faceAxis, const FloatArray& source, FloatArray& target,
              const ParallelFor& parallelFor);
  bool Project(double dt, const ParallelFor& parallelFor, const std::function<bool()>& goOn);
  /// Without a step: the potential of that is no pressure, and is not kept.
  void ProjectAlone();
  /// Of the air beyond an open end, the component along an axis; of what is no velocity (-1) 0.
  float Outside(int axis) const
  {
    return axis < 0 ? 0.0f : static_cast<float>(this->Options.Breeze[axis]);
  }
  void FinishVelocity();
  void FinishScalar(FloatArray& values) const;
};

} // namespace waft
