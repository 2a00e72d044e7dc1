// SPDX-License-Identifier: BSD-3-Clause
// Prints how long plans take, how many marks they reach and what memory they need: a maze of 16
// boxes with windows (and how much faster a classic RRT-Connect gets through it, where OMPL is
// installed), the same maze in 100,000 triangles, letters on the ground, and spans of many frames.
// Arguments: number of seeds [50], and one of maze, fine, fast, narrow, letters, long [all].
#include "Base/StateArchive.h"
#include "PlainBlending.h"
#include "PlanScenes.h"
#include "RandomChains.h"
#include "Trajectory/Style.h"
#ifdef WAFT_HAS_OMPL
#include "RRTConnect.h"
#endif

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

using namespace waft;
using namespace waft::test;

namespace
{

double PeakMegabytes()
{
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024.0;
}

struct Stopwatch
{
  std::chrono::steady_clock::time_point Begin = std::chrono::steady_clock::now();
  std::clock_t CpuBegin = std::clock();

  double Seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - this->Begin).count();
  }
  double CpuSeconds() const
  {
    return static_cast<double>(std::clock() - this->CpuBegin) / CLOCKS_PER_SEC;
  }
};

int CountMet(const PlanOutput& output)
{
  return static_cast<int>(std::count_if(output.Report.begin(), output.Report.end(),
                                        [](const ReportRow& line)
                                        { return line.Status == ConstraintStatus::Met; }));
}

PlanOutput Plan(const PlanScene& scene, std::uint64_t seed, const ParallelFor& parallelFor)
{
  PlanOptions options;
  options.Seed = seed;
  const PlanInput input{ SwirlDatabase(), scene.Objects, scene.Constraints, scene.Obstacles,
                         scene.Scene };
  PlanOutput output;
  SilentMonitor monitor;
  PlanScene::Check(PlanMotion(input, options, parallelFor, monitor, output));
  return output;
}

/// Median seconds of processor time.
double Maze(const char* name, int frames, const MazeSize& size, int seeds)
{
  PlanScene scene;
  AddMaze(scene, size);
  AddMazeFlight(scene, frames);
  PlanScene::Check(scene.Obstacles.Build(scene.Meshes));
  std::size_t triangles = 0;
  for (std::size_t i = 1; i < scene.Meshes.size(); ++i)
  {
    triangles += scene.Meshes[i].Mesh.Triangles.size();
  }
  std::vector<double> seconds;
  StyleSamples style;
  int met = 0;
  for (int seed = 1; seed <= seeds; ++seed)
  {
    const Stopwatch watch;
    const PlanOutput output = Plan(scene, static_cast<std::uint64_t>(seed), SerialFor());
    seconds.push_back(watch.CpuSeconds());
    met += CountMet(output);
    AppendStyle(output.Tracks[0].Positions, scene.Scene.Time.Step(), style);
  }
  const StyleSamples reference = StyleOf(SwirlDatabase());
  std::printf("%s, %zu triangles, %d frames: median %.3f s, 95th percentile %.3f s of processor "
              "time, %d of %d reached, Kolmogorov-Smirnov %.2f curvature %.2f acceleration\n",
              name, triangles, frames, Quantile(seconds, 0.5), Quantile(seconds, 0.95), met, seeds,
              KolmogorovSmirnov(reference.LogCurvature, style.LogCurvature),
              KolmogorovSmirnov(reference.Acceleration, style.Acceleration));
  std::fflush(stdout);
  return Quantile(seconds, 0.5);
}

/// The same maze without style and without time.
void CompareWithRRTConnect(double median, int runs)
{
#ifdef WAFT_HAS_OMPL
  PlanScene scene;
  AddMaze(scene);
  AddMazeFlight(scene, 300);
  PlanScene::Check(scene.Obstacles.Build(scene.Meshes));
  const MotionObject& object = scene.Objects[0];
  const std::vector<double> seconds =
    RunRRTConnect(scene.Obstacles, scene.Scene.Bounds, object.ClearanceRadius, object.Position,
                  scene.Constraints[0].Value, runs);
  std::printf("RRT-Connect with straight segments (OMPL): median %.3f s, %zu of %d reached; the "
              "planner takes %.1f times as long\n",
              Quantile(seconds, 0.5), seconds.size(), runs, median / Quantile(seconds, 0.5));
#else
  static_cast<void>(median);
  static_cast<void>(runs);
  std::printf("RRT-Connect with straight segments: built without OMPL (libompl-dev), not run\n");
#endif
  std::fflush(stdout);
}

void Letters(int count)
{
  PlanScene scene;
  AddLetters(scene, count);
  PlanScene::Check(scene.Obstacles.Build(scene.Meshes));
  const Stopwatch watch;
  const PlanOutput output = Plan(scene, 1, ThreadedFor(2));
  std::printf("letters of %d objects, 300 frames, 2 threads: %.2f s (%.2f s of processor time), "
              "%d reached, peak memory %.0f MB\n",
              count, watch.Seconds(), watch.CpuSeconds(), CountMet(output), PeakMegabytes());
  std::fflush(stdout);
}

/// The blending of one chain, and the plain way.
void LongChains()
{
  for (const int frames : { 250, 1150, 2950 })
  {
    const PieceChain chain = RandomChain(4, frames);
    const int times = 200000 / frames;
    double seconds[2];
    bool isSame = true;
    for (const bool isPlain : { false, true })
    {
      const Stopwatch watch;
      for (int i = 0; i < times; ++i)
      {
        const std::vector<Vec3> path =
          isPlain ? PlainBlend(Library(), chain) : BlendChain(Library(), chain);
        isSame = isSame && path.size() > 1;
      }
      seconds[isPlain] = watch.CpuSeconds() / times;
    }
    isSame = isSame && BlendChain(Library(), chain) == PlainBlend(Library(), chain);
    std::printf(
      "chain of %d frames, %zu pieces, 1 thread: blended in %.2f CPU-us a frame, the plain "
      "way %.2f, %s\n",
      frames, chain.Pieces.size(), 1e6 * seconds[0] / frames, 1e6 * seconds[1] / frames,
      isSame ? "the same bits" : "OTHER BITS");
  }
}

/// One span each, ever longer: seconds a frame and object should not grow.
void LongSpans(int count)
{
  for (const int frames : { 300, 1200, 3000 })
  {
    PlanScene scene;
    AddLetters(scene, count, frames);
    PlanScene::Check(scene.Obstacles.Build(scene.Meshes));
    const Stopwatch watch;
    const PlanOutput output = Plan(scene, 1, SerialFor());
    const double seconds = watch.CpuSeconds();
    DigestStream positions;
    for (const Track& track : output.Tracks)
    {
      positions.Values(track.Positions);
    }
    std::printf(
      "span of %d frames, %d objects, 1 thread: %.2f s of processor time, %.1f us a frame "
      "and object, %d reached, digest %016llx\n",
      frames - 50, count, seconds, 1e6 * seconds / (count * (frames - 50.0)), CountMet(output),
      static_cast<unsigned long long>(positions.Sum()));
    std::fflush(stdout);
  }
}

} // namespace

int main(int argc, char** argv)
{
  const int seeds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 50;
  const std::string only = argc > 2 ? argv[2] : "";
  const auto isWanted = [&](const char* name) { return only.empty() || only == name; };
  SwirlDatabase();
  MazeSize fine;
  fine.Splits = 5;
  MazeSize narrow;
  narrow.Window = 0.35;
  if (isWanted("maze"))
  {
    CompareWithRRTConnect(Maze("maze", 300, MazeSize(), seeds), seeds);
  }
  if (isWanted("fine"))
  {
    Maze("fine maze", 300, fine, seeds);
  }
  if (isWanted("fast"))
  {
    Maze("fast maze", 200, MazeSize(), seeds);
  }
  if (isWanted("narrow"))
  {
    Maze("narrow maze", 300, narrow, seeds);
  }
  if (isWanted("letters"))
  {
    Letters(125);
    Letters(1000);
  }
  if (isWanted("long"))
  {
    LongChains();
    LongSpans(48);
  }
  return 0;
}
