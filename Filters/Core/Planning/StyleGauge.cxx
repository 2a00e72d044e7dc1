// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/StyleGauge.h"

#include "Planning/PlannerNumbers.h"
#include "Trajectory/Style.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

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

void AddTo(const std::vector<double>& quantiles, const std::vector<double>& values,
           ValuesByQuantile& all)
{
  all.Counts.resize(quantiles.size() + 1, 0);
  for (const double value : values)
  {
    const auto below = std::lower_bound(quantiles.begin(), quantiles.end(), value);
    ++all.Counts[static_cast<std::size_t>(below - quantiles.begin())];
    all.Largest = std::max(all.Largest, value);
  }
}

/// Largest distance between the distribution of the values and that of the quantiles. It is taken
/// on at the first or the last value between two of these.
double DistanceTo(const std::vector<double>& quantiles, const ValuesByQuantile& values)
{
  const auto count = static_cast<double>(
    std::accumulate(values.Counts.begin(), values.Counts.end(), std::int64_t(0)));
  if (count == 0.0 || quantiles.empty())
  {
    return 0.0;
  }
  double worst = 0.0;
  std::int64_t before = 0;
  for (std::size_t below = 0; below < values.Counts.size(); ++below)
  {
    if (values.Counts[below] > 0)
    {
      const double reference = static_cast<double>(below) / static_cast<double>(quantiles.size());
      const auto after = before + values.Counts[below];
      worst = std::max({ worst, std::abs(static_cast<double>(before) / count - reference),
                         std::abs(static_cast<double>(after) / count - reference) });
      before = after;
    }
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

void ValuesByQuantile::Add(const ValuesByQuantile& others)
{
  this->Counts.resize(std::max(this->Counts.size(), others.Counts.size()), 0);
  std::transform(others.Counts.begin(), others.Counts.end(), this->Counts.begin(),
                 this->Counts.begin(), std::plus<std::int64_t>());
  this->Largest = std::max(this->Largest, others.Largest);
}

void StyleGauge::Append(const std::vector<Vec3>& positions, double step, int first, int last,
                        StyleHistory& history) const
{
  if (first >= last)
  {
    return;
  }
  StyleSamples samples;
  AppendStyle(positions, step, static_cast<std::size_t>(first), static_cast<std::size_t>(last),
              samples);
  AddTo(this->LogCurvature, samples.LogCurvature, history.LogCurvature);
  AddTo(this->Acceleration, samples.Acceleration, history.Acceleration);
}

double StyleGauge::Distance(const StyleHistory& history) const
{
  return PlannerNumbers::CurvatureWeight * DistanceTo(this->LogCurvature, history.LogCurvature) +
         PlannerNumbers::AccelerationWeight * DistanceTo(this->Acceleration, history.Acceleration);
}

double StyleGauge::AccelerationExcess(const StyleHistory& flight) const
{
  return this->HighAcceleration > 0.0
           ? std::max(0.0, flight.Acceleration.Largest / this->HighAcceleration - 1.0)
           : 0.0;
}

} // namespace waft
