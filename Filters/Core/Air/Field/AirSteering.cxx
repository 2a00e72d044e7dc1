// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Field/AirSteering.h"

#include "Base/Simd.h"

namespace waft
{
namespace
{

using Field = FieldSeries::Field;

constexpr int SmoothingPasses = 2; // of what steers

// A row of a lattice along x in three fields, as plain floats, and its neighbours.
struct Row
{
  const float *Earlier, *Now, *Later;
  const float *Below[2], *Above[2]; // in y and z: the row itself at the ends
  double Apart[2];                  // those neighbours [m]
  double Spacing;                   // along x [m]
  double Time;                      // between the earlier and the later field [s]
  std::size_t Count;                // points
};

// Of the floats from begin up to end, whose neighbours along x are `low` and `high` floats away and
// `apart` from each other [m]. along: the velocity along x, y and z, three times a point.
WAFT_SIMD_CLONES void Derive(const Row& row, const std::array<const float*, 3>& along,
                             std::size_t begin, std::size_t end, std::size_t low, std::size_t high,
                             double apart, float* derivative)
{
  const float *u = along[0], *v = along[1], *w = along[2];
  const float *earlier = row.Earlier, *later = row.Later, *last = row.Now - low,
              *next = row.Now + high;
  const float *back = row.Below[0], *front = row.Above[0], *below = row.Below[1],
              *above = row.Above[1];
  const double time = row.Time, dy = row.Apart[0], dz = row.Apart[1];
#pragma GCC ivdep
  for (std::size_t q = begin; q < end; ++q)
  {
    double d = (later[q] - earlier[q]) / time;
    d += u[q] * (next[q] - last[q]) / apart;
    d += v[q] * (front[q] - back[q]) / dy;
    d += w[q] * (above[q] - below[q]) / dz;
    derivative[q] = static_cast<float>(d);
  }
}

void DeriveRow(const Row& row, std::vector<float>& velocities, float* derivative)
{
  const std::size_t end = 3 * row.Count;
  velocities.resize(3 * end);
  const std::array<const float*, 3> along = { velocities.data(), velocities.data() + end,
                                              velocities.data() + 2 * end };
  for (std::size_t q = 0; q < end; ++q)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      velocities[axis * end + q] = row.Now[q - q % 3 + axis];
    }
  }
  Derive(row, along, 0, 3, 0, 3, row.Spacing, derivative);
  Derive(row, along, 3, end - 3, 3, 3, 2 * row.Spacing, derivative);
  Derive(row, along, end - 3, end, 3, 0, row.Spacing, derivative);
}

WAFT_SIMD_CLONES void AddPush(const float* wanted, const float* own, const float* goal,
                              const float* now, float rate, std::size_t count, float* push)
{
  for (std::size_t q = 0; q < count; ++q)
  {
    push[q] = wanted[q] - own[q] + rate * (goal[q] - now[q]);
  }
}

WAFT_SIMD_CLONES void Mean(const float* low, const float* middle, const float* high,
                           std::size_t count, float* mean)
{
  for (std::size_t q = 0; q < count; ++q)
  {
    mean[q] = 0.25f * (low[q] + high[q]) + 0.5f * middle[q];
  }
}

void ForLayers(const std::array<int, 3>& n, const ParallelFor& parallel,
               const std::function<void(std::size_t)>& work)
{
  parallel(static_cast<std::size_t>(n[2]),
           [&](std::size_t begin, std::size_t end)
           {
             for (std::size_t k = begin; k < end; ++k)
             {
               work(k);
             }
           });
}

// Binomial means along each axis: what is finer than two spacings is left to the air itself. Across
// a wall there is no push.
void Smooth(const std::array<int, 3>& n, const ParallelFor& parallel, Field& field, Field& before)
{
  const std::size_t count[3] = { static_cast<std::size_t>(n[0]), static_cast<std::size_t>(n[1]),
                                 static_cast<std::size_t>(n[2]) };
  const std::size_t stride[3] = { 3, 3 * count[0], 3 * count[0] * count[1] };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    std::swap(field, before);
    const float* from = before.data()->data();
    float* to = field.data()->data();
    // Floats from first up to first + floats, all of one place along the axis.
    const auto run = [&](std::size_t first, std::size_t floats, std::size_t at)
    {
      const float* middle = from + first;
      const float* low = at == 0 ? middle + stride[axis] : middle - stride[axis];
      const float* high = at + 1 == count[axis] ? middle - stride[axis] : middle + stride[axis];
      Mean(low, middle, high, floats, to + first);
      for (std::size_t q = axis; (at == 0 || at + 1 == count[axis]) && q < floats; q += 3)
      {
        to[first + q] = 0.0f;
      }
    };
    ForLayers(n, parallel,
              [&](std::size_t k)
              {
                for (std::size_t j = 0; j < count[1]; ++j)
                {
                  const std::size_t first = k * stride[2] + j * stride[1];
                  if (axis == 0)
                  {
                    run(first, 3, 0);
                    Mean(from + first, from + first + 3, from + first + 6, stride[1] - 6,
                         to + first + 3);
                    run(first + stride[1] - 3, 3, count[0] - 1);
                  }
                  else
                  {
                    run(first, stride[1], axis == 1 ? j : k);
                  }
                }
              });
  }
}

} // namespace

void ThreeFrames::MoveTo(const HalfSeries& series, std::size_t f)
{
  const std::size_t before = f > 0 ? f - 1 : 0;
  const std::size_t after = std::min(f + 1, series.Values.size() - 1);
  if (f == this->Next)
  {
    std::rotate(this->Fields.begin(), this->Fields.begin() + 1, this->Fields.end());
  }
  else
  {
    this->Fields[0] = series.At(before);
    this->Fields[1] = series.At(f);
  }
  if (after > f)
  {
    this->Fields[2] = series.At(after);
  }
  else
  {
    this->Fields[2] = this->Fields[1];
  }
  this->Next = f + 1;
  this->Time = after > before ? series.Times[after] - series.Times[before] : 1.0;
}

void ThreeFrames::MaterialDerivative(const HalfSeries& series, std::size_t begin, std::size_t end,
                                     Field& derivative) const
{
  const std::array<int, 3>& n = series.Dimensions;
  const std::size_t count[2] = { static_cast<std::size_t>(n[1]), static_cast<std::size_t>(n[2]) };
  const std::size_t stride[2] = { 3 * static_cast<std::size_t>(n[0]),
                                  3 * static_cast<std::size_t>(n[0]) * count[0] };
  Row row;
  row.Spacing = series.Spacing[0];
  row.Time = this->Time;
  std::vector<float> velocities;
  row.Count = static_cast<std::size_t>(n[0]);
  for (std::size_t k = begin; k < end; ++k)
  {
    for (std::size_t j = 0; j < count[0]; ++j)
    {
      const std::size_t first = k * stride[1] + j * stride[0];
      row.Earlier = this->Fields[0].data()->data() + first;
      row.Now = this->Fields[1].data()->data() + first;
      row.Later = this->Fields[2].data()->data() + first;
      for (std::size_t axis = 0; axis < 2; ++axis)
      {
        const std::size_t at = axis == 0 ? j : k;
        const bool hasBelow = at > 0;
        const bool hasAbove = at + 1 < count[axis];
        row.Below[axis] = hasBelow ? row.Now - stride[axis] : row.Now;
        row.Above[axis] = hasAbove ? row.Now + stride[axis] : row.Now;
        row.Apart[axis] =
          (hasBelow && hasAbove ? 2 : 1) * series.Spacing[static_cast<int>(axis) + 1];
      }
      DeriveRow(row, velocities, derivative.data()->data() + first);
    }
  }
}

AirSteering::AirSteering(const HalfSeries& wanted, const HalfSeries& own, double rate) :
  Wanted(wanted), Own(own), Pushes(static_cast<const SeriesLattice&>(wanted)), Rate(rate)
{
  this->Pushes.Meaning = FieldMeaning::Acceleration;
  this->Pushes.Values.resize(wanted.Values.size());
}

FieldSeries AirSteering::At(int frame, const Field& now, const ParallelFor& parallel)
{
  const auto f = static_cast<std::size_t>(frame);
  Field push(now.size());
  this->WantedNow.MoveTo(this->Wanted, f);
  this->OwnNow.MoveTo(this->Own, f);
  Field wanted(now.size()), own(now.size());
  const std::size_t layer = now.size() / static_cast<std::size_t>(this->Wanted.Dimensions[2]);
  ForLayers(this->Wanted.Dimensions, parallel,
            [&](std::size_t k)
            {
              this->WantedNow.MaterialDerivative(this->Wanted, k, k + 1, wanted);
              this->OwnNow.MaterialDerivative(this->Own, k, k + 1, own);
              const std::size_t first = k * layer;
              AddPush(wanted[first].data(), own[first].data(), this->WantedNow.Now()[first].data(),
                      now[first].data(), static_cast<float>(this->Rate), 3 * layer,
                      push[first].data());
            });
  for (int pass = 0; pass < SmoothingPasses; ++pass)
  {
    Smooth(this->Pushes.Dimensions, parallel, push, wanted);
  }
  this->Pushes.Set(f, push);
  FieldSeries one{ static_cast<const SeriesLattice&>(this->Pushes) };
  one.Times = { this->Pushes.Times[f] };
  one.Values = { std::move(push) };
  return one;
}

} // namespace waft
