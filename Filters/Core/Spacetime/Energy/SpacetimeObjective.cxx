// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Energy/SpacetimeObjective.h"

#include "Base/FractionDone.h"
#include "Spacetime/Energy/ObjectTerms.h"

#include <algorithm>
#include <cmath>

namespace waft
{

struct SpacetimeObjective::Worker
{
  Worker(const SpacetimeModel& model, const AirFields& fields, const TimeLevel& level,
         const SphKernelTable& kernels) :
    Terms(model, fields, FluidOf(model, level), kernels)
  {
  }
  FrameTerms Terms;
  NeighbourList List; // of the frame at hand, where lists are not kept
};

SpacetimeObjective::SpacetimeObjective(const SpacetimeModel& model, const AirFields& fields,
                                       const TimeLevel& level, const ParallelFor& parallel,
                                       const SphKernelTable& kernels, bool keepsLists) :
  Problem(model),
  Acting(fields), Times(level), Parallel(parallel), Kernels(kernels), KeepsLists(keepsLists)
{
  const double self = model.Fluid.GasMass * model.Fluid.Kernel(0.0);
  this->SpatialScale = 1.0 / ((1.0 - self) * (1.0 - self));
  const std::size_t frames = level.NumberOfFrames();
  this->Lists.resize(keepsLists ? frames : 0);
  this->FrameSums.resize(frames);
  this->Bound.assign(frames * model.NumberOfObjects, 0);
  this->HasLaw.assign(frames * model.NumberOfObjects, 0);
  for (std::size_t j = 1; j < frames; ++j)
  {
    for (std::size_t o = 0; o < model.NumberOfObjects; ++o)
    {
      this->Bound[j * model.NumberOfObjects + o] = StepIsBound(model, level, j, o) ? 1 : 0;
      this->HasLaw[j * model.NumberOfObjects + o] = StepHasLaw(model, level, j, o) ? 1 : 0;
    }
  }
  for (std::size_t j = 0; j < frames; ++j)
  {
    for (std::size_t o = 0; o < model.NumberOfObjects; ++o)
    {
      this->Smoothness.push_back(
        static_cast<float>(SmoothnessWeight(model, level, j, static_cast<long>(o))));
    }
  }
}

SpacetimeObjective::~SpacetimeObjective() = default;

std::unique_ptr<SpacetimeObjective::Worker> SpacetimeObjective::Borrow()
{
  {
    const std::lock_guard<std::mutex> lock(this->PoolMutex);
    if (!this->Pool.empty())
    {
      auto worker = std::move(this->Pool.back());
      this->Pool.pop_back();
      return worker;
    }
  }
  return std::make_unique<Worker>(this->Problem, this->Acting, this->Times, this->Kernels);
}

void SpacetimeObjective::Return(std::unique_ptr<Worker> worker)
{
  const std::lock_guard<std::mutex> lock(this->PoolMutex);
  this->Pool.push_back(std::move(worker));
}

NeighbourList& SpacetimeObjective::ListOf(Worker& worker, std::size_t j)
{
  if (this->KeepsLists)
  {
    return this->Lists[j];
  }
  worker.List = NeighbourList();
  return worker.List;
}

FrameTerms& SpacetimeObjective::ForwardFrame(const StateVector& state, std::size_t j)
{
  if (this->Pool.empty())
  {
    this->Pool.push_back(
      std::make_unique<Worker>(this->Problem, this->Acting, this->Times, this->Kernels));
  }
  FrameTerms& terms = this->Pool.front()->Terms;
  const double step = j + 1 < this->Times.NumberOfFrames() ? this->Times.Steps[j + 1] : 1.0;
  const SpacetimeModel& model = this->Problem;
  const float* moving = state.data() + this->Offset(j);
  std::vector<float> deviations;
  if (!model.Air.IsEmpty())
  {
    deviations.resize(model.FrameSize());
    model.Air.Deviations(moving, model.NumberOfBodies(), model.Stride(), this->Times.Frames[j],
                         this->Times.Steps[j], deviations.data(), nullptr);
    moving = deviations.data();
  }
  terms.Forward(moving, this->Times.Frames[j], step, this->ListOf(*this->Pool.front(), j));
  return terms;
}

std::size_t SpacetimeObjective::NumberOfPairs() const
{
  std::size_t sum = 0;
  for (const NeighbourList& list : this->Lists)
  {
    sum += list.NumberOfEntries();
  }
  return sum;
}

bool SpacetimeObjective::Chunked(Monitor* monitor, double from, double to,
                                 const std::function<void(std::size_t, std::size_t)>& body)
{
  const std::size_t frames = this->Times.NumberOfFrames();
  // About 0.1 s of one core between two calls of the monitor.
  const std::size_t chunk =
    std::max<std::size_t>(2, 600000 / std::max<std::size_t>(1, this->Problem.NumberOfParticles()));
  for (std::size_t first = 0; first < frames; first += chunk)
  {
    const std::size_t size = std::min(chunk, frames - first);
    this->Parallel(size,
                   [&](std::size_t begin, std::size_t end) { body(first + begin, first + end); });
    const double fraction = FractionDone(first + size, frames);
    if (monitor && !monitor->Tick(from + (to - from) * fraction, {}))
    {
      return false;
    }
  }
  return true;
}

void SpacetimeObjective::SphFrame(Worker& worker, const StateVector& state,
                                  const StateVector& moving, std::size_t j, StateVector* gradient)
{
  const SpacetimeModel& model = this->Problem;
  const SpacetimeWeights& weights = model.Weights;
  const std::size_t stride = model.Stride();
  const std::size_t ng = model.NumberOfGas;
  const bool last = j + 1 == this->Times.NumberOfFrames();
  const float* here = state.data() + this->Offset(j);
  const float* deviations = moving.data() + this->Offset(j);
  FrameTerms& terms = worker.Terms;
  const double step = last ? 0.0 : this->Times.Steps[j + 1];
  NeighbourList& list = this->ListOf(worker, j);
  terms.Forward(deviations, this->Times.Frames[j], last ? 1.0 : step, list);

  const double stepWeight = last ? 0.0 : this->Times.StepWeights[j + 1];
  const float wx = static_cast<float>(weights.PositionWeight * stepWeight);
  const float wv = static_cast<float>(weights.VelocityWeight * stepWeight);
  const float ws = static_cast<float>(weights.CoherenceWeight * weights.SpatialShare *
                                      this->SpatialScale * this->Times.FrameWeights[j]);
  const auto s = static_cast<float>(step);
  const auto eps = static_cast<float>(weights.XsphFactor);
  const auto objectStep = static_cast<float>(weights.ObjectPosition);
  const auto objectAir = static_cast<float>(weights.ObjectCoherence);
  double ex = 0.0, ev = 0.0, ec = 0.0, evObjects = 0.0;
  double exPlain = 0.0, ecPlain = 0.0; // objects as gas
  for (int c = 0; c < 3; ++c)
  {
    const float* x = here + c * stride;
    const float* xn = x + model.FrameSize();
    const float* vn = xn + 3 * stride;
    const float* w = deviations + (3 + c) * stride;
    const float* wn = w + model.FrameSize();
    const float* a = terms.Acceleration(c);
    const float* d = terms.Average(c);
    float* abar = terms.AccelerationBar(c);
    float* dbar = terms.AverageBar(c);
    float* outX = last ? nullptr : this->Row(j + 1, 0, c);
    float* outV = last ? nullptr : this->Row(j + 1, 1, c);
    const auto add = [&](std::size_t i, float weight, float own, float flight, float law, float air,
                         float airPlain, float slip)
    {
      const float rs = d[i] - slip;
      ec += static_cast<double>(weight * air * rs) * rs;
      ecPlain += static_cast<double>(weight * airPlain * rs) * rs;
      float byAverage = weight * air * ws * rs;
      float byAcceleration = 0.0f;
      if (!last)
      {
        const float rx = flight * ((xn[i] - x[i]) - s * (vn[i] + eps * d[i]));
        const float rv = law * ((wn[i] - w[i]) - s * a[i]);
        ex += static_cast<double>(own * weight * rx) * rx;
        exPlain += static_cast<double>(weight * rx) * rx;
        ev += static_cast<double>(weight * rv) * rv;
        const float byX = own * weight * wx * rx;
        const float byV = weight * wv * rv;
        outX[i] = byX;
        outV[i] = byV;
        byAcceleration = -s * byV;
        byAverage -= s * eps * byX;
      }
      abar[i] = byAcceleration;
      dbar[i] = byAverage;
    };
    for (std::size_t i = 0; i < ng; ++i)
    {
      add(i, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 0.0f);
    }
    const double ofGas = ev;
    for (std::size_t o = 0; o < model.NumberOfObjects; ++o)
    {
      const bool isBound = !last && this->Bound[(j + 1) * model.NumberOfObjects + o];
      const bool hasLaw = last || this->HasLaw[(j + 1) * model.NumberOfObjects + o];
      const float fraction = model.CoherenceFraction(this->Times.Frames[j], o);
      add(ng + o, static_cast<float>(model.Offsets.size()), objectStep, isBound ? 0.0f : 1.0f,
          hasLaw ? 1.0f : 0.0f, objectAir * fraction, fraction,
          c == 2 ? model.SettlingSlip(o) : 0.0f);
    }
    evObjects += ev - ofGas;
  }
  SpacetimeTerms& sums = this->FrameSums[j];
  sums.Ex = 0.5 * stepWeight * ex;
  sums.Ev = 0.5 * stepWeight * ev;
  sums.EvObjects = 0.5 * stepWeight * evObjects;
  const double spatial =
    0.5 * weights.SpatialShare * this->SpatialScale * this->Times.FrameWeights[j];
  sums.Ec = spatial * ec;
  sums.E2 = weights.PositionWeight * 0.5 * stepWeight * exPlain + weights.VelocityWeight * sums.Ev +
            weights.CoherenceWeight * spatial * ecPlain;
  this->ShareFrame(terms, moving, j);
  if (gradient)
  {
    float* g = gradient->data() + this->Offset(j);
    std::fill(g, g + model.FrameSize(), 0.0f);
    terms.Adjoint(g);
  }
  const double crowding = weights.Separation * this->Times.FrameWeights[j];
  sums.Separation =
    crowding * terms.Crowding(static_cast<float>(crowding),
                              gradient ? gradient->data() + this->Offset(j) : nullptr);
}

void SpacetimeObjective::SmoothRow(const StateVector& moving, std::size_t j)
{
  const SpacetimeModel& model = this->Problem;
  const std::size_t stride = model.Stride();
  const std::size_t ng = model.NumberOfGas;
  const double fraction = 1.0 - model.Weights.SpatialShare;
  const double w = this->Times.SmoothWeights[j];
  const auto factor = static_cast<float>(SmoothnessWeight(model, this->Times, j, -1));
  const bool inAir = !model.Air.IsEmpty();
  double sum = 0.0, control = 0.0;
  for (int c = 0; c < 3; ++c)
  {
    float* r = this->Row(j, 2, c);
    const auto row = [&](std::size_t k)
    { return moving.data() + this->Offset(k) + (3 + c) * stride; };
    std::copy(row(j), row(j) + model.NumberOfBodies(), r);
    for (const TimeLevel::Neighbour& neighbour : this->Times.Rows[j])
    {
      const float* v = row(neighbour.Frame);
      const auto coefficient = static_cast<float>(neighbour.Coefficient);
      for (std::size_t i = 0; i < model.NumberOfBodies(); ++i)
      {
        r[i] -= coefficient * v[i];
      }
    }
    for (std::size_t i = 0; i < ng; ++i)
    {
      sum += static_cast<double>(r[i]) * r[i];
      r[i] *= factor;
    }
    const auto weight = static_cast<float>(model.Offsets.size());
    for (std::size_t o = 0; o < model.NumberOfObjects; ++o)
    {
      float& value = r[ng + o];
      const float own = this->Smoothness[j * model.NumberOfObjects + o];
      const double square = static_cast<double>(weight * value) * value;
      if (inAir)
      {
        control += own * square;
      }
      else
      {
        sum += square;
      }
      value *= weight * own;
    }
  }
  this->FrameSums[j].Ec += 0.5 * fraction * w * sum;
  this->FrameSums[j].E2 += model.Weights.CoherenceWeight * 0.5 * fraction * w * sum;
  this->FrameSums[j].Control = 0.5 * control;
}

void SpacetimeObjective::ObjectFrame(const StateVector& state, std::size_t j, StateVector* gradient)
{
  const double weight = this->Times.FrameWeights[j];
  const ObjectTerms terms =
    AddObjectTerms(this->Problem, this->Times.Frames[j], weight, state.data() + this->Offset(j),
                   gradient ? gradient->data() + this->Offset(j) : nullptr);
  SpacetimeTerms& sums = this->FrameSums[j];
  sums.Clearance = weight * terms.Clearance;
  sums.Approach = weight * terms.Approach;
  sums.Contact = weight * terms.Contact;
  sums.Penalties =
    sums.Separation + sums.Control + weight * (terms.Clearance + terms.Approach + terms.Contact);
}

SpacetimeTerms SpacetimeObjective::Sum() const
{
  SpacetimeTerms terms;
  for (const SpacetimeTerms& sum : this->FrameSums)
  {
    SpacetimeTerms::Visit([](double& all, double one) { all += one; }, terms, sum);
  }
  const SpacetimeWeights& w = this->Problem.Weights;
  terms.E = w.PositionWeight * terms.Ex + w.VelocityWeight * terms.Ev +
            w.CoherenceWeight * terms.Ec + terms.Penalties + this->Acting.Cost;
  terms.Fields = this->Acting.Cost;
  return terms;
}

bool SpacetimeObjective::Evaluate(const StateVector& state, StateVector* gradient,
                                  SpacetimeTerms& terms, Monitor* monitor,
                                  const FrameVisitor& visit)
{
  ++this->Evaluations;
  const std::size_t frames = this->Times.NumberOfFrames();
  this->Residuals.resize(frames * 9 * this->Problem.Stride(), 0.0f);
  const StateVector& moving = this->TakeDeviations(state);
  const bool done = this->Chunked(monitor, 0.0, 0.9,
                                  [&](std::size_t begin, std::size_t end)
                                  {
                                    auto worker = this->Borrow();
                                    for (std::size_t j = begin; j < end; ++j)
                                    {
                                      this->SphFrame(*worker, state, moving, j, gradient);
                                      this->SmoothRow(moving, j);
                                      this->ObjectFrame(state, j, gradient);
                                      if (visit)
                                      {
                                        visit(j, worker->Terms);
                                      }
                                    }
                                    this->Return(std::move(worker));
                                  });
  if (!done)
  {
    return false;
  }
  if (gradient)
  {
    this->Parallel(frames,
                   [&](std::size_t begin, std::size_t end)
                   {
                     for (std::size_t j = begin; j < end; ++j)
                     {
                       this->GatherFrame(j, *gradient);
                     }
                   });
  }
  terms = this->Sum();
  return true;
}

} // namespace waft
