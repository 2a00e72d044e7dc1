// SPDX-License-Identifier: BSD-3-Clause
// An air that is stirred for ever: where its warm-up ends, and that it goes on as it is.
#include "Air/Field/WarmUp.h"
#include "Grid/SmokeEnsemble.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace waft;

namespace
{

constexpr double StirredRate = 15.0;

AirScene Closed(int frames)
{
  AirScene scene;
  scene.Smoke.Bounds = { Vec3(-2, -2, 0), Vec3(2, 2, 4) };
  scene.Smoke.Resolution = { 16, 16, 16 };
  scene.Smoke.Boundary.fill(BoundaryKind::Closed);
  scene.Smoke.BuoyancyTemperature = 0.0;
  scene.Smoke.FramesPerSecond = StirredRate;
  scene.Smoke.NegligibleForce = StirringLeast;
  scene.LatticeDimensions = { 16, 16, 16 };
  scene.Time = { frames, StirredRate };
  return scene;
}

/// Those between two times, in the time of the frames.
SmokeForces Felt(const Box& volume, std::uint64_t seed, double from, double to, double first)
{
  SmokeForces forces = StirringForces(volume, seed, from, to);
  for (Vortex& vortex : forces.Vortices)
  {
    vortex.CenterTime -= first;
  }
  for (AnalyticWind& wind : forces.Winds)
  {
    wind.CenterTime -= first;
  }
  return forces;
}

/// From rest through the warm-up.
HalfSeries Simulated(std::uint64_t seed, int frames, int resolution, WarmUp& warmUp)
{
  AirScene scene = Closed(frames);
  const Box volume = scene.Smoke.Bounds;
  SilentMonitor monitor;
  const auto forces = [&](double until) { return StirringForces(volume, seed, 0.0, until); };
  EXPECT_TRUE(FindWarmUp(scene, forces, SerialFor(), monitor, warmUp));
  const double first = warmUp.Frames / StirredRate;
  scene.Forces = Felt(volume, seed, first - warmUp.Turnover / StirredRate,
                      first + (frames - 1) / StirredRate, first);
  scene.Smoke.Resolution.fill(resolution);
  SmokeState begun;
  EXPECT_TRUE(BeginWarmUp(warmUp, scene, begun));
  HalfSeries air;
  EXPECT_TRUE(SimulateAir(scene, nullptr, SerialFor(), monitor, air, &begun));
  return air;
}

double Rms(const HalfSeries& air, std::size_t first, std::size_t last)
{
  double sum = 0.0;
  for (std::size_t f = first; f < last; ++f)
  {
    for (const std::array<float, 3>& v : air.At(f))
    {
      sum += v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    }
  }
  return std::sqrt(sum / static_cast<double>((last - first) * air.NumberOfPoints()));
}

} // namespace

TEST(WarmUp, EndsWithinFourTurnoversInAnAirThatGoesOnAsItIs)
{
  double first = 0.0, all = 0.0;
  for (const std::uint64_t seed : { 3, 4, 5 })
  {
    WarmUp warmUp;
    const HalfSeries air = Simulated(seed, 150, 16, warmUp);
    EXPECT_GE(warmUp.Frames, 2 * warmUp.Turnover - 1);
    EXPECT_LE(warmUp.Frames, 4 * warmUp.Turnover);
    first += Rms(air, 0, 30);
    all += Rms(air, 0, 150);
  }
  EXPECT_NEAR(first, all, 0.15 * all); // 0.6 of it after three seconds from rest
}

TEST(WarmUp, ALongerShotBeginsWithTheSameAir)
{
  WarmUp one, other;
  const HalfSeries shorter = Simulated(6, 30, 16, one);
  const HalfSeries longer = Simulated(6, 60, 16, other);
  EXPECT_EQ(one.Frames, other.Frames);
  for (std::size_t f = 0; f < 30; ++f)
  {
    ASSERT_EQ(shorter.At(f), longer.At(f)) << f;
  }
}

TEST(WarmUp, TheLastTurnoverIsOfTheGridOfTheShot)
{
  WarmUp warmUp;
  const HalfSeries coarse = Simulated(7, 15, 16, warmUp);
  const HalfSeries fine = Simulated(7, 15, 32, warmUp);
  EXPECT_NEAR(Rms(fine, 0, 15), Rms(coarse, 0, 15), 0.25 * Rms(coarse, 0, 15));
  EXPECT_NE(fine.At(0), coarse.At(0));
}

TEST(WarmUp, OfAnAirThatNothingStirsEnds)
{
  SilentMonitor monitor;
  WarmUp warmUp;
  ASSERT_TRUE(FindWarmUp(
    Closed(10), [](double) { return SmokeForces(); }, SerialFor(), monitor, warmUp));
  EXPECT_LE(warmUp.Frames, 4 * warmUp.Turnover);
  for (const std::array<float, 3>& v : warmUp.Recent.At(0))
  {
    ASSERT_EQ(v, (std::array<float, 3>{}));
  }
}
