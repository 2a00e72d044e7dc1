// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Field/WindSplines.h"

#include "Base/Simd.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace waft
{
namespace
{

/// Means over a spacing of the sum of squares of the splines, and of their slopes.
constexpr double MeanSquare = 151.0 / 315.0;
constexpr double MeanSlopeSquare = 2.0 / 3.0;

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

// The splines that are not zero at each of the points along an axis.
struct Weights
{
  std::vector<int> First;
  std::vector<std::array<float, 4>> Of;
};

// values [outer][from][inner] summed along the middle axis, with the weights of points there.
WAFT_SIMD_CLONES void Contract(const float* values, std::size_t outer, std::size_t from,
                               std::size_t inner, const Weights& weights, float* sums)
{
  for (std::size_t o = 0; o < outer; ++o)
  {
    for (std::size_t p = 0; p < weights.First.size(); ++p)
    {
      const float w[4] = { weights.Of[p][0], weights.Of[p][1], weights.Of[p][2], weights.Of[p][3] };
      const float* v = values + (o * from + static_cast<std::size_t>(weights.First[p])) * inner;
      for (std::size_t i = 0; i < inner; ++i)
      {
        *sums++ =
          w[0] * v[i] + w[1] * v[i + inner] + w[2] * v[i + 2 * inner] + w[3] * v[i + 3 * inner];
      }
    }
  }
}

} // namespace

double HoldAt(double distance, double& slope)
{
  if (distance >= 1.0)
  {
    slope = 0.0;
    return 1.0;
  }
  const double q = std::max(distance, 0.0);
  slope = (15.0 - 30.0 * q * q + 15.0 * q * q * q * q) / 8.0;
  return q * (15.0 - 10.0 * q * q + 3.0 * q * q * q * q) / 8.0;
}

WindSplines::WindSplines(const Box& volume, const Timeline& time, double spacing,
                         double timeSpacing, double variance) :
  Volume(volume),
  Reach(spacing)
{
  for (int c = 0; c < 3; ++c)
  {
    const int spans = std::max(2, static_cast<int>(std::lround(volume.Size()[c] / spacing)));
    this->Step[c] = volume.Size()[c] / spans;
    this->Count[static_cast<std::size_t>(c)] = spans + 3;
  }
  const double frames = std::max(1, time.NumberOfFrames - 1);
  const int spans = std::max(1, static_cast<int>(std::lround(frames * time.Step() / timeSpacing)));
  this->FramesPerKnot = frames / spans;
  this->KnotCount = static_cast<std::size_t>(spans) + 3;
  // A component of the curl is the difference of two slopes.
  const double square = 2.0 * MeanSlopeSquare * std::pow(MeanSquare, 3);
  this->Unit = spacing * std::sqrt(variance / square);
}

std::size_t WindSplines::Nodes() const
{
  return static_cast<std::size_t>(this->Count[0]) * static_cast<std::size_t>(this->Count[1]) *
         static_cast<std::size_t>(this->Count[2]);
}

WindSplines::Axis WindSplines::AxisAt(int axis, double x) const
{
  const double h = this->Step[axis];
  const double low = this->Volume.Min[axis];
  const double high = this->Volume.Max[axis];
  const double held = std::clamp(x, low, high);
  const int spans = this->Count[static_cast<std::size_t>(axis)] - 3;
  const double coordinate = (held - low) / h;
  Axis s;
  s.First = std::clamp(static_cast<int>(std::floor(coordinate)), 0, spans - 1);
  double slopes[4];
  CubicWeights(coordinate - s.First, s.Plain, slopes);
  double atLow, atHigh;
  const double a = HoldAt((held - low) / h, atLow);
  const double b = HoldAt((high - held) / h, atHigh);
  for (int i = 0; i < 4; ++i)
  {
    s.Held[i] = a * b * s.Plain[i];
    s.Slope[i] = (a * b * slopes[i] + (atLow * b - a * atHigh) * s.Plain[i]) / h;
  }
  return s;
}

WindSplines::Place WindSplines::At(const Vec3& x) const
{
  Place place;
  for (int c = 0; c < 3; ++c)
  {
    place.Along[c] = this->AxisAt(c, x[c]);
  }
  return place;
}

WindSplines::Instant WindSplines::At(double frame) const
{
  const auto last = static_cast<double>(this->KnotCount - 3);
  const double knot = std::clamp(frame / this->FramesPerKnot, 0.0, last);
  Instant at;
  at.First = std::min(static_cast<int>(knot), static_cast<int>(this->KnotCount) - 4);
  CubicWeights(knot - at.First, at.Weight, nullptr);
  for (double& weight : at.Weight)
  {
    weight *= this->Unit;
  }
  return at;
}

WindSplines::Rows WindSplines::RowsOf(const Place& place) const
{
  Rows rows;
  for (int k = 0; k < 4; ++k)
  {
    for (int j = 0; j < 4; ++j)
    {
      const int y = place.Along[1].First + j;
      const int z = place.Along[2].First + k;
      rows[static_cast<std::size_t>(4 * k + j)] =
        (z * this->Count[1] + y) * this->Count[0] + place.Along[0].First;
    }
  }
  return rows;
}

namespace
{

WAFT_INLINE void Load(const double* p, Double4& v)
{
  std::memcpy(&v, p, sizeof(v));
}

WAFT_INLINE void Add(const Double4& more, double* p)
{
  Double4 sum;
  Load(p, sum);
  sum += more;
  std::memcpy(p, &sum, sizeof(sum));
}

WAFT_INLINE double SumOf(const Double4& v)
{
  return (v[0] + v[1]) + (v[2] + v[3]);
}

// The parts along x of what is needed, summed over the rows; the products of those with the splines
// along x come last.
WAFT_SIMD_CLONES void SumRows(const WindSplines::Axis& x, const WindSplines::Axis& y,
                              const WindSplines::Axis& z, const int* rows, const double* values,
                              std::size_t nodes, double* curl, double* potential)
{
  Double4 x01{}, x02{}, xHeld{}, y0{}, yHeld{}, z0{}, zHeld{};
  for (int k = 0; k < 4; ++k)
  {
    for (int j = 0; j < 4; ++j)
    {
      const double* row = values + rows[4 * k + j];
      Double4 a0, a1, a2;
      Load(row, a0);
      Load(row + nodes, a1);
      Load(row + 2 * nodes, a2);
      x01 += a0 * (y.Held[j] * z.Slope[k]);
      x02 += a0 * (y.Slope[j] * z.Held[k]);
      xHeld += a0 * (y.Held[j] * z.Held[k]);
      y0 += a1 * (y.Plain[j] * z.Slope[k]);
      yHeld += a1 * (y.Plain[j] * z.Held[k]);
      z0 += a2 * (y.Slope[j] * z.Plain[k]);
      zHeld += a2 * (y.Held[j] * z.Plain[k]);
    }
  }
  Double4 plain, held, slope;
  Load(x.Plain, plain);
  Load(x.Held, held);
  Load(x.Slope, slope);
  curl[0] = SumOf(z0 * held - y0 * held);
  curl[1] = SumOf(x01 * plain - zHeld * slope);
  curl[2] = SumOf(yHeld * slope - x02 * plain);
  potential[0] = SumOf(xHeld * plain);
  potential[1] = SumOf(yHeld * held);
  potential[2] = SumOf(zHeld * held);
}

WAFT_SIMD_CLONES void AddRows(const WindSplines::Axis& x, const WindSplines::Axis& y,
                              const WindSplines::Axis& z, const int* rows, const double* v,
                              const double* p, double* values, std::size_t nodes)
{
  Double4 plain, held, slope;
  Load(x.Plain, plain);
  Load(x.Held, held);
  Load(x.Slope, slope);
  for (int k = 0; k < 4; ++k)
  {
    for (int j = 0; j < 4; ++j)
    {
      double* row = values + rows[4 * k + j];
      Add(plain * (v[1] * (y.Held[j] * z.Slope[k]) - v[2] * (y.Slope[j] * z.Held[k]) +
                   p[0] * (y.Held[j] * z.Held[k])),
          row);
      Add(held * (p[1] * (y.Plain[j] * z.Held[k]) - v[0] * (y.Plain[j] * z.Slope[k])) +
            slope * (v[2] * (y.Plain[j] * z.Held[k])),
          row + nodes);
      Add(held * (v[0] * (y.Slope[j] * z.Plain[k]) + p[2] * (y.Held[j] * z.Plain[k])) -
            slope * (v[1] * (y.Held[j] * z.Plain[k])),
          row + 2 * nodes);
    }
  }
}

} // namespace

Vec3 WindSplines::Curl(const Place& place, const Rows& rows, const double* values,
                       std::size_t nodes)
{
  Vec3 curl, potential;
  SumRows(place.Along[0], place.Along[1], place.Along[2], rows.data(), values, nodes, curl.data(),
          potential.data());
  return place.Hold.Factor * curl + place.Hold.Slope.cross(potential);
}

void WindSplines::AddCurl(const Place& place, const Rows& rows, const Vec3& value, double* values,
                          std::size_t nodes)
{
  const Vec3 v = place.Hold.Factor * value;
  const Vec3 p = value.cross(place.Hold.Slope);
  AddRows(place.Along[0], place.Along[1], place.Along[2], rows.data(), v.data(), p.data(), values,
          nodes);
}

void WindSplines::AddTo(const double* coefficients, double frame, const SeriesLattice& lattice,
                        const std::vector<WindHold>& holds, HalfSeries::Field& field) const
{
  enum Part
  {
    Plain,
    Held,
    Slope
  };
  Weights along[3][3]; // axis, part
  std::array<std::size_t, 3> points{}, nodes{};
  for (int c = 0; c < 3; ++c)
  {
    points[static_cast<std::size_t>(c)] =
      static_cast<std::size_t>(lattice.Dimensions[static_cast<std::size_t>(c)]);
    nodes[static_cast<std::size_t>(c)] =
      static_cast<std::size_t>(this->Count[static_cast<std::size_t>(c)]);
    for (int i = 0; i < lattice.Dimensions[static_cast<std::size_t>(c)]; ++i)
    {
      const Axis s = this->AxisAt(c, lattice.Origin[c] + i * lattice.Spacing[c]);
      const double* parts[3] = { s.Plain, s.Held, s.Slope };
      for (int p = 0; p < 3; ++p)
      {
        along[c][p].First.push_back(s.First);
        std::array<float, 4> weights{};
        std::copy_n(parts[p], 4, weights.begin());
        along[c][p].Of.push_back(weights);
      }
    }
  }
  // Of W or of A: its component, that of A, sign, and which part of the splines along x, y, z.
  struct Term
  {
    std::size_t Of, Potential;
    float Sign;
    Part Parts[3];
  };
  static constexpr Term Curls[] = {
    { 0, 2, 1.0f, { Held, Slope, Plain } }, { 0, 1, -1.0f, { Held, Plain, Slope } },
    { 1, 0, 1.0f, { Plain, Held, Slope } }, { 1, 2, -1.0f, { Slope, Held, Plain } },
    { 2, 1, 1.0f, { Slope, Plain, Held } }, { 2, 0, -1.0f, { Plain, Slope, Held } }
  };
  static constexpr Term Potentials[] = { { 0, 0, 1.0f, { Plain, Held, Held } },
                                         { 1, 1, 1.0f, { Held, Plain, Held } },
                                         { 2, 2, 1.0f, { Held, Held, Plain } } };
  const Instant at = this->At(frame);
  const std::size_t size = this->Nodes();
  std::vector<float> values(size), alongX(points[0] * nodes[1] * nodes[2]),
    alongY(points[0] * points[1] * nodes[2]), sums(points[0] * points[1] * points[2]);
  const auto contract = [&](const Term& term)
  {
    const double* knot =
      coefficients + size * (3 * static_cast<std::size_t>(at.First) + term.Potential);
    for (std::size_t i = 0; i < size; ++i)
    {
      double sum = 0.0;
      for (std::size_t m = 0; m < 4; ++m)
      {
        sum += at.Weight[m] * knot[3 * m * size + i];
      }
      values[i] = static_cast<float>(sum);
    }
    // The long inner loops last.
    Contract(values.data(), nodes[1] * nodes[2], nodes[0], 1, along[0][term.Parts[0]],
             alongX.data());
    Contract(alongX.data(), nodes[2], nodes[1], points[0], along[1][term.Parts[1]], alongY.data());
    Contract(alongY.data(), 1, nodes[2], points[0] * points[1], along[2][term.Parts[2]],
             sums.data());
  };
  for (const Term& term : Curls)
  {
    contract(term);
    for (std::size_t i = 0; i < sums.size(); ++i)
    {
      const float factor = holds.empty() ? 1.0f : static_cast<float>(holds[i].Factor);
      field[i][term.Of] += term.Sign * factor * sums[i];
    }
  }
  for (std::size_t c = 0; c < 3 && !holds.empty(); ++c)
  {
    contract(Potentials[c]);
    for (std::size_t i = 0; i < sums.size(); ++i)
    {
      const Vec3 more = holds[i].Slope.cross(sums[i] * Vec3::Unit(static_cast<int>(c)));
      for (std::size_t d = 0; d < 3; ++d)
      {
        field[i][d] += static_cast<float>(more[static_cast<int>(d)]);
      }
    }
  }
}

} // namespace waft
