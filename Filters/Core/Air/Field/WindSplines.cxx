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

// Splines that are not zero at each of the points along an axis: plain, held back, their slope.
enum Part
{
  Plain,
  Held,
  Slope
};
struct Weights
{
  std::vector<int> First;
  std::vector<std::array<float, 4>> Of[3]; // by part
};

// values [outer][from][inner] summed along the middle axis, with the weights of points there.
WAFT_SIMD_CLONES void Contract(const float* values, std::size_t outer, std::size_t from,
                               std::size_t inner, const Weights& weights, Part part, float* sums)
{
  for (std::size_t o = 0; o < outer; ++o)
  {
    for (std::size_t p = 0; p < weights.First.size(); ++p)
    {
      const float* w = weights.Of[part][p].data();
      const float w0 = w[0], w1 = w[1], w2 = w[2], w3 = w[3];
      const float* v = values + (o * from + static_cast<std::size_t>(weights.First[p])) * inner;
      for (std::size_t i = 0; i < inner; ++i)
      {
        *sums++ = w0 * v[i] + w1 * v[i + inner] + w2 * v[i + 2 * inner] + w3 * v[i + 3 * inner];
      }
    }
  }
}

// Of four planes of values each, the sum with weights; less that of others.
WAFT_SIMD_CLONES void Combine(const float* values, const float* w, const float* others,
                              const float* o, std::size_t plane, float* sums)
{
  const float w0 = w[0], w1 = w[1], w2 = w[2], w3 = w[3];
  for (std::size_t i = 0; i < plane; ++i)
  {
    sums[i] = w0 * values[i] + w1 * values[i + plane] + w2 * values[i + 2 * plane] +
              w3 * values[i + 3 * plane];
  }
  if (others)
  {
    const float o0 = o[0], o1 = o[1], o2 = o[2], o3 = o[3];
    for (std::size_t i = 0; i < plane; ++i)
    {
      sums[i] -= o0 * others[i] + o1 * others[i + plane] + o2 * others[i + 2 * plane] +
                 o3 * others[i + 3 * plane];
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
                         double timeSpacing, double variance, bool loops) :
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
  this->Spans = static_cast<std::size_t>(spans);
  this->KnotCount = this->Spans + (loops ? 0 : 3);
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
  const double knot =
    std::clamp(frame / this->FramesPerKnot, 0.0, static_cast<double>(this->Spans));
  const std::size_t first = std::min(static_cast<std::size_t>(knot), this->Spans - 1);
  Instant at;
  CubicWeights(knot - static_cast<double>(first), at.Weight, nullptr);
  for (std::size_t m = 0; m < 4; ++m)
  {
    at.Knots[m] = (first + m) % this->KnotCount;
    at.Weight[m] *= this->Unit;
  }
  return at;
}

std::array<std::size_t, 16> WindSplines::NodesOf(const Place& place) const
{
  std::array<std::size_t, 16> nodes;
  for (int k = 0; k < 4; ++k)
  {
    for (int j = 0; j < 4; ++j)
    {
      const int y = place.Along[1].First + j;
      const int z = place.Along[2].First + k;
      nodes[static_cast<std::size_t>(4 * k + j)] =
        static_cast<std::size_t>((z * this->Count[1] + y) * this->Count[0] + place.Along[0].First);
    }
  }
  return nodes;
}

namespace
{

WAFT_INLINE void Load(const double* p, Double4& v)
{
  std::memcpy(&v, p, sizeof(v));
}

WAFT_INLINE void Load(const WindSplines::Axis& x, Double4& plain, Double4& held, Double4& slope)
{
  Load(x.Plain, plain);
  Load(x.Held, held);
  Load(x.Slope, slope);
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
WAFT_SIMD_CLONES void SumRows(const WindSplines::Place& place, const WindSplines::Rows& rows,
                              const double* values, double* curl, double* potential)
{
  const WindSplines::Axis& y = place.Along[1];
  const WindSplines::Axis& z = place.Along[2];
  Double4 x01{}, x02{}, xHeld{}, y0{}, yHeld{}, z0{}, zHeld{};
  for (int k = 0; k < 4; ++k)
  {
    for (int j = 0; j < 4; ++j)
    {
      const double* row = values + rows.First[static_cast<std::size_t>(4 * k + j)];
      Double4 a[3];
      Load(row, a[0]);
      Load(row + rows.Next, a[1]);
      Load(row + 2 * rows.Next, a[2]);
      x01 += a[0] * (y.Held[j] * z.Slope[k]);
      x02 += a[0] * (y.Slope[j] * z.Held[k]);
      xHeld += a[0] * (y.Held[j] * z.Held[k]);
      y0 += a[1] * (y.Plain[j] * z.Slope[k]);
      yHeld += a[1] * (y.Plain[j] * z.Held[k]);
      z0 += a[2] * (y.Slope[j] * z.Plain[k]);
      zHeld += a[2] * (y.Held[j] * z.Plain[k]);
    }
  }
  Double4 plain, held, slope;
  Load(place.Along[0], plain, held, slope);
  curl[0] = SumOf(z0 * held - y0 * held);
  curl[1] = SumOf(x01 * plain - zHeld * slope);
  curl[2] = SumOf(yHeld * slope - x02 * plain);
  potential[0] = SumOf(xHeld * plain);
  potential[1] = SumOf(yHeld * held);
  potential[2] = SumOf(zHeld * held);
}

WAFT_SIMD_CLONES void AddRows(const WindSplines::Place& place, const WindSplines::Rows& rows,
                              const double* v, const double* p, double* values)
{
  const WindSplines::Axis& y = place.Along[1];
  const WindSplines::Axis& z = place.Along[2];
  Double4 plain, held, slope;
  Load(place.Along[0], plain, held, slope);
  for (int k = 0; k < 4; ++k)
  {
    for (int j = 0; j < 4; ++j)
    {
      const Double4 products[3] = {
        plain * (v[1] * (y.Held[j] * z.Slope[k]) - v[2] * (y.Slope[j] * z.Held[k]) +
                 p[0] * (y.Held[j] * z.Held[k])),
        held * (p[1] * (y.Plain[j] * z.Held[k]) - v[0] * (y.Plain[j] * z.Slope[k])) +
          slope * (v[2] * (y.Plain[j] * z.Held[k])),
        held * (v[0] * (y.Slope[j] * z.Plain[k]) + p[2] * (y.Held[j] * z.Plain[k])) -
          slope * (v[1] * (y.Held[j] * z.Plain[k]))
      };
      double* row = values + rows.First[static_cast<std::size_t>(4 * k + j)];
      Add(products[0], row);
      Add(products[1], row + rows.Next);
      Add(products[2], row + 2 * rows.Next);
    }
  }
}

// Squares of what each value adds to the components of the curl, but for the hold's slope.
WAFT_SIMD_CLONES void AddSquaresOfRows(const WindSplines::Place& place,
                                       const WindSplines::Rows& rows, double weight, double* values)
{
  const WindSplines::Axis& y = place.Along[1];
  const WindSplines::Axis& z = place.Along[2];
  Double4 plain, held, slope;
  Load(place.Along[0], plain, held, slope);
  plain *= plain;
  held *= held;
  slope *= slope;
  const auto square = [weight](double a, double b) { return weight * a * a * b * b; };
  for (int k = 0; k < 4; ++k)
  {
    for (int j = 0; j < 4; ++j)
    {
      const double yz = square(y.Plain[j], z.Held[k]), zy = square(y.Held[j], z.Plain[k]);
      const Double4 squares[3] = { plain * (square(y.Held[j], z.Slope[k]) +
                                            square(y.Slope[j], z.Held[k])),
                                   held * square(y.Plain[j], z.Slope[k]) + slope * yz,
                                   held * square(y.Slope[j], z.Plain[k]) + slope * zy };
      double* row = values + rows.First[static_cast<std::size_t>(4 * k + j)];
      Add(squares[0], row);
      Add(squares[1], row + rows.Next);
      Add(squares[2], row + 2 * rows.Next);
    }
  }
}

} // namespace

void WindSplines::AddSquares(const Place& place, const Rows& rows, double weight, double* values)
{
  AddSquaresOfRows(place, rows, weight * place.Hold.Factor * place.Hold.Factor, values);
}

Vec3 WindSplines::Curl(const Place& place, const Rows& rows, const double* values)
{
  Vec3 curl, potential;
  SumRows(place, rows, values, curl.data(), potential.data());
  return place.Hold.Factor * curl + place.Hold.Slope.cross(potential);
}

void WindSplines::AddCurl(const Place& place, const Rows& rows, const Vec3& value, double* values)
{
  const Vec3 v = place.Hold.Factor * value;
  const Vec3 p = value.cross(place.Hold.Slope);
  AddRows(place, rows, v.data(), p.data(), values);
}

Vec3 WindSplines::WindAt(const Place& place, double frame, const double* coefficients) const
{
  const Instant at = this->At(frame);
  const Rows rows{ this->NodesOf(place), this->Nodes() };
  Vec3 wind = Vec3::Zero();
  for (std::size_t m = 0; m < 4; ++m)
  {
    const double* knot = coefficients + 3 * this->Nodes() * at.Knots[m];
    wind += at.Weight[m] * Curl(place, rows, knot);
  }
  return wind;
}

void WindSplines::AddTo(const double* coefficients, double frame, const SeriesLattice& lattice,
                        const std::vector<WindHold>& holds, HalfSeries::Field& field) const
{
  Weights along[3];
  std::array<std::size_t, 3> points{}, nodes{};
  for (int c = 0; c < 3; ++c)
  {
    const auto axis = static_cast<std::size_t>(c);
    points[axis] = static_cast<std::size_t>(lattice.Dimensions[axis]);
    nodes[axis] = static_cast<std::size_t>(this->Count[axis]);
    for (int i = 0; i < lattice.Dimensions[axis]; ++i)
    {
      const Axis s = this->AxisAt(c, lattice.Origin[c] + i * lattice.Spacing[c]);
      along[c].First.push_back(s.First);
      const double* parts[3] = { s.Plain, s.Held, s.Slope };
      for (const Part part : { Plain, Held, Slope })
      {
        std::array<float, 4> weights{};
        std::copy_n(parts[part], 4, weights.begin());
        along[c].Of[part].push_back(weights);
      }
    }
  }
  const Instant at = this->At(frame);
  const std::size_t size = this->Nodes();
  std::vector<float> values(size), alongX(points[0] * nodes[1] * nodes[2]);
  // A component of A, summed along x and y.
  const auto inPlanes = [&](std::size_t potential, Part x, Part y)
  {
    const auto knot = [&](std::size_t m)
    { return coefficients + size * (3 * at.Knots[m] + potential); };
    const double *knot0 = knot(0), *knot1 = knot(1), *knot2 = knot(2), *knot3 = knot(3);
    for (std::size_t i = 0; i < size; ++i)
    {
      values[i] = static_cast<float>(at.Weight[0] * knot0[i] + at.Weight[1] * knot1[i] +
                                     at.Weight[2] * knot2[i] + at.Weight[3] * knot3[i]);
    }
    Contract(values.data(), nodes[1] * nodes[2], nodes[0], 1, along[0], x, alongX.data());
    std::vector<float> planes(points[0] * points[1] * nodes[2]);
    Contract(alongX.data(), nodes[2], nodes[1], points[0], along[1], y, planes.data());
    return planes;
  };
  const std::vector<float> ofX = inPlanes(0, Plain, Held), ofXByY = inPlanes(0, Plain, Slope),
                           ofY = inPlanes(1, Held, Plain), ofYByX = inPlanes(1, Slope, Plain),
                           ofZByX = inPlanes(2, Slope, Held), ofZByY = inPlanes(2, Held, Slope);
  const std::vector<float> ofZ = holds.empty() ? std::vector<float>() : inPlanes(2, Held, Held);
  const std::size_t plane = points[0] * points[1];
  std::vector<float> sums[6];
  for (std::vector<float>& of : sums)
  {
    of.resize(plane);
  }
  for (std::size_t z = 0; z < points[2]; ++z)
  {
    const std::size_t first = static_cast<std::size_t>(along[2].First[z]) * plane;
    const float* w[3] = { along[2].Of[Plain][z].data(), along[2].Of[Held][z].data(),
                          along[2].Of[Slope][z].data() };
    const auto combine = [&](const std::vector<float>& of, Part part,
                             const std::vector<float>* less, Part other, std::vector<float>& sum)
    {
      Combine(of.data() + first, w[part], less ? less->data() + first : nullptr, w[other], plane,
              sum.data());
    };
    combine(ofZByY, Plain, &ofY, Slope, sums[0]);
    combine(ofX, Slope, &ofZByX, Plain, sums[1]);
    combine(ofYByX, Held, &ofXByY, Held, sums[2]);
    std::array<float, 3>* out = field.data() + z * plane;
    if (holds.empty())
    {
      for (std::size_t i = 0; i < plane; ++i)
      {
        for (std::size_t c = 0; c < 3; ++c)
        {
          out[i][c] += sums[c][i];
        }
      }
      continue;
    }
    combine(ofX, Held, nullptr, Held, sums[3]);
    combine(ofY, Held, nullptr, Held, sums[4]);
    combine(ofZ, Plain, nullptr, Plain, sums[5]);
    for (std::size_t i = 0; i < plane; ++i)
    {
      const WindHold& hold = holds[z * plane + i];
      const Vec3 more = hold.Factor * Vec3(sums[0][i], sums[1][i], sums[2][i]) +
                        hold.Slope.cross(Vec3(sums[3][i], sums[4][i], sums[5][i]));
      for (int c = 0; c < 3; ++c)
      {
        out[i][static_cast<std::size_t>(c)] += static_cast<float>(more[c]);
      }
    }
  }
}

} // namespace waft
