// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Field/AirSimulation.h"

#include "Air/Field/AirSampler.h"

#include <algorithm>
#include <utility>

namespace waft
{
namespace
{

// Where the points of a lattice lie between those of another along one axis: the lower of the two
// neighbours, the part of the way to the other one, held at the ends.
struct Neighbours
{
  std::vector<int> Low, High;
  std::vector<float> Part;

  Neighbours(const PointLattice& of, const PointLattice& among, int axis)
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

// Linear between the points that a field is given at.
void Interpolate(const PointLattice& from, const FieldSeries::Field& field,
                 const SeriesLattice& lattice, const ParallelFor& parallel,
                 FieldSeries::Field& values)
{
  const std::array<int, 3>& n = lattice.Dimensions;
  const Neighbours along[3] = { { lattice, from, 0 }, { lattice, from, 1 }, { lattice, from, 2 } };
  values.resize(lattice.NumberOfPoints());
  const auto row = [&](int j, int k)
  {
    return field.data() +
           (static_cast<std::size_t>(k) * from.Dimensions[1] + j) * from.Dimensions[0];
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
}

// Across a wall there is no velocity, nor any on the floor.
void StopAtWalls(const AirScene& scene, const SeriesLattice& lattice, FieldSeries::Field& values)
{
  std::size_t stride = 1;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto count = static_cast<std::size_t>(lattice.Dimensions[axis]);
    const auto stopAt = [&](std::size_t layer)
    {
      for (std::size_t first = layer * stride; first < values.size(); first += count * stride)
      {
        for (std::size_t i = first; i < first + stride; ++i)
        {
          values[i][axis] = 0.0f;
        }
      }
    };
    if (scene.Smoke.Boundary[axis] == BoundaryKind::Closed)
    {
      stopAt(0);
      stopAt(count - 1);
    }
    stride *= count;
  }
  StopAtFloor(lattice, values);
}

FieldSeries::Field OnLattice(const SmokeFrame& cells, const AirScene& scene,
                             const SeriesLattice& lattice, const ParallelFor& parallel)
{
  FieldSeries::Field values;
  Interpolate(cells, cells.Velocity, lattice, parallel, values);
  StopAtWalls(scene, lattice, values);
  return values;
}

} // namespace

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

void AppendAir(const AirScene& scene, const SmokeFrame& cells, double time,
               const ParallelFor& parallel, HalfSeries& air)
{
  air.Times.push_back(time);
  air.Values.emplace_back();
  air.Set(air.Values.size() - 1, OnLattice(cells, scene, air, parallel));
}

HalfSeries OnLattice(HalfSeries series, const SeriesLattice& lattice, const ParallelFor& parallel)
{
  if (series.IsEmpty() || series.Dimensions == lattice.Dimensions)
  {
    return series;
  }
  HalfSeries other(lattice);
  other.Meaning = series.Meaning;
  other.Times = series.Times;
  for (std::size_t f = 0; f < series.Values.size(); ++f)
  {
    FieldSeries::Field values;
    Interpolate(series, series.At(f), lattice, parallel, values);
    other.Values.emplace_back();
    other.Set(f, values);
  }
  return other;
}

Result SimulateAir(const AirScene& scene, AirSteering* steering, const ParallelFor& parallel,
                   Monitor& monitor, HalfSeries& air, const SmokeState* begun)
{
  SmokeSolver solver;
  WAFT_RETURN_IF_FAILED(solver.Begin(scene.Smoke, scene.Forces));
  air = AirLattice(scene, FieldMeaning::Velocity);
  SmokeFrame cells;
  for (int frame = 0; frame < scene.Time.NumberOfFrames; ++frame)
  {
    WAFT_RETURN_IF_FAILED(PlaceSolids(scene, frame, solver));
    if (frame == 0 && begun != nullptr)
    {
      WAFT_RETURN_IF_FAILED(solver.Restore(*begun));
    }
    if (frame == 0 && steering != nullptr)
    {
      const AirSampler wanted(steering->WantedAir());
      WAFT_RETURN_IF_FAILED(
        solver.SetVelocity([&](const Vec3& x) { return wanted.At(0, x); }, /*project=*/true));
    }
    if (solver.Frame() < frame)
    {
      PartMonitor step(monitor, static_cast<double>(frame) / scene.Time.NumberOfFrames,
                       (frame + 1.0) / scene.Time.NumberOfFrames);
      const Result stepped = solver.Step(parallel, step);
      if (!stepped || stepped.IsStopped())
      {
        return stepped;
      }
    }
    solver.ReadVelocity(cells);
    AppendAir(scene, cells, scene.Time.Time(frame), parallel, air);
    if (steering != nullptr)
    {
      solver.SetSteering(
        steering->At(frame, OnLattice(cells, scene, steering->WantedAir(), parallel), parallel));
    }
  }
  return Result::Ok();
}

} // namespace waft
