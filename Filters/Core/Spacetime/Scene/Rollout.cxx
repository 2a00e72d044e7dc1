// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Scene/Rollout.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

constexpr double GasMargin = 0.05; // gas is kept this far from the walls [dx]
constexpr int ReplayedFrames[] = { 30, 90, 150 };

Vec3 BodyRow(const float* rows, std::size_t stride, std::size_t i)
{
  return { rows[i], rows[stride + i], rows[2 * stride + i] };
}

struct SquareSums
{
  double Wrong = 0.0, All = 0.0;
  double Ratio() const { return this->All > 0.0 ? std::sqrt(this->Wrong / this->All) : -1.0; }
};

// From one frame until another; objects that do not fly keep to the solution. False: stopped.
bool RunForward(SpacetimeObjective& objective, int from, int until,
                const std::vector<char>& isFlying, StateVector& state, Monitor& monitor)
{
  const SpacetimeModel& model = objective.Model();
  const std::size_t stride = model.Stride();
  for (int frame = from; frame < until; ++frame)
  {
    const auto j = static_cast<std::size_t>(frame);
    FrameTerms& terms = objective.ForwardFrame(state, j);
    const float* here = state.data() + j * model.FrameSize();
    float* next = state.data() + (j + 1) * model.FrameSize();
    for (std::size_t i = 0; i < model.NumberOfBodies(); ++i)
    {
      if (i >= model.NumberOfGas && !isFlying[i - model.NumberOfGas])
      {
        continue;
      }
      const Vec3 x = BodyRow(here, stride, i);
      const Vec3 v = NextVelocity(model, objective.Level(), terms, j, i, x,
                                  BodyRow(here + 3 * stride, stride, i), Vec3::Zero());
      MoveBody(model, i, 1.0, x, v, next);
    }
    if (!monitor.Tick(1.0, "replaying the motion"))
    {
      return false;
    }
  }
  return true;
}

} // namespace

Vec3 NextVelocity(const SpacetimeModel& model, const TimeLevel& level, FrameTerms& terms,
                  std::size_t j, std::size_t body, const Vec3& x, const Vec3& v, const Vec3& pull)
{
  const double step = level.Steps[j + 1];
  const Vec3 a(terms.Acceleration(0)[body], terms.Acceleration(1)[body],
               terms.Acceleration(2)[body]);
  if (model.Air.IsEmpty())
  {
    return v + step * (a + pull);
  }
  const Vec3 w = model.Air.Deviation(body, x, v, level.Frames[j], level.Steps[j]);
  return model.Air.Carried(body, x, w + step * (a + pull), level.Frames[j + 1], step);
}

void MoveBody(const SpacetimeModel& model, std::size_t body, double step, const Vec3& x,
              const Vec3& velocity, float* next)
{
  const std::size_t stride = model.Stride();
  for (int c = 0; c < 3; ++c)
  {
    const double ahead = x[c] + step * velocity[c];
    next[(3 + c) * stride + body] = static_cast<float>(velocity[c]);
    next[c * stride + body] =
      static_cast<float>(std::clamp(ahead, GasMargin, model.Size[c] - GasMargin));
  }
}

ReplayError MeasureReplay(SpacetimeObjective& objective, const StateVector& state, int second,
                          Monitor& monitor)
{
  const SpacetimeModel& model = objective.Model();
  const std::size_t stride = model.Stride();
  SquareSums objects, gas;
  for (const int from : ReplayedFrames)
  {
    const int until = from + second;
    if (until >= model.NumberOfFrames)
    {
      break;
    }
    std::vector<char> isFlying(model.NumberOfObjects, 1);
    for (std::size_t o = 0; o < model.NumberOfObjects; ++o)
    {
      for (int frame = from; frame <= until; ++frame)
      {
        isFlying[o] =
          isFlying[o] && !StepIsGiven(model, objective.Level(), static_cast<std::size_t>(frame), o);
      }
    }
    StateVector replayed = state;
    if (!RunForward(objective, from, until, isFlying, replayed, monitor))
    {
      return {};
    }
    const std::size_t offset = static_cast<std::size_t>(until) * model.FrameSize() + 3 * stride;
    for (std::size_t i = 0; i < model.NumberOfBodies(); ++i)
    {
      if (i >= model.NumberOfGas && !isFlying[i - model.NumberOfGas])
      {
        continue;
      }
      const Vec3 v = BodyRow(state.data() + offset, stride, i);
      SquareSums& sums = i < model.NumberOfGas ? gas : objects;
      sums.Wrong += (BodyRow(replayed.data() + offset, stride, i) - v).squaredNorm();
      sums.All += v.squaredNorm();
    }
  }
  return { objects.Ratio(), gas.Ratio() };
}

} // namespace waft
