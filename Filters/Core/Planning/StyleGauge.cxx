// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/StyleGauge.h"

#include "Planning/PlannerNumbers.h"
#include "Trajectory/Style.h"

#include <algorithm>
#include <cmath>

namespace waft
{

namespace
{

std::vector<double> QuantilesOf(std::vector<double> values)
{
  std::vector<double> result;
  if (values.empty())
  {
    return result;
  }
  std::sort(values.begin(), values.end());
  for (int i = 0; i < PlannerNumbers::Quantiles; ++i)
  {
    const double rank = (i + 0.5) / PlannerNumbers::Quantiles * static_cast<double>(values.size());
    result.push_back(values[std::min(values.size() - 1, static_cast<std::size_t>(rank))]);
  }
  return result;
}

/// Largest distance between the distribution of the values and that of the quantiles.
double DistanceTo(const std::vector<double>& quantiles, std::vector<double>& values)
{
  if (values.empty() || quantiles.empty())
  {
    return 0.0;
  }
  std::sort(values.begin(), values.end());
  double worst = 0.0;
  std::size_t below = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    while (below < quantiles.size() && quantiles[below] < values[i])
    {
      ++below;
    }
    const double reference = static_cast<double>(below) / static_cast<double>(quantiles.size());
    const auto count = static_cast<double>(values.size());
    worst = std::max({ worst, std::abs(static_cast<double>(i) / count - reference),
                       std::abs((static_cast<double>(i) + 1.0) / count - reference) });
  }
  return worst;
}

} // namespace

StyleGauge::StyleGauge(const MotionDatabase& database)
{
  StyleSamples samples = StyleOf(database);
  this->HighAcceleration = Quantile(samples.Acceleration, PlannerNumbers::HighQuantile);
  this->LogCurvature = QuantilesOf(std::move(samples.LogCurvature));
  this->Acceleration = QuantilesOf(std::move(samples.Acceleration));
}

void StyleGauge::Append(const std::vector<Vec3>& positions, double step, int first, int last,
                        StyleHistory& history)
{
  if (first >= last)
  {
    return;
  }
  StyleSamples samples;
  AppendStyle(positions, step, static_cast<std::size_t>(first), static_cast<std::size_t>(last),
              samples);
  history.LogCurvature.insert(history.LogCurvature.end(), samples.LogCurvature.begin(),
                              samples.LogCurvature.end());
  history.Acceleration.insert(history.Acceleration.end(), samples.Acceleration.begin(),
                              samples.Acceleration.end());
}

double StyleGauge::Distance(StyleHistory history) const
{
  return PlannerNumbers::CurvatureWeight * DistanceTo(this->LogCurvature, history.LogCurvature) +
         PlannerNumbers::AccelerationWeight * DistanceTo(this->Acceleration, history.Acceleration);
}

double StyleGauge::AccelerationExcess(const StyleHistory& flight) const
{
  double most = 0.0;
  for (double acceleration : flight.Acceleration)
  {
    most = std::max(most, acceleration);
  }
  return this->HighAcceleration > 0.0 ? std::max(0.0, most / this->HighAcceleration - 1.0) : 0.0;
}

} // namespace waft
