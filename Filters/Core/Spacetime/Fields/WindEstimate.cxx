// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Fields/WindEstimate.h"

#include <cmath>

namespace waft
{

std::array<int, 3> LatticeDimensions(const Vec3& cells)
{
  std::array<int, 3> dimensions;
  for (int a = 0; a < 3; ++a)
  {
    dimensions[a] = std::max(2, static_cast<int>(std::round(cells[a]))) + 2;
  }
  return dimensions;
}

std::array<int, 3> WindLatticeOf(const Vec3& size)
{
  constexpr double CellsAlongWidth = 5.0;
  return LatticeDimensions(size * CellsAlongWidth / size.maxCoeff());
}

SplineWind MakeLattice(const Vec3& size, const std::array<int, 3>& dimensions, double framesPerKnot)
{
  SplineWind lattice;
  lattice.Dimensions = dimensions;
  for (int a = 0; a < 3; ++a)
  {
    lattice.Spacing[a] = size[a] / (dimensions[a] - 2);
    lattice.Origin[a] = -0.5 * lattice.Spacing[a];
  }
  lattice.FramesPerKnot = framesPerKnot;
  return lattice;
}

SplineWind MakeWindLattice(const SpacetimeModel& model, double framesPerKnot)
{
  return MakeLattice(model.Size,
                     model.WindNodes[0] > 0 ? model.WindNodes : WindLatticeOf(model.Size),
                     framesPerKnot);
}

int KnotsOf(const SpacetimeModel& model, double framesPerKnot)
{
  return static_cast<int>(std::ceil((model.NumberOfFrames - 1) / framesPerKnot)) + 1;
}

SplineWind EstimateWind(const SpacetimeObjective& objective, const StateVector& state,
                        const WindOptions& options, const ParallelFor& parallel)
{
  const SpacetimeModel& model = objective.Model();
  const TimeLevel& level = objective.Level();
  const std::size_t stride = model.Stride();
  std::vector<SplineSamples> samples(level.NumberOfFrames());
  for (std::size_t j = 0; j < samples.size(); ++j)
  {
    samples[j].Frame = level.Frames[j];
  }
  const auto collect = [&](std::size_t j)
  {
    const double step = j + 1 < level.NumberOfFrames() ? level.Steps[j + 1] : 0.0;
    for (std::size_t i = 0; i < model.NumberOfBodies() && step > 0.0; ++i)
    {
      const bool gas = i < model.NumberOfGas;
      if ((gas && (i + 3 * j) % options.GasStride != 0) ||
          (!gas && StepIsBound(model, level, j + 1, i - model.NumberOfGas)))
      {
        continue;
      }
      const float* p = state.data() + j * model.FrameSize() + i;
      SplineSamples::Sample sample;
      sample.Position = VectorAt(p, stride);
      double rv[3];
      objective.VelocityResidual(j + 1, i, rv);
      sample.Value = Vec3(rv[0], rv[1], rv[2]) / step;
      if (!objective.Fields().Wind.IsEmpty())
      {
        sample.Value += SampleField(objective.Fields().Wind, sample.Position, level.Frames[j]);
      }
      sample.Weight = (gas ? options.GasStride : 1.0) * model.VelocityWeight(i) * step;
      samples[j].Samples.push_back(sample);
    }
  };
  parallel(samples.size(),
           [&](std::size_t begin, std::size_t end)
           {
             for (std::size_t j = begin; j < end; ++j)
             {
               collect(j);
             }
           });
  return FitSplineField(MakeWindLattice(model, options.FramesPerKnot),
                        KnotsOf(model, options.FramesPerKnot), samples, options.Fit, parallel);
}

} // namespace waft
