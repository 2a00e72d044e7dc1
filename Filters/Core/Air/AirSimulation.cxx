// SPDX-License-Identifier: BSD-3-Clause
#include "Air/AirSimulation.h"

#include <algorithm>

namespace waft
{
namespace
{

using Field = AirSteering::Field;

constexpr int SmoothingPasses = 2; // of what steers

// The cells' velocities at the points of the lattice; across a wall there is none.
void Restrict(SmokeFrame& cells, const AirScene& scene, const FieldSeries& lattice,
              const ParallelFor& parallel, Field& values)
{
  FieldSeries one;
  one.Dimensions = cells.Dimensions;
  one.Origin = cells.Origin;
  one.Spacing = cells.Spacing;
  one.Times = { 0.0 };
  one.Values.resize(1);
  std::swap(one.Values[0], cells.Velocity); // until the end of this function
  const std::array<int, 3>& n = lattice.Dimensions;
  values.resize(lattice.NumberOfPoints());
  const auto isWall = [&](int axis, int i)
  {
    const bool ends = i == 0 || i + 1 == n[static_cast<std::size_t>(axis)];
    const bool closed =
      scene.Smoke.Boundary[static_cast<std::size_t>(axis)] == BoundaryKind::Closed;
    return ends && (closed || (axis == 2 && i == 0 && scene.Smoke.ClosedFloor));
  };
  parallel(static_cast<std::size_t>(n[2]),
           [&](std::size_t begin, std::size_t end)
           {
             for (auto k = static_cast<int>(begin); k < static_cast<int>(end); ++k)
             {
               std::size_t at = static_cast<std::size_t>(k) * n[1] * n[0];
               for (int j = 0; j < n[1]; ++j)
               {
                 for (int i = 0; i < n[0]; ++i, ++at)
                 {
                   const Vec3 x = lattice.Origin + Vec3(i, j, k).cwiseProduct(lattice.Spacing);
                   const Vec3 u = one.Sample(x, 0.0);
                   const int index[3] = { i, j, k };
                   for (int c = 0; c < 3; ++c)
                   {
                     values[at][static_cast<std::size_t>(c)] =
                       isWall(c, index[c]) ? 0.0f : static_cast<float>(u[c]);
                   }
                 }
               }
             }
           });
  std::swap(one.Values[0], cells.Velocity);
}

// Binomial means along each axis: what is finer than two spacings is left to the air itself. Across
// a wall there is no push.
void Smooth(const std::array<int, 3>& n, Field& field)
{
  const std::ptrdiff_t stride[3] = { 1, n[0], static_cast<std::ptrdiff_t>(n[0]) * n[1] };
  Field before;
  for (int axis = 0; axis < 3; ++axis)
  {
    before = field;
    std::ptrdiff_t p = 0;
    for (int k = 0; k < n[2]; ++k)
    {
      for (int j = 0; j < n[1]; ++j)
      {
        for (int i = 0; i < n[0]; ++i, ++p)
        {
          const int at = axis == 0 ? i : axis == 1 ? j : k;
          const bool first = at == 0;
          const bool last = at + 1 == n[static_cast<std::size_t>(axis)];
          const auto low = static_cast<std::size_t>(first ? p + stride[axis] : p - stride[axis]);
          const auto high = static_cast<std::size_t>(last ? p - stride[axis] : p + stride[axis]);
          for (std::size_t c = 0; c < 3; ++c)
          {
            const float mean = 0.25f * (before[low][c] + before[high][c]) +
                               0.5f * before[static_cast<std::size_t>(p)][c];
            const bool crosses = (first || last) && static_cast<int>(c) == axis;
            field[static_cast<std::size_t>(p)][c] = crosses ? 0.0f : mean;
          }
        }
      }
    }
  }
}

Result PlaceSolids(const AirScene& scene, int frame, SmokeSolver& solver)
{
  if (!scene.Solids || (frame > 0 && !scene.SolidsMove))
  {
    return Result::Ok();
  }
  std::vector<float> distances;
  std::vector<std::array<float, 3>> velocities;
  WAFT_RETURN_IF_FAILED(scene.Solids(frame, distances, velocities));
  return solver.SetSolids(distances, velocities);
}

} // namespace

FieldSeries AirLattice(const AirScene& scene, FieldMeaning meaning)
{
  FieldSeries series;
  series.Meaning = meaning;
  series.Dimensions = scene.LatticeDimensions;
  series.Origin = scene.Smoke.Bounds.Min;
  for (int c = 0; c < 3; ++c)
  {
    series.Spacing[c] = scene.Smoke.Bounds.Size()[c] /
                        std::max(1, scene.LatticeDimensions[static_cast<std::size_t>(c)] - 1);
  }
  return series;
}

AirSteering::AirSteering(const FieldSeries& wanted, FieldSeries own, FieldSeries push,
                         double rate) :
  Wanted(wanted),
  Own(std::move(own)), Pushes(std::move(push)), Rate(rate)
{
  if (this->Pushes.IsEmpty())
  {
    this->Pushes = wanted;
    this->Pushes.Meaning = FieldMeaning::Acceleration;
    this->Pushes.Values.assign(wanted.Values.size(), {});
  }
}

FieldSeries AirSteering::At(int frame, const Field& now)
{
  const auto f = static_cast<std::size_t>(frame);
  Field& push = this->Pushes.Values[f];
  push.resize(now.size());
  const Field wanted = MaterialDerivative(this->Wanted, f);
  const Field own = MaterialDerivative(this->Own, f);
  for (std::size_t i = 0; i < push.size(); ++i)
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      const float feed = wanted[i][c] - own[i][c] + push[i][c];
      push[i][c] =
        feed + static_cast<float>(this->Rate) * (this->Wanted.Values[f][i][c] - now[i][c]);
    }
  }
  for (int pass = 0; pass < SmoothingPasses; ++pass)
  {
    Smooth(this->Pushes.Dimensions, push);
  }
  if (f > 0)
  {
    this->Own.Values[f - 1] = Field(); // no later frame asks for it
  }
  FieldSeries one;
  one.Meaning = FieldMeaning::Acceleration;
  one.Dimensions = this->Pushes.Dimensions;
  one.Origin = this->Pushes.Origin;
  one.Spacing = this->Pushes.Spacing;
  one.Times = { this->Pushes.Times[f] };
  one.Values = { push };
  return one;
}

Result SimulateAir(const AirScene& scene, AirSteering* steering, const ParallelFor& parallel,
                   Monitor& monitor, FieldSeries& air, SmokeState* begun)
{
  SmokeSolver solver;
  WAFT_RETURN_IF_FAILED(solver.Begin(scene.Smoke, scene.Forces));
  air = AirLattice(scene, FieldMeaning::Velocity);
  SmokeFrame cells;
  for (int frame = 0; frame < scene.Time.NumberOfFrames; ++frame)
  {
    WAFT_RETURN_IF_FAILED(PlaceSolids(scene, frame, solver));
    if (frame == 0 && begun != nullptr && !begun->Arrays.empty())
    {
      WAFT_RETURN_IF_FAILED(solver.Restore(*begun));
    }
    else
    {
      PartMonitor step(monitor, static_cast<double>(frame) / scene.Time.NumberOfFrames,
                       (frame + 1.0) / scene.Time.NumberOfFrames);
      const Result stepped = solver.Step(parallel, step);
      if (!stepped || stepped.IsStopped())
      {
        return stepped;
      }
    }
    if (frame == 0 && begun != nullptr)
    {
      *begun = solver.Save();
    }
    solver.ReadVelocity(cells);
    Field values;
    Restrict(cells, scene, air, parallel, values);
    if (steering != nullptr)
    {
      solver.SetSteering(steering->At(frame, values));
    }
    air.Times.push_back(scene.Time.Time(frame));
    air.Values.push_back(std::move(values));
  }
  return Result::Ok();
}

Field MaterialDerivative(const FieldSeries& air, std::size_t f)
{
  Field derivative(air.NumberOfPoints());
  const std::array<int, 3>& n = air.Dimensions;
  const std::ptrdiff_t stride[3] = { 1, n[0], static_cast<std::ptrdiff_t>(n[0]) * n[1] };
  const std::size_t before = f > 0 ? f - 1 : 0;
  const std::size_t after = std::min(f + 1, air.Values.size() - 1);
  const double time = air.Times[after] - air.Times[before];
  std::ptrdiff_t p = 0;
  for (int k = 0; k < n[2]; ++k)
  {
    for (int j = 0; j < n[1]; ++j)
    {
      for (int i = 0; i < n[0]; ++i, ++p)
      {
        const int index[3] = { i, j, k };
        const auto at = static_cast<std::size_t>(p);
        for (std::size_t c = 0; c < 3; ++c)
        {
          double d =
            time > 0.0 ? (air.Values[after][at][c] - air.Values[before][at][c]) / time : 0.0;
          for (int axis = 0; axis < 3; ++axis)
          {
            const int low = index[axis] > 0 ? -1 : 0;
            const int high = index[axis] + 1 < n[static_cast<std::size_t>(axis)] ? 1 : 0;
            const auto a = static_cast<std::size_t>(p + low * stride[axis]);
            const auto b = static_cast<std::size_t>(p + high * stride[axis]);
            d += air.Values[f][at][static_cast<std::size_t>(axis)] *
                 (air.Values[f][b][c] - air.Values[f][a][c]) /
                 (std::max(1, high - low) * air.Spacing[axis]);
          }
          derivative[at][c] = static_cast<float>(d);
        }
      }
    }
  }
  return derivative;
}

} // namespace waft
