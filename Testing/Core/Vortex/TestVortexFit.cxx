// SPDX-License-Identifier: BSD-3-Clause
#include "TrueVortex.h"

#include "Vortex/VortexFit.h"
#include "Vortex/VortexRegion.h"
#include "Vortex/VortexSamples.h"

#include <gtest/gtest.h>

#include <ctime>
#include <limits>

using namespace waft;
using test::Truth;

namespace
{

constexpr double Width = 4.0;

/// An object that passes by the vortex on a bent way, 30 frames a second.
void AddTrack(const Vortex& v, int track, double noise, Random& random,
              std::vector<VortexSample>& samples, bool claimed = true, int frames = 150)
{
  const Vec3 axis = (v.P2 - v.P1).normalized();
  const Vec3 u = axis.unitOrthogonal();
  const Vec3 w = axis.cross(u);
  const double height = 0.5 * (track % 3 - 1) + random.Uniform(-0.15, 0.15);
  const double climb = random.Uniform(-0.1, 0.1);
  const double phase = random.Uniform(0.0, 6.28);
  const double turn = random.Uniform(0.3, 0.9); // rad/s
  const double radius = random.Uniform(1.0, 2.2) * v.CoreRadius;
  const double drift = random.Uniform(-0.1, 0.15);
  const int first =
    static_cast<int>(30.0 * v.CenterTime) - frames / 2 + static_cast<int>(random.Index(30)) - 15;
  for (int k = 0; k < frames; ++k)
  {
    const double t = k / 30.0;
    const double r = radius + drift * (t - 2.5);
    const double a = phase + turn * t;
    VortexSample s;
    s.Track = track;
    s.Frame = first + k;
    s.Time = s.Frame / 30.0;
    s.Position =
      0.5 * (v.P1 + v.P2) + (height + climb * t) * axis + r * (std::cos(a) * u + std::sin(a) * w);
    s.Acceleration = v.Acceleration(s.Position, s.Time);
    s.Acceleration += noise * s.Acceleration.norm() *
                      Vec3(random.Normal(), random.Normal(), random.Normal()) / std::sqrt(3.0);
    s.VortexId = claimed ? v.VortexId : -1;
    samples.push_back(s);
  }
}

/// The annotation's vortex, moved with its segment and therefore somewhat wrong.
Vortex Displaced(const Vortex& truth, Random& random)
{
  Vortex v = truth;
  const Vec3 shift = 0.08 * Width * random.Direction();
  const Eigen::AngleAxisd turn(0.3, random.Direction());
  const Vec3 half = turn * (0.5 * (truth.P2 - truth.P1));
  const Vec3 center = 0.5 * (truth.P1 + truth.P2) + shift;
  v.P1 = center - half;
  v.P2 = center + half;
  v.Strength *= random.Uniform(0.7, 1.4);
  v.CenterTime += random.Uniform(-0.5, 0.5);
  v.Duration *= random.Uniform(0.8, 1.3);
  v.CoreRadius *= random.Uniform(0.8, 1.3);
  return v;
}

struct Error
{
  double Axis, Center, Strength, Time; // degrees, of L, relative, s
};

Error Compare(const Vortex& a, const Vortex& truth)
{
  const Vec3 u = (a.P2 - a.P1).normalized();
  const Vec3 w = (truth.P2 - truth.P1).normalized();
  const double sign = u.dot(w) < 0.0 ? -1.0 : 1.0;
  return { std::atan2(u.cross(w).norm(), std::abs(u.dot(w))) * 180.0 / M_PI,
           (0.5 * (a.P1 + a.P2 - truth.P1 - truth.P2)).norm() / Width,
           std::abs(sign * a.Strength / truth.Strength - 1.0),
           std::abs(a.CenterTime - truth.CenterTime) };
}

/// Nothing is sought besides the priors.
VortexFitOptions PriorsOnly()
{
  VortexFitOptions options;
  options.MaximumNewVortices = 0;
  return options;
}

Vortex FitOne(const std::vector<VortexSample>& samples, const std::vector<Vortex>& priors,
              const VortexFitOptions& options = PriorsOnly())
{
  SilentMonitor monitor;
  std::vector<Vortex> fitted;
  const Result result = FitVortices(samples, priors, options, monitor, fitted);
  EXPECT_TRUE(static_cast<bool>(result)) << result.Message();
  EXPECT_FALSE(fitted.empty());
  return fitted.empty() ? Vortex() : fitted[0];
}

} // namespace

TEST(VortexFit, ThreeTracksRecoverTheVortex)
{
  std::vector<double> confidence, seconds;
  for (int seed = 0; seed < 24; ++seed)
  {
    const Vortex truth = Truth(seed);
    Random random(static_cast<std::uint64_t>(seed));
    std::vector<VortexSample> samples;
    for (int track = 0; track < 3; ++track)
    {
      AddTrack(truth, track, 0.05, random, samples);
    }
    const Vortex prior = Displaced(truth, random);
    const std::clock_t start = std::clock();
    const Vortex fitted = FitOne(samples, { prior });
    seconds.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    const Error error = Compare(fitted, truth);
    EXPECT_LT(error.Axis, 5.0) << seed;
    EXPECT_LT(error.Center, 0.05) << seed;
    EXPECT_LT(error.Strength, 0.10) << seed;
    EXPECT_LT(error.Time, 0.2) << seed;
    EXPECT_EQ(fitted.VortexId, 4);
    EXPECT_EQ(fitted.ObjectCount, 3);
    confidence.push_back(fitted.Confidence);
  }
  std::sort(confidence.begin(), confidence.end());
  EXPECT_GT(confidence[0], 0.3);
  EXPECT_GT(confidence[12], 0.7);
  std::sort(seconds.begin(), seconds.end());
  std::printf("[ figure ] %.1f ms of CPU a fit from three tracks\n", 1000.0 * seconds[12]);
#ifdef NDEBUG
  EXPECT_LE(seconds[12], 0.020); // processor time: a busy machine takes about as much
#endif
}

TEST(VortexFit, OneTrackHasLowConfidence)
{
  for (int seed = 0; seed < 10; ++seed)
  {
    const Vortex truth = Truth(seed);
    Random random(static_cast<std::uint64_t>(seed));
    std::vector<VortexSample> samples;
    AddTrack(truth, 0, 0.05, random, samples);
    const Vortex fitted = FitOne(samples, { Displaced(truth, random) });
    EXPECT_EQ(fitted.ObjectCount, 1);
    EXPECT_LE(fitted.Confidence, 0.3);
  }
}

TEST(VortexFit, TracksThatTheAnnotationDoesNotClaimAreWitnessesToo)
{
  const Vortex truth = Truth(3);
  Random random(3);
  std::vector<VortexSample> samples;
  for (int track = 0; track < 3; ++track)
  {
    AddTrack(truth, track, 0.05, random, samples, track == 0);
  }
  const Vortex fitted = FitOne(samples, { Displaced(truth, random) });
  EXPECT_EQ(fitted.ObjectCount, 3);
  EXPECT_LT(Compare(fitted, truth).Center, 0.05);
  EXPECT_LT(Compare(fitted, truth).Strength, 0.1);
}

TEST(VortexFit, StandsOutliersWindAndClockwiseTurning)
{
  for (int seed = 30; seed < 36; ++seed)
  {
    Vortex truth = Truth(seed);
    truth.Strength = -truth.Strength;
    Random random(static_cast<std::uint64_t>(seed));
    std::vector<VortexSample> samples;
    for (int track = 0; track < 4; ++track)
    {
      AddTrack(truth, track, 0.03, random, samples);
    }
    for (VortexSample& s : samples)
    {
      s.Acceleration += Vec3(0.15, -0.1, 0.05); // wind
      if (random.Uniform() < 0.08)
      {
        s.Acceleration += 6.0 * random.Direction(); // a collision
      }
    }
    const Error error = Compare(FitOne(samples, { Displaced(truth, random) }), truth);
    EXPECT_LT(error.Axis, 5.0) << seed;
    EXPECT_LT(error.Center, 0.06) << seed;
    EXPECT_LT(error.Strength, 0.15) << seed;
    EXPECT_LT(error.Time, 0.2) << seed;
  }
}

TEST(VortexFit, FindsSeveralVorticesWithoutPriors)
{
  Vortex first = Truth(1);
  Vortex second = Truth(2);
  const Vec3 side(1.2, 0.4, 0.0);
  first.P1 -= side;
  first.P2 -= side;
  second.P1 += side;
  second.P2 += side;
  second.CenterTime += 2.0;
  Random random(1);
  std::vector<VortexSample> samples;
  for (int track = 0; track < 4; ++track)
  {
    AddTrack(first, track, 0.0, random, samples, false);
    AddTrack(second, 10 + track, 0.0, random, samples, false);
  }
  for (VortexSample& s : samples)
  {
    s.Acceleration = first.Acceleration(s.Position, s.Time) +
                     second.Acceleration(s.Position, s.Time) + 0.02 * random.Direction();
  }
  VortexFitOptions options;
  options.MaximumNewVortices = 5;
  options.Sweeps = 3;
  SilentMonitor monitor;
  std::vector<Vortex> fitted;
  ASSERT_TRUE(static_cast<bool>(FitVortices(samples, {}, options, monitor, fitted)));
  ASSERT_GE(fitted.size(), 2u);
  double energy = 0.0, left = 0.0;
  for (const VortexSample& s : samples)
  {
    Vec3 rest = s.Acceleration;
    for (const Vortex& v : fitted)
    {
      rest -= v.Acceleration(s.Position, s.Time);
    }
    energy += s.Acceleration.squaredNorm();
    left += rest.squaredNorm();
  }
  EXPECT_LT(left, 0.05 * energy);
  for (const Vortex& truth : { first, second })
  {
    double nearest = 1e9;
    for (const Vortex& v : fitted)
    {
      const Error error = Compare(v, truth);
      nearest = std::min(nearest, error.Axis / 5.0 + error.Center / 0.05 + error.Strength / 0.1);
    }
    EXPECT_LT(nearest, 3.0);
  }
}

TEST(VortexFit, MergesDuplicatesIntoTheEarlier)
{
  const Vortex truth = Truth(5);
  Random random(5);
  std::vector<VortexSample> samples;
  for (int track = 0; track < 4; ++track)
  {
    AddTrack(truth, track, 0.03, random, samples);
    for (auto s = samples.end() - 150; track >= 2 && s != samples.end(); ++s)
    {
      s->VortexId = 9;
    }
  }
  Vortex one = truth;
  Vortex two = truth;
  two.VortexId = 9;
  two.P1 += Vec3(0.03, 0.0, 0.0);
  two.P2 += Vec3(0.03, 0.02, 0.0);
  one.Strength *= 0.6;
  two.Strength *= 0.5;
  SilentMonitor monitor;
  std::vector<Vortex> fitted;
  ASSERT_TRUE(static_cast<bool>(FitVortices(samples, { one, two }, PriorsOnly(), monitor, fitted)));
  ASSERT_EQ(fitted.size(), 1u);
  EXPECT_EQ(fitted[0].VortexId, 4);
  EXPECT_EQ(fitted[0].ObjectCount, 4);
  EXPECT_LT(Compare(fitted[0], truth).Strength, 0.1);
  EXPECT_LT(Compare(fitted[0], truth).Center, 0.05);
}

TEST(VortexFit, HandsBackWhatNobodySawAndKeepsBounds)
{
  const Vortex truth = Truth(7);
  Vortex unseen = Truth(8);
  unseen.VortexId = 11;
  unseen.CenterTime = 90.0;
  Random random(7);
  std::vector<VortexSample> samples;
  AddTrack(truth, 0, 0.3, random, samples);
  VortexFitOptions options = PriorsOnly();
  options.MaximumStrength = 2.0;
  options.MaximumDuration = 1.0;
  SilentMonitor monitor;
  std::vector<Vortex> fitted;
  ASSERT_TRUE(static_cast<bool>(FitVortices(samples, { unseen, truth }, options, monitor, fitted)));
  ASSERT_EQ(fitted.size(), 2u);
  EXPECT_EQ(fitted[0].VortexId, 11);
  EXPECT_EQ(fitted[0].ObjectCount, 0);
  EXPECT_EQ(fitted[0].P1, unseen.P1);
  EXPECT_EQ(fitted[0].Strength, unseen.Strength);
  EXPECT_LE(std::abs(fitted[1].Strength), 2.0 * (1 + 1e-12));
  EXPECT_LE(fitted[1].Duration, 1.0 + 1e-12);
}

TEST(VortexFit, RepeatsBitForBitAndStopsWhenAsked)
{
  struct Stopper : Monitor
  {
    int Left = 3;
    bool Tick(double, const std::string&) override { return --this->Left > 0; }
  };
  const Vortex truth = Truth(9);
  Random random(9);
  std::vector<VortexSample> samples;
  for (int track = 0; track < 3; ++track)
  {
    AddTrack(truth, track, 0.1, random, samples);
  }
  const Vortex prior = Displaced(truth, random);
  VortexFitOptions options = PriorsOnly();
  options.Seed = 5;
  const Vortex once = FitOne(samples, { prior }, options);
  const Vortex twice = FitOne(samples, { prior }, options);
  EXPECT_EQ(once.P1, twice.P1);
  EXPECT_EQ(once.P2, twice.P2);
  EXPECT_EQ(once.Strength, twice.Strength);
  EXPECT_EQ(once.CenterTime, twice.CenterTime);
  EXPECT_EQ(once.Confidence, twice.Confidence);
  Stopper stopper;
  std::vector<Vortex> fitted;
  EXPECT_TRUE(FitVortices(samples, { prior }, options, stopper, fitted).IsStopped());
  ASSERT_EQ(fitted.size(), 1u);
  EXPECT_TRUE(fitted[0].P1.allFinite());
}

TEST(VortexFit, RefusesBadNumbersByName)
{
  const Vortex truth = Truth(9);
  Random random(9);
  std::vector<VortexSample> samples;
  AddTrack(truth, 6, 0.0, random, samples);
  SilentMonitor monitor;
  std::vector<Vortex> fitted;
  const auto message = [&](const std::vector<Vortex>& priors, const VortexFitOptions& options)
  {
    const Result result = FitVortices(samples, priors, options, monitor, fitted);
    EXPECT_FALSE(static_cast<bool>(result));
    return result.Message();
  };
  Vortex flat = truth;
  flat.P2 = flat.P1;
  EXPECT_NE(message({ flat }, PriorsOnly()).find("vortex 4"), std::string::npos);
  EXPECT_NE(message({ truth, truth }, PriorsOnly()).find("each used once"), std::string::npos);
  VortexFitOptions options = PriorsOnly();
  options.NumberOfStarts = 0;
  EXPECT_NE(message({ truth }, options).find("NumberOfStarts"), std::string::npos);
  samples[12].Acceleration.y() = std::numeric_limits<double>::infinity();
  EXPECT_NE(message({ truth }, PriorsOnly()).find("sample 12 (track 6, frame"), std::string::npos);
  samples.clear();
  EXPECT_TRUE(static_cast<bool>(FitVortices(samples, { truth }, PriorsOnly(), monitor, fitted)));
  EXPECT_EQ(fitted.size(), 1u);
  EXPECT_TRUE(static_cast<bool>(FitVortices({}, {}, PriorsOnly(), monitor, fitted)));
  EXPECT_TRUE(fitted.empty());
}

TEST(VortexFit, FindsNothingInNoiseAndInAUniformWind)
{
  Random random(12);
  std::vector<VortexSample> samples;
  for (int track = 0; track < 6; ++track)
  {
    AddTrack(Truth(track), track, 0.0, random, samples, false);
  }
  for (VortexSample& s : samples)
  {
    s.Acceleration =
      Vec3(0.5, 0.2, 0.0) + 0.1 * Vec3(random.Normal(), random.Normal(), random.Normal());
  }
  VortexFitOptions options;
  options.MaximumNewVortices = 4;
  SilentMonitor monitor;
  std::vector<Vortex> fitted;
  ASSERT_TRUE(static_cast<bool>(FitVortices(samples, {}, options, monitor, fitted)));
  for (const Vortex& v : fitted)
  {
    EXPECT_LT(v.Confidence, 0.2);
  }
  EXPECT_TRUE(fitted.empty()) << fitted.size();
}
