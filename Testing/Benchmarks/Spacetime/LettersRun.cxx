// SPDX-License-Identifier: BSD-3-Clause
#include "LettersRun.h"

#include "PlanScenes.h"
#include "Spacetime/Run/Spacetime.h"
#include "StandardRun.h"

#include <cstdio>

namespace waft
{

int RunLetters(int leaves, double memoryLimit, const ParallelFor& parallel)
{
  test::PlanScene scene;
  test::AddLetters(scene, leaves);
  test::PlanScene::Check(scene.Obstacles.Build(scene.Meshes));
  PlanOptions planOptions;
  planOptions.Seed = 1;
  const PlanInput planInput{ test::SwirlDatabase(), scene.Objects, scene.Constraints,
                             scene.Obstacles, scene.Scene };
  PlanOutput plan;
  SilentMonitor monitor;
  test::PlanScene::Check(PlanMotion(planInput, planOptions, parallel, monitor, plan));
  SpacetimeInput input;
  input.Scene = scene.Scene;
  input.Tracks = plan.Tracks;
  input.Objects = scene.Objects;
  input.Constraints = plan.Constraints;
  input.Obstacles = scene.Meshes;
  input.Vortices = plan.Vortices;
  SpacetimeOptions options;
  options.MemoryLimit = memoryLimit;
  SpacetimeOutput output;
  const double cpu = CpuSeconds();
  test::PlanScene::Check(RunSpacetime(input, options, parallel, monitor, output));
  const double whole = CpuSeconds() - cpu;
  const double start = output.Convergence.front().E;
  for (std::size_t k = 0; k < output.Convergence.size(); ++k)
  {
    const ConvergenceRow& row = output.Convergence[k];
    if (row.Iteration % 10 == 0 || k + 1 == output.Convergence.size())
    {
      std::printf("%-22s iteration %4d  E %10.4f = %7.3f %% of E0  Ex %.4g Ev %.4g Ec %.4g  wall "
                  "%.2f s\n",
                  row.Stage.c_str(), row.Iteration, row.E, 100.0 * row.E / start, row.Ex, row.Ev,
                  row.Ec, row.Seconds);
    }
  }
  std::printf("%d leaves, %.1f s CPU, peak memory %.0f MB\n", leaves, whole, PeakMegabytes());
  return 0;
}

} // namespace waft
