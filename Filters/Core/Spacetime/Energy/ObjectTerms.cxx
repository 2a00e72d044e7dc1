// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Energy/ObjectTerms.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

// A little more than what is asked for, so that the penalty's slack stays within it. Not above a
// surface that is landed on: an object would hover there until its rest.
constexpr double Margin = 0.03; // [dx]

double ClearanceTerms(const SpacetimeModel& model, int frame, double scale, const float* state,
                      float* gradient)
{
  const std::size_t stride = model.Stride();
  const double weight = model.Weights.Clearance;
  double sum = 0.0;
  for (std::size_t o = 0; o < model.NumberOfObjects; ++o)
  {
    if (model.Flag(frame, o) & FixedPosition)
    {
      continue;
    }
    const std::size_t i = model.NumberOfGas + o;
    const auto push = [&](double depth, int c, double direction)
    {
      if (depth > 0.0)
      {
        sum += 0.5 * weight * depth * depth;
        if (gradient)
        {
          gradient[c * stride + i] -= static_cast<float>(scale * weight * depth * direction);
        }
      }
    };
    const double radius = model.Clearances[o].With(Margin).Radius;
    for (int c = 0; c < 3; ++c)
    {
      const double x = state[c * stride + i];
      push((c == 2 ? FloorClearance(model, frame, o) : radius) - x, c, 1.0);
      push(radius - (model.Size[c] - x), c, -1.0);
    }
    if (!model.Obstacles.IsEmpty())
    {
      const Vec3 p(state[i], state[stride + i], state[2 * stride + i]);
      Vec3 normal;
      Mat3 curvature;
      const double depth =
        ObstacleClearance(model, frame, o) - model.Obstacles.Evaluate(p, frame, normal, curvature);
      if (depth > 0.0)
      {
        sum += 0.5 * weight * depth * depth;
        for (int c = 0; c < 3 && gradient; ++c)
        {
          gradient[c * stride + i] -= static_cast<float>(scale * weight * depth * normal[c]);
        }
      }
    }
  }
  return sum;
}

// Distance beyond the reach about the approach.
double ApproachTerms(const SpacetimeModel& model, int frame, double scale, const float* state,
                     float* gradient)
{
  if (model.Reach.empty())
  {
    return 0.0;
  }
  const std::size_t stride = model.Stride();
  const double weight = model.Weights.Reach;
  double sum = 0.0;
  for (std::size_t o = 0; o < model.NumberOfObjects; ++o)
  {
    const std::size_t index = static_cast<std::size_t>(frame) * model.NumberOfObjects + o;
    if (model.Reach[index] <= 0.0f || (model.Flags[index] & FixedPosition))
    {
      continue;
    }
    const std::size_t i = model.NumberOfGas + o;
    const Vec3 d = Vec3(state[i], state[stride + i], state[2 * stride + i]) - model.Approach[index];
    const double beyond = d.norm() - model.Reach[index];
    if (beyond > 0.0)
    {
      sum += 0.5 * weight * beyond * beyond;
      for (int c = 0; c < 3 && gradient; ++c)
      {
        gradient[c * stride + i] += static_cast<float>(scale * weight * beyond * d[c] / d.norm());
      }
    }
  }
  return sum;
}

double ContactTerms(const SpacetimeModel& model, int frame, double scale, const float* state,
                    float* gradient)
{
  const double d0 = model.Weights.ContactDistance;
  const double weight = model.Weights.Contact;
  const std::size_t n = model.NumberOfObjects;
  if (d0 <= 0.0 || weight <= 0.0 || n < 2)
  {
    return 0.0;
  }
  const std::size_t stride = model.Stride();
  const float* x = state + model.NumberOfGas;
  std::vector<std::uint32_t> order(n);
  for (std::size_t o = 0; o < n; ++o)
  {
    order[o] = static_cast<std::uint32_t>(o);
  }
  std::sort(order.begin(), order.end(),
            [x](std::uint32_t a, std::uint32_t b) { return x[a] != x[b] ? x[a] < x[b] : a < b; });
  double sum = 0.0;
  for (std::size_t p = 0; p < n; ++p)
  {
    for (std::size_t q = p + 1; q < n && x[order[q]] - x[order[p]] < d0; ++q)
    {
      const std::size_t a = order[p];
      const std::size_t b = order[q];
      double d[3], r2 = 0.0;
      for (int c = 0; c < 3; ++c)
      {
        d[c] = static_cast<double>(x[c * stride + a]) - x[c * stride + b];
        r2 += d[c] * d[c];
      }
      if (r2 >= d0 * d0 || r2 < 1e-12)
      {
        continue;
      }
      const bool fixedA = model.Flag(frame, a) & FixedPosition;
      const bool fixedB = model.Flag(frame, b) & FixedPosition;
      if (fixedA && fixedB)
      {
        continue;
      }
      const double r = std::sqrt(r2);
      const double depth = PairDistance(model, frame, a, b) - r;
      if (depth <= 0.0)
      {
        continue;
      }
      sum += 0.5 * weight * depth * depth;
      for (int c = 0; c < 3 && gradient; ++c)
      {
        const auto g = static_cast<float>(scale * weight * depth * d[c] / r);
        gradient[c * stride + model.NumberOfGas + a] -= g;
        gradient[c * stride + model.NumberOfGas + b] += g;
      }
    }
  }
  return sum;
}

} // namespace

double FloorClearance(const SpacetimeModel& model, int frame, std::size_t object)
{
  const bool lands = (model.Flag(frame, object) & LandsOnFloor) != 0;
  return model.Clearances[object].With(Margin).From(lands);
}

double ObstacleClearance(const SpacetimeModel& model, int frame, std::size_t object)
{
  const bool lands = (model.Flag(frame, object) & LandsOnObstacle) != 0;
  return model.Clearances[object].With(Margin).From(lands);
}

double PairDistance(const SpacetimeModel& model, int frame, std::size_t a, std::size_t b)
{
  const double distance = model.Weights.ContactDistance;
  return model.Kept.NumberOfBodies() == 0 ? distance
                                          : std::min(distance, model.Kept.At(frame, a, b));
}

ObjectTerms AddObjectTerms(const SpacetimeModel& model, int frame, double scale, const float* state,
                           float* gradient)
{
  ObjectTerms terms; // the gradient's bits depend on their order
  terms.Clearance = ClearanceTerms(model, frame, scale, state, gradient);
  terms.Approach = ApproachTerms(model, frame, scale, state, gradient);
  terms.Contact = ContactTerms(model, frame, scale, state, gradient);
  return terms;
}

} // namespace waft
