// SPDX-License-Identifier: BSD-3-Clause
// E of Eqs. 2-4 over all frames of a time level, and its exact gradient.
#pragma once

#include "Base/Monitor.h"
#include "Base/Parallel.h"
#include "Particles/NeighbourList.h"
#include "Spacetime/Energy/Convergence.h"
#include "Spacetime/Energy/FrameTerms.h"
#include "Spacetime/Model/StateVector.h"
#include "Spacetime/Model/TimeLevel.h"

#include <functional>
#include <memory>
#include <mutex>
#include <vector>

namespace waft
{

/// The unknowns are six rows a frame (x, y, z, u, v, w of gas, then objects, padded).
/// With j a frame of the level and s the step to the next one (Shi et al. 2005, Eqs. 3, 4, 9-11):
///   rx = x^{j+1} - x^j - s (v^{j+1} + eps D^j)
///   rv = v^{j+1} - v^j - s (a^j + f^j)
///   rs = D^j / (1 - m W(0) / rho0)
///   rt = v^j - mean of v^k over the neighbours in time
/// In a sampled air v is the deviation from it (GivenAir) but in rx, which takes velocities.
class SpacetimeObjective
{
public:
  /// The model, the fields and the level must outlive the objective; the fields may change between
  /// two evaluations. Without keepsLists neighbours are looked for at each evaluation: slower, for
  /// few evaluations in little memory.
  SpacetimeObjective(const SpacetimeModel& model, const AirFields& fields, const TimeLevel& level,
                     const ParallelFor& parallel, const SphKernelTable& kernels,
                     bool keepsLists = true);
  ~SpacetimeObjective();

  /// Each frame's terms, on the way to E: by several threads, in any order.
  using FrameVisitor = std::function<void(std::size_t j, FrameTerms& terms)>;
  /// E, and its gradient where asked for (not null). Deterministic for any number of threads.
  /// False when the monitor asked to stop; the outputs are then not usable.
  bool Evaluate(const StateVector& state, StateVector* gradient, SpacetimeTerms& terms,
                Monitor* monitor = nullptr, const FrameVisitor& visit = {});

  /// Half sums of squares of rx and of rv (without weights) by object, of the last evaluation.
  void ObjectResiduals(std::vector<double>& ex, std::vector<double>& ev,
                       std::vector<int>& steps) const;
  /// The velocity residual rv [dx / frame] of a body in the step into frame j, likewise.
  void VelocityResidual(std::size_t j, std::size_t body, double rv[3]) const;

  /// The rows of a frame at its present state, for outputs. Not thread safe.
  FrameTerms& ForwardFrame(const StateVector& state, std::size_t j);

  const SpacetimeModel& Model() const { return this->Problem; }
  const AirFields& Fields() const { return this->Acting; }
  const TimeLevel& Level() const { return this->Times; }
  std::size_t NumberOfEvaluations() const { return this->Evaluations; }
  std::size_t NumberOfPairs() const; // directed, entries of the lists

private:
  struct Worker;
  std::unique_ptr<Worker> Borrow();
  void Return(std::unique_ptr<Worker> worker);
  NeighbourList& ListOf(Worker& worker, std::size_t j);
  void SphFrame(Worker& worker, const StateVector& state, const StateVector& moving, std::size_t j,
                StateVector* gradient);
  /// What of the objects' acceleration is whose.
  void ShareFrame(FrameTerms& terms, const StateVector& moving, std::size_t j);
  void SmoothRow(const StateVector& moving, std::size_t j);
  /// In a sampled air: what E takes for the velocities.
  const StateVector& TakeDeviations(const StateVector& state);
  void ObjectFrame(const StateVector& state, std::size_t j, StateVector* gradient);
  void GatherFrame(std::size_t j, StateVector& gradient) const;
  void ToVelocities(std::size_t j, float* gradient) const;
  SpacetimeTerms Sum() const; // of all frames
  bool Chunked(Monitor* monitor, double from, double to,
               const std::function<void(std::size_t, std::size_t)>& body);
  /// Row c of a kind (0: rx, 1: rv, 2: rt) of the step into a frame.
  float* Row(std::size_t j, int kind, int c)
  {
    return this->Residuals.data() + (j * 9 + 3 * kind + c) * this->Problem.Stride();
  }
  const float* Row(std::size_t j, int kind, int c) const
  {
    return const_cast<SpacetimeObjective*>(this)->Row(j, kind, c);
  }
  std::size_t Offset(std::size_t j) const { return j * this->Problem.FrameSize(); }

  const SpacetimeModel& Problem;
  const AirFields& Acting;
  const TimeLevel& Times;
  ParallelFor Parallel;
  const SphKernelTable& Kernels;
  bool KeepsLists;
  double SpatialScale; // 1 / (1 - m W(0))^2
  std::size_t Evaluations = 0;

  std::vector<NeighbourList> Lists; // by frame; empty when they are not kept
  std::vector<float> Residuals;     // weighted, of the step into frame j: rx, rv and rt, nine rows
  StateVector Deviations;           // in a sampled air
  StateVector Jacobians;            // nine rows a frame, of the air where they are taken
  std::vector<SpacetimeTerms> FrameSums;
  std::vector<std::uint8_t> Bound;  // [frame * objects + object]: no free flight into the frame
  std::vector<std::uint8_t> HasLaw; // likewise: rv counts
  std::vector<float> Smoothness;    // of the third row of objects, likewise
  std::mutex PoolMutex;
  std::vector<std::unique_ptr<Worker>> Pool;
};

} // namespace waft
