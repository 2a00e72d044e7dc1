// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Field/WindCorrection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
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
constexpr double Converged = 3e-3;      // of what the gradient was, by the diagonal
constexpr std::size_t Parts = 16;       // of the frames, each for a thread

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
    const WindSplines::Instant at = scale.At(frame);
    wind += WindSplines::Curl(place, at, scale.RowsOf(place, at),
                              this->Coefficients.data() + this->Begins[l]);
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

// The coefficients that samples touch, knot by knot of each scale: a row's four stay side by side,
// and the others are 0 in the most probable wind.
class WindCorrection::Touched
{
public:
  struct Knot
  {
    std::size_t All = 0;   // where its own begin among all coefficients
    std::size_t Begin = 0; // and among those that are touched
    std::vector<std::uint32_t> Nodes;
    std::vector<std::uint32_t> PlaceOf; // by node
  };

  Touched(const WindCorrection& wind, const std::vector<WindSamples>& samples)
  {
    for (std::size_t l = 0; l < wind.Scales.size(); ++l)
    {
      const WindSplines& scale = wind.Scales[l];
      std::vector<Knot> knots(scale.Knots());
      for (Knot& knot : knots)
      {
        knot.PlaceOf.assign(scale.Nodes(), 0);
      }
      for (const WindSamples& at : samples)
      {
        const WindSplines::Instant instant = scale.At(at.Frame);
        for (const Vec3& x : at.Positions)
        {
          for (const std::size_t row : scale.NodesOf(scale.At(x)))
          {
            for (const std::size_t k : instant.Knots)
            {
              std::fill_n(knots[k].PlaceOf.begin() + static_cast<std::ptrdiff_t>(row), 4, 1);
            }
          }
        }
      }
      for (std::size_t k = 0; k < knots.size(); ++k)
      {
        Knot& knot = knots[k];
        knot.All = wind.Begins[l] + 3 * scale.Nodes() * k;
        knot.Begin = this->Size;
        for (std::size_t i = 0; i < knot.PlaceOf.size(); ++i)
        {
          if (knot.PlaceOf[i] != 0)
          {
            knot.PlaceOf[i] = static_cast<std::uint32_t>(knot.Nodes.size());
            knot.Nodes.push_back(static_cast<std::uint32_t>(i));
          }
        }
        this->Size += 3 * knot.Nodes.size();
      }
      this->Knots.push_back(std::move(knots));
    }
  }

  WindSplines::Rows RowsOf(std::size_t scale, const std::array<std::size_t, 16>& nodes,
                           const WindSplines::Instant& at) const
  {
    WindSplines::Rows rows;
    for (std::size_t m = 0; m < 4; ++m)
    {
      const Knot& knot = this->Knots[scale][at.Knots[m]];
      rows.Next[m] = knot.Nodes.size();
      for (std::size_t i = 0; i < 16; ++i)
      {
        rows.First[m][i] = knot.Begin + knot.PlaceOf[nodes[i]];
      }
    }
    return rows;
  }

  // act(of all, touched): of each coefficient.
  template <class Act>
  void Each(const WindCorrection& wind, const Act& act) const
  {
    for (std::size_t l = 0; l < this->Knots.size(); ++l)
    {
      for (const Knot& knot : this->Knots[l])
      {
        std::size_t at = knot.Begin;
        for (std::size_t c = 0; c < 3; ++c)
        {
          for (const std::uint32_t node : knot.Nodes)
          {
            act(knot.All + c * wind.Scales[l].Nodes() + node, at++);
          }
        }
      }
    }
  }

  std::vector<std::vector<Knot>> Knots; // by scale
  std::size_t Size = 0;
};

bool WindCorrection::Fit(const std::vector<WindSamples>& samples, double error, int iterations,
                         const ParallelFor& parallel, Monitor& monitor)
{
  const std::size_t levels = this->Scales.size();
  const Touched touched(*this, samples);
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
  // Some frames, and what they add to the knots that they touch, which lie one after the other.
  struct Part
  {
    std::size_t First = 0, Last = 0;          // of samples
    std::vector<std::size_t> Begin, End, Own; // by scale, the last in Sums
    std::vector<double> Sums;
  };
  std::vector<Part> parts(std::min(Parts, samples.size()));
  for (std::size_t p = 0; p < parts.size(); ++p)
  {
    Part& part = parts[p];
    part.First = p * samples.size() / parts.size();
    part.Last = (p + 1) * samples.size() / parts.size() - 1;
    for (std::size_t l = 0; l < levels; ++l)
    {
      const WindSplines& scale = this->Scales[l];
      std::size_t first = scale.At(samples[part.First].Frame).Knots[0];
      std::size_t last = scale.At(samples[part.Last].Frame).Knots[3];
      if (last < first + 3) // it goes on from the last knot to the first
      {
        first = 0;
        last = scale.Knots() - 1;
      }
      const Touched::Knot& end = touched.Knots[l][last];
      part.Begin.push_back(touched.Knots[l][first].Begin);
      part.End.push_back(end.Begin + 3 * end.Nodes.size());
      part.Own.push_back(part.Sums.size());
      part.Sums.resize(part.Sums.size() + part.End[l] - part.Begin[l]);
    }
  }
  const double weight = 1.0 / (error * error);
  // before(value, places, instants, rows): what a sample adds by its splines of all scales;
  // add(that, place, instant, rows, sums, begin): to those of one scale.
  const auto visit = [&](std::size_t f, const auto& before, const auto& add, Part& part)
  {
    const WindSamples& at = samples[f];
    std::vector<WindSplines::Instant> instants;
    for (const WindSplines& scale : this->Scales)
    {
      instants.push_back(scale.At(at.Frame));
    }
    std::vector<WindSplines::Place> places(levels);
    std::vector<WindSplines::Rows> rows(levels);
    for (std::size_t s = 0; s < at.Positions.size(); ++s)
    {
      for (std::size_t l = 0; l < levels; ++l)
      {
        places[l] = this->Scales[l].At(at.Positions[s]);
        places[l].Hold = this->Distance ? this->HoldOf(l, near[f][s]) : WindHold();
        rows[l] = touched.RowsOf(l, this->Scales[l].NodesOf(places[l]), instants[l]);
      }
      const Vec3 value = before(at.Values[s], places, instants, rows);
      for (std::size_t l = 0; l < levels; ++l)
      {
        add(value, places[l], instants[l], rows[l], part.Sums.data() + part.Own[l], part.Begin[l]);
      }
    }
  };
  // To result, what all samples add.
  const auto sumUp = [&](const auto& before, const auto& add, std::vector<double>& result)
  {
    parallel(parts.size(),
             [&](std::size_t begin, std::size_t end)
             {
               for (std::size_t p = begin; p < end; ++p)
               {
                 Part& part = parts[p];
                 std::fill(part.Sums.begin(), part.Sums.end(), 0.0);
                 for (std::size_t f = part.First; f <= part.Last; ++f)
                 {
                   visit(f, before, add, part);
                 }
               }
             });
    for (const Part& part : parts)
    {
      for (std::size_t l = 0; l < levels; ++l)
      {
        for (std::size_t i = part.Begin[l]; i < part.End[l]; ++i)
        {
          result[i] += part.Sums[part.Own[l] + i - part.Begin[l]];
        }
      }
    }
  };
  // result = M^T weight (M a - values) + a
  const auto apply = [&](const std::vector<double>& a, bool lessValues, std::vector<double>& result)
  {
    result = a;
    sumUp(
      [&](const Vec3& value, const std::vector<WindSplines::Place>& places,
          const std::vector<WindSplines::Instant>& instants,
          const std::vector<WindSplines::Rows>& rows)
      {
        Vec3 wind = lessValues ? Vec3(-value) : Vec3::Zero();
        for (std::size_t l = 0; l < levels; ++l)
        {
          wind += WindSplines::Curl(places[l], instants[l], rows[l], a.data());
        }
        return Vec3(weight * wind);
      },
      [](const Vec3& value, const WindSplines::Place& place, const WindSplines::Instant& at,
         const WindSplines::Rows& rows, double* sums, std::size_t begin)
      { WindSplines::AddCurl(place, at, rows, value, sums, begin); },
      result);
  };
  std::vector<double> diagonal(touched.Size, 1.0); // about the matrix's own
  sumUp([](const Vec3& value, const auto&, const auto&, const auto&) { return value; },
        [weight](const Vec3&, const WindSplines::Place& place, const WindSplines::Instant& at,
                 const WindSplines::Rows& rows, double* sums, std::size_t begin)
        { WindSplines::AddSquares(place, at, rows, weight, sums, begin); },
        diagonal);
  std::vector<double> found(touched.Size, 0.0), residual, direction, product;
  apply(found, true, residual);
  const double without = Dot(residual, residual);
  touched.Each(*this,
               [&](std::size_t all, std::size_t at) { found[at] = this->Coefficients[all]; });
  apply(found, true, residual);
  for (double& r : residual)
  {
    r = -r;
  }
  const auto scaled = [&](std::size_t i) { return residual[i] / diagonal[i]; };
  direction.resize(touched.Size);
  double size = Dot(residual, residual), descent = 0.0;
  for (std::size_t i = 0; i < residual.size(); ++i)
  {
    direction[i] = scaled(i);
    descent += residual[i] * direction[i];
  }
  const double enough = Converged * Converged * descent;
  bool goesOn = true;
  int iteration = 0;
  for (; iteration < iterations && descent > enough && goesOn; ++iteration)
  {
    apply(direction, false, product);
    const double step = descent / Dot(direction, product);
    const double before = descent;
    descent = 0.0;
    for (std::size_t i = 0; i < residual.size(); ++i)
    {
      found[i] += step * direction[i];
      residual[i] -= step * product[i];
      descent += residual[i] * scaled(i);
    }
    size = Dot(residual, residual);
    for (std::size_t i = 0; i < residual.size(); ++i)
    {
      direction[i] = scaled(i) + descent / before * direction[i];
    }
    goesOn = monitor.Tick(static_cast<double>(iteration + 1) / iterations, "");
  }
  std::fill(this->Coefficients.begin(), this->Coefficients.end(), 0.0);
  touched.Each(*this,
               [&](std::size_t all, std::size_t at) { this->Coefficients[all] = found[at]; });
  std::size_t values = 0;
  for (const WindSamples& at : samples)
  {
    values += 3 * at.Positions.size();
  }
  this->Last.Unknowns = touched.Size;
  this->Last.Iterations = iteration;
  this->Last.Gradient = without > 0.0 ? std::sqrt(size / without) : 0.0;
  this->Last.ChiSquared = Dot(found, found) / static_cast<double>(std::max<std::size_t>(1, values));
  return goesOn;
}

} // namespace waft
