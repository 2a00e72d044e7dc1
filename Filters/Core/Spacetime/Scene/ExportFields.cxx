// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Fields/WindEstimate.h"
#include "Spacetime/Scene/SpacetimeExport.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

constexpr double ForceFloor = 0.05; // m/s^2: below it a point counts as undriven

// The annotation's rule: vortex where it gives more than half of the force.
void Annotate(const SpacetimeUnits& units, const std::vector<Vortex>& vortices, const Vec3& x,
              double time, const Vec3& vortexForce, const Vec3& windForce, Track& track)
{
  const double vortex = vortexForce.norm();
  const double wind = windForce.norm();
  ForceType type = ForceType::None;
  int id = -1;
  if (vortex > 0.5 * (vortex + wind) && vortex > ForceFloor)
  {
    type = ForceType::Vortex;
    double strongest = 0.0;
    for (const Vortex& candidate : vortices)
    {
      const double a = ToWorld(units, candidate).Acceleration(x, time).norm();
      if (a > strongest)
      {
        strongest = a;
        id = candidate.VortexId;
      }
    }
  }
  else if (wind > ForceFloor)
  {
    type = ForceType::Wind;
  }
  track.ForceTypes.push_back(type);
  track.VortexIds.push_back(id);
}

void AppendObjects(const SpacetimeInput& input, const SpacetimeSetup& setup,
                   const std::vector<Vortex>& vortices, FrameTerms& terms, const float* state,
                   int frame, SpacetimeOutput& output)
{
  const SpacetimeModel& model = setup.Model;
  const std::size_t stride = model.Stride();
  const std::size_t per = model.Offsets.size();
  const double speed = setup.Spacing / setup.FrameStep;
  const double time = input.Scene.Time.Time(frame);
  const std::vector<FrameTerms::AirAt> air = terms.Air();
  for (std::size_t o = 0; o < model.NumberOfObjects; ++o)
  {
    const std::size_t i = model.NumberOfGas + o;
    Track& track = output.Tracks[o];
    double witness = 0.0;
    for (std::size_t k = model.NumberOfGas + o * per; k < model.NumberOfGas + (o + 1) * per; ++k)
    {
      witness += (air[k].Density - air[k].WallFraction) / static_cast<double>(per);
    }
    Vec3 v, u, vortex, wind;
    for (int c = 0; c < 3; ++c)
    {
      v[c] = state[(3 + c) * stride + i];
      u[c] = v[c] + terms.Average(c)[i] / std::max(0.05, witness);
      vortex[c] = terms.ByVortices(c)[i];
      wind[c] = terms.External(c)[i] - vortex[c];
    }
    vortex *= setup.AccelerationUnit();
    wind *= setup.AccelerationUnit();
    track.SphVelocities.push_back(speed * v);
    track.AirVelocities.push_back(speed * u);
    track.VortexAccelerations.push_back(vortex);
    track.WindAccelerations.push_back(wind);
    track.Forces.push_back(vortex + wind);
    Annotate(setup, vortices, track.Positions[frame], time, vortex, wind, track);
  }
}

void AppendParticles(const SpacetimeInput& input, const SpacetimeSetup& setup, FrameTerms& terms,
                     const float* state, ParticleSeries& series)
{
  const SpacetimeModel& model = setup.Model;
  const std::size_t stride = model.Stride();
  const std::size_t per = model.Offsets.size();
  const std::size_t n = model.NumberOfParticles();
  const double speed = setup.Spacing / setup.FrameStep;
  const double density = input.Scene.AirDensity;
  const std::vector<FrameTerms::AirAt> air = terms.Air();
  series.Frames.emplace_back();
  ParticleSeries::Frame& frame = series.Frames.back();
  for (auto* v : { &frame.Positions, &frame.Velocities, &frame.Winds, &frame.VortexForces })
  {
    v->reserve(3 * n);
  }
  for (std::size_t k = 0; k < n; ++k)
  {
    const bool gas = k < model.NumberOfGas;
    const std::size_t part = gas ? 0 : (k - model.NumberOfGas) % per;
    const std::size_t i = gas ? k : model.NumberOfGas + (k - model.NumberOfGas) / per;
    for (int c = 0; c < 3; ++c)
    {
      const double offset = gas ? 0.0 : model.Offsets[part][c];
      frame.Positions.push_back(
        static_cast<float>(setup.Origin[c] + setup.Spacing * (state[c * stride + i] + offset)));
      frame.Velocities.push_back(static_cast<float>(speed * state[(3 + c) * stride + i]));
      const double vortex = terms.ByVortices(c)[i];
      frame.VortexForces.push_back(static_cast<float>(setup.AccelerationUnit() * vortex));
      frame.Winds.push_back(
        static_cast<float>(setup.AccelerationUnit() * (terms.External(c)[i] - vortex)));
    }
    frame.Densities.push_back(static_cast<float>(density * air[k].Density));
    frame.Pressures.push_back(static_cast<float>(density * speed * speed * air[k].Pressure));
  }
}

// The estimated wind, and the user's where it is an acceleration, at the nodes of the estimate's
// lattice.
FieldSeries ExportWind(const SpacetimeInput& input, const SpacetimeSetup& setup,
                       const SplineWind& wind)
{
  const SpacetimeModel& model = setup.Model;
  const bool background = !model.Background.IsEmpty() && model.Background.Drag <= 0.0;
  const SplineWind shape = MakeWindLattice(model, WindOptions().FramesPerKnot);
  const std::size_t knots =
    !wind.IsEmpty()
      ? wind.Knots.size()
      : (background ? 1 + static_cast<std::size_t>(model.NumberOfFrames / shape.FramesPerKnot) : 1);
  FieldSeries field;
  field.Meaning = FieldMeaning::Acceleration;
  field.Dimensions = shape.Dimensions;
  field.Origin = setup.ToWorld(shape.Origin);
  field.Spacing = setup.Spacing * shape.Spacing;
  for (std::size_t knot = 0; knot < knots; ++knot)
  {
    const double frame = static_cast<double>(knot) * shape.FramesPerKnot;
    field.Times.push_back(input.Scene.Time.Time(frame));
    std::vector<std::array<float, 3>> values;
    for (int k = 0; k < shape.Dimensions[2]; ++k)
    {
      for (int j = 0; j < shape.Dimensions[1]; ++j)
      {
        for (int i = 0; i < shape.Dimensions[0]; ++i)
        {
          const Vec3 x = shape.Origin + Vec3(i, j, k).cwiseProduct(shape.Spacing);
          Vec3 value = Vec3::Zero();
          if (!wind.IsEmpty())
          {
            value += SampleField(wind, x, frame);
          }
          if (background)
          {
            value += SampleField(model.Background, x, frame);
          }
          value *= setup.AccelerationUnit();
          values.push_back({ static_cast<float>(value.x()), static_cast<float>(value.y()),
                             static_cast<float>(value.z()) });
        }
      }
    }
    field.Values.push_back(std::move(values));
  }
  return field;
}

} // namespace

bool ExportFields(const SpacetimeInput& input, const SpacetimeSetup& setup,
                  SpacetimeObjective& objective, const StateVector& state,
                  const std::vector<std::vector<Vec3>>& positions, Monitor& monitor,
                  SpacetimeOutput& output)
{
  const SpacetimeModel& model = setup.Model;
  output.Tracks.assign(model.NumberOfObjects, Track());
  for (std::size_t o = 0; o < model.NumberOfObjects; ++o)
  {
    output.Tracks[o].ObjectId = setup.Objects[o].ObjectId;
    output.Tracks[o].Positions = positions[o];
  }
  ParticleSeries& series = output.Particles;
  series = ParticleSeries();
  const double mass = input.Scene.AirDensity * std::pow(setup.Spacing, 3);
  for (std::size_t k = 0; k < model.NumberOfParticles(); ++k)
  {
    const bool gas = k < model.NumberOfGas;
    series.ObjectIds.push_back(
      gas ? -1 : setup.Objects[(k - model.NumberOfGas) / model.Offsets.size()].ObjectId);
    series.Masses.push_back(
      static_cast<float>(mass * (gas ? model.Fluid.GasMass : model.Fluid.ObjectMass)));
  }
  bool going = true;
  for (int frame = 0; frame < model.NumberOfFrames; ++frame)
  {
    FrameTerms& terms = objective.ForwardFrame(state, static_cast<std::size_t>(frame));
    const float* here = state.data() + frame * model.FrameSize();
    AppendObjects(input, setup, objective.Fields().Vortices, terms, here, frame, output);
    AppendParticles(input, setup, terms, here, series);
    // An abort is noted, and the rest still written: a result without its last frames is none.
    going = monitor.Tick(1.0, "writing the motion") && going;
  }
  output.Vortices.clear();
  for (const Vortex& vortex : objective.Fields().Vortices)
  {
    output.Vortices.push_back(ToWorld(setup, vortex));
  }
  output.Wind = ExportWind(input, setup, objective.Fields().Wind);
  return going;
}

} // namespace waft
