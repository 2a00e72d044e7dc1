// SPDX-License-Identifier: BSD-3-Clause
// The distance of a flight from the style of the database, of how many values lie between which
// quantiles, beside the plain way over all sorted values.
#include "Base/Random.h"
#include "Planning/PlannerNumbers.h"
#include "Planning/StyleGauge.h"
#include "Planning/SwirlDatabase.h"
#include "Trajectory/Style.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace waft;

namespace
{

std::vector<double> PlainQuantiles(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  std::vector<double> quantiles;
  for (int i = 0; i < PlannerNumbers::Quantiles; ++i)
  {
    const double rank = (i + 0.5) / PlannerNumbers::Quantiles * static_cast<double>(values.size());
    quantiles.push_back(values[std::min(values.size() - 1, static_cast<std::size_t>(rank))]);
  }
  return quantiles;
}

double PlainDistance(const std::vector<double>& quantiles, std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  const auto count = static_cast<double>(values.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const auto below =
      std::count_if(quantiles.begin(), quantiles.end(), [&](double q) { return q < values[i]; });
    const double reference = static_cast<double>(below) / static_cast<double>(quantiles.size());
    worst = std::max({ worst, std::abs(static_cast<double>(i) / count - reference),
                       std::abs((static_cast<double>(i) + 1.0) / count - reference) });
  }
  return worst;
}

std::vector<Vec3> Wander(Random& random, int frames)
{
  std::vector<Vec3> path = { Vec3::Zero() };
  Vec3 step = 0.02 * random.Direction();
  while (static_cast<int>(path.size()) < frames)
  {
    step = 0.95 * step + 0.004 * random.Direction();
    path.push_back(path.back() + step);
  }
  return path;
}

} // namespace

TEST(StyleGauge, DistanceIsThatOfAllValuesSortedToTheBit)
{
  constexpr double step = 1.0 / 30.0;
  const MotionDatabase& database = test::SwirlDatabase();
  const StyleSamples all = StyleOf(database);
  const std::vector<double> curvatures = PlainQuantiles(all.LogCurvature);
  const std::vector<double> accelerations = PlainQuantiles(all.Acceleration);
  const StyleGauge gauge(database);
  Random random(5);
  StyleHistory history;
  StyleSamples plain;
  EXPECT_EQ(gauge.Distance(history), 0.0);
  for (int flight = 0; flight < 12; ++flight)
  {
    const int frames = 12 + 30 * flight;
    const std::vector<Vec3> path = Wander(random, frames);
    StyleHistory own;
    gauge.Append(path, step, 1, frames - 1, own);
    history.LogCurvature.Add(own.LogCurvature);
    history.Acceleration.Add(own.Acceleration);
    AppendStyle(path, step, 1, static_cast<std::size_t>(frames - 1), plain);
    EXPECT_EQ(gauge.Distance(history),
              PlannerNumbers::CurvatureWeight * PlainDistance(curvatures, plain.LogCurvature) +
                PlannerNumbers::AccelerationWeight *
                  PlainDistance(accelerations, plain.Acceleration));
    EXPECT_EQ(history.Acceleration.Largest,
              *std::max_element(plain.Acceleration.begin(), plain.Acceleration.end()));
  }
}
