// SPDX-License-Identifier: BSD-3-Clause
// What pushes the air: vortices, winds, confinement, buoyancy; and where smoke comes from.
#include "Grid/SmokeInternals.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace waft
{
namespace
{

constexpr double BreezeTime = 1.0; // s

std::array<float, 3> ToFloats(const Vec3& v)
{
  return { static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()) };
}

/// Where a coordinate is between the points of a lattice along one axis, held at its ends.
struct LatticeBetween
{
  std::size_t Low = 0, High = 0;
  float Part = 0.0f;
};

LatticeBetween Between(double coordinate, int points)
{
  const double held = std::clamp(coordinate, 0.0, static_cast<double>(points - 1));
  const int low = std::min(static_cast<int>(held), std::max(points - 2, 0));
  return { static_cast<std::size_t>(low), static_cast<std::size_t>(std::min(low + 1, points - 1)),
           static_cast<float>(held - low) };
}

} // namespace

void SmokeSolver::Internals::AddVortices(double time, const ParallelFor& parallelFor,
                                         const VectorArrays& sum) const
{
  std::vector<VortexNow> now;
  for (const Vortex& vortex : this->Forces.Vortices)
  {
    const double factor = vortex.TimeFactor(time);
    if (factor < this->Options.NegligibleForce)
    {
      continue;
    }
    VortexNow v;
    const Vec3 r0 = vortex.P2 - vortex.P1;
    for (int axis = 0; axis < 3; ++axis)
    {
      v.P1[axis] = static_cast<float>(vortex.P1[axis]);
      v.P2[axis] = static_cast<float>(vortex.P2[axis]);
      v.R0[axis] = static_cast<float>(r0[axis]);
    }
    v.Scale = static_cast<float>(factor * vortex.Strength / (4.0 * M_PI));
    v.Core = static_cast<float>(vortex.CoreRadius * vortex.CoreRadius * r0.squaredNorm());
    now.push_back(v);
  }
  ForPlanes(parallelFor, this->Layout.N[2],
            [&](int k)
            {
              for (const VortexNow& vortex : now)
              {
                AddVortexPlane(this->Layout, this->FirstCenter, this->Spacing, vortex, sum, k);
              }
            });
}

void SmokeSolver::Internals::AddWinds(double time, double dt, const ParallelFor& parallelFor,
                                      const ConstVectorArrays& center,
                                      const VectorArrays& sum) const
{
  const StaggeredLayout& layout = this->Layout;
  for (const AnalyticWind& wind : this->Forces.Winds)
  {
    const double s = (time - wind.CenterTime) / wind.Duration;
    const double factor = std::exp(-0.5 * s * s);
    if (factor < this->Options.NegligibleForce)
    {
      continue;
    }
    std::array<FloatArray, 3> along;
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int i = 0; i < layout.N[axis]; ++i)
      {
        const double d = (this->VoxelCenter(axis, i) - wind.Center[axis]) / wind.Radius;
        along[axis].push_back(static_cast<float>(std::exp(-0.5 * d * d)));
      }
    }
    const std::array<float, 3> vector = ToFloats(factor * wind.Strength * wind.Direction);
    ForPlanes(parallelFor, layout.N[2],
              [&](int k) {
                AddSeparablePlane(layout, vector, along[0].data(), along[1].data(), along[2].data(),
                                  sum, k);
              });
  }
  this->AddField(this->Forces.Wind, time, dt, parallelFor, center, sum);
  this->AddSteering(parallelFor, sum);
  this->AddBreeze(parallelFor, center, sum);
}

// Gusts of the volume's own push its mean off, and only what comes in brings it back.
void SmokeSolver::Internals::AddBreeze(const ParallelFor& parallelFor,
                                       const ConstVectorArrays& center,
                                       const VectorArrays& sum) const
{
  const StaggeredLayout& layout = this->Layout;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (this->Options.Breeze[axis] == 0.0)
    {
      continue;
    }
    const auto forEachRow = [&](int k, const auto& act)
    {
      for (int j = 0; j < layout.N[1]; ++j)
      {
        act(layout.Index(0, j, k));
      }
    };
    std::vector<double> planes(static_cast<std::size_t>(layout.N[2]));
    ForPlanes(parallelFor, layout.N[2],
              [&](int k)
              {
                forEachRow(k,
                           [&](std::ptrdiff_t row)
                           {
                             planes[static_cast<std::size_t>(k)] += std::accumulate(
                               center[axis] + row, center[axis] + row + layout.N[0], 0.0);
                           });
              });
    const double mean =
      std::accumulate(planes.begin(), planes.end(), 0.0) / layout.N[0] / layout.N[1] / layout.N[2];
    const auto pull = static_cast<float>((this->Options.Breeze[axis] - mean) / BreezeTime);
    ForPlanes(parallelFor, layout.N[2],
              [&](int k)
              {
                forEachRow(k,
                           [&](std::ptrdiff_t row)
                           {
                             for (std::ptrdiff_t p = row; p < row + layout.N[0]; ++p)
                             {
                               sum[axis][p] += pull;
                             }
                           });
              });
  }
}

// The field of one time: rows of its lattice between those of the cells, then along each row.
void SmokeSolver::Internals::AddSteering(const ParallelFor& parallelFor,
                                         const VectorArrays& sum) const
{
  const FieldSeries& field = this->Steering;
  if (field.IsEmpty())
  {
    return;
  }
  const StaggeredLayout& layout = this->Layout;
  std::array<std::vector<LatticeBetween>, 3> between;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int i = 0; i < layout.N[axis]; ++i)
    {
      const double x = this->VoxelCenter(axis, i);
      between[axis].push_back(
        Between((x - field.Origin[axis]) / field.Spacing[axis], field.Dimensions[axis]));
    }
  }
  const auto points = static_cast<std::size_t>(field.Dimensions[0]);
  const auto rows = static_cast<std::size_t>(field.Dimensions[1]);
  const std::vector<std::array<float, 3>>& values = field.Values.front();
  ForPlanes(parallelFor, layout.N[2],
            [&](int k)
            {
              std::vector<std::array<float, 3>> row(points);
              const LatticeBetween& z = between[2][static_cast<std::size_t>(k)];
              for (int j = 0; j < layout.N[1]; ++j)
              {
                const LatticeBetween& y = between[1][static_cast<std::size_t>(j)];
                const std::array<float, 3>* at[4] = {
                  values.data() + (z.Low * rows + y.Low) * points,
                  values.data() + (z.Low * rows + y.High) * points,
                  values.data() + (z.High * rows + y.Low) * points,
                  values.data() + (z.High * rows + y.High) * points,
                };
                const float weight[4] = { (1.0f - z.Part) * (1.0f - y.Part),
                                          (1.0f - z.Part) * y.Part, z.Part * (1.0f - y.Part),
                                          z.Part * y.Part };
                for (std::size_t i = 0; i < points; ++i)
                {
                  for (std::size_t c = 0; c < 3; ++c)
                  {
                    row[i][c] = weight[0] * at[0][i][c] + weight[1] * at[1][i][c] +
                                weight[2] * at[2][i][c] + weight[3] * at[3][i][c];
                  }
                }
                for (int i = 0; i < layout.N[0]; ++i)
                {
                  const LatticeBetween& x = between[0][static_cast<std::size_t>(i)];
                  const std::ptrdiff_t p = layout.Index(i, j, k);
                  for (std::size_t c = 0; c < 3; ++c)
                  {
                    sum[c][p] += (1.0f - x.Part) * row[x.Low][c] + x.Part * row[x.High][c];
                  }
                }
              }
            });
}

void SmokeSolver::Internals::AddField(const FieldSeries& field, double time, double dt,
                                      const ParallelFor& parallelFor,
                                      const ConstVectorArrays& center,
                                      const VectorArrays& sum) const
{
  if (field.IsEmpty())
  {
    return;
  }
  const StaggeredLayout& layout = this->Layout;
  // A velocity draws the air with rate r; over dt implicitly, so that no rate is too large.
  const bool drags = field.Meaning == FieldMeaning::Velocity;
  const float rate =
    static_cast<float>(this->Options.WindDrag / (1.0 + this->Options.WindDrag * dt));
  ForPlanes(parallelFor, layout.N[2],
            [&](int k)
            {
              for (int j = 0; j < layout.N[1]; ++j)
              {
                for (int i = 0; i < layout.N[0]; ++i)
                {
                  const Vec3 x(this->VoxelCenter(0, i), this->VoxelCenter(1, j),
                               this->VoxelCenter(2, k));
                  const std::array<float, 3> value = ToFloats(field.Sample(x, time));
                  const std::ptrdiff_t p = layout.Index(i, j, k);
                  for (int axis = 0; axis < 3; ++axis)
                  {
                    sum[axis][p] += drags ? rate * (value[axis] - center[axis][p]) : value[axis];
                  }
                }
              }
            });
}

void SmokeSolver::Internals::ComputeCenters(const ParallelFor& parallelFor,
                                            std::array<FloatArray, 3>& center) const
{
  const ConstVectorArrays faces = ConstPointers(this->Velocity);
  const VectorArrays cells = Pointers(center);
  ForPlanes(parallelFor, this->Layout.N[2],
            [&](int k) { CenterVelocityPlane(this->Layout, faces, cells, k); });
}

void SmokeSolver::Internals::ComputeVorticity(const ParallelFor& parallelFor,
                                              const std::array<FloatArray, 3>& center,
                                              std::array<FloatArray, 3>& vorticity,
                                              FloatArray& size) const
{
  const ConstVectorArrays cells = ConstPointers(center);
  const VectorArrays out = Pointers(vorticity);
  ForPlanes(parallelFor, this->Layout.N[2],
            [&](int k)
            { VorticityPlane(this->Layout, this->Spacing, cells, out, size.data(), k); });
}

void SmokeSolver::Internals::AddConfinementAndBuoyancy(const ParallelFor& parallelFor)
{
  const StaggeredLayout& layout = this->Layout;
  if (this->Options.Confinement > 0.0)
  {
    for (FloatArray& component : this->Center)
    {
      FillGhosts(layout, this->DerivedEnds, -1, component.data());
    }
    this->ComputeVorticity(parallelFor, this->Center, this->Vorticity, this->VorticitySize);
    FillGhosts(layout, this->DerivedEnds, -1, this->VorticitySize.data());
    const float strength =
      static_cast<float>(this->Options.Confinement * this->Options.Spacing().minCoeff());
    ForPlanes(parallelFor, layout.N[2],
              [&](int k)
              {
                ConfinePlane(layout, this->Spacing, strength, ConstPointers(this->Vorticity),
                             this->VorticitySize.data(), Pointers(this->Acceleration), k);
              });
  }
  const float lift = static_cast<float>(this->Options.BuoyancyTemperature);
  const float weight = static_cast<float>(this->Options.BuoyancyDensity);
  if ((lift != 0.0f && this->HasWarmth) || (weight != 0.0f && this->HasSmoke))
  {
    ForPlanes(parallelFor, layout.N[2],
              [&](int k)
              {
                for (int j = 0; j < layout.N[1]; ++j)
                {
                  const std::ptrdiff_t row = layout.Index(0, j, k);
                  for (std::ptrdiff_t p = row; p < row + layout.N[0]; ++p)
                  {
                    this->Acceleration[2][p] +=
                      lift * this->Temperature[p] - weight * this->Density[p];
                  }
                }
              });
  }
}

void SmokeSolver::Internals::Emit(double time)
{
  const StaggeredLayout& layout = this->Layout;
  const Vec3 spacing = this->Options.Spacing();
  const double soft = spacing.maxCoeff();
  for (const SmokeEmitter& emitter : this->Forces.Emitters)
  {
    if (time < emitter.StartTime || time > emitter.EndTime)
    {
      continue;
    }
    std::array<int, 3> low, high;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double middle = (emitter.Center[axis] - this->Options.Bounds.Min[axis]) / spacing[axis];
      const double reach = (emitter.Radius + soft) / spacing[axis];
      low[axis] = static_cast<int>(std::clamp<double>(middle - reach, 0.0, layout.N[axis]));
      high[axis] = static_cast<int>(std::clamp<double>(middle + reach + 1, 0.0, layout.N[axis]));
    }
    for (int k = low[2]; k < high[2]; ++k)
    {
      for (int j = low[1]; j < high[1]; ++j)
      {
        for (int i = low[0]; i < high[0]; ++i)
        {
          const Vec3 x =
            this->Options.Bounds.Min + Vec3(i + 0.5, j + 0.5, k + 0.5).cwiseProduct(spacing);
          const double inside = (emitter.Radius - (x - emitter.Center).norm()) / soft + 0.5;
          const std::ptrdiff_t p = layout.Index(i, j, k);
          if (inside <= 0.0 || this->Solids.CenterIsSolid()[p])
          {
            continue;
          }
          const double fraction = std::min(inside, 1.0);
          this->Density[p] =
            std::max(this->Density[p], static_cast<float>(fraction * emitter.Density));
          if (emitter.Temperature != 0.0)
          {
            this->Temperature[p] += static_cast<float>(
              fraction * (emitter.Temperature - static_cast<double>(this->Temperature[p])));
          }
        }
      }
    }
  }
}

} // namespace waft
