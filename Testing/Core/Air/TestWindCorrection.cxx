// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Field/WindCorrection.h"
#include "Base/Random.h"
#include "Base/ThreadRanks.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace waft;

namespace
{

const Box Volume;
const Timeline Time{ 91, 30.0 };

// Solenoidal, and tangential at the sides.
Vec3 Gyre(const Vec3& x, double t)
{
  const double k = M_PI / 4.0;
  const double a = 0.5 + 0.3 * std::sin(t);
  return { a * std::cos(k * x.x()) * std::sin(k * x.y()),
           -a * std::sin(k * x.x()) * std::cos(k * x.y()), 0.0 };
}

WindCorrection Fitted(const ParallelFor& parallel, Communicator& ranks)
{
  WindCorrectionOptions options;
  options.Iterations = 300;
  options.Ridge = options.Bending = options.Changing = 1e-5;
  WindCorrection wind(Volume, Time, options);
  Random random(2);
  std::vector<WindSamples> samples;
  for (int f = 0; f < Time.NumberOfFrames; f += 3)
  {
    WindSamples at;
    at.Frame = f;
    for (int s = 0; s < 300; ++s)
    {
      at.Positions.push_back(random.InBox(Volume));
      at.Values.push_back(Gyre(at.Positions.back(), Time.Time(f)));
    }
    samples.push_back(at);
  }
  SilentMonitor monitor;
  EXPECT_TRUE(wind.Fit(samples, parallel, ranks, monitor));
  return wind;
}

WindCorrection Fitted(const ParallelFor& parallel)
{
  SingleRank alone;
  return Fitted(parallel, alone);
}

TEST(WindCorrection, FindsTheFlowThatItsSamplesAreOf)
{
  const WindCorrection wind = Fitted(SerialFor());
  Random random(9);
  double missed = 0.0, all = 0.0;
  for (int s = 0; s < 500; ++s)
  {
    const Vec3 x = random.InBox(Volume);
    const double frame = random.Uniform(5.0, 85.0);
    missed += (wind.At(x, frame) - Gyre(x, frame / 30.0)).squaredNorm();
    all += Gyre(x, frame / 30.0).squaredNorm();
  }
  EXPECT_LT(std::sqrt(missed / all), 0.1);
}

TEST(WindCorrection, IsSolenoidalAndRunsAlongWalls)
{
  const WindCorrection wind = Fitted(SerialFor());
  Random random(4);
  const double h = 1e-4;
  for (int s = 0; s < 100; ++s)
  {
    Vec3 x = random.InBox({ Vec3(-1.9, -1.9, 0.1), Vec3(1.9, 1.9, 3.9) });
    double divergence = 0.0;
    for (int c = 0; c < 3; ++c)
    {
      divergence +=
        (wind.At(x + h * Vec3::Unit(c), 40.0)[c] - wind.At(x - h * Vec3::Unit(c), 40.0)[c]) /
        (2.0 * h);
    }
    EXPECT_NEAR(divergence, 0.0, 1e-5);
    const int c = s % 3;
    x[c] = s % 2 == 0 ? Volume.Min[c] : Volume.Max[c];
    EXPECT_NEAR(wind.At(x, 40.0)[c], 0.0, 1e-12);
  }
}

TEST(WindCorrection, IsAddedToALatticeAsItIs)
{
  const WindCorrection wind = Fitted(SerialFor());
  FieldSeries sum;
  sum.Meaning = FieldMeaning::Velocity;
  sum.Dimensions = { 7, 6, 5 };
  sum.Origin = Volume.Min;
  sum.Spacing = Vec3(4.0 / 6, 4.0 / 5, 1.0);
  sum.Times = { 1.0 };
  sum.Values.assign(1,
                    std::vector<std::array<float, 3>>(sum.NumberOfPoints(), { 1.0f, 2.0f, 3.0f }));
  HalfSeries halves(sum);
  SilentMonitor monitor;
  EXPECT_TRUE(wind.AddTo(halves, halves, SerialFor(), monitor));
  for (int i = 0; i < 7; ++i)
  {
    const Vec3 x = sum.Origin + Vec3(i, 2, 3).cwiseProduct(sum.Spacing);
    const Vec3 expected = Vec3(1.0, 2.0, 3.0) + wind.At(x, 30.0);
    EXPECT_LT((halves.Around(1.0).Sample(x, 1.0) - expected).norm(), 2e-3);
  }
}

TEST(WindCorrection, IsTheSameOnAnyNumberOfThreads)
{
  const WindCorrection one = Fitted(SerialFor());
  const WindCorrection four = Fitted(ThreadedFor(4));
  const Vec3 x(0.3, 0.7, 1.1);
  EXPECT_EQ(one.At(x, 33.3), four.At(x, 33.3));
}

} // namespace

TEST(WindCorrection, IsTheSameOnAnyNumberOfRanks)
{
  WindCorrection alone = Fitted(SerialFor());
  for (const int size : { 2, 3 })
  {
    EXPECT_TRUE(RunRanks(size, [&](Communicator& ranks)
                         { EXPECT_EQ(Fitted(SerialFor(), ranks).Values(), alone.Values()); }));
  }
}
