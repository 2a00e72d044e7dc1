// SPDX-License-Identifier: BSD-3-Clause
// What a frame's gradient has from the rows of the steps beside it, in a sampled air by way of the
// deviations from that.
#include "Spacetime/Energy/SpacetimeObjective.h"

namespace waft
{

void SpacetimeObjective::GatherFrame(std::size_t j, StateVector& gradient) const
{
  const SpacetimeModel& model = this->Problem;
  const std::size_t stride = model.Stride();
  const std::size_t n = model.NumberOfBodies();
  const bool last = j + 1 == this->Times.NumberOfFrames();
  const auto row = [&](std::size_t k, int kind, int c) { return this->Row(k, kind, c); };
  float* g = gradient.data() + this->Offset(j);
  const auto step = static_cast<float>(this->Times.Steps[j]);
  for (int c = 0; c < 3; ++c)
  {
    float* gx = g + c * stride;
    float* gv = g + (3 + c) * stride;
    if (j > 0)
    {
      const float* rx = row(j, 0, c);
      const float* rv = row(j, 1, c);
      for (std::size_t i = 0; i < n; ++i)
      {
        gx[i] += rx[i];
        gv[i] += rv[i] - step * rx[i];
      }
    }
    if (!last)
    {
      const float* rx = row(j + 1, 0, c);
      const float* rv = row(j + 1, 1, c);
      for (std::size_t i = 0; i < n; ++i)
      {
        gx[i] -= rx[i];
        gv[i] -= rv[i];
      }
    }
    const float* rt = row(j, 2, c);
    for (std::size_t i = 0; i < n; ++i)
    {
      gv[i] += rt[i];
    }
    for (const TimeLevel::Neighbour& column : this->Times.Columns[j])
    {
      const float* other = row(column.Frame, 2, c);
      const auto coefficient = static_cast<float>(column.Coefficient);
      for (std::size_t i = 0; i < n; ++i)
      {
        gv[i] -= coefficient * other[i];
      }
    }
  }
  if (!model.Air.IsEmpty())
  {
    this->ToVelocities(j, g);
  }
}

void SpacetimeObjective::ToVelocities(std::size_t j, float* gradient) const
{
  const SpacetimeModel& model = this->Problem;
  const std::size_t stride = model.Stride();
  const double step = this->Times.Steps[j];
  std::vector<float> direct(3 * stride, 0.0f); // by rx
  for (int c = 0; c < 3 && j > 0; ++c)
  {
    const float* rx = this->Row(j, 0, c);
    for (std::size_t i = 0; i < model.NumberOfBodies(); ++i)
    {
      direct[c * stride + i] = -static_cast<float>(step) * rx[i];
    }
  }
  GivenAir::ToVelocities(this->Jacobians.data() + j * 9 * stride, direct.data(),
                         model.NumberOfBodies(), stride, step, gradient);
}

const StateVector& SpacetimeObjective::TakeDeviations(const StateVector& state)
{
  const SpacetimeModel& model = this->Problem;
  if (model.Air.IsEmpty())
  {
    return state;
  }
  const std::size_t stride = model.Stride();
  this->Deviations.resize(this->Times.NumberOfFrames() * model.FrameSize());
  this->Jacobians.resize(this->Times.NumberOfFrames() * 9 * stride);
  this->Parallel(this->Times.NumberOfFrames(),
                 [&](std::size_t begin, std::size_t end)
                 {
                   for (std::size_t j = begin; j < end; ++j)
                   {
                     const std::size_t offset = this->Offset(j);
                     model.Air.Deviations(state.data() + offset, model.NumberOfBodies(), stride,
                                          this->Times.Frames[j], this->Times.Steps[j],
                                          this->Deviations.data() + offset,
                                          this->Jacobians.data() + j * 9 * stride);
                   }
                 });
  return this->Deviations;
}

} // namespace waft
