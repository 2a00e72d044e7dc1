// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Field/WindCorrection.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace waft
{
namespace
{

constexpr double GustSquare = 3.0;      // of the median, that a field's square has in a gust
constexpr double Finest = 2.0;          // of the lattice's spacings
constexpr double Apart = 0.75;          // of the next larger one, that a scale is at most
constexpr double EddyTime = 2.0 / 3.0;  // power of its size
constexpr double WithinSpacing = 1.15;  // spacings, at which a scale's structure function is full
constexpr std::size_t StructureAt = 16; // frames
constexpr double LeastShare = 1e-3;     // of the variance, that a scale has

/// Mean square of the differences of one component between points so far apart along an axis
/// [m^2/s^2], between points of the lattice; over a third of three components: of zero distance the
/// square itself.
double StructureOf(const std::vector<HalfSeries::Field>& fields, const SeriesLattice& lattice,
                   double distance)
{
  double sum = 0.0;
  std::size_t count = 0;
  std::size_t stride = 1;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const int points = lattice.Dimensions[axis];
    const double cells = distance / lattice.Spacing[static_cast<int>(axis)];
    const auto low = static_cast<std::size_t>(std::clamp(static_cast<int>(cells), 0, points - 1));
    const auto part = static_cast<float>(cells - static_cast<double>(low));
    for (const HalfSeries::Field& field : fields)
    {
      for (std::size_t i = 0; i < field.size(); ++i)
      {
        const std::size_t at = i / stride % static_cast<std::size_t>(points);
        if (at + low + 1 >= static_cast<std::size_t>(points))
        {
          continue;
        }
        for (std::size_t c = 0; c < 3; ++c)
        {
          const float there =
            (1.0f - part) * field[i + low * stride][c] + part * field[i + (low + 1) * stride][c];
          const double difference = there - field[i][c];
          sum += difference * difference;
        }
        count += 3;
      }
    }
    stride *= static_cast<std::size_t>(points);
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

/// What an artist's gust blows up is no eddy.
void LeaveOutGusts(std::vector<HalfSeries::Field>& fields, std::vector<double>& squares)
{
  if (squares.empty())
  {
    return;
  }
  std::vector<double> sorted = squares;
  std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
  const double most = GustSquare * sorted[sorted.size() / 2];
  for (std::size_t f = squares.size(); f-- > 0;)
  {
    if (squares[f] > most)
    {
      fields.erase(fields.begin() + static_cast<std::ptrdiff_t>(f));
      squares.erase(squares.begin() + static_cast<std::ptrdiff_t>(f));
    }
  }
}

double Dot(const std::vector<double>& a, const std::vector<double>& b)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    sum += a[i] * b[i];
  }
  return sum;
}

} // namespace

std::vector<WindScale> ScalesOf(const HalfSeries& air, double spacing, double timeSpacing)
{
  const double least = Finest * air.Spacing.maxCoeff();
  std::vector<WindScale> scales;
  for (const double factor : { 2.0, 1.0, 0.5 })
  {
    const double own = std::max(factor * spacing, least);
    if (scales.empty() || own < Apart * scales.back().Spacing)
    {
      scales.push_back({ own, timeSpacing * std::pow(own / spacing, EddyTime), 0.0 });
    }
  }
  std::vector<HalfSeries::Field> fields;
  const std::size_t stride = std::max<std::size_t>(1, air.Values.size() / StructureAt);
  std::vector<double> squares;
  for (std::size_t f = stride / 2; f < air.Values.size(); f += stride)
  {
    fields.push_back(air.At(f));
    double own = 0.0;
    for (const std::array<float, 3>& u : fields.back())
    {
      own += static_cast<double>(u[0]) * u[0] + static_cast<double>(u[1]) * u[1] +
             static_cast<double>(u[2]) * u[2];
    }
    squares.push_back(own / (3.0 * static_cast<double>(fields.back().size())));
  }
  LeaveOutGusts(fields, squares);
  const double variance = std::accumulate(squares.begin(), squares.end(), 0.0) /
                          static_cast<double>(std::max<std::size_t>(1, fields.size()));
  double above = variance;
  for (std::size_t l = 0; l < scales.size(); ++l)
  {
    const double below = l + 1 < scales.size()
                           ? 0.5 * StructureOf(fields, air, WithinSpacing * scales[l + 1].Spacing)
                           : 0.0;
    scales[l].Variance = std::max(above - below, LeastShare * variance);
    above = std::min(above, below);
  }
  return scales;
}

WindCorrection::WindCorrection(const Box& volume, const Timeline& time,
                               const std::vector<WindScale>& scales, DistanceFromSolids distance,
                               bool solidsMove, bool loops) :
  Time(time),
  Distance(std::move(distance)), SolidsMove(solidsMove)
{
  std::size_t size = 0;
  for (const WindScale& scale : scales)
  {
    this->Scales.emplace_back(volume, time, scale.Spacing, scale.TimeSpacing, scale.Variance,
                              loops);
    this->Begins.push_back(size);
    size += this->Scales.back().Coefficients();
  }
  this->Coefficients.assign(size, 0.0);
}

WindCorrection::Nearness WindCorrection::NearnessAt(const Vec3& x, double frame) const
{
  Nearness near;
  if (this->Distance)
  {
    near.Distance = this->Distance(x, frame, this->Scales.front().Spacing(), near.Away);
  }
  return near;
}

WindHold WindCorrection::HoldOf(std::size_t scale, const Nearness& near) const
{
  WindHold hold;
  if (this->Distance)
  {
    const double reach = this->Scales[scale].Spacing();
    double slope = 0.0;
    hold.Factor = HoldAt(near.Distance / reach, slope);
    hold.Slope =
      near.Distance > 0.0 && near.Distance < reach ? Vec3(slope / reach * near.Away) : Vec3::Zero();
  }
  return hold;
}

Vec3 WindCorrection::At(const Vec3& x, double frame) const
{
  Vec3 wind = Vec3::Zero();
  const Nearness near = this->NearnessAt(x, frame);
  for (std::size_t l = 0; l < this->Scales.size(); ++l)
  {
    const WindSplines& scale = this->Scales[l];
    WindSplines::Place place = scale.At(x);
    place.Hold = this->HoldOf(l, near);
    wind += scale.WindAt(place, frame, this->Coefficients.data() + this->Begins[l]);
  }
  return wind;
}

bool WindCorrection::AddTo(const HalfSeries& air, HalfSeries& sum, const ParallelFor& parallel,
                           Monitor& monitor) const
{
  PartMonitor part(monitor, 1.0, 1.0);
  std::vector<Nearness> still(this->Distance && !this->SolidsMove ? air.NumberOfPoints() : 0);
  parallel(still.size(),
           [&](std::size_t begin, std::size_t end)
           {
             for (std::size_t i = begin; i < end; ++i)
             {
               still[i] = this->NearnessAt(air.PointAt(i), 0.0);
             }
           });
  const auto addAt = [&](std::size_t f)
  {
    const double frame = air.Times[f] / this->Time.Step();
    HalfSeries::Field field = air.At(f);
    std::vector<Nearness> moved(this->Distance && this->SolidsMove ? field.size() : 0);
    for (std::size_t i = 0; i < moved.size(); ++i)
    {
      moved[i] = this->NearnessAt(air.PointAt(i), frame);
    }
    const std::vector<Nearness>& near = this->SolidsMove ? moved : still;
    for (std::size_t l = 0; l < this->Scales.size(); ++l)
    {
      std::vector<WindHold> holds(this->Distance ? field.size() : 0);
      for (std::size_t i = 0; i < holds.size(); ++i)
      {
        holds[i] = this->HoldOf(l, near[i]);
      }
      this->Scales[l].AddTo(this->Coefficients.data() + this->Begins[l], frame, air, holds, field);
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

bool WindCorrection::Fit(const std::vector<WindSamples>& samples, double error, double left,
                         int iterations, const ParallelFor& parallel, Monitor& monitor)
{
  std::vector<std::vector<Nearness>> near(this->Distance ? samples.size() : 0);
  parallel(near.size(),
           [&](std::size_t begin, std::size_t end)
           {
             for (std::size_t f = begin; f < end; ++f)
             {
               for (const Vec3& x : samples[f].Positions)
               {
                 near[f].push_back(this->NearnessAt(x, samples[f].Frame));
               }
             }
           });
  const auto holdOf = [&](std::size_t scale, std::size_t frame, std::size_t sample)
  { return this->Distance ? this->HoldOf(scale, near[frame][sample]) : WindHold(); };
  WindEquations equations(this->Scales, samples, holdOf, 1.0 / (error * error), parallel);
  const std::size_t unknowns = equations.Size();
  const std::vector<double> diagonal = equations.Diagonal();
  std::vector<double> found(unknowns, 0.0), residual, direction(unknowns), product;
  equations.Apply(found, true, residual);
  const double without = Dot(residual, residual);
  equations.Each([&](std::size_t all, std::size_t at) { found[at] = this->Coefficients[all]; });
  equations.Apply(found, true, residual);
  for (double& r : residual)
  {
    r = -r;
  }
  const auto scaled = [&](std::size_t i) { return residual[i] / diagonal[i]; };
  double size = Dot(residual, residual), descent = 0.0;
  for (std::size_t i = 0; i < unknowns; ++i)
  {
    direction[i] = scaled(i);
    descent += residual[i] * direction[i];
  }
  const double enough = left * left * descent; // by the diagonal
  bool goesOn = true;
  int iteration = 0;
  for (; iteration < iterations && descent > enough && goesOn; ++iteration)
  {
    equations.Apply(direction, false, product);
    const double step = descent / Dot(direction, product);
    const double before = descent;
    descent = 0.0;
    for (std::size_t i = 0; i < unknowns; ++i)
    {
      found[i] += step * direction[i];
      residual[i] -= step * product[i];
      descent += residual[i] * scaled(i);
    }
    size = Dot(residual, residual);
    for (std::size_t i = 0; i < unknowns; ++i)
    {
      direction[i] = scaled(i) + descent / before * direction[i];
    }
    goesOn = monitor.Tick(static_cast<double>(iteration + 1) / iterations, "");
  }
  std::fill(this->Coefficients.begin(), this->Coefficients.end(), 0.0);
  equations.Each([&](std::size_t all, std::size_t at) { this->Coefficients[all] = found[at]; });
  std::size_t values = 0;
  for (const WindSamples& at : samples)
  {
    values += 3 * at.Positions.size();
  }
  this->Last.Unknowns = unknowns;
  this->Last.Iterations = iteration;
  this->Last.Gradient = without > 0.0 ? std::sqrt(size / without) : 0.0;
  this->Last.ChiSquared = Dot(found, found) / static_cast<double>(std::max<std::size_t>(1, values));
  return goesOn;
}

} // namespace waft
