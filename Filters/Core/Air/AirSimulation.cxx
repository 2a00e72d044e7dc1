// SPDX-License-Identifier: BSD-3-Clause
#include "Air/AirSimulation.h"

#include <algorithm>
#include <utility>

namespace waft
{
namespace
{

using Field = AirSteering::Field;

constexpr int SmoothingPasses = 2; // of what steers

// Where the points of a lattice lie between those of another along one axis: the lower of the two
// neighbours, the part of the way to the other one, held at the ends.
struct Neighbours
{
  std::vector<int> Low, High;
  std::vector<float> Part;

  Neighbours(const SeriesLattice& of, const SeriesLattice& among, int axis)
  {
    const auto a = static_cast<std::size_t>(axis);
    const double last = among.Dimensions[a] - 1;
    for (int i = 0; i < of.Dimensions[a]; ++i)
    {
      const double x = of.Origin[axis] + i * of.Spacing[axis];
      const double at = std::clamp((x - among.Origin[axis]) / among.Spacing[axis], 0.0, last);
      this->Low.push_back(static_cast<int>(at));
      this->High.push_back(std::min(this->Low.back() + 1, among.Dimensions[a] - 1));
      this->Part.push_back(static_cast<float>(at - this->Low.back()));
    }
  }
};

// The cells' velocities at the points of the lattice; across a wall there is none, nor on the
// floor.
void Restrict(const SmokeFrame& cells, const AirScene& scene, const SeriesLattice& lattice,
              const ParallelFor& parallel, Field& values)
{
  SeriesLattice grid;
  grid.Dimensions = cells.Dimensions;
  grid.Origin = cells.Origin;
  grid.Spacing = cells.Spacing;
  const std::array<int, 3>& n = lattice.Dimensions;
  const Neighbours along[3] = { { lattice, grid, 0 }, { lattice, grid, 1 }, { lattice, grid, 2 } };
  values.resize(lattice.NumberOfPoints());
  const auto isWall = [&](int axis, int i)
  {
    const bool ends = i == 0 || i + 1 == n[static_cast<std::size_t>(axis)];
    const bool closed =
      scene.Smoke.Boundary[static_cast<std::size_t>(axis)] == BoundaryKind::Closed;
    return ends && (closed || (axis == 2 && i == 0 && scene.Smoke.ClosedFloor));
  };
  const auto row = [&](int j, int k)
  {
    return cells.Velocity.data() +
           (static_cast<std::size_t>(k) * grid.Dimensions[1] + j) * grid.Dimensions[0];
  };
  const auto points = [&](std::size_t j, std::size_t k)
  {
    const std::array<float, 3>* rows[4] = { row(along[1].Low[j], along[2].Low[k]),
                                            row(along[1].High[j], along[2].Low[k]),
                                            row(along[1].Low[j], along[2].High[k]),
                                            row(along[1].High[j], along[2].High[k]) };
    const float y = along[1].Part[j];
    const float z = along[2].Part[k];
    const float weights[4] = { (1.0f - y) * (1.0f - z), y * (1.0f - z), (1.0f - y) * z, y * z };
    std::array<float, 3>* value = values.data() + (k * n[1] + j) * n[0];
    for (std::size_t i = 0; i < along[0].Low.size(); ++i, ++value)
    {
      const auto low = static_cast<std::size_t>(along[0].Low[i]);
      const auto high = static_cast<std::size_t>(along[0].High[i]);
      const float x = along[0].Part[i];
      *value = { 0.0f, 0.0f, 0.0f };
      for (int r = 0; r < 4; ++r)
      {
        for (std::size_t c = 0; c < 3; ++c)
        {
          (*value)[c] += weights[r] * ((1.0f - x) * rows[r][low][c] + x * rows[r][high][c]);
        }
      }
      const std::size_t index[3] = { i, j, k };
      for (int c = 0; c < 3; ++c)
      {
        if (isWall(c, static_cast<int>(index[c])))
        {
          (*value)[static_cast<std::size_t>(c)] = 0.0f;
        }
      }
    }
  };
  parallel(static_cast<std::size_t>(n[2]),
           [&](std::size_t begin, std::size_t end)
           {
             for (std::size_t k = begin; k < end; ++k)
             {
               for (std::size_t j = 0; j < along[1].Low.size(); ++j)
               {
                 points(j, k);
               }
             }
           });
  StopAtFloor(lattice, values);
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

} // namespace

void StopAtFloor(const SeriesLattice& lattice, AirSteering::Field& values)
{
  const auto floor = static_cast<std::ptrdiff_t>(lattice.Dimensions[0]) * lattice.Dimensions[1];
  std::fill_n(values.begin(), floor, std::array<float, 3>{});
}

namespace
{

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

HalfSeries AirLattice(const AirScene& scene, FieldMeaning meaning)
{
  HalfSeries series;
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

AirSteering::AirSteering(const HalfSeries& wanted, HalfSeries own, HalfSeries push, double rate) :
  Wanted(wanted), Own(std::move(own)), Pushes(std::move(push)), Rate(rate)
{
  if (this->Pushes.IsEmpty())
  {
    this->Pushes = wanted;
    this->Pushes.Meaning = FieldMeaning::Acceleration;
    this->Pushes.Values.assign(wanted.Values.size(), {});
  }
}

FieldSeries AirSteering::Lacking(const Field& now) const
{
  FieldSeries lacking{ static_cast<const SeriesLattice&>(this->Wanted) };
  lacking.Times = { this->Wanted.Times.front() };
  lacking.Values = { this->Wanted.At(0) };
  for (std::size_t i = 0; i < now.size(); ++i)
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      lacking.Values[0][i][c] -= now[i][c];
    }
  }
  return lacking;
}

FieldSeries AirSteering::At(int frame, const Field& now)
{
  const auto f = static_cast<std::size_t>(frame);
  Field push = this->Pushes.At(f);
  push.resize(now.size());
  const Field goal = this->Wanted.At(f);
  const Field wanted = MaterialDerivative(this->Wanted, f);
  const Field own = MaterialDerivative(this->Own, f);
  for (std::size_t i = 0; i < push.size(); ++i)
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      const float feed = wanted[i][c] - own[i][c] + push[i][c];
      push[i][c] = feed + static_cast<float>(this->Rate) * (goal[i][c] - now[i][c]);
    }
  }
  for (int pass = 0; pass < SmoothingPasses; ++pass)
  {
    Smooth(this->Pushes.Dimensions, push);
  }
  if (f > 0)
  {
    this->Own.Values[f - 1] = {}; // no later frame asks for it
  }
  this->Pushes.Set(f, push);
  FieldSeries one{ static_cast<const SeriesLattice&>(this->Pushes) };
  one.Times = { this->Pushes.Times[f] };
  one.Values = { std::move(push) };
  return one;
}

Result SimulateAir(const AirScene& scene, AirSteering* steering, const ParallelFor& parallel,
                   Monitor& monitor, HalfSeries& air, SmokeState* begun)
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
    Field values;
    const auto read = [&]
    {
      solver.ReadVelocity(cells);
      Restrict(cells, scene, air, parallel, values);
    };
    read();
    if (steering != nullptr && frame == 0)
    {
      WAFT_RETURN_IF_FAILED(solver.AddVelocity(steering->Lacking(values)));
      read();
    }
    if (steering != nullptr)
    {
      solver.SetSteering(steering->At(frame, values));
    }
    air.Times.push_back(scene.Time.Time(frame));
    air.Values.emplace_back();
    air.Set(static_cast<std::size_t>(frame), values);
  }
  return Result::Ok();
}

Field MaterialDerivative(const HalfSeries& air, std::size_t f)
{
  Field derivative(air.NumberOfPoints());
  const std::array<int, 3>& n = air.Dimensions;
  const std::ptrdiff_t stride[3] = { 1, n[0], static_cast<std::ptrdiff_t>(n[0]) * n[1] };
  const std::size_t before = f > 0 ? f - 1 : 0;
  const std::size_t after = std::min(f + 1, air.Values.size() - 1);
  const double time = air.Times[after] - air.Times[before];
  const Field now = air.At(f), earlier = air.At(before), later = air.At(after);
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
          double d = time > 0.0 ? (later[at][c] - earlier[at][c]) / time : 0.0;
          for (int axis = 0; axis < 3; ++axis)
          {
            const int low = index[axis] > 0 ? -1 : 0;
            const int high = index[axis] + 1 < n[static_cast<std::size_t>(axis)] ? 1 : 0;
            const auto a = static_cast<std::size_t>(p + low * stride[axis]);
            const auto b = static_cast<std::size_t>(p + high * stride[axis]);
            d += now[at][static_cast<std::size_t>(axis)] * (now[b][c] - now[a][c]) /
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
