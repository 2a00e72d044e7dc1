// SPDX-License-Identifier: BSD-3-Clause
// Prints E against seconds on the standard problem and when it passes its marks, the cost of an
// evaluation, how that grows with particles and frames, peak memory and the state of the gas.
// Options: --seeds n (1..n) or --seed s, --threads n, --frames n, --objects n, --particles n (of an
// object), --gas-scale f (an axis), --stride4 n --stride2 n --stride1 n (iterations), --history m,
// --every n (iterations a line), --evaluate 1 (nothing but the cost of an evaluation),
// --letters n (instead: n planned leaves that land as a word), --ceres n (instead: a small problem
// solved by n iterations of Ceres and by Waft).
#include "CeresRun.h"
#include "LettersRun.h"
#include "StandardRun.h"

#include "Spacetime/SpacetimeObjective.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <tuple>
#include <vector>

using namespace waft;

namespace
{

constexpr double OperationsPerPair = 190.0; // of a value and gradient: counted in the sums

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

void PrintCost(const StandardProblem& problem, const StateVector& state, const char* when,
               const ParallelFor& parallel, const SphKernelTable& kernels)
{
  const SpacetimeModel& model = problem.Model;
  const TimeLevel full = TimeLevel::Full(model.NumberOfFrames, 1);
  SpacetimeObjective objective(model, full, parallel, kernels);
  SpacetimeTerms terms;
  StateVector gradient(state.size());
  objective.Evaluate(state, &gradient, terms);
  const double start = CpuSeconds();
  constexpr int Repeats = 3;
  for (int k = 0; k < Repeats; ++k)
  {
    objective.Evaluate(state, &gradient, terms);
  }
  const double cost = (CpuSeconds() - start) / Repeats;
  const double pairs = PairsWithinSupport(model, state);
  const double peak = PeakGigaflops();
  std::printf("%s: E %.4f (Ex %.4g Ev %.4g Ec %.4g); value and gradient %.3f s CPU, %.2f ns a "
              "directed pair of %.1f million, %.0f %% of %.0f Gflop/s, %.3f us a particle and "
              "frame\n",
              when, terms.E, terms.Ex, terms.Ev, terms.Ec, cost, 1e9 * cost / pairs, 1e-6 * pairs,
              peak > 0.0 ? 100.0 * 1e-9 * OperationsPerPair * pairs / cost / peak : 0.0, peak,
              1e6 * cost / (double(model.NumberOfParticles()) * model.NumberOfFrames));
  std::fflush(stdout);
}

// 64 gas particles and 5 objects over 15 frames, unless told otherwise.
int PrintCeres(int argc, char** argv, int iterations, const ParallelFor& parallel)
{
  const int side = static_cast<int>(Argument(argc, argv, "--side", 4));
  StandardProblem problem;
  problem.Gas = { side, side, side };
  problem.Seed = static_cast<std::uint64_t>(Argument(argc, argv, "--seed", 1));
  problem.NumberOfObjects = static_cast<int>(Argument(argc, argv, "--objects", 5));
  problem.ParticlesPerObject = static_cast<int>(Argument(argc, argv, "--particles", 5));
  problem.NumberOfFrames = static_cast<int>(Argument(argc, argv, "--frames", 15));
  problem.Build();
  const int own = static_cast<int>(Argument(argc, argv, "--stride1", 2000));
  const CeresComparison result = CompareWithCeres(problem, own, iterations, parallel);
  std::printf("%zu gas + %zu x %zu object particles, %d frames; E at the start %.6g\n",
              problem.Model.NumberOfGas, problem.Model.NumberOfObjects,
              problem.Model.Offsets.size(), problem.Model.NumberOfFrames, result.Start);
  for (const auto& [name, end] :
       { std::pair("Ceres", result.Ceres), std::pair("Waft", result.Waft) })
  {
    std::printf("%-5s E %.6g, %.2f s CPU, %d evaluations\n", name, end.Cost, end.Seconds,
                end.Evaluations);
  }
  return 0;
}

double Median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

} // namespace

int main(int argc, char** argv)
{
  const int threads = static_cast<int>(Argument(argc, argv, "--threads", 2));
  const ParallelFor parallel = ThreadedFor(threads);
  if (const int leaves = static_cast<int>(Argument(argc, argv, "--letters", 0)); leaves > 0)
  {
    return RunLetters(leaves, parallel);
  }
  if (const int iterations = static_cast<int>(Argument(argc, argv, "--ceres", 0)); iterations > 0)
  {
    return PrintCeres(argc, argv, iterations, parallel);
  }
  const bool portable = Argument(argc, argv, "--portable", 0) != 0;
  const SphKernelTable& kernels = portable ? PortableSphKernels() : FastestSphKernels();
  std::vector<StandardLevel> levels;
  for (const auto& [name, stride, standard] :
       { std::tuple("--stride4", 4, 60), std::tuple("--stride2", 2, 110),
         std::tuple("--stride1", 1, 100) })
  {
    if (const int n = static_cast<int>(Argument(argc, argv, name, standard)); n > 0)
    {
      levels.push_back({ stride, n });
    }
  }
  const double scale = Argument(argc, argv, "--gas-scale", 1.0);
  const int first = static_cast<int>(Argument(argc, argv, "--seed", 1));
  const int last = first + static_cast<int>(Argument(argc, argv, "--seeds", 1)) - 1;
  const double shares[4] = { 0.05, 0.02, 0.014, 0.012 };
  const double marks[4] = { 8.0, 20.0, 40.0, 90.0 };
  std::vector<double> wall[4], cpu[4];
  for (int seed = first; seed <= last; ++seed)
  {
    StandardProblem problem;
    problem.Seed = static_cast<std::uint64_t>(seed);
    problem.NumberOfFrames = static_cast<int>(Argument(argc, argv, "--frames", 301));
    problem.NumberOfObjects = static_cast<int>(Argument(argc, argv, "--objects", 25));
    problem.ParticlesPerObject = static_cast<int>(Argument(argc, argv, "--particles", 5));
    for (int& n : problem.Gas)
    {
      n = static_cast<int>(n * scale + 0.5);
    }
    problem.Build();
    const SpacetimeModel& model = problem.Model;
    std::printf("seed %d: %zu gas + %zu x %zu object particles, %d frames, %s, %d threads\n", seed,
                model.NumberOfGas, model.NumberOfObjects, model.Offsets.size(),
                model.NumberOfFrames, kernels.Name, threads);
    PrintCost(problem, problem.Start, "at the start", parallel, kernels);
    if (Argument(argc, argv, "--evaluate", 0) != 0)
    {
      std::printf("peak memory %.0f MB\n", PeakMegabytes());
      continue;
    }
    StateVector state;
    const StandardCurve curve =
      SolveStandard(problem, levels, static_cast<int>(Argument(argc, argv, "--history", 6)),
                    static_cast<int>(Argument(argc, argv, "--every", 10)), parallel, state);
    const double peak = PeakMegabytes();
    PrintCost(problem, state, "at the end", parallel, kernels);
    const GasFaults faults = CheckGas(model, state);
    std::printf("peak memory %.0f MB; gas outside the volume %zu, pairs under 0.3 dx %zu, nearest "
                "%.3f dx\n",
                peak, faults.Outside, faults.Close, faults.Nearest);
    for (int k = 0; k < 4; ++k)
    {
      const StandardCurve::Point point = curve.Passes(shares[k]);
      wall[k].push_back(point.Wall < 0.0 ? 1e9 : point.Wall);
      cpu[k].push_back(point.Cpu < 0.0 ? 1e9 : point.Cpu);
    }
  }
  if (!wall[0].empty())
  {
    std::printf("median of %zu seeds (1e+09: not reached)\n  E / E0   wall [s]   CPU [s]   wanted, "
                "wall on two threads\n",
                wall[0].size());
    for (int k = 0; k < 4; ++k)
    {
      std::printf("  %4.1f %%  %9.4g  %9.4g  %8.0f\n", 100.0 * shares[k], Median(wall[k]),
                  Median(cpu[k]), marks[k]);
    }
  }
  return 0;
}
