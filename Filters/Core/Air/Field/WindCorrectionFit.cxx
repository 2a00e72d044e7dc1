// SPDX-License-Identifier: BSD-3-Clause
// The wind correction by least squares.
#include "Air/Field/WindCorrection.h"

#include <algorithm>

namespace waft
{
namespace
{

constexpr double SampleTime = 0.1; // s, that one sample stands for

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

void WindCorrection::AddCurl(const Basis& basis, const Vec3& value, double* nodes) const
{
  const Splines& x = basis.Along[0];
  const Splines& y = basis.Along[1];
  const Splines& z = basis.Along[2];
  for (int k = 0; k < 4; ++k)
  {
    for (int j = 0; j < 4; ++j)
    {
      double* a = nodes + this->RowOf(basis, j, k);
      const double plain0 =
        value[1] * (y.Held[j] * z.Slope[k]) - value[2] * (y.Slope[j] * z.Held[k]);
      const double held1 = -value[0] * (y.Plain[j] * z.Slope[k]);
      const double held2 = value[0] * (y.Slope[j] * z.Plain[k]);
      const double slope1 = value[2] * (y.Plain[j] * z.Held[k]);
      const double slope2 = -value[1] * (y.Held[j] * z.Plain[k]);
      for (int i = 0; i < 4; ++i, a += 3)
      {
        a[0] += plain0 * x.Plain[i];
        a[1] += slope1 * x.Slope[i] + held1 * x.Held[i];
        a[2] += held2 * x.Held[i] + slope2 * x.Slope[i];
      }
    }
  }
}

void WindCorrection::Penalise(const std::vector<double>& a, std::vector<double>& sum) const
{
  const double unit = 1.0 / this->Spacing.squaredNorm() * 3.0; // coefficients over the spacing
  const double ridge = this->Options.Ridge * unit;
  const double bending = this->Options.Bending * unit;
  const double changing = this->Options.Changing * unit;
  const std::size_t stride[4] = { 3, 3 * static_cast<std::size_t>(this->Count[0]),
                                  3 * static_cast<std::size_t>(this->Count[0]) * this->Count[1],
                                  3 * this->NodesPerKnot() };
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    sum[i] += ridge * a[i];
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::size_t s = stride[axis];
    const std::size_t line =
      s * static_cast<std::size_t>(this->Count[static_cast<std::size_t>(axis)]);
    for (std::size_t first = 0; first < a.size(); first += line)
    {
      for (std::size_t i = first + s; i < first + line - s; ++i) // but for the first and last node
      {
        const double bend = bending * (a[i - s] - 2.0 * a[i] + a[i + s]);
        sum[i - s] += bend;
        sum[i] -= 2.0 * bend;
        sum[i + s] += bend;
      }
    }
  }
  const std::size_t s = stride[3];
  for (std::size_t i = 0; i + s < a.size(); ++i)
  {
    const double change = changing * (a[i + s] - a[i]);
    sum[i + s] += change;
    sum[i] -= change;
  }
}

bool WindCorrection::Fit(const std::vector<WindSamples>& samples, const ParallelFor& parallel,
                         Communicator& ranks, Monitor& monitor)
{
  if (samples.empty())
  {
    return true;
  }
  std::vector<Level> levels;
  std::vector<std::vector<Basis>> bases(samples.size());
  for (const WindSamples& at : samples)
  {
    levels.push_back(this->LevelAt(at.Frame));
  }
  parallel(samples.size(),
           [&](std::size_t begin, std::size_t end)
           {
             for (std::size_t f = begin; f < end; ++f)
             {
               for (const Vec3& x : samples[f].Positions)
               {
                 Basis basis;
                 for (int c = 0; c < 3; ++c)
                 {
                   basis.Along[c] = this->SplinesAt(c, x[c]);
                 }
                 bases[f].push_back(basis);
               }
             }
           });
  // What a sample counts: all of them together as many as there are tenths of a second.
  const double last = samples.back().Frame - samples.front().Frame;
  const double weight = samples.size() < 2 ? 1.0
                                           : last * this->Time.Step() /
                                               static_cast<double>(samples.size() - 1) / SampleTime;
  const std::size_t knot = 3 * this->NodesPerKnot();
  std::vector<double> parts(samples.size() * knot); // by frame
  const std::vector<std::size_t> begins = BeginsOfRanks(samples.size(), ranks.Size());
  const std::size_t first = begins[static_cast<std::size_t>(ranks.Rank())];
  const std::size_t own = begins[static_cast<std::size_t>(ranks.Rank()) + 1] - first;
  // result = M^T weight (M a - values) + penalty a
  const auto apply = [&](const std::vector<double>& a, bool lessValues, std::vector<double>& result)
  {
    parallel(own,
             [&](std::size_t begin, std::size_t end)
             {
               for (std::size_t f = first + begin; f < first + end; ++f)
               {
                 const Nodes nodes = this->At(levels[f], a);
                 double* part = parts.data() + f * knot;
                 std::fill_n(part, knot, 0.0);
                 for (std::size_t s = 0; s < bases[f].size(); ++s)
                 {
                   Vec3 w = this->Curl(bases[f][s], nodes.data());
                   if (lessValues)
                   {
                     w -= samples[f].Values[s];
                   }
                   this->AddCurl(bases[f][s], weight * w, part);
                 }
               }
             });
    ranks.Gather(parts.data(), sizeof(double) * knot, begins);
    result.assign(a.size(), 0.0);
    parallel(knot,
             [&](std::size_t begin, std::size_t end)
             {
               for (std::size_t f = 0; f < samples.size(); ++f)
               {
                 const double* part = parts.data() + f * knot;
                 for (int m = 0; m < 4; ++m)
                 {
                   double* sum =
                     result.data() + static_cast<std::size_t>(levels[f].First + m) * knot;
                   for (std::size_t i = begin; i < end; ++i)
                   {
                     sum[i] += levels[f].Weight[m] * part[i];
                   }
                 }
               }
             });
    this->Penalise(a, result);
  };
  std::vector<double> residual, direction, product;
  apply(this->Coefficients, true, residual);
  for (double& r : residual)
  {
    r = -r;
  }
  direction = residual;
  double size = Dot(residual, residual);
  const double enough = 1e-8 * size;
  for (int iteration = 0; iteration < this->Options.Iterations && size > enough; ++iteration)
  {
    if (!GoesOn(ranks, monitor, static_cast<double>(iteration) / this->Options.Iterations))
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
