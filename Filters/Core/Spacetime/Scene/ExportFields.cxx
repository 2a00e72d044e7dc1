// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Fields/WindEstimate.h"
#include "Spacetime/Scene/Rollout.h"
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

// What moves an object in a drawn air beside it, from the frame before on: the gas' deviation that
// is felt there, and the control that neither air nor gas gives [dx / frame].
struct AirDeviation
{
  Vec3 Gas = Vec3::Zero();
  Vec3 Control = Vec3::Zero();
};

// The acceleration that no term of the model gives into a frame, in a drawn air about the frame
// before: objects go with it, so that there it is the change of their control.
void AppendResidual(const SpacetimeSetup& setup, const SpacetimeObjective& objective, int frame,
                    std::size_t object, const Vec3& controlBefore, const Vec3& control,
                    Track& track)
{
  const SpacetimeModel& model = setup.Model;
  track.Residuals.push_back(Vec3::Zero());
  if (frame == 0)
  {
    return;
  }
  const bool lies = (model.Flag(frame, object) & NoDynamics) != 0;
  if (!model.Air.IsEmpty())
  {
    if (!lies && frame > 1)
    {
      track.Residuals[static_cast<std::size_t>(frame) - 1] =
        setup.AccelerationUnit() * (control - controlBefore);
    }
    return;
  }
  double rv[3];
  objective.VelocityResidual(static_cast<std::size_t>(frame), model.NumberOfGas + object, rv);
  track.Residuals.back() =
    lies ? Vec3(Vec3::Zero()) : Vec3(setup.AccelerationUnit() * Vec3(rv[0], rv[1], rv[2]));
}

void AppendObjects(const SpacetimeInput& input, const SpacetimeSetup& setup,
                   const SpacetimeObjective& objective, FrameTerms& terms, const float* state,
                   int frame, std::vector<AirDeviation>& deviations, SpacetimeOutput& output)
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
    Vec3 x, v, relative, vortex, wind;
    for (int c = 0; c < 3; ++c)
    {
      x[c] = state[c * stride + i];
      v[c] = state[(3 + c) * stride + i];
      relative[c] = terms.Average(c)[i];
      vortex[c] = terms.ByVortices(c)[i];
      wind[c] = terms.External(c)[i] - vortex[c];
    }
    Vec3 u = v + relative / std::max(0.05, witness);
    const Vec3 controlBefore = deviations[o].Control;
    if (!model.Air.IsEmpty())
    {
      const Vec3 w = model.Air.Deviation(i, x, v, frame, frame > 0 ? 1.0 : 0.0);
      deviations[o].Control = w - deviations[o].Gas;
      deviations[o].Gas = w + relative;
      u = model.Air.Velocity(x, frame) + deviations[o].Gas;
    }
    AppendResidual(setup, objective, frame, o, controlBefore, deviations[o].Control, track);
    vortex *= setup.AccelerationUnit();
    wind *= setup.AccelerationUnit();
    track.SphVelocities.push_back(speed * v);
    track.AirVelocities.push_back(speed * u);
    track.VortexAccelerations.push_back(vortex);
    track.WindAccelerations.push_back(wind);
    track.Forces.push_back(vortex + wind);
    Annotate(setup, objective.Fields().Vortices, track.Positions[frame], time, vortex, wind, track);
  }
}

void AppendParticles(const SpacetimeInput& input, const SpacetimeSetup& setup,
                     const SpacetimeObjective& objective, FrameTerms& terms, const float* state,
                     int number, const std::vector<Track>& tracks, ParticleSeries& series)
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
  for (auto* v :
       { &frame.Positions, &frame.Velocities, &frame.Winds, &frame.VortexForces, &frame.Residuals })
  {
    v->reserve(3 * n);
  }
  for (std::size_t k = 0; k < n; ++k)
  {
    const bool gas = k < model.NumberOfGas;
    const std::size_t part = gas ? 0 : (k - model.NumberOfGas) % per;
    const std::size_t i = gas ? k : model.NumberOfGas + (k - model.NumberOfGas) / per;
    double rv[3] = {};
    if (gas && number > 0)
    {
      objective.VelocityResidual(static_cast<std::size_t>(number), i, rv);
    }
    const Vec3 residual = gas ? Vec3(setup.AccelerationUnit() * Vec3(rv[0], rv[1], rv[2]))
                              : tracks[i - model.NumberOfGas].Residuals.back();
    for (int c = 0; c < 3; ++c)
    {
      const double offset = gas ? 0.0 : model.Offsets[part][c];
      frame.Positions.push_back(
        static_cast<float>(setup.Origin[c] + setup.Spacing * (state[c * stride + i] + offset)));
      frame.Velocities.push_back(static_cast<float>(speed * state[(3 + c) * stride + i]));
      frame.Residuals.push_back(static_cast<float>(residual[c]));
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

bool MeasureDynamics(const SpacetimeSetup& setup, SpacetimeObjective& objective,
                     const StateVector& state, Monitor& monitor, SpacetimeOutput& output)
{
  const SpacetimeModel& model = setup.Model;
  const ParticleSeries& series = output.Particles;
  double residuals = 0.0, accelerations = 0.0;
  for (std::size_t k = 1; k < series.Frames.size(); ++k)
  {
    const ParticleSeries::Frame& frame = series.Frames[k];
    for (std::size_t i = 0; i < 3 * model.NumberOfGas; ++i)
    {
      const double a = (frame.Velocities[i] - series.Frames[k - 1].Velocities[i]) / setup.FrameStep;
      residuals += static_cast<double>(frame.Residuals[i]) * frame.Residuals[i];
      accelerations += a * a;
    }
  }
  output.GasHiddenHand = accelerations > 0.0 ? std::sqrt(residuals / accelerations) : -1.0;
  const ReplayError replay =
    MeasureReplay(objective, state, static_cast<int>(std::lround(1.0 / setup.FrameStep)), monitor);
  output.ObjectReplayError = replay.Objects;
  output.GasReplayError = replay.Gas;
  return monitor.Tick(1.0, "writing the motion");
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
  std::vector<AirDeviation> deviations(model.NumberOfObjects);
  for (int frame = 0; frame < model.NumberOfFrames; ++frame)
  {
    FrameTerms& terms = objective.ForwardFrame(state, static_cast<std::size_t>(frame));
    const float* here = state.data() + frame * model.FrameSize();
    AppendObjects(input, setup, objective, terms, here, frame, deviations, output);
    AppendParticles(input, setup, objective, terms, here, frame, output.Tracks, series);
    // An abort is noted, and the rest still written: a result without its last frames is none.
    going = monitor.Tick(1.0, "writing the motion") && going;
  }
  going = going && MeasureDynamics(setup, objective, state, monitor, output);
  output.Vortices.clear();
  for (const Vortex& vortex : objective.Fields().Vortices)
  {
    output.Vortices.push_back(ToWorld(setup, vortex));
  }
  output.Wind = ExportWind(input, setup, objective.Fields().Wind);
  return going;
}

} // namespace waft
