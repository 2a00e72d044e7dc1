// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Run/SpacetimeProgram.h"

#include "Spacetime/Model/LevelTransfer.h"

#include <algorithm>
#include <cstdio>
#include <iterator>

namespace waft
{
namespace
{

constexpr int LeashSteps = 5;             // radii 0.01 L 2^k, k = 0..4
constexpr double FirstLeash = 0.01;       // of L
constexpr int CoarseStrides[] = { 2, 4 }; // frames; on eight, pressure is not the gas' any more
constexpr double WorthCoarsening = 0.8;   // a level has fewer frames than this share of the next
/// Of a level's own: ten of every fourth frame are a time line of 37 or more. A shorter one comes
/// to the coarser level's answer as soon without it.
constexpr std::size_t FewestFrames[] = { 4, 10 };

SpacetimeStep Minimise(int coarseness, int pass, std::string name, int iterations,
                       double leash = 0.0)
{
  SpacetimeStep step;
  step.Coarseness = coarseness;
  step.Pass = pass;
  step.Name = std::move(name);
  step.Iterations = iterations;
  step.Leash = leash;
  return step;
}

SpacetimeStep Update(int coarseness, int pass, bool vortices)
{
  SpacetimeStep step;
  step.Coarseness = coarseness;
  step.IsUpdate = true;
  step.Pass = pass;
  step.FitsVortices = vortices;
  return step;
}

/// Of a stage that follows large changes made for less work.
int LastIterations(const SpacetimeOptions& options)
{
  return (options.MaximumNumberOfIterations + 2) / 3;
}

void AddLast(const std::string& name, int pass, int iterations, bool vortices,
             std::vector<SpacetimeStep>& steps)
{
  steps.push_back(Minimise(0, pass, name + " a", iterations));
  steps.push_back(Update(0, pass, vortices));
  steps.push_back(Minimise(0, pass, name + " b", iterations));
}

} // namespace

TimeLevel SpacetimeProgram::LevelOf(int coarseness, int numberOfFrames, int window) const
{
  return coarseness > 0 ? TimeLevel::Make(this->CoarseFrames[coarseness - 1], window)
                        : TimeLevel::Full(numberOfFrames, window);
}

double SpacetimeProgram::Work(std::size_t first, int numberOfFrames) const
{
  double work = 0.0;
  for (std::size_t k = first; k < this->Steps.size(); ++k)
  {
    const SpacetimeStep& step = this->Steps[k];
    const double frames = step.Coarseness > 0
                            ? static_cast<double>(this->CoarseFrames[step.Coarseness - 1].size())
                            : numberOfFrames;
    work += frames / numberOfFrames * step.Iterations;
  }
  return work;
}

std::size_t SpacetimeProgram::FirstFine() const
{
  std::size_t k = 0;
  while (k < this->Steps.size() && this->Steps[k].Coarseness > 0)
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
  double finer = frames;
  for (std::size_t k = 0; k < std::size(CoarseStrides); ++k)
  {
    std::vector<int> coarse = CoarseFrames(setup.Model, setup.Table, CoarseStrides[k]);
    const auto size = static_cast<double>(coarse.size());
    if (!(size < WorthCoarsening * finer) || coarse.size() < FewestFrames[k])
    {
      break;
    }
    finer = size;
    program.CoarseFrames.push_back(std::move(coarse));
  }
  const int coarsest = program.Coarsest();
  const char* const suffixes[] = { "", ", coarse", ", coarser" };
  std::vector<SpacetimeStep>& steps = program.Steps;
  for (int k = 0; k < LeashSteps && options.UseLeash; ++k)
  {
    const double radius = FirstLeash * width * (1 << k);
    char name[64];
    std::snprintf(name, sizeof(name), "leash %.3g m", radius);
    steps.push_back(Minimise(coarsest, 1, name + std::string(suffixes[coarsest]),
                             options.LeashIterations, radius));
  }
  if (coarsest > 1)
  {
    steps.push_back(
      Minimise(coarsest, 1, std::string("free") + suffixes[coarsest], LastIterations(options)));
    steps.push_back(Update(coarsest, 1, false));
  }
  const int level = std::min(coarsest, 1);
  const int many = coarsest > 1 ? (2 * iterations + 4) / 5 : iterations / 2;
  for (int pass = 1; pass <= options.Passes; ++pass)
  {
    const std::string name = "free " + std::to_string(pass) + suffixes[level];
    if (level > 0)
    {
      steps.push_back(Minimise(level, pass, name + " a", many));
      steps.push_back(Update(level, pass, false));
    }
    steps.push_back(
      Minimise(level, pass, name + (level > 0 ? " b" : ""), level > 0 ? many : iterations));
    steps.push_back(Update(level, pass, true));
  }
  AddLast("fine", options.Passes, level > 0 ? LastIterations(options) : iterations, false, steps);
  return program;
}

SpacetimeProgram PlanEdit(const SpacetimeOptions& options)
{
  SpacetimeProgram program;
  program.Steps.push_back(
    Minimise(0, options.Passes, "edit", (options.MaximumNumberOfIterations + 1) / 2));
  return program;
}

SpacetimeProgram PlanAgain(const SpacetimeOptions& options, bool fitVortices)
{
  SpacetimeProgram program;
  AddLast("again", options.Passes, LastIterations(options), fitVortices, program.Steps);
  return program;
}

} // namespace waft
