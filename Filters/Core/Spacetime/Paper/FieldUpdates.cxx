// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Paper/FieldUpdates.h"

#include "Constraints/MotionProblem.h"
#include "Spacetime/Fields/WindEstimate.h"
#include "Vortex/VortexFit.h"

#include <cmath>
#include <set>

namespace waft
{
namespace
{

constexpr double WindBound = 1.8; // of the vortices' rms acceleration; twice would be an error
constexpr double VortexTolerance = 1.02; // E may grow by this factor for new vortices
constexpr int SampleStride = 2;          // frames between samples of a vortex fit

template <typename Visit>
void ForFlights(const SpacetimeModel& model, const TimeLevel& level,
                const std::vector<Vec3>& positions, Visit visit)
{
  for (std::size_t j = 0; j + 1 < level.NumberOfFrames(); ++j)
  {
    for (std::size_t o = 0; o < model.NumberOfObjects; ++o)
    {
      if (!StepIsBound(model, level, j + 1, o))
      {
        visit(j, o, positions[j * model.NumberOfObjects + o]);
      }
    }
  }
}

Vec3 VortexAcceleration(const AirFields& fields, const Vec3& x, double frame)
{
  Vec3 sum = Vec3::Zero();
  for (const Vortex& vortex : fields.Vortices)
  {
    sum += vortex.Acceleration(x, frame);
  }
  return sum;
}

void Scale(SplineWind& wind, double factor)
{
  for (std::vector<float>& knot : wind.Knots)
  {
    for (float& value : knot)
    {
      value *= static_cast<float>(factor);
    }
  }
}

} // namespace

std::vector<Vec3> ObjectPositions(const SpacetimeModel& model, std::size_t frames,
                                  const StateVector& state)
{
  std::vector<Vec3> positions;
  for (std::size_t j = 0; j < frames; ++j)
  {
    for (std::size_t o = 0; o < model.NumberOfObjects; ++o)
    {
      const float* p = state.data() + j * model.FrameSize() + model.NumberOfGas + o;
      positions.emplace_back(p[0], p[model.Stride()], p[2 * model.Stride()]);
    }
  }
  return positions;
}

void HoldWind(const SpacetimeModel& model, const TimeLevel& level,
              const std::vector<Vec3>& positions, AirFields& fields)
{
  if (fields.Wind.IsEmpty())
  {
    return;
  }
  struct Sums
  {
    double Vortices = 0.0, Wind = 0.0;
  } flights, all;
  for (std::size_t j = 0; j < level.NumberOfFrames(); ++j)
  {
    for (std::size_t o = 0; o < model.NumberOfObjects; ++o)
    {
      const Vec3& x = positions[j * model.NumberOfObjects + o];
      const double vortices = VortexAcceleration(fields, x, level.Frames[j]).squaredNorm();
      const double wind = SampleField(fields.Wind, x, level.Frames[j]).squaredNorm();
      all.Vortices += vortices;
      all.Wind += wind;
      if (j + 1 < level.NumberOfFrames() && !StepIsBound(model, level, j + 1, o))
      {
        flights.Vortices += vortices;
        flights.Wind += wind;
      }
    }
  }
  double factor = 1.0;
  for (const Sums& sums : { flights, all })
  {
    if (sums.Vortices > 0.0 && sums.Wind > WindBound * WindBound * sums.Vortices)
    {
      factor = std::min(factor, WindBound * std::sqrt(sums.Vortices / sums.Wind));
    }
  }
  if (factor < 1.0)
  {
    Scale(fields.Wind, factor);
  }
}

bool UpdateWind(AirFields& fields, SpacetimeObjective& objective, const StateVector& state,
                const ParallelFor& parallel, Monitor* monitor, SpacetimeTerms& terms)
{
  const SpacetimeModel& model = objective.Model();
  // New vortices may be weaker than those that the wind was held to.
  const std::vector<Vec3> positions =
    ObjectPositions(model, objective.Level().NumberOfFrames(), state);
  HoldWind(model, objective.Level(), positions, fields);
  // The residuals that the estimate reads belong to the last evaluation: make that this state.
  if (!objective.Evaluate(state, nullptr, terms, monitor))
  {
    return false;
  }
  const SplineWind before = fields.Wind;
  const SplineWind fitted = EstimateWind(objective, state, WindOptions(), parallel);
  for (double fraction = 1.0; fraction > 0.2; fraction *= 0.5)
  {
    fields.Wind = fitted;
    HoldWind(model, objective.Level(), positions, fields);
    Scale(fields.Wind, fraction);
    SpacetimeTerms next;
    if (!objective.Evaluate(state, nullptr, next, monitor))
    {
      fields.Wind = before;
      return false;
    }
    if (std::isfinite(next.E) && next.E < terms.E)
    {
      terms = next;
      return true;
    }
  }
  fields.Wind = before;
  return objective.Evaluate(state, nullptr, terms, monitor);
}

bool UpdateVortices(AirFields& fields, const SpacetimeUnits& units, SpacetimeObjective& objective,
                    const std::vector<Track>& planned, const Box& bounds, std::uint64_t seed,
                    const StateVector& state, Monitor& monitor, SpacetimeTerms& terms)
{
  const SpacetimeModel& model = objective.Model();
  if (!objective.Evaluate(state, nullptr, terms, &monitor))
  {
    return false;
  }
  std::vector<Vortex> priors;
  std::set<int> known;
  for (const Vortex& vortex : fields.Vortices)
  {
    priors.push_back(ToWorld(units, vortex));
    known.insert(vortex.VortexId);
  }
  const TimeLevel& level = objective.Level();
  const std::vector<Vec3> positions = ObjectPositions(model, level.NumberOfFrames(), state);
  std::vector<VortexSample> samples;
  ForFlights(model, level, positions,
             [&](std::size_t j, std::size_t o, const Vec3& x)
             {
               const int frame = level.Frames[j];
               if (j % SampleStride != 0)
               {
                 return;
               }
               Vec3 rv;
               objective.VelocityResidual(j + 1, model.NumberOfGas + o, rv.data());
               // What the motion asks for: the fields as they are and what they leave over.
               Vec3 a = VortexAcceleration(fields, x, frame) + rv / level.Steps[j + 1];
               if (!fields.Wind.IsEmpty())
               {
                 a += SampleField(fields.Wind, x, frame);
               }
               VortexSample sample;
               sample.Track = static_cast<int>(o);
               sample.Frame = frame;
               sample.Time = frame * units.FrameStep;
               sample.Position = units.ToWorld(x);
               sample.Acceleration = a * units.AccelerationUnit();
               const std::vector<int>& ids = planned[o].VortexIds;
               if (static_cast<std::size_t>(frame) < ids.size() && known.count(ids[frame]))
               {
                 sample.VortexId = ids[frame];
               }
               samples.push_back(sample);
             });
  VortexFitOptions options;
  options.Bounds = bounds;
  options.Seed = seed;
  options.MaximumNewVortices = 0;
  std::vector<Vortex> fitted;
  const Result result = FitVortices(samples, priors, options, monitor, fitted);
  if (!result || result.IsStopped() || fitted.empty())
  {
    return !result.IsStopped();
  }
  const std::vector<Vortex> before = fields.Vortices;
  fields.Vortices.clear();
  for (const Vortex& vortex : fitted)
  {
    fields.Vortices.push_back(ToModel(units, vortex));
  }
  SpacetimeTerms next;
  const bool evaluated = objective.Evaluate(state, nullptr, next, &monitor);
  if (evaluated && std::isfinite(next.E) && next.E <= VortexTolerance * terms.E)
  {
    terms = next;
    return true;
  }
  fields.Vortices = before;
  return evaluated;
}

} // namespace waft
