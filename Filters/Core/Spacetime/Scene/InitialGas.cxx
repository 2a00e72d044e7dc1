// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Scene/InitialGas.h"

#include "Base/FractionDone.h"
#include "Spacetime/Fields/SplineFit.h"
#include "Spacetime/Fields/WindEstimate.h"
#include "Spacetime/Scene/Rollout.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

constexpr double StillWeight =
  0.001;                           // of a gas particle that knows of no object, against an object
constexpr double WallWeight = 0.2; // of one at a wall: the flow must not cross it
constexpr double WallReach = 0.6;  // [dx]
constexpr double Pull = 0.04; // towards the flow [1 / frame]: the vortices lead, the flow keeps up
constexpr double FlowSpacing = 1.7;   // of the flow's lattice [dx]: finer than that is the gas' own
constexpr double FramesPerKnot = 8.0; // of the flow
constexpr double MostStrength = 3.0;
constexpr double Beginning = 15.0; // the gas starts with the flow of this frame

Vec3 Row(const float* state, std::size_t stride, std::size_t i)
{
  return { state[i], state[stride + i], state[2 * stride + i] };
}

/// What penalties take from the strength of a fit is given back: the factor with which it comes
/// nearest to the objects.
double LostStrength(const SplineWind& flow, const std::vector<SplineSamples>& samples)
{
  double product = 0.0, square = 0.0;
  for (const SplineSamples& frame : samples)
  {
    for (const SplineSamples::Sample& sample : frame.Samples)
    {
      if (!sample.Value.isZero()) // an object's
      {
        const Vec3 u = SampleField(flow, sample.Position, frame.Frame);
        product += u.dot(sample.Value);
        square += u.squaredNorm();
      }
    }
  }
  return square > 0.0 ? std::clamp(product / square, 1.0, MostStrength) : 1.0;
}

SplineWind FitFlow(const SpacetimeModel& model, const TimeLevel& level, const StateVector& state,
                   const ParallelFor& parallel)
{
  const std::size_t stride = model.Stride();
  std::vector<SplineSamples> samples(level.NumberOfFrames());
  for (std::size_t j = 0; j < samples.size(); ++j)
  {
    samples[j].Frame = level.Frames[j];
    const float* here = state.data() + j * model.FrameSize();
    for (std::size_t o = 0; o < model.NumberOfObjects; ++o)
    {
      if (j == 0 || StepIsBound(model, level, j, o))
      {
        continue;
      }
      SplineSamples::Sample sample;
      sample.Position = Row(here, stride, model.NumberOfGas + o);
      sample.Value = Row(here + 3 * stride, stride, model.NumberOfGas + o);
      sample.Value.z() += model.SettlingSlip(o);
      samples[j].Samples.push_back(sample);
    }
    const auto every = static_cast<std::size_t>(WindOptions().GasStride);
    for (std::size_t i = j % every; i < model.NumberOfGas; i += every)
    {
      SplineSamples::Sample sample;
      sample.Position = Row(here, stride, i);
      const bool atWall = (sample.Position.array() < WallReach).any() ||
                          ((model.Size - sample.Position).array() < WallReach).any();
      sample.Weight = every * (atWall ? WallWeight : StillWeight);
      samples[j].Samples.push_back(sample);
    }
  }
  SplineWind flow = FitSplineField(
    MakeLattice(model.Size, LatticeDimensions(model.Size / FlowSpacing), FramesPerKnot),
    KnotsOf(model, FramesPerKnot), samples, SplineFitOptions(), parallel);
  const double strength = LostStrength(flow, samples);
  for (std::vector<float>& knot : flow.Knots)
  {
    for (float& value : knot)
    {
      value = static_cast<float>(strength * value);
    }
  }
  return flow;
}

} // namespace

bool MakeInitialGas(SpacetimeObjective& objective, const ParallelFor& parallel, Monitor& monitor,
                    StateVector& state)
{
  const SpacetimeModel& model = objective.Model();
  const TimeLevel& level = objective.Level();
  const std::size_t stride = model.Stride();
  const std::size_t gas = model.NumberOfGas;
  const bool inAir = !model.Air.IsEmpty();
  const SplineWind flow = inAir ? SplineWind() : FitFlow(model, level, state, parallel);
  const StateVector still = state;
  for (std::size_t i = 0; i < gas; ++i)
  {
    // Of what is before the first frame no object tells the flow's first knots.
    const Vec3 x = Row(state.data(), stride, i);
    const Vec3 v = inAir ? model.Air.Velocity(x, 0.0) : SampleField(flow, x, Beginning);
    for (int c = 0; c < 3; ++c)
    {
      state[(3 + c) * stride + i] = static_cast<float>(v[c]);
    }
  }
  for (std::size_t j = 0; j + 1 < level.NumberOfFrames(); ++j)
  {
    if (!monitor.Tick(FractionDone(j, level.NumberOfFrames()), {}))
    {
      state = still;
      return false;
    }
    FrameTerms& terms = objective.ForwardFrame(state, j);
    const float* here = state.data() + j * model.FrameSize();
    float* next = state.data() + (j + 1) * model.FrameSize();
    const double step = level.Steps[j + 1];
    bool isFinite = true;
    for (std::size_t i = 0; i < gas; ++i)
    {
      const Vec3 x = Row(here, stride, i);
      const Vec3 v = Row(here + 3 * stride, stride, i);
      const Vec3 pull =
        inAir ? Vec3(Vec3::Zero()) : Vec3(Pull * (SampleField(flow, x, level.Frames[j]) - v));
      const Vec3 after = NextVelocity(model, level, terms, j, i, x, v, pull);
      MoveBody(model, i, step, x, after, next);
      isFinite = isFinite && after.allFinite();
    }
    if (!isFinite)
    {
      state = still;
      return false;
    }
  }
  return true;
}

} // namespace waft
