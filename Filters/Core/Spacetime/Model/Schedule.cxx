// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Model/Schedule.h"

#include <algorithm>
#include <cstdio>
#include <iterator>

namespace waft
{

Stage Minimise(StageKind kind, int coarseness, int pass, char part, int iterations)
{
  Stage stage;
  stage.Kind = kind;
  stage.Coarseness = coarseness;
  stage.Pass = pass;
  stage.Part = part;
  stage.Iterations = iterations;
  return stage;
}

Stage Update(int coarseness, int pass, bool vortices)
{
  Stage stage = Minimise(StageKind::Fields, coarseness, pass, 0, 0);
  stage.FitsVortices = vortices;
  return stage;
}

int LastIterations(const SpacetimeOptions& options)
{
  return (options.MaximumNumberOfIterations + 2) / 3;
}

std::string Stage::Name() const
{
  const char* const levels[] = { "", ", coarse", ", coarser" };
  char text[64] = "";
  switch (this->Kind)
  {
    case StageKind::Leash:
      std::snprintf(text, sizeof(text), "leash %.3g m", this->Leash);
      break;
    case StageKind::Coarsest:
      std::snprintf(text, sizeof(text), "free");
      break;
    case StageKind::Pass:
      std::snprintf(text, sizeof(text), "free %d", this->Pass);
      break;
    case StageKind::Fine:
      std::snprintf(text, sizeof(text), "fine");
      break;
    case StageKind::Fields:
      std::snprintf(text, sizeof(text), "fields");
      break;
  }
  std::string name = text;
  name += levels[std::clamp<std::size_t>(this->Coarseness, 0, std::size(levels) - 1)];
  return this->Part != 0 ? name + " " + this->Part : name;
}

TimeLevel Schedule::LevelOf(int coarseness, int numberOfFrames, int window) const
{
  return coarseness > 0 ? TimeLevel::Make(this->CoarseFrames[coarseness - 1], window)
                        : TimeLevel::Full(numberOfFrames, window);
}

double Schedule::Work(std::size_t first, int numberOfFrames) const
{
  double work = 0.0;
  for (std::size_t k = first; k < this->Stages.size(); ++k)
  {
    const Stage& stage = this->Stages[k];
    const double frames = stage.Coarseness > 0
                            ? static_cast<double>(this->CoarseFrames[stage.Coarseness - 1].size())
                            : numberOfFrames;
    work += frames / numberOfFrames * stage.Iterations;
  }
  return work;
}

std::size_t Schedule::FirstFine() const
{
  const auto found = std::find_if(this->Stages.begin(), this->Stages.end(),
                                  [](const Stage& stage) { return stage.Coarseness == 0; });
  return static_cast<std::size_t>(found - this->Stages.begin());
}

} // namespace waft
