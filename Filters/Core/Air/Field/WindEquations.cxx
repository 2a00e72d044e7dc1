// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Field/WindEquations.h"

#include "Base/Simd.h"

#include <algorithm>
#include <utility>

namespace waft
{
namespace
{

constexpr std::size_t MostParts = 16; // of the frames, each for a thread

// Of nodes that lie side by side, of a component: the sum over the knots, with their weights.
WAFT_SIMD_CLONES void SumRuns(const std::vector<WindEquations::Run>& runs,
                              const std::array<const double*, 4>& knots, const double* weights,
                              double* sums)
{
  const double w0 = weights[0], w1 = weights[1], w2 = weights[2], w3 = weights[3];
  for (const WindEquations::Run& run : runs)
  {
    const double *k0 = knots[0] + run.AtKnots[0], *k1 = knots[1] + run.AtKnots[1],
                 *k2 = knots[2] + run.AtKnots[2], *k3 = knots[3] + run.AtKnots[3];
    double* sum = sums + run.Place;
    for (std::uint32_t i = 0; i < run.Length; ++i)
    {
      sum[i] = (w0 * k0[i] + w1 * k1[i]) + (w2 * k2[i] + w3 * k3[i]);
    }
  }
}

// To a knot, its share of these.
WAFT_SIMD_CLONES void ShareRuns(const std::vector<WindEquations::Run>& runs, const double* sums,
                                double weight, std::size_t m, double* knot)
{
  for (const WindEquations::Run& run : runs)
  {
    const double* sum = sums + run.Place;
    double* own = knot + run.AtKnots[m];
    for (std::uint32_t i = 0; i < run.Length; ++i)
    {
      own[i] += weight * sum[i];
    }
  }
}

} // namespace

WindEquations::WindEquations(const std::vector<WindSplines>& scales,
                             const std::vector<WindSamples>& samples, HoldOf holdOf, double weight,
                             const ParallelFor& parallel) :
  Scales(scales),
  Samples(samples), Hold(std::move(holdOf)), Weight(weight), Parallel(parallel)
{
  for (const WindSplines& scale : scales)
  {
    this->Slices.emplace_back(samples.size());
    std::vector<Slice>& slices = this->Slices.back();
    parallel(samples.size(),
             [&](std::size_t begin, std::size_t end)
             {
               for (std::size_t f = begin; f < end; ++f)
               {
                 slices[f] = this->SliceOf(scale, samples[f]);
               }
             });
  }
  this->ListKnots();
  const std::size_t count = std::min(MostParts, samples.size());
  for (std::size_t p = 0; p < count; ++p)
  {
    this->Parts.push_back(
      this->PartOf(p * samples.size() / count, (p + 1) * samples.size() / count - 1));
  }
}

WindEquations::Slice WindEquations::SliceOf(const WindSplines& scale,
                                            const WindSamples& samples) const
{
  Slice slice;
  slice.At = scale.At(samples.Frame);
  slice.PlaceOf.assign(scale.Nodes(), 0);
  for (const Vec3& x : samples.Positions)
  {
    for (const std::size_t row : scale.NodesOf(scale.At(x)))
    {
      std::fill_n(slice.PlaceOf.begin() + static_cast<std::ptrdiff_t>(row), 4, 1);
    }
  }
  bool isIn = false;
  for (std::uint32_t node = 0; node < slice.PlaceOf.size(); ++node)
  {
    const bool isTouched = slice.PlaceOf[node] != 0;
    if (isTouched)
    {
      const auto place = static_cast<std::uint32_t>(slice.Size++);
      if (!isIn)
      {
        slice.Runs.push_back({ node, place, 0 });
      }
      ++slice.Runs.back().Length;
      slice.PlaceOf[node] = place;
    }
    isIn = isTouched;
  }
  return slice;
}

void WindEquations::ListKnots()
{
  std::size_t all = 0;
  for (std::size_t l = 0; l < this->Scales.size(); ++l)
  {
    const WindSplines& scale = this->Scales[l];
    std::vector<Knot> knots(scale.Knots());
    std::vector<std::vector<std::uint32_t>> places(
      knots.size(), std::vector<std::uint32_t>(scale.Nodes(), 0)); // by node
    for (const Slice& slice : this->Slices[l])
    {
      for (const Run& run : slice.Runs)
      {
        for (const std::size_t k : slice.At.Knots)
        {
          std::fill_n(places[k].begin() + run.Node, run.Length, 1);
        }
      }
    }
    for (std::size_t k = 0; k < knots.size(); ++k)
    {
      Knot& knot = knots[k];
      knot.All = all;
      all += 3 * scale.Nodes();
      knot.Begin = this->Unknowns;
      for (std::uint32_t node = 0; node < places[k].size(); ++node)
      {
        if (places[k][node] != 0)
        {
          places[k][node] = static_cast<std::uint32_t>(knot.Nodes.size());
          knot.Nodes.push_back(node);
        }
      }
      this->Unknowns += 3 * knot.Nodes.size();
    }
    for (Slice& slice : this->Slices[l])
    {
      for (Run& run : slice.Runs)
      {
        for (std::size_t m = 0; m < 4; ++m)
        {
          run.AtKnots[m] = places[slice.At.Knots[m]][run.Node];
        }
      }
    }
    this->Knots.push_back(std::move(knots));
  }
}

WindEquations::Part WindEquations::PartOf(std::size_t firstFrame, std::size_t lastFrame) const
{
  Part part;
  part.First = firstFrame;
  part.Last = lastFrame;
  for (std::size_t l = 0; l < this->Scales.size(); ++l)
  {
    std::size_t first = this->Slices[l][firstFrame].At.Knots[0];
    std::size_t last = this->Slices[l][lastFrame].At.Knots[3];
    if (last < first + 3) // it goes on from the last knot to the first
    {
      first = 0;
      last = this->Scales[l].Knots() - 1;
    }
    const Knot& end = this->Knots[l][last];
    part.Begin.push_back(this->Knots[l][first].Begin);
    part.End.push_back(end.Begin + 3 * end.Nodes.size());
    part.Own.push_back(part.Sums.size());
    part.Sums.resize(part.Sums.size() + part.End[l] - part.Begin[l]);
  }
  return part;
}

std::array<std::size_t, 4> WindEquations::BeginsOf(std::size_t scale, const Slice& slice,
                                                   std::size_t c) const
{
  std::array<std::size_t, 4> begins{};
  for (std::size_t m = 0; m < 4; ++m)
  {
    const Knot& knot = this->Knots[scale][slice.At.Knots[m]];
    begins[m] = knot.Begin + c * knot.Nodes.size();
  }
  return begins;
}

std::vector<double> WindEquations::SumOfKnots(std::size_t scale, const Slice& slice,
                                              const double* a) const
{
  std::vector<double> sums(3 * slice.Size);
  for (std::size_t c = 0; c < 3; ++c)
  {
    const auto [k0, k1, k2, k3] = this->BeginsOf(scale, slice, c);
    SumRuns(slice.Runs, { a + k0, a + k1, a + k2, a + k3 }, slice.At.Weight,
            sums.data() + c * slice.Size);
  }
  return sums;
}

void WindEquations::Share(std::size_t scale, const Slice& slice, const double* weights,
                          const std::vector<double>& sums, Part& part) const
{
  double* own = part.Sums.data() + part.Own[scale];
  for (std::size_t c = 0; c < 3; ++c)
  {
    const std::array<std::size_t, 4> begins = this->BeginsOf(scale, slice, c);
    for (std::size_t m = 0; m < 4; ++m)
    {
      ShareRuns(slice.Runs, sums.data() + c * slice.Size, weights[m], m,
                own + (begins[m] - part.Begin[scale]));
    }
  }
}

WindSplines::Place WindEquations::PlaceOf(std::size_t scale, std::size_t frame,
                                          std::size_t sample) const
{
  WindSplines::Place place = this->Scales[scale].At(this->Samples[frame].Positions[sample]);
  place.Hold = this->Hold(scale, frame, sample);
  return place;
}

WindSplines::Rows WindEquations::RowsOf(std::size_t scale, std::size_t frame,
                                        const WindSplines::Place& place) const
{
  const Slice& slice = this->Slices[scale][frame];
  WindSplines::Rows rows{ this->Scales[scale].NodesOf(place), slice.Size };
  for (std::size_t& first : rows.First)
  {
    first = slice.PlaceOf[first];
  }
  return rows;
}

void WindEquations::AddFrame(std::size_t frame, const double* a, bool lessValues, Part& part) const
{
  const WindSamples& samples = this->Samples[frame];
  const std::size_t levels = this->Scales.size();
  std::vector<std::vector<double>> own(levels), sums(levels);
  for (std::size_t l = 0; l < levels; ++l)
  {
    own[l] = this->SumOfKnots(l, this->Slices[l][frame], a);
    sums[l].assign(own[l].size(), 0.0);
  }
  std::vector<WindSplines::Place> places(levels);
  std::vector<WindSplines::Rows> rows(levels);
  for (std::size_t s = 0; s < samples.Positions.size(); ++s)
  {
    Vec3 wind = lessValues ? Vec3(-samples.Values[s]) : Vec3::Zero();
    for (std::size_t l = 0; l < levels; ++l)
    {
      places[l] = this->PlaceOf(l, frame, s);
      rows[l] = this->RowsOf(l, frame, places[l]);
      wind += WindSplines::Curl(places[l], rows[l], own[l].data());
    }
    for (std::size_t l = 0; l < levels; ++l)
    {
      WindSplines::AddCurl(places[l], rows[l], this->Weight * wind, sums[l].data());
    }
  }
  for (std::size_t l = 0; l < levels; ++l)
  {
    const Slice& slice = this->Slices[l][frame];
    this->Share(l, slice, slice.At.Weight, sums[l], part);
  }
}

void WindEquations::AddSquares(std::size_t frame, Part& part) const
{
  for (std::size_t l = 0; l < this->Scales.size(); ++l)
  {
    const Slice& slice = this->Slices[l][frame];
    std::vector<double> sums(3 * slice.Size, 0.0);
    for (std::size_t s = 0; s < this->Samples[frame].Positions.size(); ++s)
    {
      const WindSplines::Place place = this->PlaceOf(l, frame, s);
      WindSplines::AddSquares(place, this->RowsOf(l, frame, place), this->Weight, sums.data());
    }
    double squares[4];
    std::transform(slice.At.Weight, slice.At.Weight + 4, squares, [](double w) { return w * w; });
    this->Share(l, slice, squares, sums, part);
  }
}

template <class Add>
void WindEquations::SumUp(const Add& add, std::vector<double>& result)
{
  this->Parallel(this->Parts.size(),
                 [&](std::size_t begin, std::size_t end)
                 {
                   for (std::size_t p = begin; p < end; ++p)
                   {
                     Part& part = this->Parts[p];
                     std::fill(part.Sums.begin(), part.Sums.end(), 0.0);
                     for (std::size_t f = part.First; f <= part.Last; ++f)
                     {
                       add(f, part);
                     }
                   }
                 });
  for (const Part& part : this->Parts)
  {
    for (std::size_t l = 0; l < this->Scales.size(); ++l)
    {
      const auto own = part.Sums.begin() + static_cast<std::ptrdiff_t>(part.Own[l]);
      const auto to = result.begin() + static_cast<std::ptrdiff_t>(part.Begin[l]);
      const auto count = static_cast<std::ptrdiff_t>(part.End[l] - part.Begin[l]);
      std::transform(own, own + count, to, to, std::plus<double>());
    }
  }
}

void WindEquations::Apply(const std::vector<double>& a, bool lessValues,
                          std::vector<double>& result)
{
  result = a;
  this->SumUp([&](std::size_t frame, Part& part)
              { this->AddFrame(frame, a.data(), lessValues, part); },
              result);
}

std::vector<double> WindEquations::Diagonal()
{
  std::vector<double> diagonal(this->Unknowns, 1.0);
  this->SumUp([this](std::size_t frame, Part& part) { this->AddSquares(frame, part); }, diagonal);
  return diagonal;
}

} // namespace waft
