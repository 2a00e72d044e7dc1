// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Run/Schedule.h"

#include "Spacetime/Model/LevelTransfer.h"

#include <algorithm>
#include <cstdio>
#include <iterator>

namespace waft
{
namespace
{

constexpr int LeashStages = 5;            // radii 0.01 L 2^k, k = 0..4
constexpr double FirstLeash = 0.01;       // of L
constexpr int CoarseStrides[] = { 2, 4 }; // frames; on eight, pressure is not the gas' any more
constexpr double WorthCoarsening = 0.8;   // a level has fewer frames than this fraction of the next
/// Of a level's own: ten of every fourth frame are a time line of 37 or more. A shorter one comes
/// to the coarser level's answer as soon without it.
constexpr std::size_t FewestFrames[] = { 4, 10 };

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

/// Of a stage that follows large changes made for less work.
int LastIterations(const SpacetimeOptions& options)
{
  return (options.MaximumNumberOfIterations + 2) / 3;
}

void AddLast(StageKind kind, int pass, int iterations, bool vortices, std::vector<Stage>& stages)
{
  stages.push_back(Minimise(kind, 0, pass, 'a', iterations));
  stages.push_back(Update(0, pass, vortices));
  stages.push_back(Minimise(kind, 0, pass, 'b', iterations));
}

} // namespace

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
    case StageKind::Again:
      std::snprintf(text, sizeof(text), "again");
      break;
    case StageKind::Edit:
      std::snprintf(text, sizeof(text), "edit");
      break;
    case StageKind::Fields:
      std::snprintf(text, sizeof(text), "fields");
      break;
  }
  std::string name = text;
  name += levels[std::clamp<std::size_t>(this->Coarseness, 0, std::size(levels) - 1)];
  return this->Part != 0 ? name + " " + this->Part : name;
}

bool Stage::IsSame(const Stage& other) const
{
  const bool isOfThePass = this->Kind != StageKind::Pass || this->Pass == other.Pass;
  return this->Kind == other.Kind && this->Coarseness == other.Coarseness && isOfThePass &&
         this->Part == other.Part && this->Leash == other.Leash;
}

void Serialise(StateArchive& stream, Stage& stage)
{
  stream.Values(stage.Kind, stage.Coarseness, stage.Pass, stage.Part, stage.Iterations, stage.Leash,
                stage.FitsVortices);
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

std::size_t Schedule::Find(const Stage& stage) const
{
  const auto found = std::find_if(this->Stages.begin(), this->Stages.end(),
                                  [&](const Stage& own) { return own.IsSame(stage); });
  return found != this->Stages.end() ? static_cast<std::size_t>(found - this->Stages.begin())
                                     : this->FirstFine();
}

void Serialise(StateArchive& stream, Schedule& schedule)
{
  stream.List(schedule.Stages, [](StateArchive& s, Stage& stage) { Serialise(s, stage); });
  stream.List(schedule.CoarseFrames,
              [](StateArchive& s, std::vector<int>& frames) { s.List(frames); });
}

Schedule PlanSchedule(const SpacetimeSetup& setup, const SpacetimeOptions& options, double width)
{
  if (!setup.Model.Air.IsEmpty())
  {
    return PlanInAir(options);
  }
  const int frames = setup.Model.NumberOfFrames;
  const int iterations = options.MaximumNumberOfIterations;
  Schedule schedule;
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
    schedule.CoarseFrames.push_back(std::move(coarse));
  }
  const int coarsest = schedule.Coarsest();
  std::vector<Stage>& stages = schedule.Stages;
  for (int k = 0; k < LeashStages && options.UseLeash; ++k)
  {
    stages.push_back(Minimise(StageKind::Leash, coarsest, 1, 0, options.LeashIterations));
    stages.back().Leash = FirstLeash * width * (1 << k);
  }
  if (coarsest > 1)
  {
    stages.push_back(Minimise(StageKind::Coarsest, coarsest, 1, 0, LastIterations(options)));
    stages.push_back(Update(coarsest, 1, false));
  }
  const int level = std::min(coarsest, 1);
  const int many = coarsest > 1 ? (2 * iterations + 4) / 5 : iterations / 2;
  for (int pass = 1; pass <= options.Passes; ++pass)
  {
    if (level > 0)
    {
      stages.push_back(Minimise(StageKind::Pass, level, pass, 'a', many));
      stages.push_back(Update(level, pass, false));
    }
    stages.push_back(Minimise(StageKind::Pass, level, pass, level > 0 ? 'b' : '\0',
                              level > 0 ? many : iterations));
    stages.push_back(Update(level, pass, true));
  }
  AddLast(StageKind::Fine, options.Passes, level > 0 ? LastIterations(options) : iterations, false,
          stages);
  return schedule;
}

Schedule PlanInAir(const SpacetimeOptions& options)
{
  Schedule schedule;
  schedule.Stages.push_back(
    Minimise(StageKind::Fine, 0, options.Passes, '\0', 2 * LastIterations(options) / 3));
  return schedule;
}

Schedule PlanEdit(const SpacetimeOptions& options)
{
  Schedule schedule;
  schedule.Stages.push_back(
    Minimise(StageKind::Edit, 0, options.Passes, 0, (options.MaximumNumberOfIterations + 1) / 2));
  return schedule;
}

Schedule PlanAgain(const SpacetimeOptions& options, bool fitVortices)
{
  Schedule schedule;
  AddLast(StageKind::Again, options.Passes, LastIterations(options), fitVortices, schedule.Stages);
  return schedule;
}

} // namespace waft
