// SPDX-License-Identifier: BSD-3-Clause
// WaftBenchmarkDatabase [simulations] [frames] [resolution] [threads]: time of each part of a
// motion database, and what it holds.
#include "Database/DatabaseBuild.h"
#include "Trajectory/Style.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include <sys/resource.h>

using namespace waft;

namespace
{

class Print : public Monitor
{
public:
  bool Tick(double fraction, const std::string& text) override
  {
    const int percent = static_cast<int>(100.0 * fraction);
    if (percent >= this->Next)
    {
      std::fprintf(stderr, "%3d %% %s\n", percent, text.c_str());
      this->Next = percent + 5;
    }
    return true;
  }

private:
  int Next = 0;
};

double Wall()
{
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

/// Largest memory of the process so far [MB].
double PeakMemory()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

double Cpu()
{
  return double(std::clock()) / CLOCKS_PER_SEC;
}

} // namespace

int main(int argc, char** argv)
{
  const auto argument = [&](int i, int fallback)
  { return argc > i ? std::atoi(argv[i]) : fallback; };
  DatabaseOptions options;
  options.NumberOfSimulations = argument(1, 2);
  options.NumberOfFrames = argument(2, 300);
  options.Resolution = argument(3, 64);
  const int threads = argument(4, 1);

  Print monitor;
  MotionDatabase database;
  std::vector<CoveragePoint> coverage;
  const double wall = Wall();
  const double cpu = Cpu();
  options.SimulationsAtOnce = threads;
  const Result result = BuildDatabase(options, ThreadedFor(threads), monitor, database, coverage);
  if (!result)
  {
    std::fprintf(stderr, "%s\n", result.Message().c_str());
    return 1;
  }
  const int seeds = std::max(1, options.Resolution / options.Trace.SeedStride);
  std::printf(
    "%d simulations, %d tracers, %d frames at %d^3, tolerance %g, %d threads: %.1f s, CPU "
    "%.1f s, %.0f MB at most\n",
    options.NumberOfSimulations, seeds * seeds * seeds, options.NumberOfFrames, options.Resolution,
    options.Smoke.Tolerance, threads, Wall() - wall, Cpu() - cpu, PeakMemory());
  std::size_t connectible = 0;
  for (const Connection& connection : database.Connections)
  {
    connectible += connection.IsConnectible;
  }
  std::printf("%zu segments, %zu nodes, %zu top nodes, %.1f %% of pairs connect, %zu vortices\n",
              database.Segments.size(), database.Nodes.size(), database.TopNodes.size(),
              100.0 * connectible / database.Connections.size(), database.Vortices.size());
  for (std::size_t g = 0; g < database.Groups.size(); ++g)
  {
    int segments = 0;
    for (const Segment& segment : database.Segments)
    {
      segments += segment.Group == static_cast<int>(g);
    }
    std::printf("  %d samples: %d segments, rank %d of %d, error %.4f\n",
                database.Groups[g].NumberOfSamples, segments,
                static_cast<int>(database.Groups[g].Basis.cols()),
                3 * database.Groups[g].NumberOfSamples, database.Groups[g].RelativeError);
  }
  const StyleSamples style = StyleOf(database);
  std::printf("speed: median %.3f, 95 %% %.3f, top %.3f m/s; |a|: median %.3f, 95 %% %.3f m/s^2; "
              "curvature: median %.3f, 95 %% %.3f 1/m\n",
              Quantile(style.Speed, 0.5), Quantile(style.Speed, 0.95), database.TopSpeed,
              Quantile(style.Acceleration, 0.5), Quantile(style.Acceleration, 0.95),
              std::exp(Quantile(style.LogCurvature, 0.5)),
              std::exp(Quantile(style.LogCurvature, 0.95)));
  for (const CoveragePoint& point : coverage)
  {
    std::printf("coverage: %d simulations, %.1f %% of %d further segments are new\n",
                point.Simulations, 100.0 * point.NewShare, point.NewSegments);
  }
  return 0;
}
