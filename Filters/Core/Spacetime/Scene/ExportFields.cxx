// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Fields/WindEstimate.h"
#include "Spacetime/Scene/Rollout.h"
#include "Spacetime/Scene/SpacetimeExport.h"

#include <algorithm>
#include <cmath>
#include <utility>

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
  output.GasModelResidual = accelerations > 0.0 ? std::sqrt(residuals / accelerations) : -1.0;
  const ReplayError replay =
    MeasureReplay(objective, state, static_cast<int>(std::lround(1.0 / setup.FrameStep)), monitor);
  output.ObjectReplayError = replay.Objects;
  output.GasReplayError = replay.Gas;
  return monitor.Tick(1.0, "writing the motion");
}

} // namespace

FieldExport::FieldExport(const SpacetimeInput& input, const SpacetimeSetup& setup,
                         const StateVector& state) :
  Input(input),
  Setup(setup), State(state), Frames(static_cast<std::size_t>(setup.Model.NumberOfFrames)),
  Objects(this->Frames.size() * setup.Model.NumberOfObjects)
{
}

void FieldExport::Visit(std::size_t frame, FrameTerms& terms)
{
  const SpacetimeModel& model = this->Setup.Model;
  const std::size_t stride = model.Stride();
  const std::size_t per = model.Offsets.size();
  const std::size_t n = model.NumberOfParticles();
  const double speed = this->Setup.Spacing / this->Setup.FrameStep;
  const double force = this->Setup.AccelerationUnit();
  const double density = this->Input.Scene.AirDensity;
  const float* state = this->State.data() + frame * model.FrameSize();
  const std::vector<FrameTerms::AirAt> air = terms.Air();
  ParticleSeries::Frame& particles = this->Frames[frame];
  for (auto* v :
       { &particles.Positions, &particles.Velocities, &particles.Winds, &particles.VortexForces })
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
      particles.Positions.push_back(static_cast<float>(
        this->Setup.Origin[c] + this->Setup.Spacing * (state[c * stride + i] + offset)));
      particles.Velocities.push_back(static_cast<float>(speed * state[(3 + c) * stride + i]));
      const double vortex = terms.ByVortices(c)[i];
      particles.VortexForces.push_back(static_cast<float>(force * vortex));
      particles.Winds.push_back(static_cast<float>(force * (terms.External(c)[i] - vortex)));
    }
    particles.Densities.push_back(static_cast<float>(density * air[k].Density));
    particles.Pressures.push_back(static_cast<float>(density * speed * speed * air[k].Pressure));
  }
  for (std::size_t o = 0; o < model.NumberOfObjects; ++o)
  {
    const std::size_t i = model.NumberOfGas + o;
    ObjectAir& about = this->Objects[frame * model.NumberOfObjects + o];
    for (std::size_t k = model.NumberOfGas + o * per; k < model.NumberOfGas + (o + 1) * per; ++k)
    {
      about.Witness += (air[k].Density - air[k].WallFraction) / static_cast<double>(per);
    }
    for (int c = 0; c < 3; ++c)
    {
      about.Relative[c] = terms.Average(c)[i];
      about.Vortex[c] = terms.ByVortices(c)[i];
      about.Wind[c] = terms.External(c)[i] - about.Vortex[c];
    }
  }
}

// The acceleration that no term of the model gives into a frame, in a sampled air about the frame
// before: objects go with it, so that there it is the change of their control.
void FieldExport::AppendResidual(const SpacetimeObjective& objective, int frame, std::size_t object,
                                 const Vec3& controlBefore, const Vec3& control, Track& track) const
{
  const SpacetimeModel& model = this->Setup.Model;
  const double unit = this->Setup.AccelerationUnit();
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
      track.Residuals[static_cast<std::size_t>(frame) - 1] = unit * (control - controlBefore);
    }
    return;
  }
  double rv[3];
  objective.VelocityResidual(static_cast<std::size_t>(frame), model.NumberOfGas + object, rv);
  track.Residuals.back() = lies ? Vec3(Vec3::Zero()) : Vec3(unit * Vec3(rv[0], rv[1], rv[2]));
}

void FieldExport::AppendObjects(const SpacetimeObjective& objective, int frame,
                                std::vector<AirDeviation>& deviations,
                                std::vector<Track>& tracks) const
{
  const SpacetimeModel& model = this->Setup.Model;
  const std::size_t stride = model.Stride();
  const double speed = this->Setup.Spacing / this->Setup.FrameStep;
  const double time = this->Input.Scene.Time.Time(frame);
  const auto j = static_cast<std::size_t>(frame);
  const float* state = this->State.data() + j * model.FrameSize();
  for (std::size_t o = 0; o < model.NumberOfObjects; ++o)
  {
    const std::size_t i = model.NumberOfGas + o;
    const ObjectAir& about = this->Objects[j * model.NumberOfObjects + o];
    Track& track = tracks[o];
    Vec3 x, v;
    for (int c = 0; c < 3; ++c)
    {
      x[c] = state[c * stride + i];
      v[c] = state[(3 + c) * stride + i];
    }
    Vec3 u = v + about.Relative / std::max(0.05, about.Witness);
    const Vec3 controlBefore = deviations[o].Control;
    if (!model.Air.IsEmpty())
    {
      const Vec3 w = model.Air.Deviation(i, x, v, frame, frame > 0 ? 1.0 : 0.0);
      deviations[o].Control = w - deviations[o].Gas;
      deviations[o].Gas = w + about.Relative;
      u = model.Air.Velocity(x, frame) + deviations[o].Gas;
    }
    this->AppendResidual(objective, frame, o, controlBefore, deviations[o].Control, track);
    const Vec3 vortex = this->Setup.AccelerationUnit() * about.Vortex;
    const Vec3 wind = this->Setup.AccelerationUnit() * about.Wind;
    track.SphVelocities.push_back(speed * v);
    track.AirVelocities.push_back(speed * u);
    track.VortexAccelerations.push_back(vortex);
    track.WindAccelerations.push_back(wind);
    track.Forces.push_back(vortex + wind);
    Annotate(this->Setup, objective.Fields().Vortices, track.Positions[j], time, vortex, wind,
             track);
  }
}

void FieldExport::AddResiduals(const SpacetimeObjective& objective, int frame,
                               const std::vector<Track>& tracks)
{
  const SpacetimeModel& model = this->Setup.Model;
  const double unit = this->Setup.AccelerationUnit();
  std::vector<float>& residuals = this->Frames[static_cast<std::size_t>(frame)].Residuals;
  residuals.reserve(3 * model.NumberOfParticles());
  const auto add = [&](const Vec3& residual)
  {
    for (int c = 0; c < 3; ++c)
    {
      residuals.push_back(static_cast<float>(residual[c]));
    }
  };
  for (std::size_t i = 0; i < model.NumberOfGas; ++i)
  {
    double rv[3] = {};
    if (frame > 0)
    {
      objective.VelocityResidual(static_cast<std::size_t>(frame), i, rv);
    }
    add(unit * Vec3(rv[0], rv[1], rv[2]));
  }
  for (const Track& track : tracks)
  {
    for (std::size_t part = 0; part < model.Offsets.size(); ++part)
    {
      add(track.Residuals.back());
    }
  }
}

bool FieldExport::Write(SpacetimeObjective& objective,
                        const std::vector<std::vector<Vec3>>& positions, Monitor& monitor,
                        SpacetimeOutput& output)
{
  const SpacetimeModel& model = this->Setup.Model;
  output.Tracks.assign(model.NumberOfObjects, Track());
  for (std::size_t o = 0; o < model.NumberOfObjects; ++o)
  {
    output.Tracks[o].TakeTimes(this->Setup.Objects[o]);
    output.Tracks[o].Positions = positions[o];
    const Track& given = this->Input.Tracks[o]; // it glides as it came
    output.Tracks[o].Slips = given.Slips;
    output.Tracks[o].Orientations = given.Orientations;
    output.Tracks[o].AngularVelocities = given.AngularVelocities;
  }
  ParticleSeries& series = output.Particles;
  series = ParticleSeries();
  const double mass = this->Input.Scene.AirDensity * std::pow(this->Setup.Spacing, 3);
  for (std::size_t k = 0; k < model.NumberOfParticles(); ++k)
  {
    const bool gas = k < model.NumberOfGas;
    series.ObjectIds.push_back(
      gas ? -1 : this->Setup.Objects[(k - model.NumberOfGas) / model.Offsets.size()].ObjectId);
    series.Masses.push_back(
      static_cast<float>(mass * (gas ? model.Fluid.GasMass : model.Fluid.ObjectMass)));
  }
  bool going = true;
  std::vector<AirDeviation> deviations(model.NumberOfObjects);
  for (int frame = 0; frame < model.NumberOfFrames; ++frame)
  {
    this->AppendObjects(objective, frame, deviations, output.Tracks);
    this->AddResiduals(objective, frame, output.Tracks);
    // An abort is recorded, and the rest still written: a result without its last frames is none.
    going = monitor.Tick(1.0, "writing the motion") && going;
  }
  series.Frames = std::move(this->Frames);
  going = going && MeasureDynamics(this->Setup, objective, this->State, monitor, output);
  output.Vortices.clear();
  for (const Vortex& vortex : objective.Fields().Vortices)
  {
    output.Vortices.push_back(ToWorld(this->Setup, vortex));
  }
  output.Wind = ExportWind(this->Input, this->Setup, objective.Fields().Wind);
  return going;
}

} // namespace waft
