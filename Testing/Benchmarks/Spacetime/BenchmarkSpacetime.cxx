// SPDX-License-Identifier: BSD-3-Clause
// Prints E against seconds on the standard problem, the cost of an evaluation and peak memory.
#include "Spacetime/Lbfgs.h"
#include "Spacetime/TimeLevels.h"
#include "StandardProblem.h"

#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

using namespace waft;

namespace
{

double CpuSeconds()
{
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_utime.tv_sec + 1e-6 * usage.ru_utime.tv_usec + usage.ru_stime.tv_sec +
         1e-6 * usage.ru_stime.tv_usec;
}

double PeakMegabytes()
{
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024.0;
}

double Argument(int argc, char** argv, const char* name, double standard)
{
  for (int k = 1; k + 1 < argc; ++k)
  {
    if (std::strcmp(argv[k], name) == 0)
    {
      return std::atof(argv[k + 1]);
    }
  }
  return standard;
}

} // namespace

int main(int argc, char** argv)
{
  StandardProblem problem;
  problem.Seed = static_cast<std::uint64_t>(Argument(argc, argv, "--seed", 1));
  problem.NumberOfFrames = static_cast<int>(Argument(argc, argv, "--frames", 301));
  problem.NumberOfObjects = static_cast<int>(Argument(argc, argv, "--objects", 25));
  problem.ParticlesPerObject = static_cast<int>(Argument(argc, argv, "--particles", 5));
  const double scale = Argument(argc, argv, "--gas-scale", 1.0); // per axis
  for (int& n : problem.Gas)
  {
    n = static_cast<int>(n * scale + 0.5);
  }
  const int threads = static_cast<int>(Argument(argc, argv, "--threads", 1));
  const int coarse = static_cast<int>(Argument(argc, argv, "--coarse", 100));
  const int fine = static_cast<int>(Argument(argc, argv, "--fine", 100));
  const int history = static_cast<int>(Argument(argc, argv, "--history", 6));
  const bool portable = Argument(argc, argv, "--portable", 0) != 0;
  problem.Build();

  const ParallelFor parallel = ThreadedFor(threads);
  const SphKernelTable& kernels = portable ? PortableSphKernels() : FastestSphKernels();
  const SpacetimeModel& model = problem.Model;
  std::printf("%zu gas + %zu x %zu object particles, %d frames, %s, %d threads\n",
              model.NumberOfGas, model.NumberOfObjects, model.Offsets.size(), model.NumberOfFrames,
              kernels.Name, threads);

  const TimeLevel full = TimeLevel::Full(model.NumberOfFrames, 1);
  StateVector state = problem.Start;
  {
    SpacetimeObjective objective(model, full, parallel, kernels);
    SpacetimeTerms terms;
    StateVector gradient(state.size());
    objective.Evaluate(state, &gradient, terms);
    const double start = CpuSeconds();
    const int repeats = 4;
    for (int k = 0; k < repeats; ++k)
    {
      objective.Evaluate(state, &gradient, terms);
    }
    const double cost = (CpuSeconds() - start) / repeats;
    std::printf(
      "E0 %.4f (Ex %.4g Ev %.4g Ec %.4g); value and gradient %.3f s CPU, %.2f ns an entry "
      "of %.1f million (skin and padding included)\n",
      terms.E, terms.Ex, terms.Ev, terms.Ec, cost, 1e9 * cost / objective.NumberOfPairs(),
      1e-6 * objective.NumberOfPairs());
  }

  const auto clock = std::chrono::steady_clock::now();
  const double cpu = CpuSeconds();
  const auto solve = [&](const TimeLevel& level, int iterations, StateVector& x)
  {
    SpacetimeObjective objective(model, level, parallel, kernels);
    const TimelinePreconditioner preconditioner(model, level, parallel);
    HardConstraints constraints(model, level, problem.Table, parallel);
    Lbfgs solver(level.NumberOfFrames(), model.FrameSize(), parallel, history);
    LbfgsOptions options;
    options.MaximumNumberOfIterations = iterations;
    options.Tolerance = 0.0;
    const auto observer = [&](int iteration, const SpacetimeTerms& terms)
    {
      if (iteration % 10 == 0)
      {
        const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - clock;
        std::printf(
          "%4zu frames  it %4d  E %10.5f  Ex %.4g Ev %.4g Ec %.4g  wall %.2f s  CPU %.2f s\n",
          level.NumberOfFrames(), iteration, terms.E, terms.Ex, terms.Ev, terms.Ec, wall.count(),
          CpuSeconds() - cpu);
        std::fflush(stdout);
      }
      return true;
    };
    const LbfgsEnd end =
      solver.Minimize(objective, preconditioner, constraints, options, observer, nullptr, x);
    std::printf("ended %d after %zu evaluations\n", static_cast<int>(end),
                objective.NumberOfEvaluations());
  };
  if (coarse > 0)
  {
    const TimeLevel level = TimeLevel::Make(CoarseFrames(model, problem.Table, 2), 1);
    StateVector small = Restrict(model, level, state);
    solve(level, coarse, small);
    Prolong(model, level, small, state);
  }
  if (fine > 0)
  {
    solve(full, fine, state);
  }
  std::printf("peak memory %.0f MB\n", PeakMegabytes());
  return 0;
}
