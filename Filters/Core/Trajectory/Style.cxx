// SPDX-License-Identifier: BSD-3-Clause
#include "Trajectory/Style.h"

#include <algorithm>
#include <cmath>

namespace waft
{

void AppendStyle(const std::vector<Vec3>& positions, double step, std::size_t first,
                 std::size_t last, StyleSamples& samples)
{
  first = std::max<std::size_t>(first, 1);
  for (std::size_t i = first; i < last && i + 1 < positions.size(); ++i)
  {
    const Vec3 velocity = (positions[i + 1] - positions[i - 1]) / (2.0 * step);
    const Vec3 acceleration =
      (positions[i + 1] - 2.0 * positions[i] + positions[i - 1]) / (step * step);
    const double speed = velocity.norm();
    samples.Speed.push_back(speed);
    samples.Acceleration.push_back(acceleration.norm());
    if (speed >= LeastStyleSpeed)
    {
      const double curvature = velocity.cross(acceleration).norm() / (speed * speed * speed);
      samples.LogCurvature.push_back(std::log(std::max(curvature, 1e-6)));
    }
  }
}

void AppendStyle(const std::vector<Vec3>& positions, double step, StyleSamples& samples)
{
  AppendStyle(positions, step, 0, positions.size(), samples);
}

StyleSamples StyleOf(const MotionDatabase& database)
{
  StyleSamples samples;
  for (std::size_t i = 0; i < database.Segments.size(); ++i)
  {
    AppendStyle(database.Reconstruct(static_cast<int>(i)), 1.0 / database.FramesPerSecond, samples);
  }
  return samples;
}

double KolmogorovSmirnov(std::vector<double> a, std::vector<double> b)
{
  if (a.empty() || b.empty())
  {
    return 1.0;
  }
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  double largest = 0.0;
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size())
  {
    const double value = std::min(a[i], b[j]);
    while (i < a.size() && a[i] <= value)
    {
      ++i;
    }
    while (j < b.size() && b[j] <= value)
    {
      ++j;
    }
    const double below = static_cast<double>(i) / static_cast<double>(a.size());
    const double other = static_cast<double>(j) / static_cast<double>(b.size());
    largest = std::max(largest, std::abs(below - other));
  }
  return largest;
}

double Quantile(std::vector<double> values, double fraction)
{
  if (values.empty())
  {
    return 0.0;
  }
  std::sort(values.begin(), values.end());
  const double rank = std::clamp(fraction, 0.0, 1.0) * static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::size_t>(rank);
  const std::size_t high = std::min(low + 1, values.size() - 1);
  return values[low] + (rank - static_cast<double>(low)) * (values[high] - values[low]);
}

} // namespace waft
