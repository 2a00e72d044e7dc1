// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceObjective.h"

#include "Spacetime/Energy/WallCorrection.h"

#include <algorithm>
#include <utility>

namespace waft
{
namespace test
{

ReferenceObjective::ReferenceObjective(const SpacetimeModel& model) :
  ReferenceObjective(model, TimeLevel::Full(model.NumberOfFrames, model.Weights.TemporalWindow))
{
}

ReferenceObjective::ReferenceObjective(const SpacetimeModel& model, TimeLevel level) :
  Model(model), Level(std::move(level)), Fluid(FluidOf(this->Model, this->Level))
{
}

template <typename Function>
void ReferenceObjective::ForEach(Function function) const
{
  std::size_t k = 0;
  for (std::size_t j = 0; j < this->NumberOfFrames(); ++j)
  {
    for (std::size_t i = 0; i < this->Model.NumberOfBodies(); ++i)
    {
      for (int c = 0; c < 6; ++c)
      {
        function(k++, j * this->Model.FrameSize() + c * this->Model.Stride() + i);
      }
    }
  }
}

ReferenceObjective::Numbers ReferenceObjective::From(const StateVector& state) const
{
  Numbers z(this->Size());
  this->ForEach([&](std::size_t k, std::size_t place) { z[k] = state[place]; });
  return z;
}

StateVector ReferenceObjective::To(const Numbers& z) const
{
  StateVector state(this->Model.FrameSize() * this->NumberOfFrames(), 0.0f);
  this->ForEach([&](std::size_t k, std::size_t place) { state[place] = static_cast<float>(z[k]); });
  return state;
}

SphVolume ReferenceObjective::Volume(std::size_t j) const
{
  SphVolume volume(this->Model.Size);
  volume.Rest = &this->Model.Rest;
  volume.Obstacles = &this->Model.Obstacles;
  volume.Frame = this->Level.Frames[j];
  return volume;
}

std::size_t ReferenceObjective::FirstParticle(std::size_t body) const
{
  const std::size_t gas = this->Model.NumberOfGas;
  return body < gas ? body : gas + (body - gas) * this->Model.Offsets.size();
}

std::size_t ReferenceObjective::ParticlesOf(std::size_t body) const
{
  return body < this->Model.NumberOfGas ? 1 : this->Model.Offsets.size();
}

double ReferenceObjective::DragRate(std::size_t body) const
{
  return body < this->Model.NumberOfGas ? 0.0
                                        : this->Model.DragRates[body - this->Model.NumberOfGas];
}

Vec3 ReferenceObjective::Mean(const std::vector<Vec3>& values, std::size_t body) const
{
  Vec3 sum = Vec3::Zero();
  const std::size_t first = this->FirstParticle(body);
  for (std::size_t p = first; p < first + this->ParticlesOf(body); ++p)
  {
    sum += values[p];
  }
  return sum / static_cast<double>(this->ParticlesOf(body));
}

// Objects' D counts as a mean over the air that there is beside surfaces.
void ReferenceObjective::Raise(std::size_t j, Frame& frame, std::vector<Vec3>& averages) const
{
  frame.Drawn = averages;
  frame.Raises.assign(averages.size(), 1.0);
  frame.RaiseGradients.assign(averages.size(), Vec3::Zero());
  for (std::size_t p = this->Model.NumberOfGas; p < averages.size(); ++p)
  {
    const SurfaceDensityPart surfaces =
      SurfaceDensity(this->Fluid, this->Volume(j), frame.Particles.Positions[p]);
    const WallCorrection air(surfaces.Value);
    frame.Raises[p] = air.Raise;
    frame.RaiseGradients[p] = air.Slope * surfaces.Gradient;
    averages[p] *= air.Raise;
  }
}

std::vector<ReferenceObjective::Frame> ReferenceObjective::Frames(const double* z) const
{
  std::vector<Frame> frames(this->NumberOfFrames());
  for (std::size_t j = 0; j < frames.size(); ++j)
  {
    Frame& frame = frames[j];
    frame.Particles.NumberOfGas = this->Model.NumberOfGas;
    const double step = j + 1 < frames.size() ? this->Level.Steps[j + 1] : 1.0;
    for (std::size_t i = 0; i < this->Model.NumberOfBodies(); ++i)
    {
      const Vec3 x = this->At(z, j, i, 0);
      const Vec3 v = this->At(z, j, i, 3);
      for (std::size_t p = 0; p < this->ParticlesOf(i); ++p)
      {
        const std::array<float, 3> offset =
          i < this->Model.NumberOfGas ? std::array<float, 3>{} : this->Model.Offsets[p];
        frame.Particles.Positions.push_back(x + Vec3(offset[0], offset[1], offset[2]));
        frame.Particles.Velocities.push_back(v);
      }
      frame.Outside.push_back(ForceOn(this->Model, this->Level.Frames[j], step, i, x, v));
    }
    SphRates rates;
    EvaluateSph(this->Fluid, this->Volume(j), frame.Particles, rates);
    this->Raise(j, frame, rates.Averages);
    for (std::size_t i = 0; i < this->Model.NumberOfBodies(); ++i)
    {
      // Drag towards the air about an object: D is its mean velocity relative to it.
      const Vec3 average = this->Mean(rates.Averages, i);
      frame.Averages.push_back(average);
      frame.Accelerations.push_back(this->Mean(rates.Accelerations, i) +
                                    this->DragRate(i) * average + frame.Outside[i].Acceleration);
    }
  }
  return frames;
}

ReferenceObjective::Numbers ReferenceObjective::Rows(const double* z) const
{
  return this->MakeRows(z, this->Frames(z)).Values;
}

ReferenceObjective::Numbers ReferenceObjective::Tangent(const double* z,
                                                        const Numbers& change) const
{
  const std::vector<Frame> frames = this->Frames(z);
  const std::size_t bodies = this->Model.NumberOfBodies();
  Numbers quantities(2 * this->Size());
  for (std::size_t j = 0; j < frames.size(); ++j)
  {
    SphState moved;
    moved.NumberOfGas = this->Model.NumberOfGas;
    for (std::size_t i = 0; i < bodies; ++i)
    {
      for (std::size_t p = 0; p < this->ParticlesOf(i); ++p)
      {
        moved.Positions.push_back(this->At(change.data(), j, i, 0));
        moved.Velocities.push_back(this->At(change.data(), j, i, 3));
      }
    }
    SphRates rates;
    TangentSph(this->Fluid, this->Volume(j), frames[j].Particles, moved, rates);
    for (std::size_t p = 0; p < rates.Averages.size(); ++p)
    {
      rates.Averages[p] = frames[j].Raises[p] * rates.Averages[p] +
                          frames[j].RaiseGradients[p].dot(moved.Positions[p]) * frames[j].Drawn[p];
    }
    for (std::size_t i = 0; i < bodies; ++i)
    {
      const Vec3 dx = this->At(change.data(), j, i, 0);
      const Vec3 dv = this->At(change.data(), j, i, 3);
      const OutsideForce& outside = frames[j].Outside[i];
      const Vec3 average = this->Mean(rates.Averages, i);
      const Vec3 acceleration = this->Mean(rates.Accelerations, i) + this->DragRate(i) * average +
                                outside.ByPosition * dx + outside.ByVelocity * dv;
      for (int c = 0; c < 3; ++c)
      {
        quantities[this->Column(j, i, Place, c)] = dx[c];
        quantities[this->Column(j, i, Speed, c)] = dv[c];
        quantities[this->Column(j, i, Acceleration, c)] = acceleration[c];
        quantities[this->Column(j, i, Average, c)] = average[c];
      }
    }
  }
  const RowSet rows = this->MakeRows(z, frames);
  Numbers result(rows.Values.size());
  for (const RowSet::Entry& entry : rows.Entries)
  {
    result[entry.Row] += entry.Value * quantities[entry.Column];
  }
  return result;
}

ReferenceObjective::Numbers ReferenceObjective::ByQuantities(const RowSet& rows,
                                                             const Numbers& weights) const
{
  Numbers bars(2 * this->Size());
  for (const RowSet::Entry& entry : rows.Entries)
  {
    bars[entry.Column] += entry.Value * weights[entry.Row];
  }
  return bars;
}

ReferenceObjective::Numbers ReferenceObjective::PullBack(const std::vector<Frame>& frames,
                                                         const Numbers& bars) const
{
  const std::size_t bodies = this->Model.NumberOfBodies();
  const auto bar = [&](std::size_t j, std::size_t i, Quantity quantity)
  { return Vec3(bars.data() + this->Column(j, i, quantity, 0)); };
  Numbers result(this->Size());
  for (std::size_t j = 0; j < frames.size(); ++j)
  {
    SphRates given;
    for (std::size_t i = 0; i < bodies; ++i)
    {
      const auto count = static_cast<double>(this->ParticlesOf(i));
      const Vec3 a = bar(j, i, Acceleration);
      const Vec3 d = bar(j, i, Average) + this->DragRate(i) * a;
      given.Accelerations.insert(given.Accelerations.end(), this->ParticlesOf(i), a / count);
      given.Averages.insert(given.Averages.end(), this->ParticlesOf(i), d / count);
    }
    SphState adjoint;
    std::vector<Vec3> byRaise;
    for (std::size_t p = 0; p < given.Averages.size(); ++p)
    {
      byRaise.push_back(frames[j].Drawn[p].dot(given.Averages[p]) * frames[j].RaiseGradients[p]);
      given.Averages[p] *= frames[j].Raises[p];
    }
    AdjointSph(this->Fluid, this->Volume(j), frames[j].Particles, given, adjoint);
    for (std::size_t p = 0; p < byRaise.size(); ++p)
    {
      adjoint.Positions[p] += byRaise[p];
    }
    for (std::size_t i = 0; i < bodies; ++i)
    {
      const auto count = static_cast<double>(this->ParticlesOf(i));
      const OutsideForce& outside = frames[j].Outside[i];
      const Vec3 a = bar(j, i, Acceleration);
      const Vec3 x = bar(j, i, Place) + outside.ByPosition.transpose() * a +
                     count * this->Mean(adjoint.Positions, i);
      const Vec3 v = bar(j, i, Speed) + outside.ByVelocity.transpose() * a +
                     count * this->Mean(adjoint.Velocities, i);
      for (int c = 0; c < 3; ++c)
      {
        result[this->Unknown(j, i, c)] = x[c];
        result[this->Unknown(j, i, 3 + c)] = v[c];
      }
    }
  }
  return result;
}

ReferenceObjective::Numbers ReferenceObjective::Adjoint(const double* z,
                                                        const Numbers& weights) const
{
  const std::vector<Frame> frames = this->Frames(z);
  return this->PullBack(frames, this->ByQuantities(this->MakeRows(z, frames), weights));
}

double ReferenceObjective::Evaluate(const double* z, double* gradient,
                                    std::vector<Vec3>* byAcceleration) const
{
  const std::vector<Frame> frames = this->Frames(z);
  const RowSet rows = this->MakeRows(z, frames);
  if (gradient != nullptr || byAcceleration != nullptr)
  {
    const Numbers bars = this->ByQuantities(rows, rows.Values);
    if (gradient != nullptr)
    {
      const Numbers sum = this->PullBack(frames, bars);
      std::copy(sum.begin(), sum.end(), gradient);
    }
    const std::size_t bodies = this->Model.NumberOfBodies();
    for (std::size_t k = 0; k < frames.size() * bodies && byAcceleration != nullptr; ++k)
    {
      byAcceleration->emplace_back(bars.data() +
                                   this->Column(k / bodies, k % bodies, Acceleration, 0));
    }
  }
  double e = 0.0;
  for (const double r : rows.Values)
  {
    e += 0.5 * r * r;
  }
  return e;
}

} // namespace test
} // namespace waft
