// SPDX-License-Identifier: BSD-3-Clause
#include "StandardRun.h"

#include "Spacetime/Model/LevelTransfer.h"
#include "Spacetime/Paper/PaperSchedule.h"
#include "Spacetime/Run/Schedule.h"
#include "Spacetime/Scene/InitialGas.h"
#include "Spacetime/Solver/LevelSolver.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace waft
{
namespace
{

constexpr double OperationsPerPair = 190.0; // of a value and gradient: counted in the sums

double WallSeconds()
{
  const std::chrono::duration<double> d = std::chrono::steady_clock::now().time_since_epoch();
  return d.count();
}

Vec3 PositionOf(const SpacetimeModel& model, const StateVector& state, int frame, std::size_t body)
{
  const float* p = state.data() + frame * model.FrameSize() + body;
  return { p[0], p[model.Stride()], p[2 * model.Stride()] };
}

// Calls function(distance) for the pairs of gas in a frame nearer than `reach`.
template <typename Function>
void ForGasPairs(const SpacetimeModel& model, const StateVector& state, int frame, double reach,
                 Function function)
{
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < model.NumberOfGas; ++i)
  {
    points.push_back(PositionOf(model, state, frame, i));
  }
  std::sort(points.begin(), points.end(),
            [](const Vec3& a, const Vec3& b) { return a.x() < b.x(); });
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    for (std::size_t j = i + 1; j < points.size() && points[j].x() - points[i].x() < reach; ++j)
    {
      const double r2 = (points[j] - points[i]).squaredNorm();
      if (r2 < reach * reach)
      {
        function(std::sqrt(r2));
      }
    }
  }
}

#if defined(__x86_64__)
__attribute__((target("avx2,fma"))) float MultiplyAndAdd(long rounds)
{
  __m256 sums[12];
  for (int k = 0; k < 12; ++k)
  {
    sums[k] = _mm256_set1_ps(static_cast<float>(k));
  }
  const __m256 a = _mm256_set1_ps(0.999f), b = _mm256_set1_ps(1e-3f);
  for (long r = 0; r < rounds; ++r)
  {
    for (__m256& sum : sums)
    {
      sum = _mm256_fmadd_ps(sum, a, b);
    }
  }
  float total = 0.0f;
  for (const __m256& sum : sums)
  {
    total += _mm256_cvtss_f32(sum);
  }
  return total;
}
#endif

} // namespace

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

double PeakGigaflops()
{
#if defined(__x86_64__)
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma"))
  {
    return 0.0;
  }
  constexpr long Rounds = 20000000;
  const double start = CpuSeconds();
  volatile float sink = MultiplyAndAdd(Rounds);
  (void)sink;
  return 1e-9 * Rounds * 12 * 8 * 2 / (CpuSeconds() - start);
#else
  return 0.0;
#endif
}

StandardCurve::Point StandardCurve::Passes(double fraction) const
{
  for (const Point& point : this->Points)
  {
    if (point.E <= fraction * this->Start)
    {
      return point;
    }
  }
  return { -1.0, -1.0, 0.0 };
}

EvaluationCost MeasureCost(const SpacetimeSetup& setup, const StateVector& state,
                           const ParallelFor& parallel, const SphKernelTable& kernels, bool alone)
{
  constexpr int Repeats = 3;
  const SpacetimeModel& model = setup.Model;
  const TimeLevel full = TimeLevel::Full(model.NumberOfFrames, 1);
  StateVector gradient(state.size());
  const auto measure = [&](const ParallelFor& threads, double& cpu, double& wall)
  {
    SpacetimeObjective objective(model, model.Fields, full, threads, kernels);
    SpacetimeTerms terms;
    objective.Evaluate(state, &gradient, terms);
    const double wallBefore = WallSeconds(), cpuBefore = CpuSeconds();
    for (int k = 0; k < Repeats; ++k)
    {
      objective.Evaluate(state, &gradient, terms);
    }
    wall = (WallSeconds() - wallBefore) / Repeats;
    cpu = (CpuSeconds() - cpuBefore) / Repeats;
  };
  EvaluationCost cost;
  measure(parallel, cost.Cpu, cost.Wall);
  if (alone)
  {
    double cpu;
    measure(SerialFor(), cpu, cost.WallAlone);
  }
  const double pairs = PairsWithinSupport(model, state);
  const double peak = PeakGigaflops();
  cost.Pair = 1e9 * cost.Cpu / pairs;
  cost.ParticleFrame = 1e6 * cost.Cpu / (double(model.NumberOfParticles()) * model.NumberOfFrames);
  cost.PeakFraction = peak > 0.0 ? 1e-9 * OperationsPerPair * pairs / cost.Cpu / peak : 0.0;
  return cost;
}

StandardCurve SolveStandard(const SpacetimeSetup& setup, const SpacetimeOptions& options, int every,
                            const ParallelFor& parallel, StateVector& state)
{
  const SpacetimeModel& model = setup.Model;
  Schedule schedule = PlanSchedule(setup, options, model.Size.x());
  const std::vector<Stage> again(schedule.Stages.end() - 4, schedule.Stages.end()); // on all frames
  schedule.Stages.insert(schedule.Stages.end(), again.begin(), again.end());
  const TimeLevel full = schedule.LevelOf(0, model.NumberOfFrames, options.TemporalWindow);
  SpacetimeTerms terms;
  StandardCurve curve;
  state = setup.Start;
  const double wall = WallSeconds(), cpu = CpuSeconds();
  double wallOff = 0.0, cpuOff = 0.0;
  {
    SpacetimeObjective all(model, model.Fields, full, parallel, FastestSphKernels());
    all.Evaluate(state, nullptr, terms);
    curve.Start = terms.E;
    SilentMonitor silent;
    MakeInitialGas(all, parallel, silent, state);
  }
  const auto measure =
    [&](const Stage& stage, const TimeLevel& level, const StateVector& x, int iteration, double e)
  {
    const double wallNow = WallSeconds(), cpuNow = CpuSeconds();
    StandardCurve::Point point{ wallNow - wall - wallOff, cpuNow - cpu - cpuOff, e };
    if (stage.Coarseness > 0)
    {
      StateVector prolonged = state;
      Prolong(model, level, x, prolonged);
      SpacetimeTerms at;
      SpacetimeObjective(model, model.Fields, full, parallel, FastestSphKernels(), false)
        .Evaluate(prolonged, nullptr, at);
      point.E = at.E;
    }
    curve.Points.push_back(point);
    std::printf(
      "%-16s iteration %4d  E %10.5f  at all frames %10.5f = %6.3f %% of E0  wall %6.2f s  "
      "CPU %6.2f s\n",
      stage.Name().c_str(), iteration, e, point.E, 100.0 * point.E / curve.Start, point.Wall,
      point.Cpu);
    std::fflush(stdout);
    wallOff += WallSeconds() - wallNow;
    cpuOff += CpuSeconds() - cpuNow;
  };
  std::unique_ptr<LevelSolver> solver;
  LbfgsMemory memory;
  StateVector part;
  int coarseness = -1;
  const auto leave = [&]()
  {
    if (coarseness > 0)
    {
      Prolong(model, solver->Level, part, state);
    }
    curve.Evaluations += solver ? solver->Objective.NumberOfEvaluations() : 0;
    solver.reset();
    memory = LbfgsMemory();
  };
  for (const Stage& stage : schedule.Stages)
  {
    if (stage.IsUpdate())
    {
      continue;
    }
    if (stage.Coarseness != coarseness)
    {
      leave();
      coarseness = stage.Coarseness;
      solver = std::make_unique<LevelSolver>(
        setup.Model, setup.Model.Fields, setup.Table,
        schedule.LevelOf(coarseness, model.NumberOfFrames, options.TemporalWindow), parallel,
        options.HistorySize);
      part = coarseness > 0 ? Restrict(model, solver->Level, state) : StateVector();
    }
    StateVector& x = coarseness > 0 ? part : state;
    LbfgsOptions minimise;
    minimise.MaximumNumberOfIterations = stage.Iterations;
    minimise.Tolerance = 0.0;
    const auto observer = [&](int iteration, const SpacetimeTerms& now)
    {
      if (iteration > 0 && iteration % every == 0)
      {
        measure(stage, solver->Level, x, iteration, now.E);
      }
      return true;
    };
    solver->Minimise(minimise, observer, nullptr, memory, x);
  }
  leave();
  return curve;
}

GasFaults CheckGas(const SpacetimeModel& model, const StateVector& state)
{
  GasFaults faults;
  faults.Nearest = 1e9;
  for (int frame = 0; frame < model.NumberOfFrames; ++frame)
  {
    for (std::size_t i = 0; i < model.NumberOfGas; ++i)
    {
      const Vec3 x = PositionOf(model, state, frame, i);
      faults.Outside +=
        (x.array() < 0.0).any() || (x.array() > model.Size.array() + 1e-5).any() ? 1 : 0;
    }
    ForGasPairs(model, state, frame, 0.5,
                [&](double r)
                {
                  faults.Close += r < 0.3 ? 1 : 0;
                  faults.Nearest = std::min(faults.Nearest, r);
                });
  }
  return faults;
}

double PairsWithinSupport(const SpacetimeModel& model, const StateVector& state)
{
  std::size_t count = 0;
  int frames = 0;
  const double reach = model.Fluid.Support();
  for (int frame = 0; frame < model.NumberOfFrames; frame += 30, ++frames)
  {
    ForGasPairs(model, state, frame, reach, [&](double) { count += 2; });
    for (std::size_t o = 0; o < model.NumberOfObjects; ++o)
    {
      for (const auto& offset : model.Offsets)
      {
        const Vec3 x = PositionOf(model, state, frame, model.NumberOfGas + o) +
                       Vec3(offset[0], offset[1], offset[2]);
        for (std::size_t i = 0; i < model.NumberOfGas; ++i)
        {
          count += (PositionOf(model, state, frame, i) - x).squaredNorm() < reach * reach ? 2 : 0;
        }
      }
    }
  }
  return static_cast<double>(count) * model.NumberOfFrames / frames;
}

} // namespace waft
