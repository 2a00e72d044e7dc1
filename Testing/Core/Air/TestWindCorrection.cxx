// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Field/WindCorrection.h"
#include "Base/Random.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

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

const std::vector<WindScale> Scales = { { 1.0, 0.8, 0.2 }, { 0.5, 0.5, 0.1 } };

std::vector<WindSamples> SamplesOfGyre(int perFrame)
{
  Random random(2);
  std::vector<WindSamples> samples;
  for (int f = 0; f < Time.NumberOfFrames; f += 3)
  {
    WindSamples at;
    at.Frame = f;
    for (int s = 0; s < perFrame; ++s)
    {
      at.Positions.push_back(random.InBox(Volume));
      at.Values.push_back(Gyre(at.Positions.back(), Time.Time(f)));
    }
    samples.push_back(at);
  }
  return samples;
}

WindCorrection Fitted(const ParallelFor& parallel, DistanceFromSolids solids = nullptr)
{
  WindCorrection wind(Volume, Time, Scales, std::move(solids));
  SilentMonitor monitor;
  EXPECT_TRUE(wind.Fit(SamplesOfGyre(300), 0.01, 3e-3, 60, parallel, monitor));
  return wind;
}

// A ball in the middle of the volume.
double FromBall(const Vec3& x, double, double reach, Vec3& away)
{
  const Vec3 out = x - Vec3(0.0, 0.0, 2.0);
  away = out.normalized();
  return std::min(out.norm() - 0.5, reach);
}

// The covariance of the wind between two places and frames, by what each coefficient gives there.
class PlainKriging
{
public:
  PlainKriging(const std::vector<WindSamples>& samples, double error)
  {
    for (const WindSamples& at : samples)
    {
      for (std::size_t s = 0; s < at.Positions.size(); ++s)
      {
        this->Rows.push_back(this->RowsAt(at.Positions[s], at.Frame));
        this->Wanted.push_back(at.Values[s]);
      }
    }
    const auto size = static_cast<Eigen::Index>(3 * this->Rows.size());
    Eigen::MatrixXd all(size, this->Rows.front().cols());
    Eigen::VectorXd wanted(size);
    for (Eigen::Index i = 0; i < size; ++i)
    {
      const auto [at, c] = std::div(static_cast<int>(i), 3);
      wanted[i] = this->Wanted[static_cast<std::size_t>(at)][c];
      all.row(i) = this->RowOf(i);
    }
    this->Covariance = all * all.transpose();
    const Eigen::MatrixXd nugget = error * error * Eigen::MatrixXd::Identity(size, size);
    this->Weights = (this->Covariance + nugget).ldlt().solve(wanted);
  }
  /// Of the winds at the samples: how far they are from likely.
  double ChiSquare(const Eigen::VectorXd& winds) const
  {
    const Eigen::Index size = winds.size();
    const Eigen::MatrixXd little = 1e-8 * Eigen::MatrixXd::Identity(size, size);
    return winds.dot((this->Covariance + little).ldlt().solve(winds));
  }
  Eigen::VectorXd AtSamples() const { return this->Covariance * this->Weights; }
  Vec3 At(const Vec3& x, double frame) const
  {
    const Eigen::MatrixXd rows = this->RowsAt(x, frame);
    Vec3 wind = Vec3::Zero();
    for (Eigen::Index i = 0; i < this->Weights.size(); ++i)
    {
      wind += this->Weights[i] * (rows * this->RowOf(i).transpose());
    }
    return wind;
  }

private:
  Eigen::RowVectorXd RowOf(Eigen::Index i) const
  {
    return this->Rows[static_cast<std::size_t>(i / 3)].row(i % 3);
  }
  // Three rows, a column for each coefficient of all scales.
  Eigen::MatrixXd RowsAt(const Vec3& x, double frame) const
  {
    Eigen::Index size = 0;
    for (const WindScale& scale : Scales)
    {
      size += static_cast<Eigen::Index>(Splines(scale).Coefficients());
    }
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(3, size);
    Eigen::Index begin = 0;
    for (const WindScale& scale : Scales)
    {
      const WindSplines splines = Splines(scale);
      const WindSplines::Place place = splines.At(x);
      const WindSplines::Instant at = splines.At(frame);
      for (int c = 0; c < 3; ++c)
      {
        std::vector<double> own(splines.Coefficients(), 0.0);
        for (std::size_t m = 0; m < 4; ++m)
        {
          WindSplines::AddCurl(place, { splines.NodesOf(place), splines.Nodes() },
                               at.Weight[m] * Vec3::Unit(c),
                               own.data() + 3 * splines.Nodes() * at.Knots[m]);
        }
        for (std::size_t i = 0; i < own.size(); ++i)
        {
          rows(c, begin + static_cast<Eigen::Index>(i)) = own[i];
        }
      }
      begin += static_cast<Eigen::Index>(splines.Coefficients());
    }
    return rows;
  }
  static WindSplines Splines(const WindScale& scale)
  {
    return { Volume, Time, scale.Spacing, scale.TimeSpacing, scale.Variance };
  }

  std::vector<Eigen::MatrixXd> Rows;
  std::vector<Vec3> Wanted;
  Eigen::MatrixXd Covariance; // of the samples' components
  Eigen::VectorXd Weights;
};

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
  Random random(11);
  for (int s = 0; s < 50; ++s)
  {
    const Vec3 x = random.InBox(Volume);
    const double frame = random.Uniform(0.0, 90.0);
    EXPECT_EQ(one.At(x, frame), four.At(x, frame));
  }
}

TEST(WindCorrection, IsWhatKrigingWithItsCovarianceGives)
{
  std::vector<WindSamples> samples = SamplesOfGyre(2);
  samples.resize(4);
  const double error = 0.05;
  WindCorrection wind(Volume, Time, Scales);
  SilentMonitor monitor;
  EXPECT_TRUE(wind.Fit(samples, error, 3e-3, 500, SerialFor(), monitor));
  const PlainKriging plain(samples, error);
  Random random(5);
  for (int s = 0; s < 8; ++s)
  {
    const Vec3 x = s < 2 ? samples[1].Positions[static_cast<std::size_t>(s)] : random.InBox(Volume);
    EXPECT_LT((wind.At(x, 4.0) - plain.At(x, 4.0)).norm(), 0.4 * error);
  }
}

// As a correction is fitted: 32 bodies on their ways, that want each something else.
TEST(WindCorrection, IsNoLessLikelyThanKrigingAllows)
{
  Random random(8);
  std::vector<WindSamples> samples(3);
  for (int body = 0; body < 32; ++body)
  {
    const Vec3 start = random.InBox({ Vec3(-1.5, -1.5, 0.5), Vec3(1.5, 1.5, 3.5) });
    const Vec3 speed = random.InBox({ Vec3::Constant(-0.8), Vec3::Constant(0.8) });
    const Vec3 wanted = random.InBox({ Vec3::Constant(-0.5), Vec3::Constant(0.5) });
    for (std::size_t f = 0; f < samples.size(); ++f)
    {
      samples[f].Frame = 30.0 + 3.0 * static_cast<double>(f);
      samples[f].Positions.push_back(start + 0.1 * static_cast<double>(f) * speed);
      samples[f].Values.push_back(wanted);
    }
  }
  const double error = 0.03;
  WindCorrection wind(Volume, Time, Scales);
  SilentMonitor monitor;
  EXPECT_TRUE(wind.Fit(samples, error, 3e-3, 60, SerialFor(), monitor));
  const PlainKriging plain(samples, error);
  Eigen::VectorXd found(3 * 3 * 32);
  Eigen::Index at = 0;
  for (const WindSamples& frame : samples)
  {
    for (const Vec3& x : frame.Positions)
    {
      found.segment<3>(at) = wind.At(x, frame.Frame);
      at += 3;
    }
  }
  const double likely = plain.ChiSquare(plain.AtSamples());
  EXPECT_NEAR(plain.ChiSquare(found), likely, 0.1 * likely);
}

TEST(WindCorrection, IsNothingWithoutSamplesAndWholeWhereAFitIsStopped)
{
  class StopSoon : public Monitor
  {
  public:
    bool Tick(double, const std::string&) override { return --this->Left > 0; }
    int Left = 4;
  };
  WindCorrection wind(Volume, Time, Scales);
  StopSoon stops;
  EXPECT_FALSE(wind.Fit(SamplesOfGyre(300), 0.01, 3e-3, 60, SerialFor(), stops));
  const Vec3 x(0.3, 0.7, 1.1);
  EXPECT_LT((wind.At(x, 33.0) - Gyre(x, 1.1)).norm(), Gyre(x, 1.1).norm());
  SilentMonitor monitor;
  EXPECT_TRUE(wind.Fit({}, 0.01, 3e-3, 60, SerialFor(), monitor));
  EXPECT_EQ(wind.At(x, 33.0), Vec3::Zero());
}

TEST(WindCorrection, HasTheVarianceOfItsScales)
{
  Random random(3);
  const WindSplines splines(Volume, Time, 0.4, 0.5, 0.09);
  double sum = 0.0;
  int count = 0;
  for (int draw = 0; draw < 10; ++draw)
  {
    std::vector<double> values(splines.Coefficients());
    for (double& value : values)
    {
      value = random.Normal();
    }
    for (int s = 0; s < 100; ++s)
    {
      const WindSplines::Place place =
        splines.At(random.InBox({ Vec3(-1.0, -1.0, 1.0), Vec3(1.0, 1.0, 3.0) }));
      sum += splines.WindAt(place, random.Uniform(20.0, 70.0), values.data()).squaredNorm();
      count += 3;
    }
  }
  EXPECT_NEAR(sum / count, 0.09, 0.01);
}

TEST(WindCorrection, RunsAlongWhatStandsInTheAir)
{
  const WindCorrection wind = Fitted(SerialFor(), FromBall);
  Random random(6);
  for (int s = 0; s < 50; ++s)
  {
    const Vec3 out = Vec3(random.Normal(), random.Normal(), random.Normal()).normalized();
    const Vec3 on = Vec3(0.0, 0.0, 2.0) + (0.5 + 1e-9) * out;
    EXPECT_NEAR(wind.At(on, 40.0).dot(out), 0.0, 1e-6);
    EXPECT_EQ(wind.At(on - 0.1 * out, 40.0), Vec3::Zero());
  }
  EXPECT_GT(wind.At(Vec3(1.2, 0.3, 2.0), 40.0).norm(), 0.05);
}

TEST(WindCorrection, HasNoScaleBelowTwoSpacingsOfTheLattice)
{
  Random random(7);
  HalfSeries air;
  air.Dimensions = { 17, 17, 17 };
  air.Spacing = Vec3::Constant(0.25);
  air.Times = { 0.0 };
  HalfSeries::Field field(air.NumberOfPoints());
  for (std::size_t i = 0; i < field.size(); ++i)
  {
    const Vec3 u = Gyre(air.PointAt(i), 0.0);
    field[i] = { static_cast<float>(u[0]), static_cast<float>(u[1]), static_cast<float>(u[2]) };
  }
  air.Values.resize(1);
  air.Set(0, field);
  const std::vector<WindScale> scales = ScalesOf(air, 0.5, 0.5);
  ASSERT_EQ(scales.size(), std::size_t{ 2 }); // half of it is one spacing
  EXPECT_DOUBLE_EQ(scales[0].Spacing, 1.0);
  EXPECT_DOUBLE_EQ(scales[1].Spacing, 0.5);
  EXPECT_GT(scales[0].TimeSpacing, scales[1].TimeSpacing);
  // One large eddy.
  EXPECT_GT(scales[0].Variance, 4.0 * scales[1].Variance);
  EXPECT_EQ(ScalesOf(air, 0.1, 0.5).size(), std::size_t{ 1 });
}

} // namespace
