// SPDX-License-Identifier: BSD-3-Clause
// E of Eqs. 2-4 over all frames of a time level, and its exact gradient.
#pragma once

#include "Base/Monitor.h"
#include "Base/Parallel.h"
#include "Particles/NeighborList.h"
#include "Spacetime/FrameTerms.h"
#include "Spacetime/SpacetimeModel.h"
#include "Spacetime/StateVector.h"

#include <memory>
#include <mutex>
#include <vector>

namespace waft
{

/// E = c1 Ex + c2 Ev + c3 Ec + Beside; each is half a sum of squares.
struct SpacetimeTerms
{
  double E = 0.0;
  double Ex = 0.0, Ev = 0.0, Ec = 0.0;
  double Beside = 0.0; // clearance, approach, contact and separation, weighted
};

/// The unknowns are six rows a frame (x, y, z, u, v, w of gas, then objects, padded).
/// With j a frame of the level and s the step to the next one (Shi et al. 2005, Eqs. 3, 4, 9-11):
///   rx = x^{j+1} - x^j - s (v^{j+1} + eps D^j)
///   rv = v^{j+1} - v^j - s (a^j + f^j)
///   rs = D^j / (1 - m W(0) / rho0)
///   rt = v^j - mean of v^k over the neighbours in time
class SpacetimeObjective
{
public:
  /// The model and the level must outlive the objective. Without keepsLists neighbours are looked
  /// for at each evaluation: slower, for few evaluations in little memory.
  SpacetimeObjective(const SpacetimeModel& model, const TimeLevel& level,
                     const ParallelFor& parallel, const SphKernelTable& kernels,
                     bool keepsLists = true);
  ~SpacetimeObjective();

  /// E, and its gradient where asked for (not null). Deterministic for any number of threads.
  /// False when the monitor asked to stop; the outputs are then not usable.
  bool Evaluate(const StateVector& state, StateVector* gradient, SpacetimeTerms& terms,
                Monitor* monitor = nullptr);

  /// After Evaluate: half sums of squares of rx and of rv (without weights) by object.
  void ObjectResiduals(std::vector<double>& ex, std::vector<double>& ev,
                       std::vector<int>& steps) const;
  /// After Evaluate: the velocity residual rv [dx / frame] of a body in the step into frame j.
  void VelocityResidual(std::size_t j, std::size_t body, double rv[3]) const;

  /// Writes, or reads back, what the neighbour lists remember of the evaluations so far: with it
  /// the next ones give the same bits.
  void ExchangeLists(StateStream& stream);

  /// The rows of one frame at its present state, for outputs. Not thread safe.
  FrameTerms& ForwardFrame(const StateVector& state, std::size_t j);

  const SpacetimeModel& Model() const { return this->Problem; }
  const TimeLevel& Level() const { return this->Times; }
  std::size_t NumberOfEvaluations() const { return this->Evaluations; }
  std::size_t NumberOfPairs() const; // directed, entries of the lists

private:
  struct Worker;
  std::unique_ptr<Worker> Borrow();
  void Return(std::unique_ptr<Worker> worker);
  NeighborList& ListOf(Worker& worker, std::size_t j);
  void SphFrame(Worker& worker, const StateVector& state, std::size_t j, StateVector* gradient);
  void SmoothRow(const StateVector& state, std::size_t j);
  void GatherFrame(std::size_t j, StateVector& gradient) const;
  bool Chunked(std::size_t count, Monitor* monitor, double from, double to,
               const std::function<void(std::size_t, std::size_t)>& body);

  const SpacetimeModel& Problem;
  const TimeLevel& Times;
  ParallelFor Parallel;
  const SphKernelTable& Kernels;
  double SpatialScale; // 1 / (1 - m W(0))^2
  std::size_t Evaluations = 0;

  std::vector<NeighborList> Lists; // by frame; empty when they are not kept
  /// Weighted residuals of the step into frame j: rx, rv and rt, nine rows.
  std::vector<float> Residuals;
  std::vector<SpacetimeTerms> FrameSums;
  std::vector<std::uint8_t> Bound; // [frame * objects + object]: no free flight into the frame
  std::mutex PoolMutex;
  std::vector<std::unique_ptr<Worker>> Pool;
};

} // namespace waft
