// SPDX-License-Identifier: BSD-3-Clause
// Vortices fitted to how air turns about tracks: in a planted swirl, and in noise.
#include "Base/Random.h"
#include "Vortex/AirVortexFit.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace waft;

namespace
{

constexpr int AirFrames = 90;

Timeline AirLine()
{
  Timeline line;
  line.NumberOfFrames = AirFrames;
  line.FramesPerSecond = 30.0;
  return line;
}

Vortex PlantedSwirl()
{
  Vortex vortex;
  vortex.VortexId = 0;
  vortex.P1 = Vec3(0.1, -0.1, 0.6);
  vortex.P2 = Vec3(0.0, 0.1, 1.8);
  vortex.Strength = 12.0;
  vortex.CenterTime = 1.4;
  vortex.Duration = 0.8;
  vortex.CoreRadius = 0.15;
  return vortex;
}

/// Paths across the middle of the volume; the air about each gains what accelerate says.
template <class Accelerate>
std::vector<Track> Across(int count, const Accelerate& accelerate)
{
  std::vector<Track> tracks;
  Random random(7);
  for (int n = 0; n < count; ++n)
  {
    Track track;
    track.ObjectId = n;
    const Vec3 start(random.Uniform(-0.8, 0.8), random.Uniform(-0.8, 0.8),
                     random.Uniform(0.6, 1.8));
    const Vec3 step = 0.01 * Vec3(random.Normal(), random.Normal(), 0.3 * random.Normal());
    Vec3 velocity = Vec3::Zero();
    for (int k = 0; k < AirFrames; ++k)
    {
      track.Positions.push_back(start + k * step);
      track.AirVelocities.push_back(velocity);
      velocity += accelerate(track.Positions.back(), AirLine().Time(k), random) / 30.0;
    }
    tracks.push_back(std::move(track));
  }
  return tracks;
}

VortexFitOptions AirFitOptions()
{
  VortexFitOptions options;
  options.Bounds = { Vec3(-1.2, -1.2, 0.0), Vec3(1.2, 1.2, 2.4) };
  options.MinimumGain = 0.02;
  options.UniformBackground = false;
  return options;
}

} // namespace

TEST(AirVortexFit, ExplainsASwirlAlsoOfTracksThatItDidNotSee)
{
  const auto swirl = [](const Vec3& place, double time, Random&)
  { return PlantedSwirl().Acceleration(place, time); };
  SilentMonitor monitor;
  AirVortexFit found;
  ASSERT_TRUE(static_cast<bool>(
    FitAirVortices(Across(20, swirl), AirLine(), {}, AirFitOptions(), monitor, found)));
  ASSERT_FALSE(found.Vortices.empty());
  EXPECT_GT(found.Explained, 0.8);
  EXPECT_GT(found.ExplainedLeftOut, 0.7);
  EXPECT_LE(found.Explained, 1.0);
}

TEST(AirVortexFit, ClaimsNothingOfNoise)
{
  const auto noise = [](const Vec3&, double, Random& random)
  { return Vec3(random.Normal(), random.Normal(), random.Normal()); };
  VortexFitOptions options = AirFitOptions();
  options.MaximumNewVortices = 8;
  options.MinimumGain = 0.0;
  SilentMonitor monitor;
  AirVortexFit found;
  ASSERT_TRUE(
    static_cast<bool>(FitAirVortices(Across(15, noise), AirLine(), {}, options, monitor, found)));
  EXPECT_GE(found.Explained, 0.0) << "strengths that are solved for never explain less than none";
  EXPECT_LT(found.Explained, 0.2);
  EXPECT_LT(found.ExplainedLeftOut, 0.1);
}

TEST(AirVortexFit, LeavesNobodyOutOfFewerThanFive)
{
  const auto swirl = [](const Vec3& place, double time, Random&)
  { return PlantedSwirl().Acceleration(place, time); };
  SilentMonitor monitor;
  AirVortexFit found;
  ASSERT_TRUE(static_cast<bool>(
    FitAirVortices(Across(4, swirl), AirLine(), {}, AirFitOptions(), monitor, found)));
  EXPECT_TRUE(std::isnan(found.ExplainedLeftOut));
  EXPECT_GE(found.Explained, 0.0);
}

TEST(AirVortexFit, NamesATrackWithoutAir)
{
  Track bare;
  bare.ObjectId = 4;
  bare.Positions.assign(AirFrames, Vec3::Zero());
  SilentMonitor monitor;
  AirVortexFit found;
  const Result result = FitAirVortices({ bare }, AirLine(), {}, AirFitOptions(), monitor, found);
  EXPECT_NE(std::string::npos, result.Message().find("object 4 has no point data `AirVelocity`"))
    << result.Message();
}
