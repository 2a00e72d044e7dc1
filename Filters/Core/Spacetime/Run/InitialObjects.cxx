// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Run/InitialObjects.h"

#include "Spacetime/Solver/LevelSolver.h"

#include <algorithm>

namespace waft
{
namespace
{

constexpr int Iterations = 60;
constexpr int History = 8;
constexpr double Tolerance = 1e-2; // fall of E in 20 iterations

SpacetimeModel WithoutGas(const SpacetimeModel& model)
{
  SpacetimeModel objects = model;
  objects.NumberOfGas = 0;
  objects.Air = model.Air.WithoutGas();
  return objects;
}

// Six rows of objects a frame, between a state with gas and one without.
template <class Move>
void ForRows(const SpacetimeModel& model, const SpacetimeModel& objects, const Move& move)
{
  for (std::size_t row = 0; row < 6 * static_cast<std::size_t>(model.NumberOfFrames); ++row)
  {
    move(row * model.Stride() + model.NumberOfGas, row * objects.Stride());
  }
}

} // namespace

bool MakeInitialObjects(const SpacetimeModel& model, const ConstraintTable& table,
                        const TimeLevel& level, const ParallelFor& parallel, Monitor& monitor,
                        StateVector& state)
{
  const SpacetimeModel objects = WithoutGas(model);
  const auto count = static_cast<std::ptrdiff_t>(model.NumberOfObjects);
  StateVector alone(level.NumberOfFrames() * objects.FrameSize(), 0.0f);
  ForRows(model, objects,
          [&](std::size_t whole, std::size_t part)
          {
            const auto from = state.begin() + static_cast<std::ptrdiff_t>(whole);
            std::copy(from, from + count, alone.begin() + static_cast<std::ptrdiff_t>(part));
          });
  LevelSolver solver(objects, objects.Fields, table, level, parallel, History);
  LbfgsOptions options;
  options.MaximumNumberOfIterations = Iterations;
  options.Tolerance = Tolerance;
  LbfgsMemory memory;
  const auto observer = [&](int iteration, const SpacetimeTerms&)
  { return monitor.Tick(static_cast<double>(iteration) / Iterations, {}); };
  const LbfgsEnd end = solver.Minimise(options, observer, &monitor, memory, alone);
  if (end == LbfgsEnd::Stopped)
  {
    return false;
  }
  ForRows(model, objects,
          [&](std::size_t whole, std::size_t part)
          {
            const auto from = alone.begin() + static_cast<std::ptrdiff_t>(part);
            std::copy(from, from + count, state.begin() + static_cast<std::ptrdiff_t>(whole));
          });
  return true;
}

} // namespace waft
