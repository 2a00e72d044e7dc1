// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Field/WindCorrection.h"

#include "Base/Simd.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

/// Cubic B-splines of four knots around a point 0..1 between the middle two.
void CubicWeights(double t, double* w, double* slope)
{
  const double s = 1.0 - t;
  w[0] = s * s * s / 6.0;
  w[1] = 2.0 / 3.0 - t * t * (2.0 - t) / 2.0;
  w[2] = 2.0 / 3.0 - s * s * (2.0 - s) / 2.0;
  w[3] = t * t * t / 6.0;
  if (slope)
  {
    slope[0] = -0.5 * s * s;
    slope[1] = -2.0 * t + 1.5 * t * t;
    slope[2] = 2.0 * s - 1.5 * s * s;
    slope[3] = 0.5 * t * t;
  }
}

/// From 0 at a wall to 1 at a spacing's distance.
double Hold(double s, double& slope)
{
  if (s >= 1.0)
  {
    slope = 0.0;
    return 1.0;
  }
  const double q = std::max(s, 0.0);
  slope = (15.0 - 30.0 * q * q + 15.0 * q * q * q * q) / 8.0;
  return q * (15.0 - 10.0 * q * q + 3.0 * q * q * q * q) / 8.0;
}

} // namespace

WindCorrection::WindCorrection(const Box& volume, const Timeline& time,
                               const WindCorrectionOptions& options) :
  Volume(volume),
  Time(time), Options(options)
{
  for (int c = 0; c < 3; ++c)
  {
    const int spans =
      std::max(2, static_cast<int>(std::lround(volume.Size()[c] / options.Spacing)));
    this->Spacing[c] = volume.Size()[c] / spans;
    this->Count[static_cast<std::size_t>(c)] = spans + 3;
  }
  const double frames = std::max(1, time.NumberOfFrames - 1);
  const int spans =
    std::max(1, static_cast<int>(std::lround(frames * time.Step() / options.TimeSpacing)));
  this->FramesPerKnot = frames / spans;
  this->Knots = spans + 3;
  this->Coefficients.assign(3 * this->NodesPerKnot() * static_cast<std::size_t>(this->Knots), 0.0);
}

WindCorrection::Splines WindCorrection::SplinesAt(int axis, double x) const
{
  const double h = this->Spacing[axis];
  const double low = this->Volume.Min[axis];
  const double high = this->Volume.Max[axis];
  const double held = std::clamp(x, low, high);
  const int spans = this->Count[static_cast<std::size_t>(axis)] - 3;
  const double coordinate = (held - low) / h;
  Splines s;
  s.First = std::clamp(static_cast<int>(std::floor(coordinate)), 0, spans - 1);
  double slopes[4];
  CubicWeights(coordinate - s.First, s.Plain, slopes);
  double atLow, atHigh;
  const double a = Hold((held - low) / h, atLow);
  const double b = Hold((high - held) / h, atHigh);
  for (int i = 0; i < 4; ++i)
  {
    s.Held[i] = a * b * s.Plain[i];
    s.Slope[i] = (a * b * slopes[i] + (atLow * b - a * atHigh) * s.Plain[i]) / h;
  }
  return s;
}

WindCorrection::Level WindCorrection::LevelAt(double frame) const
{
  const double knot = std::clamp(frame / this->FramesPerKnot, 0.0, this->Knots - 3.0);
  Level level;
  level.First = std::min(static_cast<int>(std::floor(knot)), this->Knots - 4);
  CubicWeights(knot - level.First, level.Weight, nullptr);
  return level;
}

WindCorrection::Nodes WindCorrection::At(const Level& level,
                                         const std::vector<double>& coefficients) const
{
  const std::size_t size = 3 * this->NodesPerKnot();
  Nodes nodes(size, 0.0);
  for (int m = 0; m < 4; ++m)
  {
    const double* knot = coefficients.data() + static_cast<std::size_t>(level.First + m) * size;
    for (std::size_t i = 0; i < size; ++i)
    {
      nodes[i] += level.Weight[m] * knot[i];
    }
  }
  return nodes;
}

// What of A is needed along x is summed first: a row of nodes has five such sums.
Vec3 WindCorrection::Curl(const Basis& basis, const double* nodes) const
{
  const Splines& x = basis.Along[0];
  const Splines& y = basis.Along[1];
  const Splines& z = basis.Along[2];
  Vec3 w = Vec3::Zero();
  for (int k = 0; k < 4; ++k)
  {
    for (int j = 0; j < 4; ++j)
    {
      const double* a = nodes + this->RowOf(basis, j, k);
      double plain0 = 0.0, held1 = 0.0, held2 = 0.0, slope1 = 0.0, slope2 = 0.0;
      for (int i = 0; i < 4; ++i, a += 3)
      {
        plain0 += a[0] * x.Plain[i];
        held1 += a[1] * x.Held[i];
        held2 += a[2] * x.Held[i];
        slope1 += a[1] * x.Slope[i];
        slope2 += a[2] * x.Slope[i];
      }
      w[0] += held2 * (y.Slope[j] * z.Plain[k]) - held1 * (y.Plain[j] * z.Slope[k]);
      w[1] += plain0 * (y.Held[j] * z.Slope[k]) - slope2 * (y.Held[j] * z.Plain[k]);
      w[2] += slope1 * (y.Plain[j] * z.Held[k]) - plain0 * (y.Slope[j] * z.Held[k]);
    }
  }
  return w;
}

Vec3 WindCorrection::At(const Vec3& x, double frame) const
{
  Basis basis;
  for (int c = 0; c < 3; ++c)
  {
    basis.Along[c] = this->SplinesAt(c, x[c]);
  }
  const Level level = this->LevelAt(frame);
  const std::size_t size = 3 * this->NodesPerKnot();
  Vec3 wind = Vec3::Zero();
  for (int m = 0; m < 4; ++m)
  {
    wind += level.Weight[m] * this->Curl(basis, this->Coefficients.data() +
                                                  static_cast<std::size_t>(level.First + m) * size);
  }
  return wind;
}

namespace
{

// The splines that are not zero at each of the points along an axis.
struct Weights
{
  std::vector<int> First;
  std::vector<std::array<double, 4>> Of;
};

// values [outer][from][inner] summed along the middle axis, with the weights of points there.
WAFT_SIMD_CLONES void Contract(const double* values, std::size_t outer, std::size_t from,
                               std::size_t inner, const Weights& weights, double* sums)
{
  for (std::size_t o = 0; o < outer; ++o)
  {
    for (std::size_t p = 0; p < weights.First.size(); ++p)
    {
      const double w[4] = { weights.Of[p][0], weights.Of[p][1], weights.Of[p][2],
                            weights.Of[p][3] };
      const double* v = values + (o * from + static_cast<std::size_t>(weights.First[p])) * inner;
      for (std::size_t i = 0; i < inner; ++i)
      {
        *sums++ =
          w[0] * v[i] + w[1] * v[i + inner] + w[2] * v[i + 2 * inner] + w[3] * v[i + 3 * inner];
      }
    }
  }
}

} // namespace

bool WindCorrection::AddTo(const HalfSeries& air, HalfSeries& sum, const ParallelFor& parallel,
                           Monitor& monitor) const
{
  PartMonitor part(monitor, 1.0, 1.0);
  enum Part
  {
    Plain,
    Held,
    Slope
  };
  Weights along[3][3]; // axis, part
  for (int c = 0; c < 3; ++c)
  {
    for (int i = 0; i < air.Dimensions[static_cast<std::size_t>(c)]; ++i)
    {
      const Splines s = this->SplinesAt(c, air.Origin[c] + i * air.Spacing[c]);
      const double* parts[3] = { s.Plain, s.Held, s.Slope };
      for (int p = 0; p < 3; ++p)
      {
        along[c][p].First.push_back(s.First);
        along[c][p].Of.push_back({ parts[p][0], parts[p][1], parts[p][2], parts[p][3] });
      }
    }
  }
  // Component of W, component of A, sign, and which part of the splines along x, y, z.
  struct Term
  {
    std::size_t Of, Potential;
    double Sign;
    Part Parts[3];
  };
  const Term terms[] = {
    { 0, 2, 1.0, { Held, Slope, Plain } }, { 0, 1, -1.0, { Held, Plain, Slope } },
    { 1, 0, 1.0, { Plain, Held, Slope } }, { 1, 2, -1.0, { Slope, Held, Plain } },
    { 2, 1, 1.0, { Slope, Plain, Held } }, { 2, 0, -1.0, { Plain, Slope, Held } }
  };
  const std::array<std::size_t, 3> nodesAlong = { static_cast<std::size_t>(this->Count[0]),
                                                  static_cast<std::size_t>(this->Count[1]),
                                                  static_cast<std::size_t>(this->Count[2]) };
  const std::array<std::size_t, 3> points = { static_cast<std::size_t>(air.Dimensions[0]),
                                              static_cast<std::size_t>(air.Dimensions[1]),
                                              static_cast<std::size_t>(air.Dimensions[2]) };
  const auto addAt = [&](std::size_t f)
  {
    const Nodes nodes =
      this->At(this->LevelAt(air.Times[f] / this->Time.Step()), this->Coefficients);
    HalfSeries::Field field = air.At(f);
    std::vector<double> values(this->NodesPerKnot());
    std::vector<double> alongX(points[0] * nodesAlong[1] * nodesAlong[2]);
    std::vector<double> alongY(points[0] * points[1] * nodesAlong[2]);
    std::vector<double> wind(points[0] * points[1] * points[2]);
    for (const Term& term : terms)
    {
      for (std::size_t i = 0; i < values.size(); ++i)
      {
        values[i] = nodes[3 * i + term.Potential];
      }
      // The long inner loops last.
      Contract(values.data(), nodesAlong[1] * nodesAlong[2], nodesAlong[0], 1,
               along[0][term.Parts[0]], alongX.data());
      Contract(alongX.data(), nodesAlong[2], nodesAlong[1], points[0], along[1][term.Parts[1]],
               alongY.data());
      Contract(alongY.data(), 1, nodesAlong[2], points[0] * points[1], along[2][term.Parts[2]],
               wind.data());
      for (std::size_t i = 0; i < wind.size(); ++i)
      {
        field[i][term.Of] += static_cast<float>(term.Sign * wind[i]);
      }
    }
    sum.Set(f, field);
  };
  parallel(air.Values.size(),
           [&](std::size_t begin, std::size_t end)
           {
             for (std::size_t f = begin; f < end && part.Tick(-1.0, ""); ++f)
             {
               addAt(f);
             }
           });
  return part.Tick(-1.0, "");
}

} // namespace waft
