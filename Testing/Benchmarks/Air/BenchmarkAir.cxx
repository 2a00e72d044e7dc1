// SPDX-License-Identifier: BSD-3-Clause
// WaftBenchmarkAir [objects] [frames] [voxels]: leaves that fall from a cloud to places on the
// ground in one sampled air, part by part; one leaf's drift beside the same by a dense matrix and
// differences; and a heap of leaves that come down on each other.
#include "Air/Drift/DriftTogether.h"
#include "Air/PlainDrift.h"
#include "Air/Run/AirAssimilation.h"
#include "Base/Primitives.h"
#include "Base/Random.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <sys/resource.h>

using namespace waft;

namespace
{

constexpr double SettlingSpeed = 0.5; // m/s

double ProcessorSeconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

double LargestMegabytes()
{
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

AssimilationInput Leaves(int count, int frames)
{
  AssimilationInput input;
  input.Scene.Time = { frames, 30.0 };
  input.Scene.Bounds = { Vec3(-2.0, -2.0, 0.0), Vec3(2.0, 2.0, 4.0) };
  ObstacleMesh ground;
  ground.Mesh = MakeBox({ Vec3(-4.0, -4.0, -1.0), Vec3(4.0, 4.0, 0.0) });
  input.Obstacles.push_back(ground);
  Random random(1);
  for (int o = 0; o < count; ++o)
  {
    MotionObject object;
    object.ObjectId = o;
    object.Position =
      Vec3(random.Uniform(-1.2, 1.2), random.Uniform(-1.2, 1.2), random.Uniform(2.4, 3.4));
    object.SettlingSpeed = SettlingSpeed;
    object.RestHeight = 0.01;
    Constraint row;
    row.ObjectId = o;
    row.Row = o;
    row.Kind = ConstraintKind::Rest;
    row.Frame = frames * 9 / 10;
    row.Until = frames - 1;
    row.Value = Vec3(random.Uniform(-1.5, 1.5), random.Uniform(-1.5, 1.5), 1.0);
    Track track;
    track.ObjectId = o;
    for (int f = 0; f < frames; ++f)
    {
      const double s = std::min(1.0, f / static_cast<double>(row.Frame));
      track.Positions.push_back((1.0 - s) * object.Position +
                                s * Vec3(row.Value.x(), row.Value.y(), object.RestHeight));
    }
    input.Objects.push_back(object);
    input.Constraints.push_back(row);
    input.Tracks.push_back(track);
  }
  return input;
}

void PrintDrifts(const HalfSeries& air, const Track& track, double rate)
{
  DriftProblem problem;
  const std::size_t frames = track.Positions.size();
  problem.Time = { static_cast<int>(frames), rate };
  problem.Law = BodyLaw::Sinking(SettlingSpeed);
  problem.IsFixed.assign(frames, 0);
  problem.Fixed = track.Positions;
  problem.Flight.assign(frames - 1, 1.0);
  problem.IsFixed.front() = problem.IsFixed.back() = 1;
  std::vector<Vec3> fast = track.Positions;
  double begun = ProcessorSeconds();
  constexpr int Times = 20;
  DriftOutcome outcome;
  for (int k = 0; k < Times; ++k)
  {
    fast = track.Positions;
    outcome = SolveDrift(problem, AirSampler(air), {}, 60, fast);
  }
  const double seconds = (ProcessorSeconds() - begun) / Times;
  std::vector<Vec3> slow = track.Positions;
  begun = ProcessorSeconds();
  const double cost = PlainSolveDrift(problem, Unpacked(air), {}, 60, slow);
  const double plain = ProcessorSeconds() - begun;
  std::printf("one leaf's drift: %.4f CPU-s to a cost of %.6g; dense matrix and differences: %.1f "
              "CPU-s to %.6g (%.0f times)\n",
              seconds, outcome.Cost, plain, cost, plain / seconds);
}

// Straight down from a cloud to a dense heap, by the first steps of the way to what they cost
// least.
void PrintHeap(const HalfSeries& air, int count, double rate)
{
  constexpr int Steps = 8;
  constexpr double Radius = 0.035; // m
  const auto frames = static_cast<std::size_t>(air.Values.size());
  const double side = 0.012 * std::sqrt(static_cast<double>(count)); // m, half of the heap's
  Random random(4);
  std::vector<TogetherBody> bodies(static_cast<std::size_t>(count));
  KeptDistances kept(rate);
  std::vector<std::vector<Vec3>> paths;
  for (TogetherBody& body : bodies)
  {
    DriftProblem problem;
    problem.Time = { static_cast<int>(frames), rate };
    problem.Law = BodyLaw::Sinking(SettlingSpeed);
    problem.IsFixed.assign(frames, 0);
    problem.Fixed.assign(frames, Vec3::Zero());
    problem.Flight.assign(frames - 1, 1.0);
    problem.IsFixed.front() = problem.IsFixed.back() = 1;
    const Vec3 from = problem.Fixed.front() =
      random.InBox({ Vec3(-1.0, -1.0, 2.0), Vec3(1.0, 1.0, 3.9) });
    const Vec3 to = problem.Fixed.back() =
      random.InBox({ Vec3(-side, -side, 0.1), Vec3(side, side, 0.1) });
    kept.AddBody(Radius, SettlingSpeed, static_cast<int>(frames),
                 { { 0, from, 0.0 }, { static_cast<int>(frames) - 1, to, 0.0 } });
    paths.emplace_back();
    for (std::size_t f = 0; f < frames; ++f)
    {
      paths.back().push_back(from + static_cast<double>(f) / (frames - 1.0) * (to - from));
    }
    body.Problem = std::make_unique<DriftProblem>(problem);
  }
  const std::vector<DriftContact> contacts = FindContacts(kept, paths, 0.5, SerialFor());
  SilentMonitor monitor;
  SingleRank alone;
  const double begun = ProcessorSeconds();
  (void)SolveTogether(bodies, contacts, AirSampler(air), DriftWeights().Contact, Steps, SerialFor(),
                      alone, monitor, paths);
  std::printf("%d leaves in a heap, %zu contacts: %d steps together %.2f CPU-s\n", count,
              contacts.size(), Steps, ProcessorSeconds() - begun);
}

} // namespace

int main(int argc, char** argv)
{
  const int count = argc > 1 ? std::atoi(argv[1]) : 48;
  const int frames = argc > 2 ? std::atoi(argv[2]) : 300;
  AssimilationOptions options;
  options.Resolution = argc > 3 ? std::atoi(argv[3]) : 64;
  const AssimilationInput input = Leaves(std::max(1, count), std::max(8, frames));
  SilentMonitor monitor;
  AssimilationOutput output;
  const double begun = ProcessorSeconds();
  if (const Result result = AssimilateAir(input, options, {}, SerialFor(), monitor, output);
      !result)
  {
    std::fprintf(stderr, "%s\n", result.Message().c_str());
    return 1;
  }
  std::printf(
    "%d candidates, grid %d^3, %d objects, %d frames, at most %d rounds: %.1f CPU-s, %.0f "
    "MB\n",
    options.Candidates, options.Resolution, count, frames, options.Rounds,
    ProcessorSeconds() - begun, LargestMegabytes());
  double before = 0.0;
  for (const AssimilationRound& row : output.Rounds)
  {
    if (row.Stage != "draw")
    {
      std::printf("  %-12s control %.3f of %.3f m/s, wind %.3f m/s, %6.1f s\n", row.Stage.c_str(),
                  row.Control, row.Flow, row.Wind, row.Seconds - before);
    }
    else if (&row == &output.Rounds.front())
    {
      std::printf("  first draws %23.1f s\n", row.Seconds);
    }
    before = row.Seconds;
  }
  PrintDrifts(output.Air->Velocity, output.Tracks.front(), 30.0);
  PrintHeap(output.Air->Velocity, 1000, 30.0);
  return 0;
}
