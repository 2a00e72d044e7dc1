// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Field/WindCorrection.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace waft
{
namespace
{

constexpr double Finest = 2.0;          // of the lattice's spacings
constexpr double Apart = 0.75;          // of the next larger one, that a scale is at most
constexpr double EddyTime = 2.0 / 3.0;  // power of its size
constexpr double WithinSpacing = 1.15;  // spacings, at which a scale's structure function is full
constexpr std::size_t StructureAt = 16; // frames
constexpr double LeastShare = 1e-3;     // of the variance, that a scale has
constexpr double Converged = 1e-2;      // of what the gradient was

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
  double square = 0.0;
  for (std::size_t f = stride / 2; f < air.Values.size(); f += stride)
  {
    fields.push_back(air.At(f));
    double own = 0.0;
    for (const std::array<float, 3>& u : fields.back())
    {
      own += static_cast<double>(u[0]) * u[0] + static_cast<double>(u[1]) * u[1] +
             static_cast<double>(u[2]) * u[2];
    }
    square += own / (3.0 * static_cast<double>(fields.back().size()));
  }
  const double variance = square / static_cast<double>(std::max<std::size_t>(1, fields.size()));
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
                               bool solidsMove) :
  Time(time),
  Distance(std::move(distance)), SolidsMove(solidsMove)
{
  std::size_t size = 0;
  for (const WindScale& scale : scales)
  {
    this->Scales.emplace_back(volume, time, scale.Spacing, scale.TimeSpacing, scale.Variance);
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
    const WindSplines::Instant at = scale.At(frame);
    const WindSplines::Rows rows = scale.RowsOf(place);
    const std::size_t nodes = scale.Nodes();
    for (std::size_t m = 0; m < 4; ++m)
    {
      const double* knot = this->Coefficients.data() + this->Begins[l] +
                           3 * nodes * (static_cast<std::size_t>(at.First) + m);
      wind += at.Weight[m] * WindSplines::Curl(place, rows, knot, nodes);
    }
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

// The nodes that samples of a frame touch, in order: a row's four stay side by side.
struct WindCorrection::Cell
{
  WindSplines::Instant At;
  std::vector<std::size_t> Nodes;
  std::vector<WindSplines::Rows> Rows; // among those nodes
  std::vector<WindHold> Holds;
  std::vector<double> Part; // [x, y, z][node], of a product with the transposed
};

bool WindCorrection::Fit(const std::vector<WindSamples>& samples, double error, int iterations,
                         const ParallelFor& parallel, Monitor& monitor)
{
  const std::size_t frames = samples.size();
  const std::size_t levels = this->Scales.size();
  std::vector<Cell> cells(frames * levels);
  parallel(frames,
           [&](std::size_t begin, std::size_t end)
           {
             for (std::size_t f = begin; f < end; ++f)
             {
               for (std::size_t l = 0; l < levels; ++l)
               {
                 const WindSplines& scale = this->Scales[l];
                 Cell& cell = cells[f * levels + l];
                 cell.At = scale.At(samples[f].Frame);
                 std::vector<int> places(scale.Nodes(), -1);
                 for (const Vec3& x : samples[f].Positions)
                 {
                   cell.Rows.push_back(scale.RowsOf(scale.At(x)));
                   for (const int row : cell.Rows.back())
                   {
                     std::fill_n(places.begin() + row, 4, 0);
                   }
                   cell.Holds.push_back(this->HoldOf(l, this->NearnessAt(x, samples[f].Frame)));
                 }
                 for (std::size_t i = 0; i < places.size(); ++i)
                 {
                   if (places[i] == 0)
                   {
                     places[i] = static_cast<int>(cell.Nodes.size());
                     cell.Nodes.push_back(i);
                   }
                 }
                 for (WindSplines::Rows& rows : cell.Rows)
                 {
                   for (int& row : rows)
                   {
                     row = places[static_cast<std::size_t>(row)];
                   }
                 }
                 cell.Part.resize(3 * cell.Nodes.size());
               }
             }
           });
  struct Knot
  {
    std::size_t Level, Index;
  };
  std::vector<Knot> knots;
  for (std::size_t l = 0; l < levels; ++l)
  {
    for (std::size_t k = 0; k < this->Scales[l].Knots(); ++k)
    {
      knots.push_back({ l, k });
    }
  }
  const double weight = 1.0 / (error * error);
  // result = M^T weight (M a - values) + a
  const auto apply = [&](const std::vector<double>& a, bool lessValues, std::vector<double>& result)
  {
    parallel(frames,
             [&](std::size_t begin, std::size_t end)
             {
               std::vector<Vec3> winds;
               std::vector<double> nodes;
               std::vector<std::vector<WindSplines::Place>> places(levels);
               for (std::size_t f = begin; f < end; ++f)
               {
                 const WindSamples& at = samples[f];
                 winds.assign(at.Positions.size(), Vec3::Zero());
                 for (std::size_t l = 0; l < levels; ++l)
                 {
                   const Cell& cell = cells[f * levels + l];
                   const std::size_t count = cell.Nodes.size();
                   const std::size_t all = this->Scales[l].Nodes();
                   const double* knot =
                     a.data() + this->Begins[l] + 3 * all * static_cast<std::size_t>(cell.At.First);
                   nodes.assign(3 * count, 0.0);
                   for (std::size_t m = 0; m < 4; ++m)
                   {
                     for (std::size_t c = 0; c < 3; ++c)
                     {
                       const double* of = knot + (3 * m + c) * all;
                       for (std::size_t i = 0; i < count; ++i)
                       {
                         nodes[c * count + i] += cell.At.Weight[m] * of[cell.Nodes[i]];
                       }
                     }
                   }
                   places[l].clear();
                   for (std::size_t s = 0; s < winds.size(); ++s)
                   {
                     places[l].push_back(this->Scales[l].At(at.Positions[s]));
                     places[l].back().Hold = cell.Holds[s];
                     winds[s] += WindSplines::Curl(places[l][s], cell.Rows[s], nodes.data(), count);
                   }
                 }
                 for (std::size_t l = 0; l < levels; ++l)
                 {
                   Cell& cell = cells[f * levels + l];
                   std::fill(cell.Part.begin(), cell.Part.end(), 0.0);
                   for (std::size_t s = 0; s < winds.size(); ++s)
                   {
                     const Vec3 off = lessValues ? Vec3(winds[s] - at.Values[s]) : winds[s];
                     WindSplines::AddCurl(places[l][s], cell.Rows[s], weight * off,
                                          cell.Part.data(), cell.Nodes.size());
                   }
                 }
               }
             });
    result = a;
    parallel(knots.size(),
             [&](std::size_t begin, std::size_t end)
             {
               for (std::size_t k = begin; k < end; ++k)
               {
                 const std::size_t l = knots[k].Level;
                 const std::size_t all = this->Scales[l].Nodes();
                 double* sum = result.data() + this->Begins[l] + 3 * all * knots[k].Index;
                 for (std::size_t f = 0; f < frames; ++f)
                 {
                   const Cell& cell = cells[f * levels + l];
                   const std::size_t m = knots[k].Index - static_cast<std::size_t>(cell.At.First);
                   for (std::size_t c = 0; c < 3 && m < 4; ++c)
                   {
                     const double* part = cell.Part.data() + c * cell.Nodes.size();
                     for (std::size_t i = 0; i < cell.Nodes.size(); ++i)
                     {
                       sum[c * all + cell.Nodes[i]] += cell.At.Weight[m] * part[i];
                     }
                   }
                 }
               }
             });
  };
  std::vector<double> residual, direction, product;
  apply(this->Coefficients, true, residual);
  for (double& r : residual)
  {
    r = -r;
  }
  direction = residual;
  double size = Dot(residual, residual);
  const double enough = Converged * Converged * size;
  for (int iteration = 0; iteration < iterations && size > enough; ++iteration)
  {
    if (!monitor.Tick(static_cast<double>(iteration) / iterations, ""))
    {
      return false;
    }
    apply(direction, false, product);
    const double step = size / Dot(direction, product);
    for (std::size_t i = 0; i < residual.size(); ++i)
    {
      this->Coefficients[i] += step * direction[i];
      residual[i] -= step * product[i];
    }
    const double before = size;
    size = Dot(residual, residual);
    for (std::size_t i = 0; i < residual.size(); ++i)
    {
      direction[i] = residual[i] + size / before * direction[i];
    }
  }
  return true;
}

} // namespace waft
