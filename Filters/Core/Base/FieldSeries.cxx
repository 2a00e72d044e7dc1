// SPDX-License-Identifier: BSD-3-Clause
#include "Base/FieldSeries.h"

#include "Base/Limits.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

// Trilinear value and gradient at one time level.
Vec3 SampleLevel(const FieldSeries& field, const std::vector<std::array<float, 3>>& values,
                 const Vec3& x, Mat3* jacobian)
{
  int base[3];
  double f[3];
  bool inside[3];
  for (int c = 0; c < 3; ++c)
  {
    const int cells = field.Dimensions[c] - 1;
    const double s = (x[c] - field.Origin[c]) / field.Spacing[c];
    inside[c] = cells > 0 && s >= 0.0 && s <= cells;
    const double clamped = std::clamp(s, 0.0, static_cast<double>(std::max(cells, 0)));
    base[c] = std::min(static_cast<int>(clamped), std::max(cells - 1, 0));
    f[c] = clamped - base[c];
  }
  Vec3 value = Vec3::Zero();
  for (int corner = 0; corner < 8; ++corner)
  {
    double weight[3];
    double slope[3];
    std::size_t index = 0;
    std::size_t stride = 1;
    for (int c = 0; c < 3; ++c)
    {
      const int up = (corner >> c) & 1;
      weight[c] = up ? f[c] : 1.0 - f[c];
      slope[c] = inside[c] ? (up ? 1.0 : -1.0) / field.Spacing[c] : 0.0;
      index += stride * std::min(base[c] + up, field.Dimensions[c] - 1);
      stride *= field.Dimensions[c];
    }
    const Vec3 v(values[index][0], values[index][1], values[index][2]);
    value += weight[0] * weight[1] * weight[2] * v;
    if (jacobian)
    {
      const Vec3 gradient(slope[0] * weight[1] * weight[2], weight[0] * slope[1] * weight[2],
                          weight[0] * weight[1] * slope[2]);
      *jacobian += v * gradient.transpose();
    }
  }
  return value;
}

// Between which times a time lies, held at the first and last one.
struct Moment
{
  std::size_t Before = 0;
  double Part = 0.0; // of the way to the next time, below 1
};

Moment MomentOf(const std::vector<double>& times, double time)
{
  const auto above = std::upper_bound(times.begin(), times.end(), time);
  if (above == times.begin())
  {
    return {};
  }
  const auto k = static_cast<std::size_t>(above - times.begin());
  return { k - 1, above == times.end() ? 0.0 : (time - times[k - 1]) / (times[k] - times[k - 1]) };
}

Vec3 SampleSeries(const FieldSeries& field, const Vec3& x, double time, Mat3* jacobian)
{
  if (jacobian)
  {
    jacobian->setZero();
  }
  if (field.IsEmpty())
  {
    return Vec3::Zero();
  }
  const Moment at = MomentOf(field.Times, time);
  if (at.Part == 0.0)
  {
    return SampleLevel(field, field.Values[at.Before], x, jacobian);
  }
  const double f = at.Part;
  Mat3 j0 = Mat3::Zero();
  Mat3 j1 = Mat3::Zero();
  const Vec3 v0 = SampleLevel(field, field.Values[at.Before], x, jacobian ? &j0 : nullptr);
  const Vec3 v1 = SampleLevel(field, field.Values[at.Before + 1], x, jacobian ? &j1 : nullptr);
  if (jacobian)
  {
    *jacobian = (1.0 - f) * j0 + f * j1;
  }
  return (1.0 - f) * v0 + f * v1;
}

} // namespace

FieldSeries::Field FieldSeries::At(double time) const
{
  if (this->IsEmpty())
  {
    return {};
  }
  const Moment at = MomentOf(this->Times, time);
  Field values = this->Values[at.Before];
  for (std::size_t i = 0; at.Part > 0.0 && i < values.size(); ++i)
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      values[i][c] = static_cast<float>((1.0 - at.Part) * values[i][c] +
                                        at.Part * this->Values[at.Before + 1][i][c]);
    }
  }
  return values;
}

Result FieldSeries::Validate(const std::string& name) const
{
  if (!this->IsEmpty())
  {
    WAFT_RETURN_IF_FAILED(CheckLattice(name, *this));
  }
  const limits::Range range =
    this->Meaning == FieldMeaning::Acceleration ? limits::Acceleration : limits::Velocity;
  if (this->Values.size() != this->Times.size())
  {
    return Result::Error(name + ": " + std::to_string(this->Values.size()) + " fields for " +
                         std::to_string(this->Times.size()) + " times");
  }
  for (std::size_t k = 0; k < this->Times.size(); ++k)
  {
    if (!limits::Time.Holds(this->Times[k]) || (k > 0 && this->Times[k] <= this->Times[k - 1]))
    {
      return Result::Error(name + ": times must increase, seen at step " + std::to_string(k));
    }
    if (this->Values[k].size() != this->NumberOfPoints())
    {
      return Result::Error(name + ": step " + std::to_string(k) + " has " +
                           std::to_string(this->Values[k].size()) + " values, expected " +
                           std::to_string(this->NumberOfPoints()));
    }
    for (std::size_t i = 0; i < this->Values[k].size(); ++i)
    {
      for (const float v : this->Values[k][i])
      {
        if (!range.Holds(v))
        {
          return Result::Error(name + ": step " + std::to_string(k) + ", point " +
                               std::to_string(i) + ": expected " + range.Text() + ", found " +
                               NumberText(v, 7));
        }
      }
    }
  }
  return Result::Ok();
}

Vec3 FieldSeries::Sample(const Vec3& x, double time) const
{
  return SampleSeries(*this, x, time, nullptr);
}

Vec3 FieldSeries::Sample(const Vec3& x, double time, Mat3& jacobian) const
{
  return SampleSeries(*this, x, time, &jacobian);
}

} // namespace waft
