// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Solver/TimelinePreconditioner.h"

#include <algorithm>
#include <utility>

namespace waft
{
namespace
{

constexpr std::size_t ColumnsAtOnce = 64; // bodies solved side by side: fits the second cache

// The average D of an object vanishes when the air goes along with it, which the air does, so that
// an object has only a fraction of the stiffness of its own D, and of the damping. Else the solver
// stirs the gas, that is many, and the objects lag behind.
constexpr double ObjectFraction = 0.3;

struct Entry
{
  int Unknown; // 2 frame + (0: x, 1: v)
  double Value;
};

} // namespace

TimelinePreconditioner::TimelinePreconditioner(const SpacetimeModel& model, const TimeLevel& level,
                                               const ParallelFor& parallel, double damping) :
  Model(model),
  Level(level), Parallel(parallel), Damping(damping)
{
  this->Gas = this->Factor(-1);
  this->Objects.resize(model.NumberOfObjects);
  parallel(model.NumberOfObjects,
           [&](std::size_t begin, std::size_t end)
           {
             for (std::size_t o = begin; o < end; ++o)
             {
               this->Objects[o] = this->Factor(static_cast<long>(o));
             }
           });
}

TimelinePreconditioner::Band TimelinePreconditioner::Factor(long object) const
{
  const SpacetimeWeights& w = this->Model.Weights;
  const int frames = static_cast<int>(this->Level.NumberOfFrames());
  const int n = 2 * frames;
  Band band;
  band.HalfWidth = std::min(n - 1, 4 * this->Level.Reach());
  const int h = band.HalfWidth;
  const double weight = object < 0 ? 1.0 : static_cast<double>(this->Model.Offsets.size());
  const double fraction = object < 0 ? 1.0 : ObjectFraction;
  const auto flag = [&](int j) -> int
  { return object < 0 ? 0 : this->Model.Flag(this->Level.Frames[j], object); };
  const auto isFixed = [&](int unknown)
  {
    return !this->Level.IsFree(static_cast<std::size_t>(unknown / 2)) ||
           (flag(unknown / 2) & (unknown % 2 ? FixedVelocity : FixedPosition)) != 0;
  };

  std::vector<double> a(static_cast<std::size_t>(n) * (h + 1), 0.0); // a[row][row - column]
  const auto addRow = [&](const std::vector<Entry>& row, double factor)
  {
    for (const Entry& p : row)
    {
      for (const Entry& q : row)
      {
        if (q.Unknown <= p.Unknown && !isFixed(p.Unknown) && !isFixed(q.Unknown))
        {
          a[static_cast<std::size_t>(p.Unknown) * (h + 1) + (p.Unknown - q.Unknown)] +=
            weight * factor * p.Value * q.Value;
        }
      }
    }
  };
  for (int j = 0; j < frames; ++j)
  {
    addRow({ { 2 * j, 1.0 } }, fraction * this->Damping);
    addRow({ { 2 * j + 1, 1.0 } }, fraction * this->Damping);
    const double air =
      object < 0 ? 1.0
                 : w.ObjectCoherence * this->Model.CoherenceFraction(this->Level.Frames[j], object);
    addRow({ { 2 * j + 1, 1.0 } },
           fraction * air * w.CoherenceWeight * w.SpatialShare * this->Level.FrameWeights[j]);
    std::vector<Entry> row{ { 2 * j + 1, 1.0 } };
    for (const auto& neighbour : this->Level.Rows[j])
    {
      row.push_back({ 2 * neighbour.Frame + 1, -neighbour.Coefficient });
    }
    addRow(row, SmoothnessWeight(this->Model, this->Level, static_cast<std::size_t>(j), object));
    if (j > 0 && (object < 0 || !StepIsBound(this->Model, this->Level, j, object)))
    {
      const double step = this->Level.StepWeights[j];
      addRow({ { 2 * j, 1.0 }, { 2 * j - 2, -1.0 }, { 2 * j + 1, -this->Level.Steps[j] } },
             (object < 0 ? 1.0 : w.ObjectPosition) * w.PositionWeight * step);
      if (object >= 0 && !this->Model.Air.IsEmpty()) // a deviation vanishes, whatever it was
      {
        const bool hasLaw =
          StepHasLaw(this->Model, this->Level, static_cast<std::size_t>(j), object);
        addRow({ { 2 * j + 1, 1.0 } }, hasLaw ? w.VelocityWeight * step : 0.0);
      }
      else
      {
        addRow({ { 2 * j + 1, 1.0 }, { 2 * j - 1, -1.0 } }, w.VelocityWeight * step);
      }
    }
  }

  // L D L^T in place.
  band.Lower.assign(static_cast<std::size_t>(n) * h, 0.0f);
  band.Inverse.assign(n, 0.0f);
  std::vector<double> diagonal(n, 1.0);
  for (int i = 0; i < n; ++i)
  {
    double* row = a.data() + static_cast<std::size_t>(i) * (h + 1);
    if (isFixed(i))
    {
      row[0] = 1.0;
    }
    for (int k = std::min(i, h); k >= 1; --k) // column i - k
    {
      double value = row[k];
      const double* other = a.data() + static_cast<std::size_t>(i - k) * (h + 1);
      for (int m = k + 1; m <= std::min(i, h); ++m) // column i - m, shared with row i - k
      {
        if (m - k <= h)
        {
          value -= row[m] * diagonal[i - m] * other[m - k];
        }
      }
      row[k] = value / diagonal[i - k];
    }
    double pivot = row[0];
    for (int k = 1; k <= std::min(i, h); ++k)
    {
      pivot -= row[k] * row[k] * diagonal[i - k];
    }
    diagonal[i] = std::max(pivot, 1e-9);
    band.Inverse[i] = isFixed(i) ? 0.0f : static_cast<float>(1.0 / diagonal[i]);
    for (int k = 1; k <= h; ++k)
    {
      band.Lower[static_cast<std::size_t>(i) * h + k - 1] =
        k <= i ? static_cast<float>(row[k]) : 0.0f;
    }
  }
  return band;
}

template <class In, class Out>
void TimelinePreconditioner::SolveColumns(const Columns& columns, const In& in,
                                          const Out& out) const
{
  const Band& band = *columns.Factor;
  const std::size_t count = columns.Count;
  const int frames = static_cast<int>(this->Level.NumberOfFrames());
  const int n = 2 * frames;
  const int h = band.HalfWidth;
  std::vector<float> y(static_cast<std::size_t>(n) * count);
  for (int i = 0; i < n; ++i)
  {
    float* row = y.data() + i * count;
    const float* source = in(i);
    std::copy(source, source + count, row);
    for (int k = 1; k <= std::min(i, h); ++k)
    {
      const float l = band.Lower[static_cast<std::size_t>(i) * h + k - 1];
      const float* other = y.data() + (i - k) * count;
      for (std::size_t b = 0; b < count && l != 0.0f; ++b)
      {
        row[b] -= l * other[b];
      }
    }
  }
  for (int i = n - 1; i >= 0; --i)
  {
    float* row = y.data() + i * count;
    for (std::size_t b = 0; b < count; ++b)
    {
      row[b] *= band.Inverse[i];
    }
    for (int k = 1; k <= h && i + k < n; ++k)
    {
      const float l = band.Lower[static_cast<std::size_t>(i + k) * h + k - 1];
      const float* other = y.data() + (i + k) * count;
      for (std::size_t b = 0; b < count && l != 0.0f; ++b)
      {
        row[b] -= l * other[b];
      }
    }
    std::copy(row, row + count, out(i));
  }
}

std::size_t TimelinePreconditioner::NumberOfColumns() const
{
  const std::size_t chunks = (this->Model.NumberOfGas + ColumnsAtOnce - 1) / ColumnsAtOnce;
  return 3 * (chunks + this->Model.NumberOfObjects);
}

TimelinePreconditioner::Columns TimelinePreconditioner::ColumnsAt(std::size_t k) const
{
  const std::size_t ng = this->Model.NumberOfGas;
  const std::size_t chunks = (ng + ColumnsAtOnce - 1) / ColumnsAtOnce;
  const int c = static_cast<int>(k % 3);
  const std::size_t part = k / 3;
  if (part < chunks)
  {
    const std::size_t first = part * ColumnsAtOnce;
    return { &this->Gas, first, std::min(ColumnsAtOnce, ng - first), c };
  }
  return { &this->Objects[part - chunks], ng + part - chunks, 1, c };
}

void TimelinePreconditioner::Solve(const StateVector& in, StateVector& out) const
{
  const std::size_t stride = this->Model.Stride();
  this->Parallel(this->NumberOfColumns(),
                 [&](std::size_t begin, std::size_t end)
                 {
                   for (std::size_t k = begin; k < end; ++k)
                   {
                     const Columns columns = this->ColumnsAt(k);
                     const int c = columns.Component;
                     const auto offset = [&](int unknown)
                     {
                       return static_cast<std::size_t>(unknown / 2) * this->Model.FrameSize() +
                              (unknown % 2 ? 3 + c : c) * stride + columns.First;
                     };
                     this->SolveColumns(
                       columns, [&](int i) { return in.data() + offset(i); },
                       [&](int i) { return out.data() + offset(i); });
                   }
                 });
}

std::vector<float> TimelinePreconditioner::ColumnOf(std::size_t object, std::size_t j) const
{
  std::vector<float> column(2 * this->Level.NumberOfFrames(), 0.0f);
  column[2 * j] = 1.0f;
  const auto value = [&](int i) { return column.data() + i; };
  this->SolveColumns({ &this->Objects[object], this->Model.NumberOfGas + object, 1, 0 }, value,
                     value);
  return column;
}

} // namespace waft
