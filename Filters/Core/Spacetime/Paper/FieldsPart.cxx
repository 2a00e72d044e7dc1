// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Paper/FieldsPart.h"

#include <cmath>
#include <vector>

namespace waft
{
namespace
{

constexpr std::size_t OneIn = 5, Left = 2; // every fifth body is left out, the third first

/// Sums of squares over free steps: of what is asked of the fields, and of what they leave.
struct FieldSums
{
  double Asked = 0.0, Remains = 0.0;

  double Explained() const { return 1.0 - this->Remains / this->Asked; } // 0 / 0 of no bodies
  void Add(const FieldSums& other)
  {
    this->Asked += other.Asked;
    this->Remains += other.Remains;
  }
};

Vec3 FieldAt(const AirFields& fields, const Vec3& x, int frame)
{
  Vec3 sum = fields.Wind.IsEmpty() ? Vec3::Zero() : SampleField(fields.Wind, x, frame);
  for (const Vortex& vortex : fields.Vortices)
  {
    sum += vortex.Acceleration(x, frame);
  }
  return sum;
}

/// With other fields than the objective's, by groups of bodies; a group is an index or beyond.
template <std::size_t N, class Group>
std::array<FieldSums, N> SumsOf(const SpacetimeObjective& objective, const StateVector& state,
                                const AirFields& tried, const Group& groupOf,
                                const ParallelFor& parallel)
{
  const SpacetimeModel& model = objective.Model();
  const TimeLevel& level = objective.Level();
  std::vector<std::array<FieldSums, N>> byFrame(level.NumberOfFrames() - 1);
  const auto addFrame = [&](std::size_t j)
  {
    const double step = level.Steps[j + 1];
    for (std::size_t i = 0; i < model.NumberOfBodies(); ++i)
    {
      const std::size_t group = groupOf(i);
      const bool isObject = i >= model.NumberOfGas;
      if (group >= N || (isObject && !StepHasLaw(model, level, j + 1, i - model.NumberOfGas)))
      {
        continue;
      }
      const Vec3 x = VectorAt(state.data() + j * model.FrameSize() + i, model.Stride());
      Vec3 asked;
      objective.VelocityResidual(j + 1, i, asked.data());
      asked += step * FieldAt(objective.Fields(), x, level.Frames[j]);
      const Vec3 remains = asked - step * FieldAt(tried, x, level.Frames[j]);
      const double weight = model.BodyWeight(i) * level.StepWeights[j + 1];
      byFrame[j][group].Add({ weight * asked.squaredNorm(), weight * remains.squaredNorm() });
    }
  };
  parallel(byFrame.size(),
           [&](std::size_t begin, std::size_t end)
           {
             for (std::size_t j = begin; j < end; ++j)
             {
               addFrame(j);
             }
           });
  std::array<FieldSums, N> sums;
  for (const std::array<FieldSums, N>& frame : byFrame)
  {
    for (std::size_t group = 0; group < N; ++group)
    {
      sums[group].Add(frame[group]);
    }
  }
  return sums;
}

} // namespace

double PartOfVortices(const SpacetimeObjective& objective, const StateVector& state,
                      bool solvesWind, const ParallelFor& parallel)
{
  const SpacetimeModel& model = objective.Model();
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
  const auto objects = [&](std::size_t body) { return body < model.NumberOfGas ? 1u : 0u; };
  const FieldSums with = SumsOf<1>(objective, state, fields, objects, parallel)[0];
  const FieldSums without = SumsOf<1>(objective, state, alone, objects, parallel)[0];
  return (without.Remains - with.Remains) / with.Asked;
}

FieldsPart PartOfFields(const SpacetimeObjective& objective, const StateVector& state,
                        const FieldChoice& choice, const ParallelFor& parallel)
{
  const SpacetimeModel& model = objective.Model();
  FieldsPart part;
  if (!model.Air.IsEmpty() || (!choice.Vortices && !choice.Wind))
  {
    return part;
  }
  const auto isLeftOut = [&](std::size_t body)
  { return (body < model.NumberOfGas ? body : body - model.NumberOfGas) % OneIn == Left; };
  FieldChoice counted = choice;
  counted.Counts = [&](std::size_t body) { return !isLeftOut(body); };
  AirFields solved = objective.Fields();
  FieldNormal normal(model, solved, counted);
  (void)normal.Gather(objective, state, parallel);
  (void)normal.Solve(solved);
  const auto groupOf = [&](std::size_t body)
  { return (body < model.NumberOfGas ? 2u : 0u) + (isLeftOut(body) ? 1u : 0u); };
  const auto sums = SumsOf<4>(objective, state, solved, groupOf, parallel);
  for (std::size_t n = 0; n < 2; ++n)
  {
    const FieldSums &objects = sums[n], &gas = sums[2 + n];
    FieldSums all = objects;
    all.Add(gas);
    part.All[n] = all.Explained();
    part.Objects[n] = objects.Explained();
    part.Gas[n] = gas.Explained();
  }
  return part;
}

} // namespace waft
