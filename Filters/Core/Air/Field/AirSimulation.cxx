// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Field/AirSimulation.h"

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

// The cells' velocities at the points of the lattice; across a wall there is none, nor on the
// floor.
void Restrict(const SmokeFrame& cells, const AirScene& scene, const SeriesLattice& lattice,
              const ParallelFor& parallel, FieldSeries::Field& values)
{
  const std::array<int, 3>& n = lattice.Dimensions;
  const Neighbours along[3] = { { lattice, cells, 0 },
                                { lattice, cells, 1 },
                                { lattice, cells, 2 } };
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
           (static_cast<std::size_t>(k) * cells.Dimensions[1] + j) * cells.Dimensions[0];
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

void AppendAir(const AirScene& scene, const SmokeSolver& solver, const ParallelFor& parallel,
               HalfSeries& air)
{
  SmokeFrame cells;
  solver.ReadVelocity(cells);
  FieldSeries::Field values;
  Restrict(cells, scene, air, parallel, values);
  air.Times.push_back(solver.Time());
  air.Values.emplace_back();
  air.Set(air.Values.size() - 1, values);
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
    if (frame == 0 && begun != nullptr)
    {
      *begun = solver.Save();
    }
    FieldSeries::Field values;
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
      solver.SetSteering(steering->At(frame, values, parallel));
    }
    air.Times.push_back(scene.Time.Time(frame));
    air.Values.push_back(steering != nullptr ? steering->TakeSpare() : std::vector<Half3>());
    air.Set(static_cast<std::size_t>(frame), values);
  }
  return Result::Ok();
}

} // namespace waft
