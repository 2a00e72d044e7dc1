// SPDX-License-Identifier: BSD-3-Clause
#include "CeresRun.h"
#include "EddiesRun.h"
#include "LettersRun.h"
#include "StandardProblem.h"
#include "StandardRun.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

using namespace waft;

namespace
{

constexpr const char* Help =
  "E against seconds of the spacetime optimisation, and what an evaluation costs.\n"
  "\n"
  "  WaftBenchmarkSpacetime --seeds 5       the standard problem: the curve of each seed, then "
  "the\n"
  "                                         table of medians\n"
  "  WaftBenchmarkSpacetime --growth 1      an evaluation at ten times the frames, and the gas\n"
  "  WaftBenchmarkSpacetime --letters 100   leaves that land as a word, instead: 100 leaves above\n"
  "                                         a floor, planned to rest on the dots of a word after\n"
  "                                         frame 250 with a small database of swirls, then\n"
  "                                         optimised with the standard options. Both are made on\n"
  "                                         the spot: no files are needed. --memory 300:\n"
  "                                         MemoryLimit, MB\n"
  "  WaftBenchmarkSpacetime --ceres 500     64 gas particles and 5 objects over 15 frames, "
  "instead:\n"
  "                                         500 iterations of Ceres, and --iterations (2000)\n"
  "                                         of the filter's solver\n"
  "  WaftBenchmarkSpacetime --eddies 0.2    how long gas keeps its eddies, instead: shear waves "
  "and\n"
  "                                         Taylor and Green's vortices of 4, 6 and 10 dx, with\n"
  "                                         that artificial viscosity, --smoothing (1.2 dx),\n"
  "                                         --courant (0.5) and --walls (2: the walls push twice\n"
  "                                         as hard as what the densities cost)\n"
  "\n"
  "The standard problem runs the optimiser's own program of levels and then what Continue adds\n"
  "(without leash, wind, fit of vortices and tolerance). Options, with their standard values:\n"
  "  --seed 1         the first seed\n"
  "  --seeds 1        how many\n"
  "  --threads 2\n"
  "  --frames 301\n"
  "  --objects 25\n"
  "  --particles 5    of an object\n"
  "  --gas-scale 1    times 13 x 14 x 14 particles, each axis\n"
  "  --iterations 150 MaximumNumberOfIterations\n"
  "  --history 6      pairs of L-BFGS\n"
  "  --every 5        iterations from one line to the next\n"
  "  --evaluate 0     1: nothing but the cost of an evaluation\n"
  "  --portable 0     1: that cost without AVX2 and AVX-512\n";

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

void Print(const EvaluationCost& cost, const char* when)
{
  std::printf("%s: value and gradient %.3f s CPU, %.3f s wall, %.2f ns a directed pair, %.0f %% of "
              "peak, %.3f us a particle and frame",
              when, cost.Cpu, cost.Wall, cost.Pair, 100.0 * cost.PeakFraction, cost.ParticleFrame);
  if (cost.WallAlone > 0.0)
  {
    std::printf("; one thread %.3f s wall, %.2f times as long", cost.WallAlone,
                cost.WallAlone / cost.Wall);
  }
  std::printf("\n");
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
  const int own = static_cast<int>(Argument(argc, argv, "--iterations", 2000));
  const CeresComparison result = CompareWithCeres(problem, own, iterations, parallel);
  std::printf("%zu gas + %zu x %zu object particles, %d frames; E at the start %.6g\n",
              problem.Setup.Model.NumberOfGas, problem.Setup.Model.NumberOfObjects,
              problem.Setup.Model.Offsets.size(), problem.Setup.Model.NumberOfFrames, result.Start);
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

/// What the seeds came to.
class Table
{
public:
  void Add(const StandardCurve& curve, const EvaluationCost& cost, double peak)
  {
    for (int k = 0; k < Marks; ++k)
    {
      const StandardCurve::Point point = curve.Passes(Shares[k]);
      this->Wall[k].push_back(point.Wall < 0.0 ? Never : point.Wall);
      this->Cpu[k].push_back(point.Cpu < 0.0 ? Never : point.Cpu);
    }
    this->Evaluations.push_back(static_cast<double>(curve.Evaluations));
    this->Seconds.push_back(cost.Cpu);
    this->Pairs.push_back(cost.Pair);
    this->PeakFractions.push_back(100.0 * cost.PeakFraction);
    this->Ratios.push_back(cost.WallAlone / cost.Wall);
    this->Megabytes.push_back(peak);
  }

  void Print() const
  {
    std::printf("\n| median of %zu seeds | wall [s] | CPU [s] | wanted: wall [s] on two threads |\n"
                "|---|---|---|---|\n",
                this->Megabytes.size());
    for (int k = 0; k < Marks; ++k)
    {
      std::printf("| E at %.1f %% of E0 | %s | %s | %.0f |\n", 100.0 * Shares[k],
                  Text(Median(this->Wall[k])).c_str(), Text(Median(this->Cpu[k])).c_str(),
                  Wanted[k]);
    }
    std::printf("\n| | median | wanted |\n|---|---|---|\n"
                "| value and gradient, CPU s | %.3f | 0.30 |\n"
                "| ns a directed pair | %.2f | |\n"
                "| of the machine's peak, %% | %.0f | |\n"
                "| one thread to all, times | %.2f | 1.75 of two |\n"
                "| evaluations of the run, all levels | %.0f | |\n"
                "| peak memory, MB | %.0f | 900 |\n",
                Median(this->Seconds), Median(this->Pairs), Median(this->PeakFractions),
                Median(this->Ratios), Median(this->Evaluations), Median(this->Megabytes));
  }

private:
  static constexpr int Marks = 4;
  static constexpr double Shares[Marks] = { 0.05, 0.02, 0.014, 0.012 };
  static constexpr double Wanted[Marks] = { 8.0, 20.0, 40.0, 90.0 };
  static constexpr double Never = 1e9;

  static std::string Text(double seconds)
  {
    char text[32];
    std::snprintf(text, sizeof(text), "%.1f", seconds);
    return seconds < Never ? text : "not reached";
  }

  std::vector<double> Wall[Marks], Cpu[Marks];
  std::vector<double> Evaluations, Seconds, Pairs, PeakFractions, Ratios, Megabytes;
};

StandardProblem MakeProblem(int argc, char** argv, int seed)
{
  StandardProblem problem;
  problem.Seed = static_cast<std::uint64_t>(seed);
  problem.NumberOfFrames = static_cast<int>(Argument(argc, argv, "--frames", 301));
  problem.NumberOfObjects = static_cast<int>(Argument(argc, argv, "--objects", 25));
  problem.ParticlesPerObject = static_cast<int>(Argument(argc, argv, "--particles", 5));
  for (int& n : problem.Gas)
  {
    n = static_cast<int>(n * Argument(argc, argv, "--gas-scale", 1.0) + 0.5);
  }
  return problem;
}

/// An evaluation of the standard problem, of ten times its frames and of ten times its particles.
int PrintGrowth(int argc, char** argv, const ParallelFor& parallel)
{
  struct Size
  {
    double Frames, Axis;
  };
  double first = 0.0;
  for (const Size& size : { Size{ 1.0, 1.0 }, Size{ 10.0, 1.0 }, Size{ 1.0, 2.17 } })
  {
    StandardProblem problem = MakeProblem(argc, argv, 1);
    problem.NumberOfFrames = static_cast<int>(size.Frames * (problem.NumberOfFrames - 1)) + 1;
    for (int& n : problem.Gas)
    {
      n = static_cast<int>(n * size.Axis + 0.5);
    }
    problem.Build();
    const SpacetimeSetup& setup = problem.Setup;
    const EvaluationCost cost =
      MeasureCost(setup, setup.Start, parallel, FastestSphKernels(), false);
    first = first > 0.0 ? first : cost.ParticleFrame;
    std::printf("%6zu particles x %4d frames: %.3f s CPU, %.3f us a particle and frame: %+.1f %%; "
                "peak memory so far %.0f MB\n",
                setup.Model.NumberOfParticles(), setup.Model.NumberOfFrames, cost.Cpu,
                cost.ParticleFrame, 100.0 * (cost.ParticleFrame / first - 1.0), PeakMegabytes());
    std::fflush(stdout);
  }
  return 0;
}

} // namespace

int main(int argc, char** argv)
{
  if (argc > 1 && (std::strcmp(argv[1], "--help") == 0 || argc % 2 == 0))
  {
    std::fputs(Help, stdout);
    return argc % 2 == 0 && std::strcmp(argv[1], "--help") != 0 ? 1 : 0;
  }
  const int threads = static_cast<int>(Argument(argc, argv, "--threads", 2));
  const ParallelFor parallel = ThreadedFor(threads);
  if (const int leaves = static_cast<int>(Argument(argc, argv, "--letters", 0)); leaves > 0)
  {
    return RunLetters(leaves, Argument(argc, argv, "--memory", 0), parallel);
  }
  if (const int iterations = static_cast<int>(Argument(argc, argv, "--ceres", 0)); iterations > 0)
  {
    return PrintCeres(argc, argv, iterations, parallel);
  }
  if (const double viscosity = Argument(argc, argv, "--eddies", -1.0); viscosity >= 0.0)
  {
    EddyGas gas;
    gas.Viscosity = viscosity;
    gas.SmoothingLength = Argument(argc, argv, "--smoothing", gas.SmoothingLength);
    gas.CourantNumber = Argument(argc, argv, "--courant", gas.CourantNumber);
    gas.Walls = Argument(argc, argv, "--walls", gas.Walls);
    return RunEddies(gas);
  }
  const int first = static_cast<int>(Argument(argc, argv, "--seed", 1));
  if (Argument(argc, argv, "--growth", 0) != 0)
  {
    return PrintGrowth(argc, argv, parallel);
  }
  const bool portable = Argument(argc, argv, "--portable", 0) != 0;
  const SphKernelTable& kernels = portable ? PortableSphKernels() : FastestSphKernels();
  SpacetimeOptions options;
  options.UseLeash = false;
  options.Passes = 1;
  options.MaximumNumberOfIterations =
    static_cast<int>(Argument(argc, argv, "--iterations", options.MaximumNumberOfIterations));
  options.HistorySize = static_cast<int>(Argument(argc, argv, "--history", options.HistorySize));
  const int seeds = static_cast<int>(Argument(argc, argv, "--seeds", 1));
  Table table;
  for (int seed = first; seed < first + seeds; ++seed)
  {
    StandardProblem problem = MakeProblem(argc, argv, seed);
    problem.Build();
    const SpacetimeSetup& setup = problem.Setup;
    const SpacetimeModel& model = setup.Model;
    std::printf("seed %d: %zu gas + %zu x %zu object particles, %d frames, %s, %d threads\n", seed,
                model.NumberOfGas, model.NumberOfObjects, model.Offsets.size(),
                model.NumberOfFrames, kernels.Name, threads);
    const EvaluationCost cost = MeasureCost(setup, setup.Start, parallel, kernels, threads > 1);
    Print(cost, "at the start");
    if (Argument(argc, argv, "--evaluate", 0) != 0)
    {
      std::printf("peak memory %.0f MB\n", PeakMegabytes());
      continue;
    }
    StateVector state;
    const StandardCurve curve = SolveStandard(
      setup, options, static_cast<int>(Argument(argc, argv, "--every", 5)), parallel, state);
    const double peak = PeakMegabytes();
    Print(MeasureCost(setup, state, parallel, kernels, false), "at the end");
    const GasFaults faults = CheckGas(model, state);
    std::printf("peak memory %.0f MB; %zu evaluations; gas outside the volume %zu, pairs under 0.3 "
                "dx %zu, nearest %.3f dx\n",
                peak, curve.Evaluations, faults.Outside, faults.Close, faults.Nearest);
    table.Add(curve, cost, peak);
    if (seed + 1 == first + seeds)
    {
      table.Print();
    }
  }
  return 0;
}
