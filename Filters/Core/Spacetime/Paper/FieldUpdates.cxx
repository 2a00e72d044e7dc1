// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Paper/FieldUpdates.h"

#include "Vortex/VortexFit.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace waft
{
namespace
{

constexpr double LeastGain = 1e-6;   // of E
constexpr double LeastShare = 1e-4;  // of what the fields explain: a vortex below it is left out
constexpr std::size_t Stride = 2;    // frames between samples of a vortex fit
constexpr std::size_t GasStride = 8; // every eighth gas particle witnesses one of these, in turn

bool IsBetter(const SpacetimeTerms& next, const SpacetimeTerms& before)
{
  return std::isfinite(next.E) && next.E < (1.0 - LeastGain) * before.E;
}

/// Solves for the objective's fields, and says what E is with them. The objective must just have
/// been evaluated at `state` with the shapes of the vortices as they are. False: stopped.
bool Try(AirFields& fields, SpacetimeObjective& objective, const StateVector& state,
         const FieldChoice& choice, const ParallelFor& parallel, Monitor* monitor,
         SpacetimeTerms& terms, std::vector<int>& dropped)
{
  FieldNormal normal(objective.Model(), fields, choice);
  if (!normal.Gather(objective, state, parallel, monitor) || !normal.Solve(fields, monitor))
  {
    return false;
  }
  dropped = normal.Idle(fields, LeastShare);
  if (!dropped.empty())
  {
    const std::set<int> idle(dropped.begin(), dropped.end());
    fields.Vortices.erase(std::remove_if(fields.Vortices.begin(), fields.Vortices.end(),
                                         [&](const Vortex& vortex)
                                         { return idle.count(vortex.VortexId) > 0; }),
                          fields.Vortices.end());
  }
  fields.Cost = FieldCost(objective.Model(), fields);
  return objective.Evaluate(state, nullptr, terms, monitor);
}

/// What all particles ask of the vortices: their present acceleration and what is left over.
std::vector<VortexSample> SamplesOf(const SpacetimeUnits& units,
                                    const SpacetimeObjective& objective,
                                    const std::vector<Track>& planned, const StateVector& state)
{
  const SpacetimeModel& model = objective.Model();
  const TimeLevel& level = objective.Level();
  std::set<int> known;
  for (const Vortex& vortex : objective.Fields().Vortices)
  {
    known.insert(vortex.VortexId);
  }
  std::vector<VortexSample> samples;
  for (std::size_t j = 0; j + 1 < level.NumberOfFrames(); j += Stride)
  {
    const int frame = level.Frames[j];
    for (std::size_t i = 0; i < model.NumberOfBodies(); ++i)
    {
      const bool isObject = i >= model.NumberOfGas;
      const std::size_t o = i - model.NumberOfGas;
      if (isObject ? !StepHasLaw(model, level, j + 1, o) : (i + 3 * j / Stride) % GasStride != 0)
      {
        continue;
      }
      const Vec3 x = VectorAt(state.data() + j * model.FrameSize() + i, model.Stride());
      Vec3 asked;
      objective.VelocityResidual(j + 1, i, asked.data());
      asked /= level.Steps[j + 1];
      for (const Vortex& vortex : objective.Fields().Vortices)
      {
        asked += vortex.Acceleration(x, frame);
      }
      VortexSample sample;
      sample.Track = static_cast<int>(isObject ? o : model.NumberOfObjects + i);
      sample.Frame = frame;
      sample.Time = frame * units.FrameStep;
      sample.Position = units.ToWorld(x);
      sample.Acceleration = asked * units.AccelerationUnit();
      sample.Weight = isObject ? model.BodyWeight(i) : static_cast<double>(GasStride);
      const std::vector<int> none;
      const std::vector<int>& ids = isObject ? planned[o].VortexIds : none;
      if (static_cast<std::size_t>(frame) < ids.size() && known.count(ids[frame]))
      {
        sample.VortexId = ids[frame];
      }
      samples.push_back(sample);
    }
  }
  return samples;
}

} // namespace

bool SolveFields(AirFields& fields, SpacetimeObjective& objective, const StateVector& state,
                 const FieldChoice& choice, const ParallelFor& parallel, Monitor* monitor,
                 SpacetimeTerms& terms, std::vector<int>& dropped)
{
  if (!objective.Evaluate(state, nullptr, terms, monitor))
  {
    return false;
  }
  const AirFields before = fields;
  SpacetimeTerms next;
  const bool going = Try(fields, objective, state, choice, parallel, monitor, next, dropped);
  if (going && IsBetter(next, terms))
  {
    terms = next;
    return true;
  }
  fields = before;
  dropped.clear();
  return going;
}

bool RefitVortices(AirFields& fields, const SpacetimeUnits& units, SpacetimeObjective& objective,
                   const std::vector<Track>& planned, const Box& bounds, std::uint64_t seed,
                   const StateVector& state, const FieldChoice& choice, const ParallelFor& parallel,
                   Monitor& monitor, SpacetimeTerms& terms, std::vector<int>& dropped)
{
  if (!objective.Evaluate(state, nullptr, terms, &monitor))
  {
    return false;
  }
  std::vector<Vortex> recorded;
  for (const Vortex& vortex : fields.Vortices)
  {
    recorded.push_back(ToWorld(units, vortex));
  }
  VortexFitOptions options;
  options.Bounds = bounds;
  options.Seed = seed;
  options.MaximumNewVortices = 0;
  std::vector<Vortex> fitted;
  const Result result =
    FitVortices(SamplesOf(units, objective, planned, state), recorded, options, monitor, fitted);
  if (!result || result.IsStopped() || fitted.empty())
  {
    return !result.IsStopped();
  }
  const AirFields before = fields;
  fields.Vortices.clear();
  for (const Vortex& vortex : fitted)
  {
    fields.Vortices.push_back(ToModel(units, vortex));
  }
  SpacetimeTerms next;
  const bool going = objective.Evaluate(state, nullptr, next, &monitor) &&
                     Try(fields, objective, state, choice, parallel, &monitor, next, dropped);
  if (going && IsBetter(next, terms))
  {
    terms = next;
    return true;
  }
  fields = before;
  dropped.clear();
  return going;
}

} // namespace waft
