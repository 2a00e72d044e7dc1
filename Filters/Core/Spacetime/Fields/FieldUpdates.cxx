// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Fields/FieldUpdates.h"

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

std::vector<Vec3> ObjectPositions(const SpacetimeModel& model, const FramePartition& partition,
                                  const StateVector& state)
{
  const std::size_t no = model.NumberOfObjects;
  std::vector<float> rows(partition.Frames() * no * 3, 0.0f);
  for (std::size_t j = partition.Own().Begin; j < partition.Own().End; ++j)
  {
    const float* p = state.data() + partition.Slot(j) * model.FrameSize() + model.NumberOfGas;
    for (std::size_t k = 0; k < 3 * no; ++k)
    {
      rows[3 * j * no + k] = p[(k % 3) * model.Stride() + k / 3];
    }
  }
  partition.Gather(rows, 3 * no);
  std::vector<Vec3> positions;
  for (std::size_t k = 0; k < rows.size(); k += 3)
  {
    positions.emplace_back(rows[k], rows[k + 1], rows[k + 2]);
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
  const std::vector<Vec3> positions = ObjectPositions(model, objective.Partition(), state);
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
                    const StateVector& state, Monitor& monitor, Monitor& fitMonitor,
                    SpacetimeTerms& terms)
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
  const FramePartition& partition = objective.Partition();
  const std::vector<Vec3> positions = ObjectPositions(model, partition, state);
  const std::vector<float> rows = objective.ObjectRows();
  std::vector<VortexSample> samples;
  ForFlights(model, level, positions,
             [&](std::size_t j, std::size_t o, const Vec3& x)
             {
               const int frame = level.Frames[j];
               if (j % SampleStride != 0)
               {
                 return;
               }
               const double weight =
                 model.VelocityWeight(model.NumberOfGas + o) * level.StepWeights[j + 1];
               const float* row = rows.data() + ((j + 1) * model.NumberOfObjects + o) * 6 + 3;
               const Vec3 rv = weight > 0.0
                                 ? Vec3(row[0] / weight, row[1] / weight, row[2] / weight)
                                 : Vec3::Zero();
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
  bool going = true;
  if (partition.IsFirst())
  {
    const Result result = FitVortices(samples, priors, options, fitMonitor, fitted);
    going = !result.IsStopped();
    if (!result || !going)
    {
      fitted.clear();
    }
  }
  if (!partition.IsAlone())
  {
    BroadcastStream stream(partition.Others());
    stream.Value(going);
    stream.List(fitted, [](StateArchive& s, Vortex& v) { Serialise(s, v); });
  }
  if (fitted.empty())
  {
    return going;
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
