// SPDX-License-Identifier: BSD-3-Clause
#include "Vortex/VortexFit.h"

#include "Vortex/VortexRegion.h"
#include "Vortex/VortexSearch.h"

#include <cmath>
#include <exception>
#include <set>
#include <string>

namespace waft
{

namespace
{

constexpr std::size_t FewestSamples = 8; // 3 numbers each for 11 + 3 unknowns

struct Slot
{
  Vortex Value;
  Vortex Prior;
  bool Fitted = false;
  bool IsNew = false;
  std::set<int> Claims; // the VortexIds whose samples it takes
};

/// Passes ticks on with the fraction of the whole fit.
class ScaledMonitor : public Monitor
{
public:
  explicit ScaledMonitor(Monitor& outer) : Outer(outer) {}
  bool Tick(double, const std::string& text) override
  {
    return this->Outer.Tick(this->Fraction, text);
  }
  double Fraction = 0.0;

private:
  Monitor& Outer;
};

class Fitter
{
public:
  Fitter(const std::vector<VortexSample>& samples, const VortexFitOptions& options,
         Monitor& monitor) :
    Samples(samples),
    Options(options), Progress(monitor)
  {
  }

  void Run(const std::vector<Vortex>& priors, std::vector<Vortex>& fitted)
  {
    int nextId = 0;
    this->Sum.assign(this->Samples.size(), Vec3::Zero());
    for (const Vortex& prior : priors)
    {
      this->AddToSum(prior, 1.0);
      this->Slots.push_back({ prior, prior, false, false, { prior.VortexId } });
      nextId = std::max(nextId, prior.VortexId + 1);
    }
    for (const VortexSample& sample : this->Samples)
    {
      nextId = std::max(nextId, sample.VortexId + 1);
    }
    const int sweeps =
      priors.size() > 1 ? this->Options.Sweeps : 1; // one has no others to wait for
    for (int sweep = 0; sweep < sweeps && !this->Stopped; ++sweep)
    {
      for (std::size_t n = 0; n < this->Slots.size() && !this->Stopped; ++n)
      {
        this->Progress.Fraction =
          (sweep + static_cast<double>(n) / static_cast<double>(this->Slots.size())) / (sweeps + 1);
        this->Refit(n, sweep);
      }
      this->Merge();
    }
    this->Seek(nextId);
    fitted.clear();
    for (const Slot& slot : this->Slots)
    {
      fitted.push_back(slot.Value);
    }
  }

  bool IsStopped() const { return this->Stopped; }

private:
  /// What all vortices but one leave of the samples' accelerations. A prior that has not had its
  /// turn counts as well: it is the best that is known of it.
  std::vector<VortexSample> Remaining(const Vortex* except) const
  {
    std::vector<VortexSample> rest = this->Samples;
    for (std::size_t k = 0; k < rest.size(); ++k)
    {
      rest[k].Acceleration -= this->Sum[k];
      if (except)
      {
        rest[k].Acceleration += except->Acceleration(rest[k].Position, rest[k].Time);
      }
    }
    return rest;
  }

  /// Keeps Sum, the acceleration of all vortices at the samples, in step.
  void AddToSum(const Vortex& vortex, double factor)
  {
    for (std::size_t k = 0; k < this->Samples.size(); ++k)
    {
      this->Sum[k] +=
        factor * vortex.Acceleration(this->Samples[k].Position, this->Samples[k].Time);
    }
  }

  void Record(const VortexSearchResult& found, const std::vector<VortexSample>& used, Slot& slot)
  {
    FromParameters(found.Parameters, slot.Value);
    slot.Value.ObjectCount = CountWitnesses(slot.Value, used);
    const double witnesses = slot.Value.ObjectCount >= 3   ? 1.0
                             : slot.Value.ObjectCount == 2 ? 0.7
                             : slot.Value.ObjectCount == 1 ? 0.3
                                                           : 0.0;
    slot.Value.Confidence = found.Explained * found.Precision * witnesses;
    slot.Fitted = true;
  }

  void Refit(std::size_t n, int sweep)
  {
    Slot& slot = this->Slots[n];
    const std::vector<VortexSample> rest = this->Remaining(&slot.Value);
    const std::vector<VortexSample> used =
      SamplesOf(slot.Value, slot.Claims, rest, this->Options.Bounds.Width());
    if (used.size() < FewestSamples)
    {
      if (!slot.Fitted)
      {
        slot.Value.ObjectCount = 0;
      }
      return;
    }
    const VortexParameters belief = ToParameters(slot.IsNew ? slot.Value : slot.Prior);
    VortexFitOptions options = this->Options;
    if (sweep > 0)
    {
      options.NumberOfStarts = 1; // from where it is: only the others have changed
    }
    const VortexParameters start = ToParameters(slot.Value);
    const auto stream = static_cast<std::uint64_t>(slot.Value.VortexId);
    const VortexSearchResult found =
      SearchVortex(used, sweep > 0 ? &start : &belief, slot.IsNew ? nullptr : &belief, options,
                   stream, this->Progress, this->Stopped);
    this->AddToSum(slot.Value, -1.0);
    this->Record(found, used, slot);
    this->AddToSum(slot.Value, 1.0);
  }

  /// Merges later vortices into earlier ones.
  void Merge()
  {
    for (std::size_t a = 0; a < this->Slots.size(); ++a)
    {
      for (std::size_t b = a + 1; b < this->Slots.size();)
      {
        Slot& first = this->Slots[a];
        Slot& second = this->Slots[b];
        if (!first.Fitted || !second.Fitted ||
            !AreDuplicates(first.Value, second.Value, this->Options))
        {
          ++b;
          continue;
        }
        // Each was fitted to what the other leaves, so together they act with both strengths.
        const double sign =
          (first.Value.P2 - first.Value.P1).dot(second.Value.P2 - second.Value.P1) < 0.0 ? -1.0
                                                                                         : 1.0;
        this->AddToSum(first.Value, -1.0);
        this->AddToSum(second.Value, -1.0);
        first.Value.Strength += sign * second.Value.Strength;
        this->AddToSum(first.Value, 1.0);
        first.Claims.insert(second.Claims.begin(), second.Claims.end());
        this->Slots.erase(this->Slots.begin() + static_cast<std::ptrdiff_t>(b));
        first.Prior.Strength = first.Value.Strength;
        this->Refit(a, 1);
      }
    }
  }

  /// New vortices in what remains, where most energy is.
  void Seek(int nextId)
  {
    if (this->Options.MaximumNewVortices == 0)
    {
      return;
    }
    std::vector<VortexSample> rest = this->Remaining(nullptr);
    int tries = 3 * this->Options.MaximumNewVortices;
    int added = 0;
    while (added < this->Options.MaximumNewVortices && tries-- > 0 && !this->Stopped)
    {
      this->Progress.Fraction = 0.7 + 0.3 * added / this->Options.MaximumNewVortices;
      std::vector<std::size_t> region;
      const std::vector<VortexSample> seed =
        StrongestRegion(rest, this->Options.Bounds.Width(), region);
      if (seed.size() < FewestSamples)
      {
        return;
      }
      Slot slot;
      slot.IsNew = true;
      slot.Value.VortexId = nextId;
      VortexSearchResult found =
        SearchVortex(seed, nullptr, nullptr, this->Options, static_cast<std::uint64_t>(nextId),
                     this->Progress, this->Stopped);
      this->Record(found, seed, slot);
      // Once more with all that feel it, wherever they were found.
      const std::vector<VortexSample> felt =
        SamplesOf(slot.Value, {}, rest, this->Options.Bounds.Width());
      if (felt.size() >= FewestSamples && !this->Stopped)
      {
        const VortexParameters start = found.Parameters;
        found = SearchVortex(felt, &start, nullptr, this->Options,
                             static_cast<std::uint64_t>(nextId), this->Progress, this->Stopped);
        this->Record(found, felt, slot);
      }
      if (found.Explained >= this->Options.MinimumGain && slot.Value.ObjectCount > 0)
      {
        for (VortexSample& sample : rest)
        {
          sample.Acceleration -= slot.Value.Acceleration(sample.Position, sample.Time);
        }
        this->AddToSum(slot.Value, 1.0);
        this->Slots.push_back(slot);
        ++nextId;
        ++added;
      }
      else
      {
        for (const std::size_t n : region)
        {
          rest[n].Weight = 0.0; // nothing of this shape is to be found here
        }
      }
    }
    for (std::size_t n = 0; n < this->Slots.size() && !this->Stopped; ++n)
    {
      if (this->Slots[n].IsNew)
      {
        this->Refit(n, 1);
      }
    }
    this->Merge();
  }

  const std::vector<VortexSample>& Samples;
  const VortexFitOptions& Options;
  ScaledMonitor Progress;
  std::vector<Slot> Slots;
  std::vector<Vec3> Sum;
  bool Stopped = false;
};

Result Check(const std::vector<VortexSample>& samples, const std::vector<Vortex>& priors)
{
  for (std::size_t n = 0; n < samples.size(); ++n)
  {
    const VortexSample& s = samples[n];
    if (!s.Position.allFinite() || !s.Acceleration.allFinite() || !std::isfinite(s.Time) ||
        !std::isfinite(s.Weight) || s.Weight < 0.0)
    {
      return Result::Error("vortex fit: sample " + std::to_string(n) + " (track " +
                           std::to_string(s.Track) + ", frame " + std::to_string(s.Frame) +
                           ") holds a number that is not finite, or a negative weight");
    }
  }
  std::set<int> ids;
  for (const Vortex& v : priors)
  {
    const std::string name = "vortex fit: vortex " + std::to_string(v.VortexId);
    if (!v.P1.allFinite() || !v.P2.allFinite() || !std::isfinite(v.Strength) ||
        !std::isfinite(v.CenterTime) || !((v.P2 - v.P1).norm() > 0.0) || !(v.Duration > 0.0) ||
        !(v.CoreRadius > 0.0) || !std::isfinite(v.Duration) || !std::isfinite(v.CoreRadius))
    {
      return Result::Error(name + ": expected finite numbers, poles apart, and a positive duration "
                                  "and core radius");
    }
    if (v.VortexId < 0 || !ids.insert(v.VortexId).second)
    {
      return Result::Error(name + ": expected ids from 0, each used once");
    }
  }
  return Result::Ok();
}

} // namespace

Result VortexFitOptions::Validate() const
{
  const auto bad = [](const char* what)
  { return Result::Error(std::string("vortex fit: ") + what); };
  if (!this->Bounds.Min.allFinite() || !this->Bounds.Max.allFinite() ||
      this->Bounds.Size().minCoeff() <= 0.0)
  {
    return bad("Bounds, expected a box with positive sides");
  }
  WAFT_RETURN_IF_FAILED(ValidateFields<VortexFitOptions>(*this));
  if (this->MaximumSamples < 30)
  {
    return bad("MaximumSamples, expected 30 or more");
  }
  const double pairs[][2] = { { this->MinimumDuration, this->MaximumDuration },
                              { this->MinimumCoreRadius, this->MaximumCoreRadius },
                              { this->MinimumLength, this->MaximumLength } };
  for (const auto& pair : pairs)
  {
    if (!(pair[0] > 0.0 && pair[0] < pair[1] && std::isfinite(pair[1])))
    {
      return bad("bounds of duration, core radius and length, expected 0 < minimum < maximum");
    }
  }
  for (const double deviation :
       { this->CenterDeviation, this->AxisDeviation, this->StrengthDeviation, this->TimeDeviation,
         this->ShapeDeviation, this->MaximumStrength })
  {
    if (!(deviation > 0.0 && std::isfinite(deviation)))
    {
      return bad("deviations and MaximumStrength, expected positive numbers");
    }
  }
  return Result::Ok();
}

Result FitVortices(const std::vector<VortexSample>& samples, const std::vector<Vortex>& priors,
                   const VortexFitOptions& options, Monitor& monitor, std::vector<Vortex>& fitted)
{
  if (Result result = options.Validate(); !result)
  {
    return result;
  }
  if (Result result = Check(samples, priors); !result)
  {
    return result;
  }
  try
  {
    Fitter fitter(samples, options, monitor);
    fitter.Run(priors, fitted);
    return fitter.IsStopped() ? Result::Stopped() : Result::Ok();
  }
  catch (const std::exception& error)
  {
    return Result::Error(std::string("vortex fit: ") + error.what());
  }
}

} // namespace waft
