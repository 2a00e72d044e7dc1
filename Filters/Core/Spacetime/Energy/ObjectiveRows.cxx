// SPDX-License-Identifier: BSD-3-Clause
// What is read out of the objective's rows, and the state of its lists.
#include "Spacetime/Energy/SpacetimeObjective.h"

#include <algorithm>

namespace waft
{

void SpacetimeObjective::VelocityResidual(std::size_t j, std::size_t body, double rv[3]) const
{
  const double weight = this->Problem.VelocityWeight(body) * this->Times.StepWeights[j];
  for (int c = 0; c < 3; ++c)
  {
    rv[c] = weight > 0.0 ? this->Row(j, 1, c)[body] / weight : 0.0;
  }
}

void SpacetimeObjective::ObjectResiduals(std::vector<double>& ex, std::vector<double>& ev,
                                         std::vector<int>& steps) const
{
  const SpacetimeModel& model = this->Problem;
  ex.assign(model.NumberOfObjects, 0.0);
  ev.assign(model.NumberOfObjects, 0.0);
  steps.assign(model.NumberOfObjects, 0);
  for (std::size_t j = 1; j < this->Times.NumberOfFrames(); ++j)
  {
    for (std::size_t o = 0; o < model.NumberOfObjects; ++o)
    {
      if (this->Bound[j * model.NumberOfObjects + o])
      {
        continue;
      }
      const std::size_t i = model.NumberOfGas + o;
      const double stepWeight = this->Times.StepWeights[j];
      const double weightX = model.BodyWeight(i) * model.Weights.ObjectPosition *
                             model.Weights.PositionWeight * stepWeight;
      const double weightV = model.VelocityWeight(i) * stepWeight;
      for (int c = 0; c < 3; ++c)
      {
        const double rx = this->Row(j, 0, c)[i] / std::max(1e-12, weightX);
        const double rv = this->Row(j, 1, c)[i] / std::max(1e-12, weightV);
        ex[o] += 0.5 * rx * rx;
        ev[o] += 0.5 * rv * rv;
      }
      ++steps[o];
    }
  }
}

void SpacetimeObjective::ShareFrame(FrameTerms& terms, const StateVector& moving, std::size_t j)
{
  const SpacetimeModel& model = this->Problem;
  SpacetimeTerms& sums = this->FrameSums[j];
  sums.Motion = sums.ByVortices = sums.ByWind = sums.ByGas = sums.ByDrag = sums.ByLanding = 0.0;
  sums.VorticesSquared = sums.WindSquared = sums.GasSquared = sums.DragSquared = 0.0;
  sums.LandingSquared = sums.NoneSquared = 0.0;
  const bool last = j + 1 == this->Times.NumberOfFrames();
  for (std::size_t o = 0; o < model.NumberOfObjects && !last && model.Air.IsEmpty(); ++o)
  {
    if (!this->HasLaw[(j + 1) * model.NumberOfObjects + o])
    {
      continue;
    }
    const std::size_t i = model.NumberOfGas + o;
    for (int c = 0; c < 3; ++c)
    {
      const float* v = moving.data() + this->Offset(j) + (3 + c) * model.Stride() + i;
      const double a = (static_cast<double>(v[model.FrameSize()]) - *v) / this->Times.Steps[j + 1];
      const double vortices = terms.ByVortices(c)[i];
      const double wind = terms.External(c)[i] - vortices;
      const double drag = static_cast<double>(model.DragRates[o]) * terms.Average(c)[i] -
                          (c == 2 ? model.Gravities[o] : 0.0f);
      const double landing = terms.ByLanding(o)[c];
      const double gas = terms.Acceleration(c)[i] - vortices - wind - drag - landing;
      const double none = a - terms.Acceleration(c)[i];
      sums.Motion += a * a;
      sums.ByVortices += vortices * a;
      sums.ByWind += wind * a;
      sums.ByDrag += drag * a;
      sums.ByLanding += landing * a;
      sums.ByGas += gas * a;
      sums.VorticesSquared += vortices * vortices;
      sums.WindSquared += wind * wind;
      sums.GasSquared += gas * gas;
      sums.DragSquared += drag * drag;
      sums.LandingSquared += landing * landing;
      sums.NoneSquared += none * none;
    }
  }
}

} // namespace waft
