// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Paper/VorticesPart.h"

#include "Spacetime/Paper/FieldNormal.h"

#include <cmath>

namespace waft
{

double PartOfVortices(const SpacetimeObjective& objective, const StateVector& state,
                      bool solvesWind, const ParallelFor& parallel)
{
  const SpacetimeModel& model = objective.Model();
  const TimeLevel& level = objective.Level();
  const AirFields& fields = objective.Fields();
  if (!model.Air.IsEmpty())
  {
    return std::nan("");
  }
  AirFields alone; // the wind without vortices
  alone.Wind = fields.Wind;
  if (solvesWind && !fields.Vortices.empty())
  {
    FieldChoice choice;
    choice.Vortices = choice.VorticesAct = false;
    FieldNormal normal(model, fields, choice);
    (void)normal.Gather(objective, state, parallel);
    (void)normal.Solve(alone);
  }
  double with = 0.0, without = 0.0, still = 0.0;
  for (std::size_t j = 0; j + 1 < level.NumberOfFrames(); ++j)
  {
    const double step = level.Steps[j + 1];
    for (std::size_t o = 0; o < model.NumberOfObjects; ++o)
    {
      if (!StepHasLaw(model, level, j + 1, o))
      {
        continue;
      }
      const std::size_t i = model.NumberOfGas + o;
      const Vec3 x = VectorAt(state.data() + j * model.FrameSize() + i, model.Stride());
      Vec3 residual;
      objective.VelocityResidual(j + 1, i, residual.data());
      Vec3 field =
        fields.Wind.IsEmpty() ? Vec3::Zero() : SampleField(fields.Wind, x, level.Frames[j]);
      for (const Vortex& vortex : fields.Vortices)
      {
        field += vortex.Acceleration(x, level.Frames[j]);
      }
      const Vec3 asked = residual + step * field;
      const Vec3 wind =
        alone.Wind.IsEmpty() ? Vec3::Zero() : SampleField(alone.Wind, x, level.Frames[j]);
      const double weight = level.StepWeights[j + 1];
      with += weight * residual.squaredNorm();
      without += weight * (asked - step * wind).squaredNorm();
      still += weight * asked.squaredNorm();
    }
  }
  return still > 0.0 ? (without - with) / still : std::nan("");
}

} // namespace waft
