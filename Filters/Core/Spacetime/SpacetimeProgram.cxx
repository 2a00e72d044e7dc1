// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/SpacetimeProgram.h"

#include "Spacetime/TimeLevels.h"

#include <cstdio>

namespace waft
{
namespace
{

constexpr int LeashSteps = 5;           // radii 0.01 L 2^k, k = 0..4
constexpr double FirstLeash = 0.01;     // of L
constexpr int CoarseStride = 2;         // frames; a larger one lets gas escape
constexpr double WorthCoarsening = 0.8; // a coarse level has fewer frames than this share of all

SpacetimeStep Minimise(bool coarse, int pass, std::string name, int iterations, double leash = 0.0)
{
  SpacetimeStep step;
  step.IsCoarse = coarse;
  step.Pass = pass;
  step.Name = std::move(name);
  step.Iterations = iterations;
  step.Leash = leash;
  return step;
}

SpacetimeStep Update(bool coarse, int pass, bool vortices)
{
  SpacetimeStep step;
  step.IsCoarse = coarse;
  step.IsUpdate = true;
  step.Pass = pass;
  step.FitsVortices = vortices;
  return step;
}

/// Of each of the two stages that follow large changes made for less work.
int LastIterations(const SpacetimeOptions& options)
{
  return (options.MaximumNumberOfIterations + 2) / 3;
}

void AddLast(const std::string& name, int pass, int iterations, bool vortices,
             std::vector<SpacetimeStep>& steps)
{
  steps.push_back(Minimise(false, pass, name + " a", iterations));
  steps.push_back(Update(false, pass, vortices));
  steps.push_back(Minimise(false, pass, name + " b", iterations));
}

} // namespace

double SpacetimeProgram::Work(std::size_t first, int numberOfFrames) const
{
  double work = 0.0;
  for (std::size_t k = first; k < this->Steps.size(); ++k)
  {
    const SpacetimeStep& step = this->Steps[k];
    const double share =
      step.IsCoarse ? static_cast<double>(this->CoarseFrames.size()) / numberOfFrames : 1.0;
    work += share * step.Iterations;
  }
  return work;
}

std::size_t SpacetimeProgram::FirstFine() const
{
  std::size_t k = 0;
  while (k < this->Steps.size() && this->Steps[k].IsCoarse)
  {
    ++k;
  }
  return k;
}

std::size_t SpacetimeProgram::Find(const std::string& name) const
{
  for (std::size_t k = 0; k < this->Steps.size(); ++k)
  {
    if (this->Steps[k].Name == name)
    {
      return k;
    }
  }
  return this->FirstFine();
}

SpacetimeProgram PlanProgram(const SpacetimeSetup& setup, const SpacetimeOptions& options,
                             double width)
{
  const int frames = setup.Model.NumberOfFrames;
  const int iterations = options.MaximumNumberOfIterations;
  SpacetimeProgram program;
  std::vector<int> coarse = CoarseFrames(setup.Model, setup.Table, CoarseStride);
  if (static_cast<double>(coarse.size()) < WorthCoarsening * frames && coarse.size() >= 4)
  {
    program.CoarseFrames = std::move(coarse);
  }
  const bool hasCoarse = !program.CoarseFrames.empty();
  const std::string suffix = hasCoarse ? ", coarse" : "";
  std::vector<SpacetimeStep>& steps = program.Steps;
  for (int k = 0; k < LeashSteps && options.UseLeash; ++k)
  {
    const double radius = FirstLeash * width * (1 << k);
    char name[64];
    std::snprintf(name, sizeof(name), "leash %.3g m", radius);
    steps.push_back(Minimise(hasCoarse, 1, name + suffix, options.LeashIterations, radius));
  }
  for (int pass = 1; pass <= options.Passes; ++pass)
  {
    const std::string name = "free " + std::to_string(pass) + suffix;
    if (hasCoarse)
    {
      steps.push_back(Minimise(true, pass, name + " a", iterations / 2));
      steps.push_back(Update(true, pass, false));
    }
    steps.push_back(Minimise(hasCoarse, pass, name + (hasCoarse ? " b" : ""),
                             hasCoarse ? iterations / 2 : iterations));
    steps.push_back(Update(hasCoarse, pass, true));
  }
  AddLast("fine", options.Passes, hasCoarse ? LastIterations(options) : iterations, false, steps);
  return program;
}

SpacetimeProgram PlanEdit(const SpacetimeOptions& options)
{
  SpacetimeProgram program;
  program.Steps.push_back(
    Minimise(false, options.Passes, "edit", (options.MaximumNumberOfIterations + 1) / 2));
  return program;
}

SpacetimeProgram PlanAgain(const SpacetimeOptions& options, bool fitVortices)
{
  SpacetimeProgram program;
  AddLast("again", options.Passes, LastIterations(options), fitVortices, program.Steps);
  return program;
}

} // namespace waft
