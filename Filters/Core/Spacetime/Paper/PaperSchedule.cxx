// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Paper/PaperSchedule.h"

#include "Spacetime/Model/LevelTransfer.h"

#include <iterator>
#include <utility>

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

} // namespace

Schedule PlanPasses(const SpacetimeSetup& setup, const SpacetimeOptions& options, double width)
{
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
  const int last = level > 0 ? LastIterations(options) : iterations;
  for (const char part : { 'a', 'b' })
  {
    stages.push_back(Minimise(StageKind::Fine, 0, options.Passes, part, last));
    stages.push_back(Update(0, options.Passes, false));
  }
  return schedule;
}

} // namespace waft
