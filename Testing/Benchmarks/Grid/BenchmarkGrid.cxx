// SPDX-License-Identifier: BSD-3-Clause
// Times one step of smoke: a sphere in a closed box, a vortex, limited cubic advection, vorticity
// confinement, max |div u| dt <= 1e-4; beside the same step as a textbook writes it. Then a series
// of frames in a cache that does not hold them all.
//
//   WaftBenchmarkGrid [largest grid, default 128] [steps, default 10]
#include "Grid/SmokeSeries.h"
#include "Grid/SmokeSolver.h"
#include "PlainSmoke.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include <sys/resource.h>

using namespace waft;

namespace
{

constexpr double Side = 4.0;
constexpr double Confinement = 0.5;
const Vec3 BallCenter(1.7, 2.1, 2.0); // from the box's corner
constexpr double BallRadius = 0.6;

Vortex TheVortex()
{
  Vortex vortex;
  vortex.P1 = Vec3(2.5, 2.3, 0.5);
  vortex.P2 = Vec3(2.2, 2.6, 3.0);
  vortex.Strength = 6.0;
  vortex.CenterTime = 0.3;
  vortex.CoreRadius = 0.3;
  return vortex;
}

double CpuSeconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

double TimeSolver(int n, int steps, int threads)
{
  SmokeOptions options;
  options.Bounds = Box{ Vec3::Zero(), Vec3::Constant(Side) };
  options.Resolution = { n, n, n };
  options.Boundary.fill(BoundaryKind::Closed);
  options.Confinement = Confinement;
  options.WarmUpSeconds = 0.0;
  options.CourantNumber = 100.0; // one substep a frame: a step is a step
  SmokeForces forces;
  forces.Vortices = { TheVortex() };
  SmokeEmitter emitter;
  emitter.Center = Vec3(2.0, 2.0, 0.8);
  forces.Emitters = { emitter };
  std::vector<float> distances;
  for (int k = 0; k <= n; ++k)
  {
    for (int j = 0; j <= n; ++j)
    {
      for (int i = 0; i <= n; ++i)
      {
        distances.push_back(
          static_cast<float>((Vec3(i, j, k) * (Side / n) - BallCenter).norm() - BallRadius));
      }
    }
  }
  SmokeSolver solver;
  SilentMonitor monitor;
  if (!solver.Begin(options, forces) || !solver.SetSolids(distances) ||
      !solver.Step(SerialFor(), monitor))
  {
    std::printf("the solver did not start\n");
    return 0.0;
  }
  const ParallelFor parallelFor = threads == 1 ? SerialFor() : ThreadedFor(threads);
  SmokeStatistics sum;
  double divergence = 0.0;
  double cpu = 0.0;
  for (int step = 0; step < steps; ++step)
  {
    const double start = CpuSeconds();
    if (!solver.Step(parallelFor, monitor))
    {
      return 0.0;
    }
    cpu += (CpuSeconds() - start) / steps;
    const SmokeStatistics& s = solver.Statistics();
    sum.AdvectionSeconds += s.AdvectionSeconds / steps;
    sum.ForceSeconds += s.ForceSeconds / steps;
    sum.PressureSeconds += s.PressureSeconds / steps;
    sum.PressureIterations += s.PressureIterations;
    divergence = std::max(divergence, solver.MaximumDivergence() / options.FramesPerSecond);
  }
  const double total = sum.AdvectionSeconds + sum.ForceSeconds + sum.PressureSeconds;
  std::printf(
    "waft   %3d^3  %d thread%s  %6.1f ms a step (cpu %.1f; advection %.1f, forces %.1f, "
    "pressure %.1f: %.0f %%, %.1f iterations)  max |div u| dt %.1e  energy %.4f\n",
    n, threads, threads == 1 ? " " : "s", 1e3 * total, 1e3 * cpu, 1e3 * sum.AdvectionSeconds,
    1e3 * sum.ForceSeconds, 1e3 * sum.PressureSeconds, 100.0 * sum.PressureSeconds / total,
    sum.PressureIterations / static_cast<double>(steps), divergence, solver.KineticEnergy());
  return total;
}

double TimePlain(int n, int steps)
{
  PlainSmoke plain(n, Side / n,
                   [](double x, double y, double z)
                   { return (Vec3(x, y, z) - BallCenter).norm() < BallRadius; });
  const Vortex vortex = TheVortex();
  PlainSmoke::Seconds sum;
  for (int step = 0; step < steps; ++step)
  {
    const double time = (step + 0.5) / 30.0;
    const PlainSmoke::Seconds s = plain.Step(1.0 / 30.0, Confinement, 1e-4,
                                             [&](double x, double y, double z)
                                             {
                                               const Vec3 f =
                                                 vortex.Acceleration(Vec3(x, y, z), time);
                                               return std::array<double, 3>{ f.x(), f.y(), f.z() };
                                             });
    sum.Advection += s.Advection / steps;
    sum.Forces += s.Forces / steps;
    sum.Pressure += s.Pressure / steps;
    sum.Iterations += s.Iterations;
  }
  const double total = sum.Advection + sum.Forces + sum.Pressure;
  std::printf("plain  %3d^3  1 thread   %6.1f ms a step (advection %.1f, forces %.1f, pressure "
              "%.1f with %.1f iterations)  energy %.4f\n",
              n, 1e3 * total, 1e3 * sum.Advection, 1e3 * sum.Forces, 1e3 * sum.Pressure,
              sum.Iterations / static_cast<double>(steps), plain.KineticEnergy());
  return total;
}

double PeakMegabytes()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// Frames one after the other, then from the last one back.
void TimeSeries(int n, int frames, int backwards, int megabytes)
{
  SmokeSeriesInput input;
  input.Options.Resolution = { n, n, n };
  input.Options.WarmUpSeconds = 0.0;
  Vortex vortex = TheVortex();
  vortex.P1 += input.Options.Bounds.Min;
  vortex.P2 += input.Options.Bounds.Min;
  input.Forces.Vortices = { vortex };
  input.NumberOfFrames = frames;
  input.CacheLimit = static_cast<std::size_t>(megabytes) << 20;
  SmokeSeries series;
  SilentMonitor monitor;
  std::shared_ptr<const SmokeFrame> fields;
  if (!series.Begin(std::move(input)))
  {
    return;
  }
  const double before = PeakMegabytes();
  const double start = CpuSeconds();
  for (int frame = 0; frame < frames; ++frame)
  {
    (void)series.At(frame, SerialFor(), monitor, fields);
  }
  const double forth = CpuSeconds() - start;
  for (int frame = frames - 1; frame >= frames - backwards; --frame)
  {
    (void)series.At(frame, SerialFor(), monitor, fields);
  }
  std::printf(
    "series %3d^3  1 thread   %d frames %.1f s of cpu; the last %d again, backwards, %.1f "
    "s; %d computed, %.0f of %d MB kept, the process grew by %.0f MB\n",
    n, frames, forth, backwards, CpuSeconds() - start - forth, series.FramesComputed(),
    static_cast<double>(series.BytesKept()) / (1 << 20), megabytes, PeakMegabytes() - before);
}

} // namespace

int main(int argc, char** argv)
{
  const int largest = argc > 1 ? std::atoi(argv[1]) : 128;
  const int steps = argc > 2 ? std::max(1, std::atoi(argv[2])) : 10;
  std::printf("sphere in a closed box, one vortex, smoke, limited cubic advection, confinement, "
              "tolerance 1e-4, %d steps\n",
              steps);
  std::printf("wall clock; on a busy machine the cpu time tells more\n");
  const double small = TimeSolver(64, steps, 1);
  TimeSeries(64, 60, 40, 256); // before what needs more memory
  TimeSolver(64, steps, 2);
  const double plain = TimePlain(64, steps);
  std::printf("plain / waft at 64^3: %.1f\n", plain / small);
  if (largest >= 128)
  {
    const double large = TimeSolver(128, std::min(steps, 5), 1);
    std::printf("128^3 / 64^3: %.1f\n", large / small);
  }
  return 0;
}
